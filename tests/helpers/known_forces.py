"""Pull-off forces that are powers of the range of adhesion, so that answers are known."""

import numpy as np
import pandas as pd
import xarray as xr
from paper_numbers import MEAN_FORCE, SUBSTRATES

#: Axes of the pull-off forces in adhesion.nc.
FORCE_DIMS = ("surface", "scan", "sphere_scan", "contact_model", "rho", "contact_y", "contact_x")
RHOS = np.array([0.5, 1, 2, 3, 5, 7, 10.0])  # nm
PUBLISHED_MEANS = pd.DataFrame({"mean_force": MEAN_FORCE}, pd.Index(SUBSTRATES, name="surface"))
#: Exponents of the range by surface.
SLOPES = np.array([2.0, 1.3, 0.7, 0.4])


def power_curves(rho=4.0, work=0.05):
    """Return forces (surface, rho) at 1 J/m² that equal the published ones at rho and work."""
    return MEAN_FORCE[:, None] / work * (RHOS / rho) ** SLOPES[:, None]


def power_forces(rho=4.0, work=0.05, spread=0.0, scans=4, seed=0):
    """Return `power_curves` of contacts, each times exp(spread x), with normal random x."""
    rng = np.random.default_rng(seed)
    factor = np.exp(spread * rng.standard_normal((4, scans, scans, 1, 2, 2)))
    return xr.DataArray(
        power_curves(rho, work)[:, None, None, :, None, None] * factor,
        dims=("surface", "scan", "sphere_scan", "rho", "contact_y", "contact_x"),
        coords={"surface": SUBSTRATES, "rho": RHOS},
    )
