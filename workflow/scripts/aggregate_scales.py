"""Pull-off forces of every filtered master, and their ratio to the unfiltered one."""

import json

from hardcontact import dataset, log

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
parts = {
    tuple(key): dataset.read(path)
    for key, path in zip(parameters["filters"], snakemake.input.filtered, strict=True)
}
count = range(next(iter(parts.values())).sizes["contact_y"])
parts = {
    (*key, side, cutoff): part.assign_coords(contact_y=count, contact_x=count).assign(
        unfiltered_wavelength=part.attrs[
            "shortest_wavelength" if side == "small" else "longest_wavelength"
        ]
    )
    for (*key, side, cutoff), part in parts.items()
}
surfaces = list(dict.fromkeys(surface for surface, *_ in parts))
dimensions = ["surface", "realization", "side"]

unfiltered = dataset.stack(
    {tuple(key): part for (*key, cutoff), part in parts.items() if cutoff == "none"}, dimensions
)
filtered = dataset.stack(
    {
        (*key, float(cutoff.removesuffix("nm"))): part[["pull_off_force"]]
        for (*key, cutoff), part in parts.items()
        if cutoff != "none"
    },
    [*dimensions, "cutoff_wavelength"],
).sortby("cutoff_wavelength")
contacts = ["contact_y", "contact_x"]
scales = filtered.assign(
    unfiltered_pull_off_force=unfiltered.pull_off_force,
    unfiltered_wavelength=unfiltered.unfiltered_wavelength.isel(realization=0, drop=True),
    ratio=filtered.pull_off_force.mean(contacts) / unfiltered.pull_off_force.mean(contacts),
    label=("surface", [parameters["labels"][surface] for surface in surfaces]),
    basis=("surface", [parameters["basis"][surface] for surface in surfaces]),
)
scales.ratio.attrs = {"units": "1", "long_name": "mean pull-off force over that unfiltered"}
scales.unfiltered_wavelength.attrs = {"units": "nm", "long_name": "end of the unfiltered spectrum"}
scales.cutoff_wavelength.attrs = {"units": "nm", "long_name": "cutoff wavelength"}

dataset.write(
    scales.assign_attrs(
        work_of_adhesion=1.0, rho=parameters["rho"], sphere_radius=parameters["sphere_radius"]
    ),
    snakemake.output[0],
    title="plastic pull-off forces of filtered masters",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
