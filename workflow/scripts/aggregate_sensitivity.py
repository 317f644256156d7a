"""How the force follows each octave, and the force on the band alone: sensitivity.nc."""

import xarray as xr

from hardcontact.base.dataset import add_surface_names, concatenate, read, read_all
from hardcontact.inference.band_forces import band_ratios_by_surface
from hardcontact.inference.hindcast import hindcast_ratios_by_surface
from hardcontact.inference.octaves import sensitivities_by_surface
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    files = read_all(params["maps"], job.input.forces)
    maps = {surface: forces for (surface,), forces in concatenate(files, "map", 1).items()}
    bands = dict(zip(params["bands"], map(read, job.input.bands), strict=True))
    touched_patches = fewest_touched_patches(read(job.input.adhesion)) if job.input.adhesion else {}
    radius, rho, confidence = params["radius"], params["rho"], params["confidence"]
    results = [sensitivities_by_surface(maps, radius, rho, touched_patches, confidence)]
    measured_maps = {name: forces for name, forces in maps.items() if "scan_octave_force" in forces}
    if measured_maps:
        results.append(hindcast_ratios_by_surface(measured_maps, params["tolerance"], confidence))
    if bands:  # Measured scans are too small for the long waves of the band.
        results.append(band_ratios_by_surface(bands, radius, rho, confidence))
    job.write(
        add_surface_names(xr.merge(results), params).assign_attrs(confidence=confidence, rho=rho),
        title="change of the pull-off force with the amplitude of each octave of wavelengths",
    )
