"""Fits without one surface: a surface that contradicts the law of the others decides them."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from hardcontact.inference.fit import WITHOUT_SURFACE, fit_mean_forces, fit_without_each_surface

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
    fits = fit_without_each_surface(forces_at_one_joule(), forces)
    assert fits["left_out"].values.tolist() == list(STANDOFFS)
    fits_without_odd = fits.sel(left_out="odd", set=2)
    assert fits_without_odd["range_without_surface"].item() == pytest.approx(RANGE, rel=0.01)
    assert fits_without_odd["work_without_surface"].item() == pytest.approx(WORK, rel=0.03)
    assert fits_without_odd["error_without_surface"].item() < 0.02
    fit_to_others = fit_mean_forces(forces_at_one_joule(), forces.drop("odd")).sel(set=2)
    for name, name_without in WITHOUT_SURFACE.items():
        assert fit_to_others[name].item() == fits_without_odd[name_without].item()
    assert (fits["error_without_surface"].sel(left_out=["a", "b"]) > 0.1).all()
    assert (fit_mean_forces(forces_at_one_joule(), forces)["best_error"] > 0.1).all()
