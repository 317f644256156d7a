"""rms metrics and PSDs of one scan."""

from hardcontact.records.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.roughness_table import measured_roughness

with job(snakemake) as this:
    this.write(
        measured_roughness(read_height_map(this.input.scan)),
        title="rms metrics and power spectral densities of one scan",
    )
