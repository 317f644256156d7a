"""Rigid and plastic pull-off of one pair of scans, at every contact and range of adhesion."""

from hardcontact.adhesion.pull_off import pull_off_of_pair
from hardcontact.contact.geometry import read_bodies
from hardcontact.records.job import job

with job(snakemake) as this:
    contact, radius = this.parameters["contact"], this.parameters["radius"]
    pair = read_bodies(this.input.substrate, this.input.sphere or None, radius, contact)
    this.write_arrays(
        pull_off_of_pair(pair, contact, this.parameters["ranges"]),
        title="pull-off forces of one pair of substrate and sphere scan",
    )
