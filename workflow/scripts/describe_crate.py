"""The finished study as an RO-Crate."""

from pathlib import Path

from hardcontact.records import crate
from hardcontact.records.job import job
from hardcontact.records.origin import pinned_versions

with job(snakemake) as this:
    this.write_text(
        crate.describe(
            Path(this.output[0]).parent,
            this.parameters["study"],
            this.input.citation,
            pinned_versions(this.input.environment),
        )
    )
