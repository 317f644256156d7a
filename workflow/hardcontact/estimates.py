"""Numbers that claims are about: variables of the final datasets, and what is derived from them.

A number travels as a dataset of three variables, `value`, `low` and `high`; `low` and `high`, the
ends of its 95 % interval, are NaN where no interval is known.
"""

import json

import numpy as np
import xarray as xr
from scipy import stats

__all__ = [
    "attribute",
    "change_outside_band",
    "critical_over_interaction_radius",
    "estimate",
    "flat_limit_fraction",
    "force_decades",
    "force_slope",
    "interaction_radius",
    "interval",
    "lognormal_misfit",
    "mean_over_median",
    "plastic_over_rigid",
    "ratio_at_fit",
    "smoothest_ratio",
]


def attribute(dataset: xr.Dataset, name: str):
    if name not in dataset.attrs:
        raise KeyError(f"no attribute named {name!r}")
    return dataset.attrs[name]


def estimate(dataset: xr.Dataset, quantity: str) -> xr.Dataset:
    """Value, low and high of a variable of the dataset or of a derived quantity.

    A row of Table 1 is the variable that the dataset's attribute `table1_variables` names.
    """
    quantity = json.loads(dataset.attrs.get("table1_variables", "{}")).get(quantity, quantity)
    if quantity in DERIVED:
        return DERIVED[quantity](dataset)
    value = dataset[quantity]
    if f"{quantity}_low" in dataset:
        return interval(value, dataset[f"{quantity}_low"], dataset[f"{quantity}_high"])
    return interval(value, np.nan, np.nan)


def interval(value: xr.DataArray, low, high) -> xr.Dataset:
    """Bundle a value with the ends of its interval: arrays of its shape, or NaN for none."""
    broadcast = xr.zeros_like(value)
    return xr.Dataset({"value": value, "low": low + broadcast, "high": high + broadcast})


def _student(mean: xr.DataArray, std: xr.DataArray, count: xr.DataArray) -> xr.Dataset:
    """95 % interval of a mean by Student's t; NaN for fewer than two samples."""
    half = xr.apply_ufunc(stats.t.ppf, 0.975, count - 1) * std / np.sqrt(count)
    return interval(mean, mean - half, mean + half)


def mean_over_median(inference: xr.Dataset) -> xr.Dataset:
    """Mean over median of the fitted pull-off forces (contact_model, surface)."""
    mean, median = "force_mean", "force_median"
    return interval(
        inference[mean] / inference[median],
        inference[f"{mean}_low"] / inference[f"{median}_high"],
        inference[f"{mean}_high"] / inference[f"{median}_low"],
    )


def ratio_at_fit(inference: xr.Dataset) -> xr.Dataset:
    """Force relative to the reference surface at the fitted range (contact_model, surface)."""
    return _at_range(inference, "ratio", inference["range_of_adhesion"])


def plastic_over_rigid(adhesion: xr.Dataset) -> xr.Dataset:
    """Plastic over rigid mean force at the reference range, scan by scan (surface)."""
    rho = attribute(adhesion, "reference_rho")
    mean = adhesion["pull_off_force"].sel(rho=rho, method="nearest", drop=True)
    mean = mean.mean(["sphere_scan", "contact_y", "contact_x"])
    ratio = mean.sel(contact_model="plastic", drop=True) / mean.sel(
        contact_model="rigid", drop=True
    )
    return _over(ratio, "scan").clip(0)


def _at_range(inference: xr.Dataset, name: str, rho: xr.DataArray) -> xr.Dataset:
    """A variable of `rho` and its interval, linearly interpolated to the range rho in nm."""
    names = {name: "value", f"{name}_low": "low", f"{name}_high": "high"}
    return inference[list(names)].interp(rho=rho).drop_vars("rho").rename(names)


def interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Radius sqrt(D rho) in nm of the disk a sphere interacts with (contact_model)."""
    diameter = 2 * attribute(inference, "sphere_radius")
    return np.sqrt(diameter * estimate(inference, "range_of_adhesion"))


def critical_over_interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Critical wavelength over the interaction radius (side, group, contact_model)."""
    critical = estimate(inference, "critical_wavelength")
    radius = interaction_radius(inference)
    return interval(
        critical["value"] / radius["value"],
        critical["low"] / radius["high"],
        critical["high"] / radius["low"],
    )


