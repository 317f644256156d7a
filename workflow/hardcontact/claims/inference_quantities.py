"""Numbers about the range and the work of adhesion, and what follows from them.

Forces in N, lengths in nm, works of adhesion in J/m². Each function returns a number as
`numbers.number` does; in brackets its dimensions. `paper` holds the numbers of
resources/paper/parameters.csv under their names.
"""

import numpy as np
import xarray as xr
from scipy import special

from hardcontact.claims.numbers import least, number, quotient, variable_as_number

__all__ = [
    "half_width_of_range",
    "half_width_of_work",
    "interaction_radius",
    "interaction_radius_at_fit",
    "interaction_share",
    "least_ratio_error",
    "only_longer_range_fits",
    "only_one_minimum_fits",
    "only_plastic_fits",
    "short_range_force",
    "sinusoid_share",
]


def short_range_force(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the mean force at the published work and the longest range of atomic interactions.

    Linear between the ranges computed (contact_model, surface).
    """
    force = variable_as_number(inference, "mean_force")
    at_range: xr.Dataset = force.interp(rho=paper["atomic_range_upper_bound"]).drop_vars("rho")
    return paper["work_of_adhesion"] * at_range


# --- errors of the fit ------------------------------------------------------------------------


def only_plastic_fits(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return by how much plastic contact fits and rigid contact does not ().

    Above one, the least error is above the published threshold for rigid and below it for plastic
    contact.
    """
    error = variable_as_number(inference, "best_error")
    rigid, plastic = (error.sel(contact_model=model, drop=True) for model in ("rigid", "plastic"))
    return _only_second_fits(rigid, plastic, paper)


def only_longer_range_fits(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return by how much some range fits and none of atomic interactions does (contact_model).

    Above one, the least error is above the published threshold at ranges of atomic interactions,
    and below it over all ranges.
    """
    error = inference["error_of_range"]
    atomic = error.where(error["rho_fine"] <= paper["atomic_range_upper_bound"]).min("rho_fine")
    return _only_second_fits(number(atomic), variable_as_number(inference, "best_error"), paper)


def only_one_minimum_fits(inference: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return by how much the best minimum along the range fits and no other (contact_model).

    Above one, the error is below the published threshold at the best and above it at the second;
    where there is no second one, its error counts as infinite.
    """
    second = inference["minimum_error"].sel(minimum=2, drop=True).fillna(np.inf)
    return _only_second_fits(number(second), variable_as_number(inference, "best_error"), paper)


def _only_second_fits(misfit: xr.Dataset, fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the smaller of the first error over the threshold and its inverse for the second."""
    threshold = number(paper["error_threshold"], paper["error_threshold"], paper["error_threshold"])
    return least(quotient(misfit, threshold), quotient(threshold, fit))


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


def interaction_radius(paper: xr.Dataset) -> xr.Dataset:
    """Return the radius sqrt(D rho) in nm of the disk that attracts the published sphere ()."""
    return number((paper["sphere_diameter"] * paper["range_of_adhesion"]) ** 0.5)


def interaction_radius_at_fit(inference: xr.Dataset) -> xr.Dataset:
    """Return this radius in nm of the study's sphere at the fitted range (contact_model)."""
    diameter = 2 * inference.attrs["sphere_radius"]
    area: xr.Dataset = diameter * variable_as_number(inference, "range_of_adhesion")
    return area.map(np.sqrt)


def interaction_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the force on a plane within the interaction radius ().

    The attraction of a ring falls as exp(-r²/D rho): 1 - 1/e of it lies within sqrt(D rho).
    """
    area = paper["sphere_diameter"] * paper["range_of_adhesion"]
    share = 1 - np.exp(-(interaction_radius(paper)["value"] ** 2) / area)
    return number(xr.DataArray(share))


def sinusoid_share(paper: xr.Dataset) -> xr.Dataset:
    """Return the share of the attraction on the nearer half of a sinusoidal gap in contact (rho).

    Of exp(-a(1 - cos x)/rho) this is (1 + L0/I0)/2 at a/rho, with the modified Struve and Bessel
    functions: 1/2 where all places attract alike. Amplitude a and ranges rho are the paper's.
    """
    ranges = [paper[f"sinusoid_range_{name}"].item() for name in ("short", "long")]
    ratio = paper["sinusoid_amplitude"].item() / np.array(ranges)
    share = (1 + special.modstruve(0, ratio) / special.iv(0, ratio)) / 2
    return number(xr.DataArray(share, {"rho": ranges}, "rho"))
