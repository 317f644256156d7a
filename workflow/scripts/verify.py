"""Print the files of a study that do not match their inputs."""

import sys

from hardcontact.base import origin
from hardcontact.base.job import job

with job(snakemake) as job:
    faults, counts = origin.check(job.parameters["results"])
    print(*faults, counts, sep="\n")
    sys.exit(1 if faults else 0)
