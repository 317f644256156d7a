"""The configuration of a study and its table of surfaces, and the list of all its variables."""

from pathlib import Path

import yaml

from hardcontact.base.dataset import read_dataset
from hardcontact.records.job import run_job
from hardcontact.report.templates import render_template

with run_job(snakemake) as job:
    job.write_text(yaml.safe_dump(job.parameters, allow_unicode=True), "configuration")
    job.write_text(Path(job.input.surfaces).read_text("utf-8"), "surfaces")
    datasets = {Path(path).stem: read_dataset(path) for path in job.input.datasets}
    job.write_text(render_template("datasets.md", datasets=datasets), "variables")
