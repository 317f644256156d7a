"""A scan with artificial roughness at small scales: the master that Fig. 6 filters."""

from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import small_scale_master

with job(snakemake) as this:
    surface, realization = this.parameters["surface"], this.parameters["realization"]
    master = small_scale_master(
        generator(this.parameters["seed"], surface, realization, "small-scale master"),
        read_height_map(this.input.scan),
        this.parameters["pixels"],
        this.parameters["transition"],
        read_spectrum(this.input.spectrum),
    )
    this.write(
        master.dataset(), title=f"small-scale master: realization {realization} of {surface}"
    )
