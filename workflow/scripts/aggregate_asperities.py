"""Asperities that carry the force, of all surfaces and scans."""

from hardcontact.base.dataset import read_all, stack
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import with_names

with job(snakemake) as job:
    scans = read_all(job.parameters["scans"], job.input.scans)
    job.write(
        with_names(stack(scans, ["surface", "scan"]), job.parameters),
        title="asperities that carry the pull-off force of plastic contacts",
    )
