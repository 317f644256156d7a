"""Pull-off forces of every filtered master, and their ratio to the unfiltered force."""

from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import (
    read_masters,
    with_names,
    with_spectrum_shifts,
    with_transitions,
)

with job(snakemake) as job:
    params = job.parameters
    limits = params["realizations"], params["load"]
    forces = read_masters(params["surfaces"], job.input.masters, *limits)
    if job.input.sampled:  # There are none if all surfaces are substitutes.
        sampled = read_masters(params["sampled_surfaces"], job.input.sampled, *limits)
        forces = with_spectrum_shifts(forces, sampled)
    job.write(
        with_transitions(with_names(forces, params), params["transitions"]).assign_attrs(
            {name: params[name] for name in ("rho", "sphere_radius")}
        ),
        title="plastic pull-off forces of filtered masters",
    )
