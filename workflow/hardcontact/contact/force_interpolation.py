"""Forces between the computed ranges of adhesion, by cubic splines."""

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from hardcontact.base.arrays import Floats


def spline_weights(points: Floats, targets: Floats | float, *, extrapolate: bool = False) -> Floats:
    """Return the weights (..., point) of a cubic spline through ascending points at targets (...).

    A spline is linear in its data, so that the weights serve all data. They are NaN beyond the
    points unless `extrapolate` is True.
    """
    spline = make_interp_spline(points, np.eye(len(points)), k=min(3, len(points) - 1))
    return np.asarray(spline(targets, extrapolate=extrapolate))


def interpolate_to_ranges(
    forces: Floats, computed_ranges: Floats, new_ranges: Floats | float
) -> Floats:
    """Return forces (..., rho) at new ranges by a cubic spline in log F and log rho; NaN beyond."""
    weights = spline_weights(np.log(computed_ranges), np.log(new_ranges))
    return np.asarray(np.exp(np.log(forces) @ weights.T))


def interpolate_forces(forces: xr.DataArray, rho: float) -> xr.DataArray:
    """Return forces (...) at one range, from forces with the dimension rho, by the same spline."""
    interpolated: xr.DataArray = xr.apply_ufunc(
        interpolate_to_ranges, forces, forces["rho"], rho, input_core_dims=[["rho"], ["rho"], []]
    )
    return interpolated
