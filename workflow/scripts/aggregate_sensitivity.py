"""How the force follows each octave of wavelengths: sensitivity.nc."""

import numpy as np

from hardcontact.base.dataset import (
    add_labels_and_sources,
    concatenate,
    read_by_key,
    read_dataset,
    stack,
)
from hardcontact.inference.octaves import octave_sensitivities
from hardcontact.inference.scan_parts import fewest_touched_patches, parts_of_maps
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    radius, rho, confidence = params["radius"], params["rho"], params["confidence"]
    # Only the scans of the user may be so few that touched patches matter.
    touched_patches = {}
    if job.input.adhesion:
        touched_patches = fewest_touched_patches(read_dataset(job.input.adhesion))
    forces_by_surface = concatenate(read_by_key(params["maps"], job.input.forces), "map")
    sensitivities = {}
    for (surface,), forces in forces_by_surface.items():
        scan_parts = parts_of_maps(forces, radius, rho, touched_patches.get(surface, np.inf))
        sensitivities[(surface,)] = octave_sensitivities(forces, scan_parts, confidence)
    sensitivity = stack(sensitivities, ["surface"]).sortby("octave")
    job.write(
        add_labels_and_sources(sensitivity, params).assign_attrs(confidence=confidence, rho=rho),
        title="change of the pull-off force with the amplitude of each octave of wavelengths",
    )
