"""Metrics and PSDs of every scan, mean metrics, spectra, and example maps: topography.nc."""

from hardcontact.base.dataset import add_labels_and_sources, read_by_name
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.topography import measured_roughness, topography_dataset

with run_job(snakemake) as job:
    params = job.parameters
    attributes = params["attributes"]
    scans = {}
    for scan_id, path in zip(params["scan_ids"], job.input.scans, strict=True):
        scans[tuple(scan_id)] = measured_roughness(load_height_map(path))
    topography = topography_dataset(
        scans=scans,
        spectra=read_by_name(params["surfaces"], job.input.spectra),
        conditionings=read_by_name(params["conditioned"], job.input.conditionings),
        examples=read_by_name(params["surfaces"], job.input.examples),
        confidence=attributes["confidence"],
    )
    topography = add_labels_and_sources(topography, attributes)
    topography.attrs |= {name: attributes[name] for name in ("sphere_surface", "reference_surface")}
    job.write(
        topography, title="topography of all surfaces: rms metrics and power spectral densities"
    )
