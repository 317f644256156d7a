"""Drawing a set: which scans of a pool it takes, how high each is, which forces follow."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.sets.pool import height_weights
from hardcontact.statistics import student_log_samples
from hardcontact.surfaces.scan_targets import group_heights
from hardcontact.surfaces.topography import METRICS

__all__ = ["draw_scans", "with_sampled_mean"]

Floats = NDArray[np.float64]

#: Metrics that do not change with the height of a scan.
SHAPES = ("skewness", "kurtosis")

#: How often a set is drawn in search of one with the heights asked for.
TRIES = 1000


def draw_scans(pool: xr.Dataset, rng: np.random.Generator, scans: int) -> xr.Dataset:
    """Draw a set of scans of one substrate from its pool, without replacement.

    A set of which a height would be below those of the pool is drawn again: with six scans or more
    it could be negative.

    Parameters
    ----------
    pool : xarray.Dataset
        Of `pool.compute_pool`, all scans.
    rng : numpy.random.Generator
        Named for the surface and the set.
    scans : int
        Of the set.

    Returns
    -------
    xarray.Dataset
        METRICS (scan), `pull_off_force` (scan, contact_model, rho, contact_y, contact_x) in N on a
        smooth sphere, and `number` (scan) in the pool; scan counts from 1.

    Raises
    ------
    ValueError
        If no set of so many scans is found.
    """
    known = pool["rms_height_of_force"].values
    for _ in range(TRIES):
        drawn = pool.isel(scan=rng.choice(pool.sizes["scan"], scans, replace=False))
        heights = group_heights(
            drawn["rms_height"].values,
            pool.attrs["mean_rms_height"],
            pool.attrs["rms_height_deviation"],
        )
        if heights.min() >= known.min() * (1 - 1e-9):
            return _at_heights(drawn, heights)
    raise ValueError(
        f"expected sets of {scans} scans with rms heights of {pool.attrs['mean_rms_height']:.3g} "
        f"+- {pool.attrs['rms_height_deviation']:.3g} nm, found none above {known.min():.3g} nm in "
        f"{TRIES} tries"
    )


def _at_heights(drawn: xr.Dataset, heights: Floats) -> xr.Dataset:
    """Return scans of a pool with their forces and metrics at other rms heights (scan,) in nm."""
    factor = heights / drawn["rms_height"].values
    weights = height_weights(drawn["rms_height_of_force"].values, heights)
    log_forces = np.einsum("na,na...->n...", weights, drawn["log_force"].values)
    axes = ("scan", "contact_model", "rho", "contact_y", "contact_x")
    metrics = {
        name: ("scan", drawn[name].values * (1.0 if name in SHAPES else factor), drawn[name].attrs)
        for name in METRICS
    }
    return xr.Dataset(
        {
            **metrics,
            "pull_off_force": (axes, np.exp(log_forces), {"units": "N"}),
            "number": ("scan", drawn["scan"].values),
        },
        {
            "scan": np.arange(1, len(heights) + 1),
            **{name: drawn[name] for name in axes[1:]},
        },
    )


def with_sampled_mean(forces: xr.DataArray, rng: np.random.Generator) -> xr.DataArray:
    """Return the forces of measured scans times one sample of what their mean may be.

    Other scans of the surface would have another mean force; the scans that there are keep their
    distribution over contacts.

    Parameters
    ----------
    forces : xarray.DataArray
        (scan, sphere_scan, contact_model, rho, contact_y, contact_x) in N.
    rng : numpy.random.Generator
        Named for the surface and the set.

    Returns
    -------
    xarray.DataArray
        In the order of the forces; a single scan is left as it is.
    """
    axes = ("scan", "contact_model", "rho")
    means = forces.mean([dim for dim in forces.dims if dim not in axes]).transpose(*axes)
    if means.sizes["scan"] < 2:
        return forces
    sample = student_log_samples(rng, means.values, 1)[0]
    factor = xr.DataArray(sample, dims=axes[1:]) / means.mean("scan").drop_vars(axes[1:])
    return (forces * factor).transpose(*forces.dims)
