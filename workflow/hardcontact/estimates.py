"""Numbers that claims are about: variables of the final datasets, and what is derived from them.

Lengths in nm, forces in N, works of adhesion in J/m². Every function returns a number with its
interval, as `intervals` describes; in brackets its dimensions.
"""

import json

import numpy as np
import xarray as xr
from scipy import special, stats

from hardcontact import contact_estimates
from hardcontact.intervals import (
    attribute,
    interval,
    magnitude,
    mean_over_contacts,
    mean_over_scans,
    quotient,
    variable,
)

__all__ = [
    "area_slope",
    "change_inside_band",
    "change_outside_band",
    "critical_over_interaction_radius",
    "estimate",
    "flat_limit_fraction",
    "force_at_published_pair",
    "force_decades",
    "force_slope",
    "half_gaussian_misfit",
    "half_width_of_range",
    "half_width_of_work",
    "interaction_radius",
    "interaction_share",
    "inverse_gaussian_misfit",
    "least_ratio_error",
    "lognormal_misfit",
    "mean_over_median",
    "plastic_over_rigid",
    "ratio_at_fit",
    "short_range_error",
    "short_range_force",
    "short_range_rise",
    "sinusoid_share",
    "small_scale_change",
    "smooth_sphere_change",
    "smoothest_ratio",
    "stylus_ratio",
]

# Of the paper, in nm, as in resources/paper/parameters.csv under these names.
ATOMIC_RANGE_UPPER_BOUND = 0.6
SINUSOID_AMPLITUDE = 2.0
SINUSOID_RANGES = (0.5, 5.0)
SMALL_SCALE_TRANSITION_WAVELENGTH = 20.0
STYLUS_RADIUS = 1000.0


def estimate(quantity: str, dataset: xr.Dataset, *others: xr.Dataset) -> xr.Dataset:
    """A derived quantity of one dataset or several, or a variable of one.

    A row of Table 1 is the variable that the dataset's attribute `table1_variables` names.
    """
    if quantity in DERIVED:
        return DERIVED[quantity](dataset, *others)
    names = json.loads(dataset.attrs.get("table1_variables", "{}"))
    return variable(dataset, names.get(quantity, quantity))


# --- forces -----------------------------------------------------------------------------------


def mean_over_median(inference: xr.Dataset) -> xr.Dataset:
    """Mean over median of the fitted pull-off forces (contact_model, surface)."""
    return quotient(variable(inference, "force_mean"), variable(inference, "force_median"))


def plastic_over_rigid(adhesion: xr.Dataset) -> xr.Dataset:
    """Plastic over rigid mean force at the reference range, scan by scan (surface)."""
    rho = attribute(adhesion, "reference_rho")
    mean = mean_over_contacts(adhesion["pull_off_force"].sel(rho=rho, method="nearest", drop=True))
    plastic, rigid = (mean.sel(contact_model=model, drop=True) for model in ("plastic", "rigid"))
    return mean_over_scans(plastic / rigid).clip(0)


def force_slope(adhesion: xr.Dataset) -> xr.Dataset:
    """Slope d ln F / d ln rho of the mean force at the reference range (surface, contact_model).

    The slope is taken scan by scan, the interval is that of its mean over the scans.
    """
    mean = mean_over_contacts(adhesion["pull_off_force"])
    logarithm = np.log(mean).assign_coords(rho=np.log(mean["rho"]))
    slope = logarithm.differentiate("rho")
    reference = np.log(attribute(adhesion, "reference_rho"))
    return mean_over_scans(slope.sel(rho=reference, method="nearest", drop=True))


def area_slope(adhesion: xr.Dataset) -> xr.Dataset:
    """Slope d ln A / d ln rho of the area A that attracts (surface, contact_model).

    Each pixel counts by its attraction over that of one that touches: A = F rho / W (Eq. 3).
    """
    return 1 + force_slope(adhesion)


def short_range_rise(adhesion: xr.Dataset) -> xr.Dataset:
    """Mean force at the smallest range over the least at any range (surface, contact_model)."""
    mean = mean_over_contacts(adhesion["pull_off_force"]).sortby("rho")
    return mean_over_scans(mean.isel(rho=0, drop=True) / mean.min("rho"))


def smooth_sphere_change(adhesion: xr.Dataset) -> xr.Dataset:
    """Largest relative change over the ranges of the force on a smooth sphere and a plane ().

    Eq. 3 on the study's pixels: the sum over a paraboloid is a product of sums over both axes.
    """
    radius, pixel = (attribute(adhesion, name) for name in ("sphere_radius", "pixel_size"))
    rho = adhesion["rho"]
    reach = int(12 * np.sqrt(radius * rho.max()) / pixel)  # beyond it exp(-72) is left
    position = xr.DataArray(pixel * np.arange(-reach, reach + 1), dims="position")
    force = np.exp(-(position**2) / (2 * radius * rho)).sum("position") ** 2 / rho
    return interval(force.max() / force.min() - 1, np.nan, np.nan)


