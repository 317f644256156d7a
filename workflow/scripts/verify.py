"""Which files of a study do not match what they were made from."""

import sys

from hardcontact.records import crate, provenance
from hardcontact.records.job import job

with job(snakemake) as this:
    folder = this.parameters["results"]
    result = provenance.check(folder, crate.described_files(folder))
    print(result)
    sys.exit(1 if result.faults else 0)
