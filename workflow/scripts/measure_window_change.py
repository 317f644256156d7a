"""Change of the plastic force on one scan when the analysis window grows."""

from hardcontact.adhesion.pull_off import window_change
from hardcontact.contact.geometry import read_bodies
from hardcontact.records.job import job

with job(snakemake) as this:
    contact, radius = this.parameters["contact"], this.parameters["radius"]
    spheres = this.input.spheres or [None]
    pairs = (read_bodies(this.input.substrate, sphere, radius, contact) for sphere in spheres)
    this.write_arrays(
        window_change(pairs, contact, this.parameters["reference_range"]),
        title="change of the pull-off force on one substrate scan with the window",
    )
