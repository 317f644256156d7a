"""Pull-off forces of every filtered master, and their ratio to the unfiltered force."""

from hardcontact.base.job import run_job
from hardcontact.contact.stacked_datasets import add_names
from hardcontact.inference.master_datasets import (
    add_spectrum_shifts,
    add_transitions,
    read_master_forces,
)

with run_job(snakemake) as job:
    params = job.parameters
    count, load = params["realizations"], params["load"]
    forces = read_master_forces(params["surfaces"], job.input.masters, count, load)
    if job.input.sampled:  # There are none if all surfaces are substitutes.
        sampled_forces = read_master_forces(
            params["sampled_surfaces"], job.input.sampled, count, load
        )
        forces = add_spectrum_shifts(forces, sampled_forces)
    job.write(
        add_transitions(add_names(forces, params), params["transitions"]).assign_attrs(
            {name: params[name] for name in ("rho", "sphere_radius")}
        ),
        title="plastic pull-off forces of filtered masters",
    )
