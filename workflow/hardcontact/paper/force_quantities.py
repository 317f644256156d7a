"""Estimates about pull-off forces, and about roughness of all scales relative to the AFM scans.

Forces in N, lengths in nm. The reference range is the computed range nearest to attribute `rho`.
Each function returns an estimate, a dataset of `value` and `value_interval` (`paper.estimates`);
its dimensions are in brackets.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from scipy import special

from hardcontact.base.arrays import Floats
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, RIGID
from hardcontact.paper.estimates import (
    as_estimate,
    mean_over_contacts,
    mean_over_scans,
    quotient,
    signed_mean_over_scans,
    variable_estimate,
)
from hardcontact.surfaces.metrics import TABLE1_VARIABLES


def slope_growth(topography: xr.Dataset) -> xr.Dataset:
    """Return the rms slope of all scales relative to the AFM scans (surface)."""
    return _all_over_afm(topography, "slope")


def slope_growth_over_height_growth(topography: xr.Dataset) -> xr.Dataset:
    """Return the growth of rms slope from AFM to all scales over that of height (surface)."""
    return quotient(_all_over_afm(topography, "slope"), _all_over_afm(topography, "height"))


def curvature_growth_over_height_growth(topography: xr.Dataset) -> xr.Dataset:
    """Return the growth of rms curvature from AFM to all scales over that of height (surface)."""
    return quotient(_all_over_afm(topography, "curvature"), _all_over_afm(topography, "height"))


def _all_over_afm(topography: xr.Dataset, quantity: str) -> xr.Dataset:
    """Return a row of Table 1 for all scales relative to the row for the AFM scans."""
    all_scales = variable_estimate(topography, TABLE1_VARIABLES[f"all_rms_{quantity}"])
    afm = variable_estimate(topography, TABLE1_VARIABLES[f"afm_rms_{quantity}"])
    return quotient(all_scales, afm)


def mean_over_median(fit: xr.Dataset) -> xr.Dataset:
    """Return the mean relative to the median pull-off force (contact_model, pair, surface)."""
    return quotient(
        variable_estimate(fit, "mean_force_at_pair"), variable_estimate(fit, "median_force_at_pair")
    )


def plastic_over_rigid(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the mean plastic force relative to the rigid force at the reference range (surface).

    The ratio is taken scan by scan.
    """
    mean = mean_over_contacts(_forces_at_reference(adhesion))
    plastic = mean.sel(contact_model=PLASTIC, drop=True)
    rigid = mean.sel(contact_model=RIGID, drop=True)
    return mean_over_scans(plastic / rigid, adhesion.attrs["confidence"])


def range_exponent_of_force(adhesion: xr.Dataset) -> xr.Dataset:
    """Return d ln F / d ln rho of the mean force at the reference range (surface, contact_model).

    The estimate is the mean of the exponents of all scans, with an interval over scans.
    """
    mean = mean_over_contacts(adhesion["pull_off_force"])
    logarithm = xr.DataArray(np.log(mean)).assign_coords(rho=np.log(mean["rho"]))
    log_rho = np.log(adhesion.attrs["rho"])
    exponent = logarithm.differentiate("rho").sel(rho=log_rho, method="nearest", drop=True)
    return signed_mean_over_scans(exponent, adhesion.attrs["confidence"])


def range_exponent_of_area(adhesion: xr.Dataset) -> xr.Dataset:
    """Return d ln A / d ln rho of the area A that attracts (surface, contact_model).

    Each pixel counts by its attraction relative to a pixel in contact: A = F rho / W (Eq. 3).
    """
    return 1 + range_exponent_of_force(adhesion)


