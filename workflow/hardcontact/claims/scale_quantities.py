"""Numbers about the scales of roughness: changes of the force without some wavelengths.

Lengths in nm. Each function returns a number as `numbers.number` does; in brackets its
dimensions. `paper` holds the numbers of resources/paper/parameters.csv under their names.
"""

import numpy as np
import xarray as xr

from hardcontact.claims.inference_quantities import interaction_radius
from hardcontact.claims.numbers import (
    absolute_value,
    mean_over_contacts,
    mean_over_scans,
    quotient,
    variable_as_number,
)

__all__ = [
    "change_inside_band",
    "change_outside_band",
    "critical_over_interaction_radius",
    "flat_limit_fraction",
    "small_scale_change",
    "smoothest_ratio",
    "stylus_ratio",
]


def critical_over_interaction_radius(band: xr.Dataset, inference: xr.Dataset) -> xr.Dataset:
    """Return the critical wavelength over the interaction radius (side, group, contact_model)."""
    return quotient(variable_as_number(band, "critical_wavelength"), interaction_radius(inference))


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
    shortest, longest = (paper[f"critical_wavelength_{side}"] for side in ("small", "large"))
    cutoff = band["cutoff_wavelength"]
    return (cutoff <= shortest).where(band["side"] == "small", cutoff >= longest)


def _largest_change(band: xr.Dataset, counted: xr.DataArray) -> xr.Dataset:
    """Return the largest change of the force by the cutoffs that count (side, group)."""
    excess = (variable_as_number(band, "scale_ratio") - 1).where(counted)
    return absolute_value(excess).max("cutoff_wavelength")


def smoothest_ratio(band: xr.Dataset) -> xr.Dataset:
    """Return the force over the unfiltered one at the largest short-wavelength cutoff (group)."""
    return _small_ratio(band).isel(cutoff_wavelength=-1, drop=True)


def stylus_ratio(band: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the force over the unfiltered one at the cutoff nearest a stylus's radius (group)."""
    radius = paper["stylus_radius"].item()
    return _small_ratio(band).sel(cutoff_wavelength=radius, method="nearest", drop=True)


def _small_ratio(band: xr.Dataset) -> xr.Dataset:
    ratio = variable_as_number(band, "scale_ratio").sel(side="small", drop=True)
    return ratio.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")


def flat_limit_fraction(scales: xr.Dataset) -> xr.Dataset:
    """Return the force at the largest short cutoff over 2 pi R W of a flat plane (surface)."""
    force = mean_over_contacts(scales["pull_off_force"].sel(side="small"))
    force = force.sortby("cutoff_wavelength").dropna("cutoff_wavelength", how="all")
    radius = 1e-9 * scales.attrs["sphere_radius"]  # m; the forces are those at W = 1 J/m2
    fraction = force.isel(cutoff_wavelength=-1, drop=True) / (2 * np.pi * radius)
    return mean_over_scans(fraction, scales.attrs["confidence"], "realization").clip(0)
