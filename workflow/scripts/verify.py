"""Which files of a study do not match what they were made from."""

import json
import sys

from hardcontact import crate, log, provenance

log.start(snakemake.log[0])
folder = json.loads(snakemake.params.canonical)["results"]
found = provenance.check(folder, crate.described(folder))
for line in found.faults:
    print(line)
print(
    f"{folder}: {len(found.files)} files checked, {len(found.faults)} faults, "
    f"{len(found.absent)} inputs not at hand"
)
sys.exit(1 if found.faults else 0)
