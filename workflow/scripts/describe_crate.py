"""The finished study as an RO-Crate."""

from pathlib import Path

from hardcontact.base import crate
from hardcontact.base.job import job
from hardcontact.base.origin import pinned_versions

with job(snakemake) as this:
    this.write_text(
        crate.describe(
            Path(this.output[0]).parent,
            this.parameters["study"],
            this.input.citation,
            pinned_versions(this.input.environment),
        )
    )
