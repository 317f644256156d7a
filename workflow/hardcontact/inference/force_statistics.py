"""Statistics of pull-off forces for fit.nc: means over scans, ratios and distribution."""

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import (
    Sampling,
    as_variables,
    jackknife_interval,
    student_log_interval,
)
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import mean_over_contacts
from hardcontact.inference.fit import interpolate_forces

#: Statistics of the forces on one surface, with their attributes. The mean has Student's interval.
#: The others are of single forces; their intervals come from the jackknife over scans.
STATISTIC_ATTRS = {
    "mean_force_at_pair": NEWTON, "median_force_at_pair": NEWTON,
    "log_force_std": DIMENSIONLESS, "lognormal_median": NEWTON,
}  # fmt: skip


def sample_mean_forces(forces: xr.DataArray, sampling: Sampling) -> Floats:
    """Return mean forces (1 + sample, surface, rho) over all scans: the means, then their samples.

    Samples are NaN for a surface with a single scan. All calls use the same random numbers.
    """
    scan_means = mean_over_contacts(forces)
    means = sampling.sample_means("adhesion", scan_means, "scan")
    return np.asarray(means.transpose("sample", "surface", "rho"))


def statistics_at_pair(
    forces: xr.DataArray, pair: tuple[float, float], reference_index: int, sampling: Sampling
) -> xr.Dataset:
    """Return STATISTIC_ATTRS and ``ratio_at_pair`` (surface) of one contact model at one pair.

    A pair is a range (nm) and a work (J/m²) of adhesion; forces are at 1 J/m². The ratio is the
    mean force relative to that on the reference surface.
    """
    rho, work = pair
    pair_forces = interpolate_forces(forces, rho) * work
    means = sample_mean_forces(pair_forces.expand_dims("rho"), sampling)[..., 0]
    variables = sampling.sampled_variables(
        "ratio_at_pair", "surface", means / means[:, [reference_index]], DIMENSIONLESS
    )
    contact_forces = pair_forces.transpose("surface", "scan", "sphere_scan", *CONTACT_AXES).values
    contact_forces = contact_forces.reshape(*contact_forces.shape[:3], -1)
    statistics = [force_statistics(surface_forces, sampling) for surface_forces in contact_forces]
    values, intervals = (np.stack(numbers, axis=1) for numbers in zip(*statistics, strict=True))
    rows = zip(STATISTIC_ATTRS.items(), values, intervals, strict=True)
    for (name, attributes), value, interval in rows:
        variables |= as_variables(name, "surface", value, interval, attributes, sampling.confidence)
    return xr.Dataset(variables, {"surface": forces.surface.values})


def force_statistics(forces: Floats, sampling: Sampling) -> tuple[Floats, Floats]:
    """Return STATISTIC_ATTRS (statistic,) of one surface, and their intervals (statistic, 2).

    Forces (scan, sphere_scan, contact) are in N, NaN for a missing scan.
    """
    is_finite = np.isfinite(forces)
    scan_count = int(is_finite.any(axis=(1, 2)).sum())
    # All scans that exist have the same number of contacts.
    finite_forces = forces[is_finite].reshape(scan_count, is_finite.sum() // max(scan_count, 1))
    scan_means = xr.DataArray(finite_forces, dims=("scan", "contact")).mean("contact")
    single_force_values = _single_force_statistics(finite_forces)
    values = np.array([scan_means.mean(), *single_force_values])
    if not sampling.sample_count:
        return values, np.full((len(values), 2), np.nan)
    kept_forces = (np.delete(finite_forces, scan, axis=0) for scan in range(scan_count))
    leave_one_out = [_single_force_statistics(kept) for kept in kept_forces]
    intervals = [
        student_log_interval(scan_means, sampling.confidence, "scan").values,
        *jackknife_interval(single_force_values, leave_one_out, sampling.confidence),
    ]
    return values, np.array(intervals)


def _single_force_statistics(forces: Floats) -> Floats:
    """Return STATISTIC_ATTRS without the mean, (3,), of single forces (...); NaN without forces."""
    if not forces.size:
        return np.full(3, np.nan)
    logarithms = np.log(forces)
    return np.array([np.median(forces), logarithms.std(), np.exp(logarithms.mean())])
