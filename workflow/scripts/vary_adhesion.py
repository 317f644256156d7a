"""Mean plastic pull-off of one pair of scans, at several loads on the contact."""

from hardcontact.adhesion.pull_off import mean_pull_off_of_pair
from hardcontact.contact.geometry import ContactArray, read_bodies
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    array = ContactArray(window=given["window"], count=given["count"])
    pair = read_bodies(this.input.substrate, this.input.sphere, given["radius"], array)
    this.write_arrays(
        mean_pull_off_of_pair(pair, given["loads"], given["ranges"]),
        title=f"mean pull-off forces of a pair of scans on {given['surface']} at several loads",
    )
