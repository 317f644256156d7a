"""Interpolation of pull-off forces between the ranges of adhesion at which they are computed."""

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats


def interpolate_to_ranges(forces: Floats, computed_ranges: Floats, new_ranges: Floats) -> Floats:
    """Return forces (..., rho) at new ranges (nm), by a cubic spline in log F and log rho.

    NaN beyond the computed ranges (nm).
    """
    weights = spline_weights(np.log(computed_ranges), np.log(new_ranges))
    return np.asarray(np.exp(np.log(forces) @ weights.T))


def interpolate_to_range(forces: xr.DataArray, rho: float) -> xr.DataArray:
    """Return forces (..., rho, ...) at one rho (nm), by the spline of `interpolate_to_ranges`."""
    weights = spline_weights(np.log(forces.rho.values), np.log(rho))
    logarithms = xr.apply_ufunc(np.log, forces).drop_vars("rho")
    interpolated: xr.DataArray = xr.apply_ufunc(
        np.exp, (logarithms * xr.DataArray(weights, dims="rho")).sum("rho", skipna=False)
    )
    return interpolated


def spline_weights(points: Floats, targets: Floats | float, *, extrapolate: bool = False) -> Floats:
    """Return the weights (..., point) of a cubic spline through ascending points at targets (...).

    A spline is linear in its data, so that one matrix serves all data. NaN beyond the points unless
    the spline is extrapolated.
    """
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(points, np.eye(len(points)), k=min(3, len(points) - 1))
    return np.asarray(spline(targets, extrapolate=extrapolate))