def lognormal_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Kolmogorov distance of the forces to their log-normal fit (surface, contact_model)."""
    return _over_forces(adhesion, lambda forces: _normal_distance(np.log(forces)))


def half_gaussian_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Kolmogorov distance of the forces to their half-Gaussian fit (surface, contact_model)."""
    return _over_forces(adhesion, _half_gaussian_distance)


def inverse_gaussian_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Kolmogorov distance of the forces to their inverse-Gaussian fit (surface, contact_model)."""
    return _over_forces(adhesion, _inverse_gaussian_distance)


def force_decades(adhesion: xr.Dataset) -> xr.Dataset:
    """Decades between the smallest and the largest force (surface, contact_model)."""
    return _over_forces(adhesion, lambda forces: np.ptp(np.log10(forces)))


def _over_forces(adhesion: xr.Dataset, statistic) -> xr.Dataset:
    """A statistic of all forces (n,) at the reference range of adhesion; it has no interval."""
    forces = adhesion["pull_off_force"].sel(
        rho=attribute(adhesion, "reference_rho"), method="nearest", drop=True
    )
    found = xr.apply_ufunc(
        lambda row: statistic(row[np.isfinite(row)]),
        forces.stack(sample=["scan", "sphere_scan", "contact_y", "contact_x"]),
        input_core_dims=[["sample"]],
        vectorize=True,
    )
    return interval(found, np.nan, np.nan)


def _normal_distance(values: np.ndarray) -> float:
    """Largest distance between the cumulative distribution and the normal one of its moments."""
    return stats.kstest((values - values.mean()) / values.std(ddof=1), "norm").statistic


def _half_gaussian_distance(values: np.ndarray) -> float:
    """As `_normal_distance`, for half of a Gaussian about zero of greatest likelihood."""
    return stats.kstest(values / np.sqrt(np.mean(values**2)), "halfnorm").statistic


def _inverse_gaussian_distance(values: np.ndarray) -> float:
    """As `_normal_distance`, for the inverse Gaussian of greatest likelihood.

    Its mean is that of the values, its shape 1/(mean of 1/value - 1/mean).
    """
    mean = values.mean()
    shape = 1 / np.mean(1 / values - 1 / mean)
    return stats.kstest(values, stats.invgauss(mean / shape, scale=shape).cdf).statistic


# --- range and work of adhesion ---------------------------------------------------------------


def ratio_at_fit(inference: xr.Dataset) -> xr.Dataset:
    """Force relative to the reference surface at the fitted range (contact_model, surface)."""
    return _at_range(inference, "ratio", inference["range_of_adhesion"])


def force_at_published_pair(inference: xr.Dataset) -> xr.Dataset:
    """Mean force at the published range and work of adhesion (contact_model, surface)."""
    return _force_at_published_work(inference, attribute(inference, "published_range"))


def short_range_force(inference: xr.Dataset) -> xr.Dataset:
    """As `force_at_published_pair`, at the longest range of atomic interactions."""
    return _force_at_published_work(inference, ATOMIC_RANGE_UPPER_BOUND)


def _force_at_published_work(inference: xr.Dataset, rho: float) -> xr.Dataset:
    return attribute(inference, "published_work") * _at_range(inference, "mean_force", rho)


def _at_range(inference: xr.Dataset, name: str, rho) -> xr.Dataset:
    """A variable of `rho` and its interval, linearly interpolated to the range rho in nm."""
    names = {name: "value", f"{name}_low": "low", f"{name}_high": "high"}
    return inference[list(names)].interp(rho=rho).drop_vars("rho").rename(names)


def short_range_error(inference: xr.Dataset) -> xr.Dataset:
    """Least mean relative error of any work, at ranges of atomic interactions (contact_model)."""
    error = inference["mean_relative_error"]
    atomic = error["rho_fine"] <= ATOMIC_RANGE_UPPER_BOUND
    return interval(error.where(atomic).min(["rho_fine", "work"]), np.nan, np.nan)


def least_ratio_error(inference: xr.Dataset) -> xr.Dataset:
    """Least mean relative error of the force ratios at one range (contact_model)."""
    return interval(inference["ratio_error"].min("rho_fine"), np.nan, np.nan)


def half_width_of_range(inference: xr.Dataset) -> xr.Dataset:
    """Half the extent in range of the region of small error (contact_model)."""
    return _half_width(inference, "range")


def half_width_of_work(inference: xr.Dataset) -> xr.Dataset:
    """Half the extent in work of adhesion of the region of small error (contact_model)."""
    return _half_width(inference, "work")


def _half_width(inference: xr.Dataset, axis: str) -> xr.Dataset:
    low, high = (inference[f"region_{axis}_{end}"] for end in ("low", "high"))
    return interval((high - low) / 2, np.nan, np.nan)


def interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Radius sqrt(D rho) in nm of the disk a sphere interacts with (contact_model)."""
    diameter = 2 * attribute(inference, "sphere_radius")
    return np.sqrt(diameter * variable(inference, "range_of_adhesion"))


