"""Scans of a set: drawn from a pool and scaled, or measured and scaled to another mean force.

The rms heights of drawn scans are scaled to those of Table 1; their forces follow by interpolation
between the rms heights of the pool.
"""

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import student_log_samples
from hardcontact.base.units import NEWTON
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import spline_weights
from hardcontact.surfaces.conditioning import scale_rms_heights
from hardcontact.surfaces.metrics import TABLE1_METRICS

#: Largest number of tries to find a set with possible heights.
MAX_TRIES = 1000


def sample_scans(pool: xr.Dataset, rng: np.random.Generator, scan_count: int) -> xr.Dataset:
    """Sample the scans of one substrate in a set from its pool, without replacement.

    Their rms heights are scaled to the mean and deviation of Table 1. A height may then be below
    the lowest computed height, for six scans or more even negative. Such a set is sampled again.
    Raises ValueError if no set with possible heights is found.
    """
    lowest = pool["rms_height_of_force"].values.min()
    mean = pool.attrs["mean_rms_height"]
    deviation = pool.attrs["rms_height_deviation"]
    for _ in range(MAX_TRIES):
        pool_scans = pool.isel(scan=rng.choice(pool.sizes["scan"], scan_count, replace=False))
        heights = scale_rms_heights(pool_scans["rms_height"].values, mean, deviation)
        if heights.min() >= lowest * (1 - 1e-9):
            return _scale_scans(pool_scans, heights)
    raise ValueError(
        f"expected sets of {scan_count} scans with rms heights of {mean:.3g} +- {deviation:.3g} "
        f"nm, found none above {lowest:.3g} nm in {MAX_TRIES} tries"
    )


def _scale_scans(pool_scans: xr.Dataset, heights: Floats) -> xr.Dataset:
    """Return the forces and metrics of scans of a pool at other rms heights (scan,) in nm."""
    factor = heights / pool_scans["rms_height"].values
    computed_heights = pool_scans["rms_height_of_force"].values
    # The spline is smooth in the root, because forces change faster at small heights.
    weights = spline_weights(np.sqrt(computed_heights), np.sqrt(heights), extrapolate=True)
    log_forces = np.einsum("na,na...->n...", weights, pool_scans["log_force"].values)
    axes = ("scan", "contact_model", "rho", *CONTACT_AXES)
    variables = {
        name: ("scan", pool_scans[name].values * factor, pool_scans[name].attrs)
        for name in TABLE1_METRICS.values()
    } | {
        "pull_off_force": (axes, np.exp(log_forces), NEWTON),
        "number": ("scan", pool_scans["scan"].values),
    }
    coordinates = {"scan": np.arange(1, len(heights) + 1)}
    return xr.Dataset(variables, coordinates | {name: pool_scans[name] for name in axes[1:]})


def scale_to_sampled_mean(forces: xr.DataArray, rng: np.random.Generator) -> xr.DataArray:
    """Scale the forces of measured scans to a sampled mean.

    Other scans of the surface would have another mean force. The distribution over contacts stays
    the same. A single scan keeps its forces.
    """
    axes = ("scan", "contact_model", "rho")
    means = forces.mean([dim for dim in forces.dims if dim not in axes]).transpose(*axes)
    if means.sizes["scan"] < 2:
        return forces
    sample = student_log_samples(rng, means.values, 1)[0]
    factor = xr.DataArray(sample, dims=axes[1:]) / means.mean("scan").drop_vars(axes[1:])
    return (forces * factor).transpose(*forces.dims)
