"""The force on the band alone, relative to that with all roughness: band_forces.nc."""

from hardcontact.base.dataset import add_surface_names, read_by_name
from hardcontact.inference.band_forces import band_ratios_by_surface
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    rho, confidence = params["rho"], params["confidence"]
    forces = read_by_name(params["band_surfaces"], job.input.surfaces)
    ratios = band_ratios_by_surface(forces, params["radius"], rho, confidence)
    # Measured surfaces have no whole surfaces, and so NaN.
    band_forces = ratios.reindex(surface=params["surfaces"])
    job.write(
        add_surface_names(band_forces, params).assign_attrs(confidence=confidence, rho=rho),
        title="pull-off force with a part of the roughness, relative to that with all roughness",
    )
