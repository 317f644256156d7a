"""Pull-off forces of all surfaces, pairs of scans, contact models and ranges of adhesion."""

import json

from hardcontact import dataset, log

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
keys = [tuple(key) for key in parameters["pairs"]]
surfaces = list(dict.fromkeys(surface for surface, _, _ in keys))

pairs = [dataset.read(path) for path in snakemake.input.pairs]
count = range(pairs[0].sizes["contact_y"])
forces = dataset.stack(
    {
        key: pair.drop_vars(["contact_pixels", "window_change"]).assign_coords(
            contact_y=count, contact_x=count
        )
        for key, pair in zip(keys, pairs, strict=True)
    },
    ["surface", "scan", "sphere_scan"],
)
checks = dataset.stack(
    {key: pair[["contact_pixels", "window_change"]] for key, pair in zip(keys, pairs, strict=True)},
    ["surface", "scan", "sphere_scan"],
)
forces = forces.assign(
    contact_pixels=checks.contact_pixels.max(["surface", "scan", "sphere_scan"], keep_attrs=True),
    window_change=checks.window_change.max("sphere_scan", keep_attrs=True),
    label=("surface", [parameters["labels"][surface] for surface in surfaces]),
    basis=("surface", [parameters["basis"][surface] for surface in surfaces]),
)

dataset.write(
    forces.assign_attrs(
        work_of_adhesion=1.0,
        reference_rho=parameters["reference_rho"],
        sphere_radius=parameters["sphere_radius"],
    ),
    snakemake.output[0],
    title="pull-off forces at a work of adhesion of 1 J/m2",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
