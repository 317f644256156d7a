"""Distribution of the pull-off forces of single contacts: mean, median, log-normal fit."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.statistics import lognormal_fit

__all__ = ["force_statistics"]

#: Samples of the bootstrap for each that is drawn here, because every sample costs a fit.
SAMPLES_PER_FIT = 10

#: What is computed of the forces, with its unit.
STATISTICS = {
    "force_mean": "N",
    "force_median": "N",
    "lognormal_shape": "1",
    "lognormal_median": "N",
    "censored_fraction": "1",
}


def force_statistics(
    forces: np.ndarray, floor: float, bootstrap: Bootstrap, *names: str
) -> xr.Dataset:
    """Return mean, median and censored log-normal fit of the computed forces of one surface.

    Parameters
    ----------
    forces : ndarray (scan, sphere_scan, contact)
        In N, NaN where a scan is missing.
    floor : float
        In N; weaker forces enter the fit as censored ones.
    bootstrap : Bootstrap
        Substrate and sphere scans are resampled together.
    *names : str
        What the random numbers are for.

    Returns
    -------
    xarray.Dataset
        The scalars STATISTICS, each with its interval.
    """
    rng = bootstrap.generator("statistics", *names)
    scans, spheres = (
        np.flatnonzero(np.isfinite(forces).any(axis=axes)) for axes in ((1, 2), (0, 2))
    )
    values = [
        _summary(
            forces[np.ix_(rng.choice(scans, scans.size), rng.choice(spheres, spheres.size))], floor
        )
        for _ in range(bootstrap.samples // SAMPLES_PER_FIT)
    ]
    summary = _summary(forces[np.ix_(scans, spheres)], floor)
    variables: dict[str, Any] = {}
    for (name, unit), value, samples in zip(
        STATISTICS.items(), summary, np.transpose(values), strict=True
    ):
        variables |= bootstrap.with_interval(name, (), value, samples, {"units": unit})
    return xr.Dataset(variables)


def _summary(forces: np.ndarray, floor: float) -> tuple[float, ...]:
    """Return STATISTICS of all forces (N) together."""
    forces = forces.ravel()
    return (forces.mean(), np.median(forces), *lognormal_fit(forces, floor))