def change_outside_band(inference: xr.Dataset) -> xr.Dataset:
    """Largest change of the force by cutoffs outside the published band (side, group).

    Cutoffs up to the published one count for the small side, from it for the large one.
    """
    shortest, longest = (attribute(inference, f"published_cutoff_{s}") for s in ("small", "large"))
    cutoff = inference["cutoff_wavelength"]
    outside = xr.where(inference["side"] == "small", cutoff <= shortest, cutoff >= longest)
    excess = (estimate(inference, "scale_ratio") - 1).where(outside)
    nearest = np.maximum(np.maximum(excess["low"], -excess["high"]), 0)
    farthest = np.maximum(excess["high"], -excess["low"])
    return interval(np.abs(excess["value"]), nearest, farthest).max("cutoff_wavelength")


def smoothest_ratio(inference: xr.Dataset) -> xr.Dataset:
    """Force over the unfiltered force at the largest short-wavelength cutoff (group)."""
    ratio = estimate(inference, "scale_ratio").sel(side="small", drop=True)
    ratio = ratio.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    return ratio.isel(cutoff_wavelength=-1, drop=True)


def flat_limit_fraction(scales: xr.Dataset) -> xr.Dataset:
    """Force at the largest short-wavelength cutoff over 2 pi R W of a flat plane (surface)."""
    force = scales["pull_off_force"].sel(side="small").mean(["contact_y", "contact_x"])
    force = force.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    radius = 1e-9 * attribute(scales, "sphere_radius")  # m; the forces are those at W = 1 J/m2
    fraction = force.isel(cutoff_wavelength=-1, drop=True) / (2 * np.pi * radius)
    return _over(fraction, "realization").clip(0)


def force_slope(adhesion: xr.Dataset) -> xr.Dataset:
    """Slope d ln F / d ln rho of the mean force at the reference range (surface, contact_model).

    The slope is taken scan by scan, the interval is that of its mean over the scans.
    """
    mean = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    logarithm = np.log(mean).assign_coords(rho=np.log(mean["rho"]))
    slope = logarithm.differentiate("rho")
    reference = np.log(attribute(adhesion, "reference_rho"))
    return _over(slope.sel(rho=reference, method="nearest", drop=True), "scan")


def lognormal_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Kolmogorov distance of the forces to their log-normal fit (surface, contact_model)."""
    return interval(_over_forces(adhesion, _kolmogorov_distance), np.nan, np.nan)


def force_decades(adhesion: xr.Dataset) -> xr.Dataset:
    """Decades between the smallest and the largest force (surface, contact_model)."""
    decades = _over_forces(adhesion, lambda logarithms: np.ptp(logarithms) / np.log(10))
    return interval(decades, np.nan, np.nan)


def _over(values: xr.DataArray, dim: str) -> xr.Dataset:
    """Mean along a dimension with its 95 % interval."""
    return _student(values.mean(dim), values.std(dim, ddof=1), values.count(dim))


def _over_forces(adhesion: xr.Dataset, statistic) -> xr.DataArray:
    """A statistic of the logarithms of all forces at the reference range of adhesion."""
    forces = adhesion["pull_off_force"].sel(
        rho=attribute(adhesion, "reference_rho"), method="nearest", drop=True
    )
    samples = np.log(forces).stack(sample=["scan", "sphere_scan", "contact_y", "contact_x"])
    return xr.apply_ufunc(
        lambda row: statistic(row[np.isfinite(row)]),
        samples,
        input_core_dims=[["sample"]],
        vectorize=True,
    )


def _kolmogorov_distance(logarithms: np.ndarray) -> float:
    """Largest distance between the cumulative distribution and the normal one of its moments."""
    standardised = (logarithms - logarithms.mean()) / logarithms.std(ddof=1)
    return stats.kstest(standardised, "norm").statistic


DERIVED = {
    function.__name__: function
    for function in (
        mean_over_median,
        ratio_at_fit,
        plastic_over_rigid,
        interaction_radius,
        critical_over_interaction_radius,
        change_outside_band,
        smoothest_ratio,
        flat_limit_fraction,
        force_slope,
        lognormal_misfit,
        force_decades,
    )
}
