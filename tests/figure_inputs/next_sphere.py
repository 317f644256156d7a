"""Separations of the pairs of range and work of adhesion by a next sphere."""

import numpy as np
import xarray as xr

from figure_inputs.building import RADIUS, generator, named
from hardcontact.insight.next_sphere import PAIRS, SCATTER

RADII = [1e3, 1e4, 1e5, RADIUS, 1e6]
PRELOADS = [1.25e-6, 1e-5, 8e-5]


def next() -> xr.Dataset:
    """Return separations that the scatter between spheres lowers, unknown at 1 µm."""
    rng, shape = generator(), (4, len(PRELOADS), len(RADII))
    apart = rng.uniform(0, 3, shape)
    forces = rng.lognormal(-15, 1, (4, 2, *shape[1:]))
    over = ("surface", "preload", "radius")
    return (
        named()
        .assign_coords(pair=list(PAIRS), preload=PRELOADS, radius=RADII, scatter=list(SCATTER))
        .assign(
            separation=((*over, "scatter"), np.stack([2 * apart, apart], axis=-1)),
            predicted_change=(("surface", "pair", *over[1:]), np.log(forces)),
            predicted_force=(("surface", "pair", *over[1:]), forces),
            tried=(over, np.broadcast_to(np.array(RADII) > 1e3, shape).astype(int)),
            resolved=(over, np.ones(shape, int)),
        )
        .assign_attrs(
            sphere_radius=RADIUS, preload=1e-5, tests=2000, spheres=5, ranges=[8.6, 1.3],
            works=[0.013, 0.092], checked_changes=60, checked_radii=[62500.0, 250e3],
            checked_share=0.97, checked_error=0.2, checked_stated=0.3,
        )
    )  # fmt: skip