def force_at_shortest_range_over_smallest(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the mean force at the shortest range, relative to its minimum over all ranges.

    Its dimensions are surface and contact_model.
    """
    mean = mean_over_contacts(adhesion["pull_off_force"]).sortby("rho")
    ratio = mean.isel(rho=0, drop=True) / mean.min("rho")
    return mean_over_scans(ratio, adhesion.attrs["confidence"])


def smooth_sphere_change(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the variation of the force on a smooth sphere and plane (no dimensions).

    It is the largest force relative to the smallest over the computed ranges, minus one.

    Eq. 3 is summed on the pixels of the study; for a paraboloid the sums over both axes separate.
    """
    radius = adhesion.attrs["sphere_radius"]
    pixel = adhesion.attrs["pixel_size"]
    rho = adhesion["rho"]
    # At this distance the attraction at the longest range is exp(-72) of that at the apex.
    half_width = int(12 * np.sqrt(radius * rho.max()) / pixel)
    position = xr.DataArray(pixel * np.arange(-half_width, half_width + 1), dims="position")
    force = np.exp(-(position**2) / (2 * radius * rho)).sum("position") ** 2 / rho
    return as_estimate(force.max() / force.min() - 1)


def lognormal_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the Kolmogorov distance of forces to their log-normal fit (surface, contact_model)."""
    return _force_statistic(adhesion, lambda forces: _normal_distance(np.log(forces)))


def half_gaussian_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the Kolmogorov distance of forces to a half-Gaussian (surface, contact_model)."""
    return _force_statistic(adhesion, _half_gaussian_distance)


def inverse_gaussian_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the Kolmogorov distance of forces to an inverse Gaussian (surface, contact_model)."""
    return _force_statistic(adhesion, _inverse_gaussian_distance)


def force_decades(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the decades between the smallest and the largest force (surface, contact_model)."""
    return _force_statistic(adhesion, lambda forces: float(np.ptp(np.log10(forces))))


def _force_statistic(adhesion: xr.Dataset, statistic: Callable[[Floats], float]) -> xr.Dataset:
    """Return a statistic of all forces (n,) at the reference range; it has no interval."""
    forces = _forces_at_reference(adhesion)
    return as_estimate(
        xr.apply_ufunc(
            lambda row: statistic(row[np.isfinite(row)]),
            forces.stack(sample=["scan", "sphere_scan", *CONTACT_AXES]),
            input_core_dims=[["sample"]],
            vectorize=True,
        )
    )


def _forces_at_reference(adhesion: xr.Dataset) -> xr.DataArray:
    """Return the pull-off forces at the reference range of adhesion."""
    return adhesion["pull_off_force"].sel(rho=adhesion.attrs["rho"], method="nearest", drop=True)


def _kolmogorov_distance(values: Floats, cumulative_distribution: Callable[..., Any]) -> float:
    """Return the largest difference between the empirical distribution of values (n,) and a model.

    `cumulative_distribution` is the distribution function of the model.
    """
    from scipy.stats import kstest

    return float(kstest(values, cumulative_distribution, method="asymp").statistic)


def _normal_distance(values: Floats) -> float:
    """Return the Kolmogorov distance to the normal distribution of the same moments."""
    return _kolmogorov_distance((values - values.mean()) / values.std(ddof=1), special.ndtr)


def _half_gaussian_distance(values: Floats) -> float:
    """Return the Kolmogorov distance to the most likely half-Gaussian about zero."""
    return _kolmogorov_distance(values / np.sqrt(2 * np.mean(values**2)), special.erf)


def _inverse_gaussian_distance(values: Floats) -> float:
    """Return the Kolmogorov distance to the most likely inverse Gaussian.

    It has the mean of the values and the shape 1/(mean of 1/value - 1/mean).
    """
    mean = values.mean()
    shape = 1 / np.mean(1 / values - 1 / mean)

    def cumulative(value: Floats) -> Floats:
        root = np.sqrt(shape / value)
        mirrored = np.exp(2 * shape / mean + special.log_ndtr(-root * (value / mean + 1)))
        return np.asarray(special.ndtr(root * (value / mean - 1)) + mirrored)

    return _kolmogorov_distance(values, cumulative)


#: The functions that claims name.
QUANTITIES = (
    slope_growth, slope_growth_over_height_growth, curvature_growth_over_height_growth,
    mean_over_median, plastic_over_rigid, range_exponent_of_force, range_exponent_of_area,
    force_at_shortest_range_over_smallest, smooth_sphere_change, lognormal_misfit,
    half_gaussian_misfit, inverse_gaussian_misfit, force_decades,
)  # fmt: skip
