"""Pull-off forces of every filtered master, and their ratio to the unfiltered force."""

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import (
    single_masters,
    stacked_forces,
    with_names,
    with_spectrum_shifts,
    with_transitions,
)

with job(snakemake) as job:
    params = job.parameters
    master_forces = []
    for surfaces, paths in (
        (params["masters"], job.input.masters),
        (params["sampled"], job.input.sampled),
    ):
        files = [([surface], read(path)) for surface, path in zip(surfaces, paths, strict=True)]
        masters = single_masters(files, params["realizations"], params["load"])
        master_forces += [stacked_forces(masters)] if masters else []
    forces, *sampled_spectrum_forces = master_forces
    if sampled_spectrum_forces:  # There are none if all surfaces are substitutes.
        forces = with_spectrum_shifts(forces, *sampled_spectrum_forces)
    job.write(
        with_transitions(with_names(forces, params), params["transitions"]).assign_attrs(
            {name: params[name] for name in ("rho", "sphere_radius")}
        ),
        title="plastic pull-off forces of filtered masters",
    )
