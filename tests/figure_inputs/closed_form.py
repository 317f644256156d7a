"""The closed form beside computed forces, as numbers without meaning."""

import numpy as np
import xarray as xr
from paper_numbers import LABELS, SUBSTRATES

from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.numbers.statistics import with_interval

RHO = [0.5, 5.6, 20.0]
SHAPE = (len(SUBSTRATES), 2, len(RHO))


def closed_form() -> xr.Dataset:
    """Return forces on two sizes of maps at three ranges, with their errors, edges and regimes."""
    rng = np.random.default_rng(1)
    force = rng.uniform(1e-7, 1e-5, SHAPE)
    dims = ("surface", "map_size", "rho")
    interval = np.stack([0.8 * force, 1.2 * force], axis=-1)
    predicted = rng.uniform(0.5, 2, (*SHAPE, 2)) * force[..., None]
    freezing = rng.uniform(0.1, 9, (SHAPE[0], SHAPE[2]))
    newton = {"units": "N"}
    return xr.Dataset(
        with_interval("computed_force", dims, force, interval, newton, 0.95)
        | {
            "predicted_force": ((*dims, "source"), predicted, newton),
            "first_term_force": ((*dims, "source"), predicted / 2, newton),
            "error": ((*dims, "source"), predicted / force[..., None], {"units": "1"}),
            "whole_freezing": (("surface", "rho"), freezing, {"units": "1"}),
            "freezing": ((*dims, "source"), np.full((*SHAPE, 2), 0.9), {"units": "1"}),
            "predicted_approach": (dims[:2], np.full(SHAPE[:2], 90.0), {"units": "nm"}),
            "regime": (("surface", "rho"), np.where(freezing > 1, SINGLE_PEAKS, MANY_POINTS)),
            "edge": (
                ("surface", "side"),
                [[40.0, 1500.0], [np.nan, 1800.0], [60.0, 2000.0], [80.0, 3000.0]],
                {"units": "nm"},
            ),
            "label": ("surface", LABELS),
            "basis": ("surface", ["substitute"] * len(LABELS)),
        },
        {
            "surface": SUBSTRATES,
            "map_size": [5000.0, 20000.0],
            "rho": RHO,
            "source": ["spectrum", "contacts"],
            "side": ["small", "large"],
        },
        {"range_of_adhesion": 5.6, "confidence": 0.95},
    )
