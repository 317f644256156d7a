"""Plasticity indices, areas and forces where the bearing area is wrong."""

import numpy as np
import xarray as xr

from figure_inputs.building import bounded, generator, named
from hardcontact.insight.elastic_limit import VARIANTS


def elastic_limit() -> xr.Dataset:
    """Return indices that grow from surface to surface, areas and forces."""
    rng = generator()
    scale = np.reshape([0.2, 1, 2, 4], (4, 1, 1, 1))
    solved = rng.lognormal(6, 0.5, (4, 3, 2))
    shares = np.array([0.0, 0.5, 0.9, 1.0])
    ratios = np.stack([np.ones(4), shares, 3 - 2 * shares, 0.5 * np.ones(4)], axis=1)
    wavelengths = xr.Variable("shortest_wavelength", [0.1, 1.0, 10.0, 100.0])
    slope = xr.Variable("surface", [0.1, 1.0, 2.0, 4.0]) * wavelengths**-0.5
    slope = xr.DataArray(slope, {"shortest_wavelength": wavelengths})
    return (
        named()
        .assign_coords(scan=[1, 2, 3], variant=VARIANTS)
        .assign(
            bounded("plastic_share", "surface", shares)
            | bounded("solved_plastic_share", "surface", shares / 2)
            | bounded("force_ratio", ("surface", "variant"), ratios)
        )
        .assign(
            plasticity_index=(
                ("surface", "scan", "contact_y", "contact_x"),
                scale * rng.lognormal(0, 0.3, (4, 3, 4, 4)),
            ),
            solved_area=(("surface", "scan", "contact"), solved),
            estimated_area=(("surface", "scan", "contact"), solved / 2),
        )
        .assign(slope_index=slope)
        .assign_attrs(bearing_area=405.0, pixel_size=5.0)
    )
