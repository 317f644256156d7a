"""Pull-off forces of every filtered master, and their ratio to the unfiltered one."""

from hardcontact.adhesion.all_surfaces import (
    at_load,
    stacked_forces,
    with_names,
    with_spectrum_shifts,
    with_transitions,
)
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    forces, *varied = (
        stacked_forces({key: at_load(one, given["load"]) for key, one in parts.items()})
        for parts in (
            read_all(given["masters"], this.input.masters),
            read_all(given["varied"], this.input.varied),
        )
        if parts
    )
    if varied:
        forces = with_spectrum_shifts(forces, *varied)
    this.write(
        with_transitions(with_names(forces, given), given["transitions"]).assign_attrs(
            {name: given[name] for name in ("rho", "sphere_radius")}
        ),
        title="plastic pull-off forces of filtered masters",
    )
