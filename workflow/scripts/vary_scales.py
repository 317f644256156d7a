"""Plastic pull-off of the masters of one realization at every cutoff and several loads."""

from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.scales.filtered_pull_off import filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import synthesized_master

with job(snakemake) as this:
    given, surface = this.parameters, this.parameters["surface"]
    scan, spectrum = read_height_map(this.input.scan), read_spectrum(this.input.spectrum)
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    for side, scales in given["sides"].items():
        rng = generator(given["seed"], surface, given["realization"], f"{side}-scale variant")
        master = synthesized_master(side, rng, scan, scales, spectrum)
        this.write(
            filtered_pull_off(master, sphere, {**given, "side": side, "scales": scales}),
            title=f"pull-off of a filtered {side}-scale master of {surface}",
            output=side,
        )
