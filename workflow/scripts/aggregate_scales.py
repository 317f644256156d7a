"""Pull-off forces of every filtered master, and their ratio to the unfiltered one."""

from hardcontact.adhesion.all_surfaces import stacked_filtered_forces, with_transitions
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    forces = stacked_filtered_forces(read_all(given["filters"], this.input.filtered), given)
    this.write(
        with_transitions(forces, given["transitions"]).assign_attrs(
            {name: given[name] for name in ("rho", "sphere_radius")}
        ),
        title="plastic pull-off forces of filtered masters",
    )
