"""Plastic pull-off at every contact of a master, whole and filtered at every cutoff."""

from hardcontact.records.job import job
from hardcontact.scales.filtered_masters import filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map

with job(snakemake) as this:
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    this.write(
        filtered_pull_off(
            read_height_map(this.input.master), sphere, this.parameters, this.threads
        ),
        title=f"plastic pull-off of a {this.parameters['side']}-scale master at all cutoffs",
    )
