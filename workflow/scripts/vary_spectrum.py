"""Plastic pull-off of masters whose spectrum is drawn within what the measurements leave open."""

from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.scales.filtered_masters import filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.joined_spectrum import drawn_spectrum
from hardcontact.surfaces.scans import flat_measurements
from hardcontact.surfaces.synthesis import SIDES, synthesized_master

with job(snakemake) as this:
    given = this.parameters
    of_master = given["seed"], given["surface"], given["realization"]
    density = drawn_spectrum(
        generator(*of_master, "drawn spectrum"),
        flat_measurements(this.input.scans, given["measuring"]),
        given["measuring"]["tip_radii"],
    )
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    for output, side in enumerate(SIDES):
        scales = given["sides"][side]
        master = synthesized_master(
            side,
            generator(*of_master, f"{side}-scale master"),  # as in the master that it is set beside
            read_height_map(this.input.stitched),
            scales,
            density,
        )
        this.write(
            filtered_pull_off(master, sphere, {**given, "side": side, "scales": scales}),
            title=f"pull-off of a {side}-scale master of a drawn spectrum",
            output=output,
        )
