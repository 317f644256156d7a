"""The pull-off force on a master of finer pixels than the study's, beside coarser ones."""

from hardcontact.config.grids import machine_megabytes, refuse_beyond_memory
from hardcontact.insight.finer_master import FinerMaster, on_several_pixels
from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import small_scale_master

with job(snakemake) as this:
    surface, given = this.parameters["surface"], FinerMaster(**this.parameters["compared"])
    pixels, transition = given.pixels[-1], this.parameters["transition"]
    refuse_beyond_memory("scales.small.pixels, times four here", pixels, machine_megabytes())
    master = small_scale_master(
        generator(this.parameters["seed"], surface, "finer master"),
        read_height_map(this.input.scan),
        pixels,
        transition,
        read_spectrum(this.input.spectrum),
    )
    compared = on_several_pixels(master, given)
    named = {key: this.parameters[key] for key in ("surface", "label", "basis")}
    this.write(
        compared.assign_attrs(named, transition=transition),
        title=f"pull-off force on {surface}, on finer and finer pixels",
    )
