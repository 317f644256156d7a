"""Asperities that carry the force, of all surfaces and scans."""

from hardcontact.adhesion.all_surfaces import stacked_asperities
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job

with job(snakemake) as this:
    this.write(
        stacked_asperities(read_all(this.parameters["scans"], this.input.scans), this.parameters),
        title="asperities that carry the pull-off force of plastic contacts",
    )
