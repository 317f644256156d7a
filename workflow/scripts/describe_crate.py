"""The finished study as an RO-Crate."""

from pathlib import Path

from hardcontact.base import crate
from hardcontact.base.job import job
from hardcontact.base.origin import pinned_versions

with job(snakemake) as job:
    job.write_text(
        crate.crate_text(
            Path(job.output[0]).parent,
            job.parameters["study"],
            job.input.citation,
            pinned_versions(job.input.environment),
        )
    )
