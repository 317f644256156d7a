"""Mean plastic pull-off of one pair of scans, at several loads on the contact."""

import json

import numpy as np
import xarray as xr

from hardcontact import adhesion, contact, dataset, log, sphere

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
rhos, radius = np.array(parameters["ranges"]), parameters["radius"]


pair = sphere.pair(
    dataset.read(snakemake.input.substrate),
    dataset.read(snakemake.input.sphere),
    parameters["window"],
    parameters["count"],
)
geometry = pair.pixel_size, radius, pair.window
counts = [
    contact.contact_pixel_count(preload, hardness, pair.pixel_size)
    for preload, hardness in parameters["loads"]
]
contacts = contact.all_lowest_gaps(
    pair.substrate, pair.positions, *geometry, max(counts), pair.roughness
)
outside = adhesion.rough_sphere_sums(
    pair.substrate, pair.roughness, pair.positions, contacts, *geometry, rhos
)
totals = [
    [
        np.mean(
            [
                adhesion.rough_total(outside[k, i, j], gaps, count, rho)
                for (i, j), (gaps, _) in contacts.items()
            ]
        )
        for k, rho in enumerate(rhos)
    ]
    for count in counts
]
forces = adhesion.pull_off_force(np.array(totals), rhos, pair.pixel_size, 1.0)

dataset.write(
    xr.Dataset(
        {"pull_off_force": (("load", "rho"), forces, {"units": "N"})},
        {"rho": ("rho", rhos, {"units": "nm", "long_name": "range of adhesion"})},
        {"work_of_adhesion": 1.0},
    ),
    snakemake.output[0],
    title=f"mean pull-off forces of a pair of scans on {parameters['surface']} at several loads",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