def interaction_share(inference: xr.Dataset) -> xr.Dataset:
    """Share of the force on a plane within the interaction radius (contact_model).

    The attraction of a ring falls as exp(-r²/D rho): 1 - 1/e of it lies within sqrt(D rho).
    """
    diameter = 2 * attribute(inference, "sphere_radius")
    exponent = interaction_radius(inference)["value"] ** 2 / diameter
    return interval(1 - np.exp(-exponent / inference["range_of_adhesion"]), np.nan, np.nan)


def critical_over_interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Critical wavelength over the interaction radius (side, group, contact_model)."""
    return quotient(variable(inference, "critical_wavelength"), interaction_radius(inference))


def sinusoid_share(inference: xr.Dataset) -> xr.Dataset:
    """Share of the attraction on the nearer half of a sinusoidal gap that touches (rho).

    Of exp(-a(1 - cos x)/rho) this is (1 + L0/I0)/2 at a/rho, with the modified Struve and Bessel
    functions: 1/2 where all places attract alike. Amplitude a and ranges rho are the paper's.
    """
    rho = xr.DataArray(list(SINUSOID_RANGES), dims="rho").assign_coords(rho=list(SINUSOID_RANGES))
    ratio = SINUSOID_AMPLITUDE / rho
    return interval((1 + special.modstruve(0, ratio) / special.iv(0, ratio)) / 2, np.nan, np.nan)


# --- scales -----------------------------------------------------------------------------------


def change_outside_band(inference: xr.Dataset) -> xr.Dataset:
    """Largest change of the force by cutoffs outside the published band (side, group).

    Cutoffs up to the published one count for the small side, from it for the large one.
    """
    return _largest_change(inference, _outside_band(inference))


def change_inside_band(inference: xr.Dataset) -> xr.Dataset:
    """Largest change of the force by cutoffs inside the published band (side, group)."""
    return _largest_change(inference, ~_outside_band(inference))


def small_scale_change(inference: xr.Dataset) -> xr.Dataset:
    """Largest change of the force by short cutoffs in the small scales added to a scan (group)."""
    cutoff = inference["cutoff_wavelength"]
    change = _largest_change(inference, cutoff <= SMALL_SCALE_TRANSITION_WAVELENGTH)
    return change.sel(side="small", drop=True)


def _outside_band(inference: xr.Dataset) -> xr.DataArray:
    shortest, longest = (attribute(inference, f"published_cutoff_{s}") for s in ("small", "large"))
    cutoff = inference["cutoff_wavelength"]
    return xr.where(inference["side"] == "small", cutoff <= shortest, cutoff >= longest)


def _largest_change(inference: xr.Dataset, counted: xr.DataArray) -> xr.Dataset:
    """Largest change of the force by the cutoffs that count (side, group)."""
    excess = (variable(inference, "scale_ratio") - 1).where(counted)
    return magnitude(excess).max("cutoff_wavelength")


def smoothest_ratio(inference: xr.Dataset) -> xr.Dataset:
    """Force over the unfiltered force at the largest short-wavelength cutoff (group)."""
    return _small_ratio(inference).isel(cutoff_wavelength=-1, drop=True)


def stylus_ratio(inference: xr.Dataset) -> xr.Dataset:
    """Force over the unfiltered force at the short cutoff nearest to a stylus's radius (group)."""
    ratio = _small_ratio(inference)
    return ratio.sel(cutoff_wavelength=STYLUS_RADIUS, method="nearest", drop=True)


def _small_ratio(inference: xr.Dataset) -> xr.Dataset:
    ratio = variable(inference, "scale_ratio").sel(side="small", drop=True)
    return ratio.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")


def flat_limit_fraction(scales: xr.Dataset) -> xr.Dataset:
    """Force at the largest short-wavelength cutoff over 2 pi R W of a flat plane (surface)."""
    force = mean_over_contacts(scales["pull_off_force"].sel(side="small"))
    force = force.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    radius = 1e-9 * attribute(scales, "sphere_radius")  # m; the forces are those at W = 1 J/m2
    fraction = force.isel(cutoff_wavelength=-1, drop=True) / (2 * np.pi * radius)
    return mean_over_scans(fraction, "realization").clip(0)


DERIVED = {
    function.__name__: function
    for function in (
        mean_over_median,
        plastic_over_rigid,
        force_slope,
        area_slope,
        short_range_rise,
        smooth_sphere_change,
        lognormal_misfit,
        half_gaussian_misfit,
        inverse_gaussian_misfit,
        force_decades,
        ratio_at_fit,
        force_at_published_pair,
        short_range_force,
        short_range_error,
        least_ratio_error,
        half_width_of_range,
        half_width_of_work,
        interaction_radius,
        interaction_share,
        critical_over_interaction_radius,
        sinusoid_share,
        change_outside_band,
        change_inside_band,
        small_scale_change,
        smoothest_ratio,
        stylus_ratio,
        flat_limit_fraction,
        *contact_estimates.FUNCTIONS,
    )
}
