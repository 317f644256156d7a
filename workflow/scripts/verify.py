"""Print the changed or missing files of a study, and those without a record or right inputs."""

import sys

from hardcontact.records.job import run_job
from hardcontact.records.verification import verify_study

with run_job(snakemake) as job:
    faults, summary = verify_study(job.parameters["results"])
    print(*faults, *summary, sep="\n")
    sys.exit(1 if faults else 0)
