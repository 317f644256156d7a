"""Table 1 and the PSDs: every scan, and their averages."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.roughness_table import measured_roughness, roughness_table

with job(snakemake) as job:
    keys = [tuple(key) for key in job.parameters.pop("scans")]
    paths = dict(zip(keys, job.input.scans, strict=True))
    first_scans = {surface: path for (surface, _), path in reversed(paths.items())}
    surfaces = dict.fromkeys(surface for surface, _ in keys)
    substitutes = job.parameters.pop("conditioned")
    job.write(
        roughness_table(
            {key: measured_roughness(read_height_map(path)) for key, path in paths.items()},
            dict(zip(surfaces, map(dataset.read, job.input.spectra), strict=True)),
            dict(zip(substitutes, map(dataset.read, job.input.conditionings), strict=True)),
            {surface: dataset.read(path) for surface, path in first_scans.items()},
            **job.parameters,
        ),
        title="topography of all surfaces: rms metrics and power spectral densities",
    )
