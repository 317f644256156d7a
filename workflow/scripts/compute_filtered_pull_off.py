"""Plastic pull-off at every contact of a master without the scales beyond one cutoff."""

from hardcontact.records.job import job
from hardcontact.scales.filtered_pull_off import filtered_pull_off
from hardcontact.surfaces.height_map import read_height_map

with job(snakemake) as this:
    master = read_height_map(this.input.master)
    sphere = read_height_map(this.input.sphere) if this.input.sphere else None
    side, cutoff = this.parameters["side"], this.parameters["cutoff"]
    this.write_arrays(
        filtered_pull_off(master, sphere, this.parameters, this.threads),
        title=f"plastic pull-off of a {side}-scale master, cutoff {cutoff} nm",
    )
