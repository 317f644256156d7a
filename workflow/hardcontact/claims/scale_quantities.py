"""Numbers about the scales of roughness: changes of the force without some wavelengths.

Lengths in nm. Each function returns a number as `numbers.number` does; in brackets its
dimensions. `paper` holds the numbers of resources/paper/parameters.csv under their names.
"""

import numpy as np
import xarray as xr

from hardcontact.claims.numbers import (
    mean_over_contacts,
    mean_over_scans,
    number,
    variable_as_number,
)
from hardcontact.statistics import bounds
from hardcontact.surfaces.masters import SIDES

__all__ = [
    "band_edge",
    "change_inside_band",
    "change_outside_band",
    "critical_over_interaction_radius",
    "flat_limit_fraction",
    "small_scale_change",
    "smoothest_ratio",
    "stylus_change",
]


def band_edge(band: xr.Dataset) -> xr.Dataset:
    """Return where the force leaves its tolerance, or a bound on where it does (side, group).

    A curve that never leaves counts as the last cutoff of its side.
    """
    known = band["cutoff_wavelength"].where(band["scale_change"].notnull())
    last = known.max("cutoff_wavelength").where(
        band["side"] == "small", known.min("cutoff_wavelength")
    )
    low, high = bounds(band, "critical_wavelength")
    return number(band["critical_wavelength"].fillna(last), low, high)


def critical_over_interaction_radius(band: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the critical wavelength over sqrt(D rho) at the published range (side, group).

    D is the diameter of the study's sphere.
    """
    radius = (2 * band.attrs["sphere_radius"] * paper["range_of_adhesion"]) ** 0.5
    ratio: xr.Dataset = variable_as_number(band, "critical_wavelength") / radius
    return ratio


def change_outside_band(band: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the largest change of the force by cutoffs outside the published band (side, group).

    Cutoffs up to the published one count for the small side, from it for the large one.
    """
    return _largest_change(band, _outside_band(band, paper))


def change_inside_band(band: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the largest change of the force by cutoffs inside the published band (side, group)."""
    return _largest_change(band, ~_outside_band(band, paper))


def small_scale_change(band: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the largest change by cutoffs among the artificial small scales of a scan (group)."""
    added = band["cutoff_wavelength"] <= paper["small_scale_transition_wavelength"]
    return _largest_change(band, added).sel(side="small", drop=True)


def _outside_band(band: xr.Dataset, paper: xr.Dataset) -> xr.DataArray:
    shortest, longest = (paper[f"critical_wavelength_{side}"] for side in SIDES)
    cutoff = band["cutoff_wavelength"]
    return (cutoff <= shortest).where(band["side"] == "small", cutoff >= longest)


def _largest_change(band: xr.Dataset, counted: xr.DataArray) -> xr.Dataset:
    """Return the largest change of the force by the cutoffs that count (side, group)."""
    return variable_as_number(band, "scale_change").where(counted).max("cutoff_wavelength")


def smoothest_ratio(band: xr.Dataset) -> xr.Dataset:
    """Return the force over the unfiltered one at the largest short cutoff (surface)."""
    return _of_small_side(band, "scale_ratio").isel(cutoff_wavelength=-1, drop=True)


def stylus_change(band: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the change of the force at the short cutoff nearest a stylus's radius (group)."""
    radius = paper["stylus_radius"].item()
    change = _of_small_side(band, "scale_change")
    return change.sel(cutoff_wavelength=radius, method="nearest", drop=True)


def _of_small_side(band: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable of the small side at the cutoffs it has, in ascending order."""
    values = variable_as_number(band, name).sel(side="small", drop=True)
    cutoffs = values["value"].dropna("cutoff_wavelength", how="all")["cutoff_wavelength"]
    return values.sel(cutoff_wavelength=np.sort(cutoffs))


def flat_limit_fraction(scales: xr.Dataset) -> xr.Dataset:
    """Return the force at the largest short cutoff over 2 pi R W of a flat plane (surface)."""
    force = mean_over_contacts(scales["pull_off_force"].sel(side="small"))
    force = force.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    radius = 1e-9 * scales.attrs["sphere_radius"]  # m; the forces are those at W = 1 J/m2
    fraction = force.isel(cutoff_wavelength=-1, drop=True) / (2 * np.pi * radius)
    return mean_over_scans(fraction, scales.attrs["confidence"], "realization")
