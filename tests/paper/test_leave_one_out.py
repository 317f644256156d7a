"""Fits without one surface: a surface that contradicts the law of the others decides them."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from hardcontact.paper.leave_one_out import NONE_LEFT_OUT, fitted_pairs, leave_one_out_fits

RANGES = np.geomspace(0.5, 20, 9)
RANGE, WORK = 5.0, 0.05
STANDOFFS = {"a": 10.0, "b": 30.0, "c": 60.0, "odd": 20.0}


def forces_at_one_joule():
    """Return forces (set, surface, rho) that fall with the standoff m as exp(-m/rho)."""
    values = [np.exp(-standoff / RANGES) * 1e-3 for standoff in STANDOFFS.values()]
    coordinates = {"set": [1, 2], "surface": list(STANDOFFS), "rho": RANGES}
    return xr.DataArray([values, values], coordinates, ["set", "surface", "rho"])


def test_the_pair_is_recovered_without_the_contradicting_surface():
    forces = pd.Series({name: WORK * 1e-3 * np.exp(-m / RANGE) for name, m in STANDOFFS.items()})
    forces["odd"] *= 5
    fits = leave_one_out_fits(forces_at_one_joule(), forces)
    assert fits["left_out"].values.tolist() == [NONE_LEFT_OUT, *STANDOFFS]
    fits_without_odd = fits.sel(left_out="odd", set=2)
    assert fits_without_odd["range_of_adhesion"].item() == pytest.approx(RANGE, rel=0.01)
    assert fits_without_odd["work_of_adhesion"].item() == pytest.approx(WORK, rel=0.03)
    assert fits_without_odd["best_error"].item() < 0.02
    fits_of_unmeasured = fitted_pairs(forces_at_one_joule(), forces.drop("odd")).sel(set=2)
    xr.testing.assert_equal(fits_of_unmeasured, fits_without_odd.drop_vars("left_out"))
    assert (fits["best_error"].sel(left_out=[NONE_LEFT_OUT, "a", "b"]) > 0.1).all()
