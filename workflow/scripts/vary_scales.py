"""Mean plastic pull-off of one master, filtered at every cutoff, at several loads."""

from hardcontact.numbers.random import generator
from hardcontact.records.job import job
from hardcontact.scales.filtered_pull_off import mean_filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import synthesized_master

with job(snakemake) as this:
    given = this.parameters
    surface, realization, side = given["surface"], given["realization"], given["side"]
    master = synthesized_master(
        side,
        generator(given["seed"], surface, realization, f"{side}-scale variant"),
        read_height_map(this.input.scan),
        given["scales"],
        read_spectrum(this.input.spectrum),
    )
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    this.write_arrays(
        mean_filtered_pull_off(master, sphere, given),
        title=f"mean pull-off of a filtered {side}-scale master of {surface}",
    )
