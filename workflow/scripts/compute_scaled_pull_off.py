"""Mean pull-off of one filtered master over radii, ranges of adhesion and contact areas."""

from hardcontact.adhesion.contact_scaling import scaled_pull_off
from hardcontact.random import generator
from hardcontact.study.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import large_scale_master, small_scale_master

#: How a master is synthesized, and the key that says how large.
MASTERS = {"small": (small_scale_master, "pixels"), "large": (large_scale_master, "tiles")}

with job(snakemake) as this:
    given = this.parameters
    surface, realization, side = given["surface"], given["realization"], given["side"]
    synthesize, size = MASTERS[side]
    master = synthesize(
        generator(given["seed"], surface, realization, f"{side}-scale scaling"),
        read_height_map(this.input.scan),
        given[size],
        given["transition"],
        read_spectrum(this.input.spectrum),
    )
    this.write_arrays(
        scaled_pull_off(master, given),
        title=f"pull-off of a filtered {side}-scale master of {surface}, scaled",
    )
