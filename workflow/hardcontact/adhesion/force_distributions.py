"""Distribution of the pull-off forces of single contacts: mean, median, log-normal fit."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.sampling import Sampling
from hardcontact.statistics import (
    jackknife_interval,
    lognormal_fit,
    student_interval,
    student_log_interval,
    with_interval,
)

__all__ = ["force_statistics"]

#: What is computed of the forces, with its unit.
STATISTICS = {
    "force_mean": "N",
    "force_median": "N",
    "lognormal_shape": "1",
    "lognormal_median": "N",
    "censored_fraction": "1",
}

#: Those of the forces of all scans together.
POOLED = ["force_median", "lognormal_shape", "lognormal_median"]


def force_statistics(forces: np.ndarray, floor: float, sampling: Sampling) -> xr.Dataset:
    """Return mean, median and censored log-normal fit of the computed forces of one surface.

    Parameters
    ----------
    forces : ndarray (scan, sphere_scan, contact)
        In N, NaN where a scan, a scan of the sphere or a contact is missing.
    floor : float
        In N; weaker forces enter the fit as censored ones.
    sampling : Sampling
        Its confidence is that of the intervals; without samples there are none.

    Returns
    -------
    xarray.Dataset
        The scalars STATISTICS, each with its interval over substrate scans: of the mean by
        Student's t on the logarithms of the scans' means, of the censored fraction by Student's t
        on the scans' fractions, of those of POOLED by the jackknife. All NaN where all forces are.
    """
    scans, spheres, contacts = (
        np.isfinite(forces).any(axis=axes) for axes in ((1, 2), (0, 2), (0, 1))
    )
    known = forces[np.ix_(scans, spheres, contacts)]
    known = known.reshape(scans.sum(), spheres.sum() * contacts.sum())
    by_scan = xr.DataArray(known, dims=("scan", "contact"))
    mean = by_scan.mean("contact")
    below = (by_scan < floor).mean("contact")
    pooled = _pooled(known, floor)
    ends = dict.fromkeys(STATISTICS, np.full(2, np.nan))
    if sampling.samples:
        confidence = sampling.confidence
        left_out = [_pooled(np.delete(known, scan, axis=0), floor) for scan in range(len(known))]
        of_pooled = jackknife_interval(pooled, left_out, confidence)
        ends = dict(zip(POOLED, of_pooled, strict=True))
        ends["force_mean"] = student_log_interval(mean, confidence, "scan").values
        ends["censored_fraction"] = student_interval(below, confidence, "scan").clip(0, 1).values
    values = dict(zip(POOLED, pooled, strict=True))
    values |= {"force_mean": float(mean.mean()), "censored_fraction": float(below.mean())}
    variables: dict[str, Any] = {}
    for name, unit in STATISTICS.items():
        variables |= with_interval(
            name, (), values[name], ends[name], {"units": unit}, sampling.confidence
        )
    return xr.Dataset(variables)


def _pooled(forces: np.ndarray, floor: float) -> np.ndarray:
    """Return those of POOLED of all forces (N) together: (3,), NaN where there is no force."""
    if not forces.size:
        return np.full(len(POOLED), np.nan)
    shape, median, _ = lognormal_fit(forces.ravel(), floor)
    return np.array([np.median(forces), shape, median])
