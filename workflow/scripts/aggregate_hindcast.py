"""Tests whether forces on your scans may be extrapolated: hindcast.nc."""

from hardcontact.base.dataset import add_labels_and_sources, concatenate, read_by_key, stack
from hardcontact.own.hindcast import hindcast_dataset
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    confidence = params["confidence"]
    forces_by_surface = concatenate(read_by_key(params["scan_ids"], job.input.forces), "map")
    hindcasts = {
        surface: hindcast_dataset(forces, params["tolerance"], confidence)
        for surface, forces in forces_by_surface.items()
    }
    hindcast = add_labels_and_sources(stack(hindcasts, ["surface"]), params)
    job.write(
        hindcast.assign_attrs(confidence=confidence, rho=params["rho"]),
        title="pull-off forces with artificial in place of measured roughness, and on wider pixels",
    )
