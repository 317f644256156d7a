"""The list of all variables of a study's datasets."""

from pathlib import Path

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.report.dataset_dictionary import page

with job(snakemake) as job:
    job.write_text(page({Path(path).stem: read(path) for path in job.input.datasets}))
