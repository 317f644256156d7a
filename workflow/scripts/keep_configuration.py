"""The configuration of a study and its table of surfaces, kept with the results."""

import yaml

from hardcontact.base.job import job

with job(snakemake) as this:
    this.write_text(yaml.safe_dump(this.parameters, allow_unicode=True), "configuration")
    this.copy(this.input.surfaces, "surfaces")
