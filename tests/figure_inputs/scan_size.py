"""Excess of forces on small scans, as numbers without meaning."""

import numpy as np
import xarray as xr

from figure_inputs.building import bounded, named
from hardcontact.adhesion.scan_size_trials import RATIOS

SIZES, RHO, TRIALS = [1250.0, 2500.0, 5000.0], [1.4, 5.6], 5
DIMENSIONS = ("surface", "scan_size", "rho")


def scan_size() -> xr.Dataset:
    """Return factors of the force that differ by all they depend on."""
    excess = 1 + np.arange(4 * 3 * 2.0).reshape(4, 3, 2) / 10
    known = 1 + np.arange(TRIALS * 3 * 2.0).reshape(TRIALS, 3, 2) / 20
    data = named().assign_coords(
        scan_size=SIZES, rho=RHO, ratio=RATIOS,
        tested=["random surfaces", "surfaces"], kind=["corrected", "uncorrected"],
    )  # fmt: skip
    return data.assign(bounded("excess", DIMENSIONS, excess)).assign(
        predicted_excess=(DIMENSIONS, 1.1 * excess),
        known_excess=(("trial", *DIMENSIONS[1:]), known),
        predicted_known_excess=(("trial", *DIMENSIONS[1:]), 0.9 * known),
        strength=0.25,
        exponent=("ratio", [1.3, 0.1, -0.4]),
        error=(("tested", "kind"), np.log([[1.1, 1.5], [1.2, 2.0]])),
        size_needed=(("surface", "rho"), 1e3 * np.arange(1.0, 9).reshape(4, 2)),
    ).assign_attrs(
        sphere_radius=250e3, surface_size=20e3, allowed_excess=1.1, rho=5.6, scan_size=2500.0
    )  # fmt: skip
