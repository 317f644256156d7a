"""Table 1 and the PSDs: every scan, and their averages."""

from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.surfaces.roughness_table import roughness_table

with job(snakemake) as this:
    keys = [tuple(key) for key in this.parameters.pop("scans")]
    surfaces = dict.fromkeys(surface for surface, _ in keys)
    substitutes = this.parameters.pop("conditioned")
    this.write(
        roughness_table(
            dict(zip(keys, map(dataset.read, this.input.scans), strict=True)),
            dict(zip(surfaces, map(dataset.read, this.input.spectra), strict=True)),
            dict(zip(substitutes, map(dataset.read, this.input.conditionings), strict=True)),
            dict(zip(surfaces, map(dataset.read, this.input.examples), strict=True)),
            **this.parameters,
        ),
        title="topography of all surfaces: rms metrics and power spectral densities",
    )
