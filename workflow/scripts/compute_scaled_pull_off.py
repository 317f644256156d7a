"""Mean pull-off of one filtered master over radii, ranges of adhesion and contact areas."""

from hardcontact.insight.contact_scaling import scaled_pull_off
from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import synthesized_master

with job(snakemake) as this:
    given = this.parameters
    surface, realization, side = given["surface"], given["realization"], given["side"]
    master = synthesized_master(
        side,
        generator(given["seed"], surface, realization, f"{side}-scale scaling"),
        read_height_map(this.input.scan),
        given,
        read_spectrum(this.input.spectrum),
    )
    this.write_arrays(
        scaled_pull_off(master, given),
        title=f"pull-off of a filtered {side}-scale master of {surface}, scaled",
    )
