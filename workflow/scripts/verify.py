"""Print the files of a study that do not match their inputs."""

import sys

from hardcontact.base.job import run_job
from hardcontact.base.verification import check

with run_job(snakemake) as job:
    faults, summary = check(job.parameters["results"])
    print(*faults, *summary, sep="\n")
    sys.exit(1 if faults else 0)
