"""Asperities that carry the force, of all surfaces and scans."""

from hardcontact.base.dataset import read_all, stack
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import with_names

with job(snakemake) as this:
    scans = read_all(this.parameters["scans"], this.input.scans)
    this.write(
        with_names(stack(scans, ["surface", "scan"]), this.parameters),
        title="asperities that carry the pull-off force of plastic contacts",
    )
