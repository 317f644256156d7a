"""Rigid and plastic pull-off of one pair of scans, at every contact and range of adhesion."""

import json

import numpy as np
import xarray as xr

from hardcontact import adhesion, contact, dataset, log, sphere

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
settings, radius = parameters["contact"], parameters["radius"]
rhos, work = np.array(parameters["ranges"]), 1.0

substrate, roughness, positions, pixel_size, window, stretch = sphere.pair(
    dataset.read(snakemake.input.substrate),
    dataset.read(snakemake.input.sphere),
    settings["window"],
    settings["count"],
)
touching = contact.contact_pixel_count(settings["preload"], settings["hardness"], pixel_size)
contacts = contact.all_lowest_gaps(
    substrate, positions, pixel_size, radius, window, touching, roughness
)


def sums(width, ranges):
    return adhesion.rough_sphere_sums(
        substrate, roughness, positions, contacts, pixel_size, radius, width, ranges
    )


outside = sums(window, rhos)
shape = (settings["count"],) * 2
gaps = np.array([gaps for gaps, _ in contacts.values()]).reshape(*shape, touching)
rigid = np.array(
    [
        [
            [adhesion.rough_total(outside[k, i, j], gaps[i, j], 1, rho) for j in range(shape[1])]
            for i in range(shape[0])
        ]
        for k, rho in enumerate(rhos)
    ]
)
force = adhesion.pull_off_force(
    np.stack([rigid, outside + touching]), rhos[:, None, None], pixel_size, work
)
reference = [parameters["reference_range"]]
narrow, wide = (
    sums(width, reference) + touching for width in (window, window + 2 * substrate.shape[0])
)

dataset.write(
    xr.Dataset(
        {
            "pull_off_force": (
                ("contact_model", "rho", "contact_y", "contact_x"),
                force,
                {"units": "N", "long_name": "pull-off force at W = 1 J/m2"},
            ),
            "closest_approach": (
                ("contact_model", "contact_y", "contact_x"),
                np.stack([gaps[..., 0], gaps[..., -1]]),
                {"units": "nm", "long_name": "approach beyond touching mean planes"},
            ),
            "penetration": (
                ("contact_y", "contact_x"),
                gaps[..., -1] - gaps[..., 0],
                {"units": "nm", "long_name": "approach of plastic beyond rigid contact"},
            ),
            "contact_pixels": ("contact_model", [1, touching], {"units": "1"}),
            "window_change": (
                (),
                float(np.abs(wide / narrow - 1).max()),
                {"units": "1", "long_name": "change of the force by a further period a side"},
            ),
        },
        {
            "contact_model": ["rigid", "plastic"],
            "rho": ("rho", rhos, {"units": "nm", "long_name": "range of adhesion"}),
            "contact_y": ("contact_y", positions * pixel_size, {"units": "nm"}),
            "contact_x": ("contact_x", positions * pixel_size, {"units": "nm"}),
        },
        {"work_of_adhesion": work, "pixel_size": pixel_size, "interpolation_stretch": stretch},
    ),
    snakemake.output[0],
    title="pull-off forces of one pair of substrate and sphere scan",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
