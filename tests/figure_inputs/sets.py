"""The dataset of many sets of substitutes: their fits and their bands."""

import numpy as np
import xarray as xr
from paper_numbers import SUBSTRATES

from figure_inputs.building import generator
from figure_inputs.scales import (
    CHANGE_DIMS,
    CUTOFFS,
    EDGES,
    RATIO_DIMS,
    SIDES,
    changes,
    critical_wavelengths,
    ratios,
)

SETS = 100


def sets() -> xr.Dataset:
    """Return sets that put the range on either side of 5 nm, as those of the study do."""
    rng = generator()
    ratio = ratios(EDGES * rng.lognormal(0, 0.25, (SETS, *EDGES.shape)))
    change = changes(ratio)
    ranges = np.where(np.arange(SETS) < 58, 9.0, 1.3)[:, None] * rng.lognormal(0, 0.1, (SETS, 2))
    fits = ("set", "contact_model")
    return xr.Dataset(
        {
            "range_of_adhesion": (fits, ranges, {"units": "nm"}),
            "work_of_adhesion": (fits, 0.12 / ranges, {"units": "J m-2"}),
            "scale_ratio": (("set", *RATIO_DIMS), ratio, {"units": "1"}),
            "scale_change": (("set", *CHANGE_DIMS), change, {"units": "1"}),
            "critical_wavelength": (
                ("set", "side", "group"),
                critical_wavelengths(change),
                {"units": "nm"},
            ),
        },
        {
            "set": np.arange(1, SETS + 1),
            "contact_model": ["rigid", "plastic"],
            "surface": SUBSTRATES,
            "side": SIDES,
            "group": [*SUBSTRATES, "pooled"],
            "cutoff_wavelength": CUTOFFS,
        },
    ).isel(cutoff_wavelength=slice(1, -1))  # fewer cutoffs than the study
