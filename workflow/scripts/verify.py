"""Print the files of a study that do not match their inputs."""

import sys

from hardcontact.base import crate, provenance
from hardcontact.base.job import job

with job(snakemake) as job:
    folder = job.parameters["results"]
    faults, counts = provenance.check(folder, crate.described_files(folder))
    print(*faults, counts, sep="\n")
    sys.exit(1 if faults else 0)
