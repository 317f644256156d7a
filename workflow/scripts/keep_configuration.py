"""The configuration of a study and its table of surfaces, kept with the results."""

import yaml

from hardcontact.base.job import job

with job(snakemake) as job:
    job.write_text(yaml.safe_dump(job.parameters, allow_unicode=True), "configuration")
    job.copy(job.input.surfaces, "surfaces")
