"""Metrics and PSDs of every scan, mean metrics, spectra, and example maps: topography.nc."""

from hardcontact.base.dataset import add_surface_names, read_by_name
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.topography import measured_roughness, topography_dataset

with run_job(snakemake) as job:
    params = job.parameters
    scan_paths = zip(params["scan_ids"], job.input.scans, strict=True)
    attributes = params["attributes"]
    topography = topography_dataset(
        scans={tuple(key): measured_roughness(load_height_map(path)) for key, path in scan_paths},
        spectra=read_by_name(params["surfaces"], job.input.spectra),
        conditionings=read_by_name(params["conditioned"], job.input.conditionings),
        examples=read_by_name(params["surfaces"], job.input.examples),
        confidence=attributes["confidence"],
    )
    job.write(
        add_surface_names(topography, attributes).assign_attrs(
            sphere_surface=attributes["sphere_surface"],
            reference_surface=attributes["reference_surface"],
        ),
        title="topography of all surfaces: rms metrics and power spectral densities",
    )
