"""Numbers about the range and the work of adhesion, and what follows from them.

Forces in N, lengths in nm, works of adhesion in J/m². Each function returns a number as
`numbers.number` does; in brackets its dimensions. `paper` holds the numbers of
resources/paper/parameters.csv under their names.
"""

import numpy as np
import xarray as xr
from scipy import special

from hardcontact.claims.numbers import number, variable_as_number

__all__ = [
    "force_at_published_pair",
    "half_width_of_range",
    "half_width_of_work",
    "interaction_radius",
    "interaction_share",
    "least_ratio_error",
    "ratio_at_fit",
    "short_range_error",
    "short_range_force",
    "sinusoid_share",
]


# --- forces at a range of adhesion ------------------------------------------------------------


def ratio_at_fit(inference: xr.Dataset) -> xr.Dataset:
    """Return forces over that of the reference surface, at the fit (contact_model, surface)."""
    return _at_range(inference, "ratio", inference["range_of_adhesion"])


def force_at_published_pair(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the mean force at the published range and work (contact_model, surface)."""
    return paper["work_of_adhesion"] * _at_range(
        inference, "mean_force", paper["range_of_adhesion"]
    )


def short_range_force(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the mean force at the published work and the longest range of atomic interactions."""
    return paper["work_of_adhesion"] * _at_range(
        inference, "mean_force", paper["atomic_range_upper_bound"]
    )


def _at_range(inference: xr.Dataset, name: str, rho: xr.DataArray) -> xr.Dataset:
    """Return a variable of `rho`, linearly interpolated to the range rho in nm."""
    return variable_as_number(inference, name).interp(rho=rho).drop_vars("rho")


# --- errors of the fit ------------------------------------------------------------------------


def short_range_error(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the least error of any work at ranges of atomic interactions (contact_model)."""
    error = inference["mean_relative_error"]
    atomic = error["rho_fine"] <= paper["atomic_range_upper_bound"]
    return number(error.where(atomic).min(["rho_fine", "work"]))


def least_ratio_error(inference: xr.Dataset) -> xr.Dataset:
    """Return the least mean relative error of the force ratios at one range (contact_model)."""
    return number(inference["ratio_error"].min("rho_fine"))


def half_width_of_range(inference: xr.Dataset) -> xr.Dataset:
    """Return half the extent in range of the region of small error (contact_model)."""
    return _half_width(inference["region_range"])


def half_width_of_work(inference: xr.Dataset) -> xr.Dataset:
    """Return half the extent in work of adhesion of the region of small error (contact_model)."""
    return _half_width(inference["region_work"])


def _half_width(region: xr.DataArray) -> xr.Dataset:
    low, high = (region.sel(bound=end, drop=True) for end in ("low", "high"))
    return number((high - low) / 2)


# --- what a range of adhesion means -----------------------------------------------------------


def interaction_radius(inference: xr.Dataset) -> xr.Dataset:
    """Return the radius sqrt(D rho) in nm of the disk that attracts a sphere (contact_model)."""
    diameter = 2 * inference.attrs["sphere_radius"]
    area: xr.Dataset = diameter * variable_as_number(inference, "range_of_adhesion")
    return area.map(np.sqrt)


def interaction_share(inference: xr.Dataset) -> xr.Dataset:
    """Return the share of the force on a plane within the interaction radius (contact_model).

    The attraction of a ring falls as exp(-r²/D rho): 1 - 1/e of it lies within sqrt(D rho).
    """
    diameter = 2 * inference.attrs["sphere_radius"]
    exponent = interaction_radius(inference)["value"] ** 2 / diameter
    return number(1 - np.exp(-exponent / inference["range_of_adhesion"]))


def sinusoid_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the attraction on the nearer half of a sinusoidal gap in contact (rho).

    Of exp(-a(1 - cos x)/rho) this is (1 + L0/I0)/2 at a/rho, with the modified Struve and Bessel
    functions: 1/2 where all places attract alike. Amplitude a and ranges rho are the paper's.
    """
    ranges = [paper[f"sinusoid_range_{name}"].item() for name in ("short", "long")]
    ratio = paper["sinusoid_amplitude"].item() / np.array(ranges)
    share = (1 + special.modstruve(0, ratio) / special.iv(0, ratio)) / 2
    return number(xr.DataArray(share, {"rho": ranges}, "rho"))
