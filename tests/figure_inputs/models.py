"""The closed form and models of others beside computed forces, as numbers without meaning."""

import xarray as xr

from figure_inputs.building import bounded, generator, named
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.insight.other_models import MODELS

RHO = [1.0, 5.6]


def models() -> xr.Dataset:
    """Return factors of six models on eight designed surfaces and four at two ranges."""
    rng = generator()
    return (
        named()
        .assign_coords(model=MODELS, design=range(8), rho=RHO, regime=[MANY_POINTS, SINGLE_PEAKS])
        .assign(
            bounded("median_factor", ("model", "regime"), rng.uniform(0.3, 3, (6, 2)))
            | {
                "factor": (("model", "design"), rng.uniform(0.1, 9, (6, 8))),
                "surface_factor": (("model", "surface", "rho"), rng.uniform(0.1, 9, (6, 4, 2))),
                "modulus": ("design", rng.uniform(0, 9, 8)),
                "surface_modulus": (("surface", "rho"), rng.uniform(0.1, 9, (4, 2))),
                "held_back": ("design", [0, 0, 1, 1] * 2),
                "force_error": ("design", rng.uniform(0, 0.2, 8)),
                "rms_factor": (("model", "regime"), rng.uniform(1, 4, (6, 2))),
                "last_wrong": ("model", rng.uniform(0.1, 9, 6)),
            }
        )
    )
