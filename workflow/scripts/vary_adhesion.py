"""Mean plastic pull-off of all pairs of scans of one surface, at several loads on the contact."""

import json

import numpy as np
import xarray as xr

from hardcontact import adhesion, contact, dataset, log, sphere

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
rhos, radius = np.array(parameters["ranges"]), parameters["radius"]


def mean_forces(substrate, rough):
    """Force (load, rho) in N at 1 J/m² of one pair of scans, averaged over its contacts."""
    pair = sphere.pair(
        dataset.read(substrate), dataset.read(rough), parameters["window"], parameters["count"]
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
    return adhesion.pull_off_force(np.array(totals), rhos, pair.pixel_size, 1.0)


keys = [tuple(key) for key in parameters["pairs"]]
paths = zip(keys, snakemake.input.substrates, snakemake.input.spheres, strict=True)
forces = dataset.stack(
    {
        key: xr.Dataset(
            {"pull_off_force": (("load", "rho"), mean_forces(*scans), {"units": "N"})},
            {"rho": ("rho", rhos, {"units": "nm", "long_name": "range of adhesion"})},
        )
        for key, *scans in log.progress(paths, len(keys), "pairs of scans")
    },
    ["scan", "sphere_scan"],
)
dataset.write(
    forces.assign_attrs(work_of_adhesion=1.0),
    snakemake.output[0],
    title=f"mean pull-off forces on {parameters['surface']} at several loads",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
