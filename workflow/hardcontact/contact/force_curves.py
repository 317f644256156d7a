"""Pull-off forces over scans: means against the range of adhesion, distributions of contacts."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.statistics import (
    Sampling,
    jackknife_interval,
    lognormal_fit,
    student_interval,
    student_log_interval,
    student_log_samples,
    with_interval,
)

#: Dimensions of single contacts, and of the sphere scans they are made with.
CONTACTS = ["sphere_scan", "contact_y", "contact_x"]


def mean_of_each_scan(forces: xr.DataArray) -> xr.DataArray:
    """Return the mean force (surface, scan, rho) of each scan, over CONTACTS that forces have."""
    contacts = [name for name in CONTACTS if name in forces.dims]
    return forces.mean(contacts).transpose("surface", "scan", "rho")


def mean_forces(
    forces: xr.DataArray, sampling: Sampling, purpose: str = "adhesion"
) -> tuple[np.ndarray, np.ndarray]:
    """Average forces over all scans of each surface, and sample this mean.

    Forces (surface, scan, rho), of scans or of their contacts, are NaN where a scan is missing.
    Samples (sample, surface, rho) by `student_log_samples` are NaN for a surface with a single
    scan. The random numbers of a surface depend on the purpose and its name alone: contact models
    share them.
    """
    scans = mean_of_each_scan(forces)
    samples = [
        student_log_samples(
            sampling.generator(purpose, str(surface)),
            scans.sel(surface=surface).dropna("scan").values,
            sampling.samples,
        )
        for surface in scans.surface.values
    ]
    return scans.mean("scan").values, np.stack(samples, axis=1)


def force_curves(
    forces: xr.DataArray, means: np.ndarray, sampled: np.ndarray, reference: int, sampling: Sampling
) -> dict[str, Any]:
    """Return mean forces and their ratios to a reference surface, over surface and rho.

    Forces (surface, scan, sphere_scan, rho, contact_y, contact_x) have the means and samples of
    `mean_forces`; the reference is the index of a surface.
    """
    dimensions = ("surface", "rho")
    ratio, ratios = means / means[reference], sampled / sampled[:, [reference]]
    interval = student_log_interval(mean_of_each_scan(forces), sampling.confidence, "scan")
    return {
        **with_interval(
            "mean_force", dimensions, means, interval.values, {"units": "N"}, sampling.confidence
        ),
        **sampling.with_interval("ratio", dimensions, ratio, ratios, {"units": "1"}),
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


def _weights(rhos: np.ndarray, ranges: np.ndarray) -> np.ndarray:
    """Return weights (rho, range) of logarithms at `rhos` in their spline; NaN beyond the ends."""
    from scipy.interpolate import make_interp_spline

    degree = min(3, len(rhos) - 1)
    spline = make_interp_spline(np.log(rhos), np.eye(len(rhos)), k=degree)
    weights: np.ndarray = spline(np.log(ranges), extrapolate=False).T
    return weights


#: What is computed of the forces, with its unit.
STATISTICS = {
    "mean_force_at_pair": "N",
    "median_force_at_pair": "N",
    "lognormal_shape": "1",
    "lognormal_median": "N",
    "censored_fraction": "1",
}

#: Those of the forces of all scans together.
POOLED = ["median_force_at_pair", "lognormal_shape", "lognormal_median"]


def force_statistics(forces: np.ndarray, floor: float, sampling: Sampling) -> xr.Dataset:
    """Return mean, median and censored log-normal fit of the computed forces of one surface.

    Forces (scan, sphere_scan, contact) are in N, NaN where one is missing; those below the floor
    enter the fit as censored ones. The scalars STATISTICS have intervals over substrate scans: the
    mean and the censored fraction by Student's t, those of POOLED by the jackknife. All are NaN
    where all forces are.
    """
    has_scan, has_sphere, has_contact = (
        np.isfinite(forces).any(axis=axes) for axes in ((1, 2), (0, 2), (0, 1))
    )
    finite_forces = forces[np.ix_(has_scan, has_sphere, has_contact)]
    finite_forces = finite_forces.reshape(has_scan.sum(), has_sphere.sum() * has_contact.sum())
    scan_forces = xr.DataArray(finite_forces, dims=("scan", "contact"))
    mean = scan_forces.mean("contact")
    censored = (scan_forces < floor).mean("contact")
    pooled, confidence = _pooled(finite_forces, floor), sampling.confidence
    values = dict(zip(POOLED, pooled, strict=True))
    values |= {
        "mean_force_at_pair": float(mean.mean()),
        "censored_fraction": float(censored.mean()),
    }
    ends = dict.fromkeys(STATISTICS, np.full(2, np.nan))
    if sampling.samples:
        left_out = [
            _pooled(np.delete(finite_forces, scan, axis=0), floor)
            for scan in range(len(finite_forces))
        ]
        ends = dict(zip(POOLED, jackknife_interval(pooled, left_out, confidence), strict=True))
        ends["mean_force_at_pair"] = student_log_interval(mean, confidence, "scan").values
        ends["censored_fraction"] = student_interval(censored, confidence, "scan").clip(0, 1).values
    variables: dict[str, Any] = {}
    for name, unit in STATISTICS.items():
        variables |= with_interval(name, (), values[name], ends[name], {"units": unit}, confidence)
    return xr.Dataset(variables)


def _pooled(forces: np.ndarray, floor: float) -> np.ndarray:
    """Return those of POOLED of all forces (N) together: (3,), NaN where there is no force."""
    if not forces.size:
        return np.full(len(POOLED), np.nan)
    shape, median, _ = lognormal_fit(forces.ravel(), floor)
    return np.array([np.median(forces), shape, median])
