"""Mean pull-off forces against the range of adhesion: over all scans, sampled, interpolated."""

from typing import Any

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from hardcontact.adhesion.sampling import Sampling
from hardcontact.statistics import student_log_interval, student_log_samples, with_interval

__all__ = [
    "at_range",
    "force_curves",
    "mean_forces",
    "mean_of_each_scan",
    "means_over_scans",
    "on_fine_grid",
]

#: Dimensions of single contacts, and of the sphere scans they are made with.
CONTACTS = ["sphere_scan", "contact_y", "contact_x"]


def mean_of_each_scan(forces: xr.DataArray) -> xr.DataArray:
    """Return the mean force of each scan, over its contacts and the scans of the sphere.

    Parameters
    ----------
    forces : xarray.DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x)
        In N, NaN where a scan is missing.

    Returns
    -------
    xarray.DataArray (surface, scan, rho)
        In N.
    """
    return forces.mean(CONTACTS).transpose("surface", "scan", "rho")


def mean_forces(forces: xr.DataArray, sampling: Sampling) -> tuple[np.ndarray, np.ndarray]:
    """Average forces over all scans of each surface, and sample this mean.

    Parameters
    ----------
    forces : xarray.DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x)
        In N, NaN where a scan is missing.
    sampling : Sampling
        The random numbers of a surface depend on its name alone: contact models share them.

    Returns
    -------
    means : ndarray (surface, rho)
        In N.
    sampled : ndarray (sample, surface, rho)
        In N, as from `student_log_samples`; NaN of a surface of one scan.
    """
    return means_over_scans(mean_of_each_scan(forces), "adhesion", sampling)


def means_over_scans(
    scans: xr.DataArray, purpose: str, sampling: Sampling
) -> tuple[np.ndarray, np.ndarray]:
    """Average the forces of scans of each surface, and sample this mean.

    Parameters
    ----------
    scans : xarray.DataArray (surface, scan, rho)
        Mean force of each in N, NaN where a scan is missing.
    purpose : str
        What the random numbers are for, before the name of the surface.
    sampling : Sampling
        Of the means.

    Returns
    -------
    means, sampled : ndarray (surface, rho) and (sample, surface, rho)
        As `mean_forces` returns them.
    """
    drawn = [
        student_log_samples(
            sampling.generator(purpose, str(surface)),
            scans.sel(surface=surface).dropna("scan").values,
            sampling.samples,
        )
        for surface in scans.surface.values
    ]
    return scans.mean("scan").values, np.stack(drawn, axis=1)


def force_curves(
    forces: xr.DataArray,
    means: np.ndarray,
    sampled: np.ndarray,
    reference: int,
    sampling: Sampling,
) -> dict[str, Any]:
    """Return mean forces, their ratios to a reference surface, and the spread over contacts.

    Parameters
    ----------
    forces : xarray.DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x)
        In N, NaN where a scan is missing.
    means : ndarray (surface, rho)
        As from `mean_forces`, in N.
    sampled : ndarray (sample, surface, rho)
        Likewise.
    reference : int
        Index of the surface.
    sampling : Sampling
        Its confidence is that of the intervals.

    Returns
    -------
    dict
        Variables over surface and rho, ready for `xarray.Dataset`.
    """
    dimensions, newton, one = ("surface", "rho"), {"units": "N"}, {"units": "1"}
    ratio, ratios = means / means[reference], sampled / sampled[:, [reference]]
    spread = forces.std(["scan", *CONTACTS]).values
    interval = student_log_interval(mean_of_each_scan(forces), sampling.confidence, "scan")
    return {
        "contact_spread": (dimensions, spread, newton),
        "ratio_contact_spread": (dimensions, spread / means[reference], one),
        **with_interval(
            "mean_force", dimensions, means, interval.values, newton, sampling.confidence
        ),
        **sampling.with_interval("ratio", dimensions, ratio, ratios, one),
    }


def on_fine_grid(forces: np.ndarray, rhos: np.ndarray, fine: np.ndarray) -> np.ndarray:
    """Return forces (..., rho) on a fine grid of rho, by a cubic spline in log F and log rho.

    NaN beyond the ranges computed.
    """
    interpolated: np.ndarray = np.exp(np.log(forces) @ _weights(rhos, fine))
    return interpolated


def at_range(forces: xr.DataArray, rho: float) -> xr.DataArray:
    """Return forces (..., rho, ...) at one rho in nm, interpolated as `on_fine_grid` does."""
    weights = xr.DataArray(_weights(forces.rho.values, np.array([rho]))[:, 0], dims="rho")
    logarithms = xr.apply_ufunc(np.log, forces).drop_vars("rho")
    interpolated: xr.DataArray = xr.apply_ufunc(
        np.exp, (logarithms * weights).sum("rho", skipna=False)
    )
    return interpolated


def _weights(rhos: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the weights (rho, at) of logarithms at `rhos` in their spline; NaN beyond the ends."""
    degree = min(3, len(rhos) - 1)
    spline = make_interp_spline(np.log(rhos), np.eye(len(rhos)), k=degree)
    weights: np.ndarray = spline(np.log(at), extrapolate=False).T
    return weights
