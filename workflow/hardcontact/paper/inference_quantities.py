"""Estimates about range and work of adhesion, and about the scales of roughness.

Forces in N, lengths in nm, works of adhesion in J/m². Each function returns an estimate as
`paper.estimates` defines it; its dimensions are in brackets. `paper` contains the numbers of
resources/paper/constants.csv by name.
"""

import numpy as np
import xarray as xr
from scipy import constants, special

from hardcontact.base.statistics import interval_ends
from hardcontact.contact.hertz_jkr_dmt import dmt_pull_off
from hardcontact.inference.edges import MEAN_GROUP, edges_or_bounds
from hardcontact.paper.estimates import (
    as_estimate,
    mean_over_contacts,
    mean_over_scans,
    variable_estimate,
)


def short_range_force(fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the mean force at the published work and the longest atomic range.

    It is interpolated linearly between the computed ranges (contact_model, surface).
    """
    force = variable_estimate(fit, "mean_force")
    atomic_force: xr.Dataset = force.interp(rho=paper["atomic_range_upper_bound"]).drop_vars("rho")
    return paper["work_of_adhesion"] * atomic_force


def short_range_error(fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the smallest error at the ranges of atomic interactions (contact_model)."""
    error = fit["best_error_by_range"]
    return as_estimate(
        error.where(error["rho_fine"] <= paper["atomic_range_upper_bound"]).min("rho_fine")
    )


def error_of_second_minimum(fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the error at the second-best minimum along the range (contact_model).

    It is infinite if there is no second minimum, and NaN if the best error is above the published
    threshold.
    """
    second_error = fit["error_at_minimum"].sel(minimum=2, drop=True).fillna(np.inf)
    return as_estimate(second_error.where(fit["best_error"] < paper["error_threshold"]))


def strength_over_casimir(paper: xr.Dataset) -> xr.Dataset:
    """Return the largest pressure of Eq. 2 relative to ideal metals (no dimensions).

    Eq. 2 has the published range and work of adhesion. Ideal metals at the gap d attract with
    pi² hbar c/(240 d⁴), Casimir, Proc. K. Ned. Akad. Wet. 51 (1948) 793. The ratio is proportional
    to d⁴ exp(-d/rho), so it is largest at d = 4 rho.
    """
    rho = 1e-9 * paper["range_of_adhesion"]
    gap = 4 * rho
    pressure = paper["work_of_adhesion"] / rho * np.exp(-gap / rho)
    pressure_of_metals = np.pi**2 * constants.hbar * constants.c / (240 * gap**4)
    return as_estimate(pressure / pressure_of_metals)


def least_ratio_error(fit: xr.Dataset) -> xr.Dataset:
    """Return the smallest mean relative error of the force ratios (contact_model)."""
    return as_estimate(fit["ratio_error"].min("rho_fine"))


def half_width_of_range(fit: xr.Dataset) -> xr.Dataset:
    """Return half the extent in range of the region of small error (contact_model)."""
    return _half_width(fit["low_error_range"])


def half_width_of_work(fit: xr.Dataset) -> xr.Dataset:
    """Return half the extent in work of adhesion of the region of small error (contact_model)."""
    return _half_width(fit["low_error_work"])


def _half_width(region: xr.DataArray) -> xr.Dataset:
    low = region.sel(end="low", drop=True)
    high = region.sel(end="high", drop=True)
    return as_estimate((high - low) / 2)


def interaction_radius(paper: xr.Dataset) -> xr.Dataset:
    """Return the radius sqrt(D rho) in nm of the disk that attracts the published sphere ()."""
    return as_estimate((paper["sphere_diameter"] * paper["range_of_adhesion"]) ** 0.5)


def interaction_radius_at_fit(fit: xr.Dataset) -> xr.Dataset:
    """Return sqrt(D rho) in nm for the sphere of the study at the fitted range (contact_model)."""
    diameter = 2 * fit.attrs["sphere_radius"]
    area: xr.Dataset = diameter * variable_estimate(fit, "range_of_adhesion")
    return area.map(np.sqrt)


def interaction_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the force on a plane within the interaction radius ().

    The attraction of a ring falls as exp(-r²/D rho): 1 - 1/e of it lies within sqrt(D rho).
    """
    area = paper["sphere_diameter"] * paper["range_of_adhesion"]
    share = 1 - np.exp(-(interaction_radius(paper)["value"] ** 2) / area)
    return as_estimate(xr.DataArray(share))


def sinusoid_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the attraction on the nearer half of a sinusoidal gap in contact (rho).

    For the attraction exp(-a(1 - cos x)/rho) the share is (1 + L0/I0)/2 at a/rho, with the modified
    Struve and Bessel functions. It is 1/2 if the attraction is uniform. Amplitude a and ranges rho
    are published.
    """
    ranges = [paper[f"sinusoid_range_{name}"].item() for name in ("short", "long")]
    ratio = paper["sinusoid_amplitude"].item() / np.array(ranges)
    share = (1 + special.modstruve(0, ratio) / special.iv(0, ratio)) / 2
    return as_estimate(xr.DataArray(share, {"rho": ranges}, "rho"))


def band_edge(edges: xr.Dataset) -> xr.Dataset:
    """Return the edges of the critical band in nm, or their bounds (side, group).

    The bound is the last cutoff of the side, at which the change is still within the tolerance.
    """
    return as_estimate(edges_or_bounds(edges), *interval_ends(edges, "edge"))


def first_edge(edges: xr.Dataset) -> xr.Dataset:
    """Return the `band_edge` of the surface whose force leaves its tolerance first (side)."""
    wavelengths = band_edge(edges).drop_sel(group=MEAN_GROUP)
    short_edge = wavelengths.sel(side="short").min("group")
    long_edge = wavelengths.sel(side="long").max("group")
    return xr.concat([short_edge, long_edge], "side")


def edge_over_interaction_radius(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the edge relative to sqrt(D rho) (side, group).

    D is the diameter of the sphere of the study, rho the published range.
    """
    radius = (2 * edges.attrs["sphere_radius"] * paper["range_of_adhesion"]) ** 0.5
    ratio: xr.Dataset = variable_estimate(edges, "edge") / radius
    return ratio


def change_outside_band(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the largest change of the force by cutoffs outside the published band (side, group).

    These are cutoffs up to the published short edge, and from the published long edge on.
    """
    cutoff = edges["cutoff_wavelength"]
    is_short = cutoff <= paper["short_edge"]
    is_long = cutoff >= paper["long_edge"]
    return _largest_change(edges, is_short.where(edges["side"] == "short", is_long))


def change_inside_band(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the change of the force by a cutoff an octave inside the published band (side, group).

    It is interpolated between the computed cutoffs of the side.
    """
    change = variable_estimate(edges, "filtered_force_change")
    sides = [
        change.sel(side=side)
        .dropna("cutoff_wavelength", how="all")
        .interp(cutoff_wavelength=factor * paper[f"{side}_edge"].item())
        .drop_vars("cutoff_wavelength")
        for side, factor in (("short", 2), ("long", 1 / 2))
    ]
    return xr.concat(sides, "side")


def short_cutoff_change(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the largest change by short cutoffs that remove only artificial roughness (group)."""
    is_artificial = edges["cutoff_wavelength"] <= paper["short_transition_wavelength"]
    return _largest_change(edges, is_artificial).sel(side="short", drop=True)


def _largest_change(edges: xr.Dataset, is_selected: xr.DataArray) -> xr.Dataset:
    """Return the largest change of the force by the selected cutoffs (side, group)."""
    return (
        variable_estimate(edges, "filtered_force_change")
        .where(is_selected)
        .max("cutoff_wavelength")
    )


def stylus_change(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the change of the force at the short cutoff nearest to a stylus radius (group)."""
    change = variable_estimate(edges, "filtered_force_change").sel(side="short", drop=True)
    cutoffs = change["value"].dropna("cutoff_wavelength", how="all")["cutoff_wavelength"]
    ascending = change.sel(cutoff_wavelength=np.sort(cutoffs))
    radius = paper["stylus_radius"].item()
    return ascending.sel(cutoff_wavelength=radius, method="nearest", drop=True)


def flat_limit_fraction(scales: xr.Dataset) -> xr.Dataset:
    """Return the force at the largest short cutoff relative to 2 pi R W of a plane (surface)."""
    force = mean_over_contacts(scales["pull_off_force"].sel(side="short"))
    force = force.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    smooth = dmt_pull_off(1.0, scales.attrs["sphere_radius"])  # the forces are at 1 J/m2
    fraction = force.isel(cutoff_wavelength=-1, drop=True) / smooth
    return mean_over_scans(fraction, scales.attrs["confidence"], "realization")


def mean_band_ratio(sensitivity: xr.Dataset) -> xr.Dataset:
    """Return the mean over surfaces of the force on a part of the roughness (band, band_part).

    The surfaces are independent: the half widths of their intervals add in squares.
    """
    ratio = sensitivity["band_force_ratio"]
    low, high = interval_ends(sensitivity, "band_force_ratio")
    mean = ratio.mean("surface")
    count = ratio.sizes["surface"]
    below = np.sqrt(((ratio - low) ** 2).sum("surface", skipna=False)) / count
    above = np.sqrt(((high - ratio) ** 2).sum("surface", skipna=False)) / count
    return as_estimate(mean, mean - below, mean + above)


#: The functions that claims name.
QUANTITIES = (
    short_range_force, short_range_error, error_of_second_minimum,
    strength_over_casimir, least_ratio_error, half_width_of_range, half_width_of_work,
    interaction_radius, interaction_radius_at_fit, interaction_share, sinusoid_share, band_edge,
    first_edge, edge_over_interaction_radius, change_outside_band, change_inside_band,
    short_cutoff_change, stylus_change, flat_limit_fraction, mean_band_ratio,
)  # fmt: skip
