"""Estimates (`estimates`) about the band and the interaction radius, for claims.

Claims name the public functions in their column `quantity` (`judgement.DERIVED_QUANTITIES`).
Forces are in N, lengths in nm. Every function takes the datasets that its claim names, also those
that it does not use. `paper` has the numbers of resources/paper/constants.csv by name.
"""

import numpy as np
import xarray as xr
from scipy import special

from hardcontact.base.statistics import interval_ends
from hardcontact.contact.hertz_jkr_dmt import dmt_pull_off
from hardcontact.contact.pull_off import mean_over_contacts
from hardcontact.inference.edges import AVERAGED, computed_cutoffs, edges_or_bounds, last_cutoff
from hardcontact.paper.claims.estimates import as_estimate, mean_over_scans, variable_estimate


def band_edge(edges: xr.Dataset) -> xr.Dataset:
    """Return the edges of the band in nm, or the bounds of open edges (side, group)."""
    return as_estimate(edges_or_bounds(edges), *interval_ends(edges, "edge"))


def outermost_edge(edges: xr.Dataset) -> xr.Dataset:
    """Return the `band_edge` of the coating whose force changes first (side).

    Each end of the interval is the outermost of that end over the coatings.
    """
    coating_edges = band_edge(edges).drop_sel(group=AVERAGED)
    short_edge = coating_edges.sel(side="short").min("group")
    long_edge = coating_edges.sel(side="long").max("group")
    return xr.concat([short_edge, long_edge], "side")


def edge_over_interaction_radius(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the edge relative to the interaction radius at the published range (side, group)."""
    squared_radius = 2 * edges.attrs["sphere_radius"] * paper["range_of_adhesion"]
    ratio: xr.Dataset = variable_estimate(edges, "edge") / squared_radius**0.5
    return ratio


def change_outside_band(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the largest change of force by cutoffs outside the published band (side, group)."""
    cutoff = edges["cutoff_wavelength"]
    is_below_band = cutoff <= paper["short_edge"]
    is_above_band = cutoff >= paper["long_edge"]
    is_outside = is_below_band.where(edges["side"] == "short", is_above_band)
    return _largest_change(edges, is_outside)


def change_inside_band(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the change of force by a cutoff an octave inside the published band (side, group)."""
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
    """Return the largest change by short cutoffs that remove only artificial waves (group)."""
    is_artificial = edges["cutoff_wavelength"] <= paper["short_transition_wavelength"]
    return _largest_change(edges, is_artificial).sel(side="short", drop=True)


def _largest_change(edges: xr.Dataset, is_selected: xr.DataArray) -> xr.Dataset:
    """Return the largest change of the force by the selected cutoffs (side, group)."""
    change = variable_estimate(edges, "filtered_force_change")
    return change.where(is_selected).max("cutoff_wavelength")


def stylus_change(edges: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the change of force at the short cutoff nearest to the radius of a stylus (group)."""
    change = variable_estimate(edges, "filtered_force_change").sel(side="short", drop=True)
    computed_change = change.sel(cutoff_wavelength=computed_cutoffs(change["value"]))
    radius = paper["stylus_radius"].item()
    return computed_change.sel(cutoff_wavelength=radius, method="nearest", drop=True)


def dmt_fraction_at_last_cutoff(forces: xr.Dataset) -> xr.Dataset:
    """Return the force at the largest short cutoff, relative to 2πRW on a plane (surface)."""
    force = mean_over_contacts(forces["pull_off_force"].sel(side="short"))
    force = force.sel(cutoff_wavelength=last_cutoff(force, "short"), drop=True)
    dmt_force = dmt_pull_off(1.0, forces.attrs["sphere_radius"])  # the forces are at 1 J/m²
    return mean_over_scans(force / dmt_force, forces.attrs["confidence"], "realization")


def mean_band_ratio(band_forces: xr.Dataset) -> xr.Dataset:
    """Return the mean over surfaces of ``band_force_ratio`` (band, band_part)."""
    ratio = band_forces["band_force_ratio"]
    low, high = interval_ends(band_forces, "band_force_ratio")
    mean = ratio.mean("surface")
    count = ratio.sizes["surface"]
    # Surfaces are independent, so that the half widths of their intervals add in squares.
    low_half_width = np.sqrt(((ratio - low) ** 2).sum("surface", skipna=False)) / count
    high_half_width = np.sqrt(((high - ratio) ** 2).sum("surface", skipna=False)) / count
    return as_estimate(mean, mean - low_half_width, mean + high_half_width)


def median_force_exponent(exponents: xr.Dataset) -> xr.Dataset:
    """Return the exponent of the force against the radius, the median over surfaces ()."""
    return variable_estimate(exponents, "force_exponent").median("surface", skipna=False)


def median_edge_exponent(exponents: xr.Dataset) -> xr.Dataset:
    """Return the median over surfaces of the exponent of an edge (side, exponent_of).

    NaN if the edges of any surface determine no exponent. The ends of the interval are medians over
    the surfaces that have an interval.
    """
    exponent = variable_estimate(exponents, "edge_exponent")
    return exponent.median("surface").where(exponent["value"].notnull().all("surface"))


def interaction_radius(paper: xr.Dataset) -> xr.Dataset:
    """Return the interaction radius sqrt(D rho) in nm, with the published diameter and range ()."""
    return as_estimate((paper["sphere_diameter"] * paper["range_of_adhesion"]) ** 0.5)


def interaction_radius_at_fit(fit: xr.Dataset) -> xr.Dataset:
    """Return the interaction radius in nm of the sphere at the fitted range (contact_model)."""
    diameter = 2 * fit.attrs["sphere_radius"]
    squared_radius: xr.Dataset = diameter * variable_estimate(fit, "range_of_adhesion")
    return squared_radius.map(np.sqrt)


def interaction_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the force on a plane within the interaction radius ().

    The attraction falls as a Gaussian of the distance from the apex, by a factor e at this radius.
    """
    return as_estimate(xr.DataArray(1 - np.exp(-1.0)))


def sinusoid_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the attraction on the nearer half of a sinusoidal gap in contact (rho).

    The mean of the exponential attraction over half a period is a sum of modified Struve and Bessel
    functions.
    """
    ranges = [paper[f"sinusoid_range_{name}"].item() for name in ("short", "long")]
    ratio = paper["sinusoid_amplitude"].item() / np.array(ranges)
    share = (1 + special.modstruve(0, ratio) / special.iv(0, ratio)) / 2
    return as_estimate(xr.DataArray(share, {"rho": ranges}, "rho"))
