"""Table 1 and the PSDs: every scan, and their averages."""

from hardcontact.base import dataset
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.metrics import measured_roughness, roughness_table

with run_job(snakemake) as job:
    params = job.parameters
    keys = [tuple(key) for key in params.pop("scan_keys")]
    paths = dict(zip(keys, job.input.scans, strict=True))
    first_scans = {surface: path for (surface, _), path in reversed(paths.items())}
    surfaces = dict.fromkeys(surface for surface, _ in keys)
    spectra = zip(surfaces, job.input.spectra, strict=True)
    conditionings = zip(params.pop("conditioned"), job.input.conditionings, strict=True)
    job.write(
        roughness_table(
            {key: measured_roughness(load_height_map(path)) for key, path in paths.items()},
            {surface: dataset.read(path) for surface, path in spectra},
            {surface: dataset.read(path) for surface, path in conditionings},
            {surface: dataset.read(path) for surface, path in first_scans.items()},
            **params,
        ),
        title="topography of all surfaces: rms metrics and power spectral densities",
    )
