"""Estimates (`estimates`) about pull-off forces, their fits and classical models, for claims.

Claims name the public functions in their column `quantity` (`judgement.DERIVED_QUANTITIES`).
Forces are in N, lengths in nm, works of adhesion in J/m². The reference range is the computed range
nearest to the attribute `rho`. `paper` has the numbers of resources/paper/constants.csv by name.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from scipy import constants

from hardcontact.base.arrays import Floats
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, RIGID
from hardcontact.contact.pull_off import mean_over_contacts
from hardcontact.paper.claims.estimates import (
    as_estimate,
    mean_over_scans,
    quotient,
    signed_mean_over_scans,
    variable_estimate,
)


def mean_over_median(fit: xr.Dataset) -> xr.Dataset:
    """Return the mean relative to the median pull-off force (contact_model, pair, surface)."""
    mean = variable_estimate(fit, "mean_force_at_pair")
    return quotient(mean, variable_estimate(fit, "median_force_at_pair"))


def plastic_over_rigid(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the mean plastic relative to the rigid force at the reference range (surface)."""
    mean = mean_over_contacts(_forces_at_reference(adhesion))
    plastic = mean.sel(contact_model=PLASTIC, drop=True)
    rigid = mean.sel(contact_model=RIGID, drop=True)
    return mean_over_scans(plastic / rigid, adhesion.attrs["confidence"])


def range_exponent_of_force(adhesion: xr.Dataset) -> xr.Dataset:
    """Return d ln F/d ln rho of the mean force at the reference range (surface, contact_model)."""
    mean = mean_over_contacts(adhesion["pull_off_force"])
    logarithm = xr.DataArray(np.log(mean)).assign_coords(rho=np.log(mean["rho"]))
    log_rho = np.log(adhesion.attrs["rho"])
    exponent = logarithm.differentiate("rho").sel(rho=log_rho, method="nearest", drop=True)
    return signed_mean_over_scans(exponent, adhesion.attrs["confidence"])


def range_exponent_of_area(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the exponent of the area that attracts against the range (surface, contact_model).

    If each pixel counts by its attraction, this area is proportional to force times range (Eq. 3).
    """
    return 1 + range_exponent_of_force(adhesion)


def shortest_range_force_over_minimum(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the shortest-range force relative to the smallest force (surface, contact_model)."""
    mean = mean_over_contacts(adhesion["pull_off_force"]).sortby("rho")
    ratio = mean.isel(rho=0, drop=True) / mean.min("rho")
    return mean_over_scans(ratio, adhesion.attrs["confidence"])


def smooth_sphere_change(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the relative change of the force on a smooth sphere over the ranges ()."""
    radius = adhesion.attrs["sphere_radius"]
    pixel = adhesion.attrs["pixel_size"]
    rho = adhesion["rho"]
    # At this distance the attraction at the longest range is exp(-72) of that at the apex.
    reach = int(12 * np.sqrt(radius * rho.max()) / pixel)
    position = xr.DataArray(pixel * np.arange(-reach, reach + 1), dims="position")
    # For a paraboloid the sums of Eq. 3 over both axes separate.
    force = np.exp(-(position**2) / (2 * radius * rho)).sum("position") ** 2 / rho
    return as_estimate(force.max() / force.min() - 1)


def finer_pixel_ratio(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the plastic force at the shortest range, half-size over full-size pixels (surface)."""
    return mean_over_scans(adhesion["finer_pixel_ratio"], adhesion.attrs["confidence"])


def lognormal_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the Kolmogorov distance of forces to the log-normal with mean and std of ln F."""

    def parameters(forces: Floats) -> tuple[Any, ...]:
        return np.log(forces).std(ddof=1), 0, np.exp(np.log(forces).mean())

    return _misfit(adhesion, "lognorm", parameters)


def half_gaussian_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the Kolmogorov distance of forces to the half-Gaussian with their mean square."""
    return _misfit(adhesion, "halfnorm", lambda forces: (0, np.sqrt(np.mean(forces**2))))


def inverse_gaussian_misfit(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the Kolmogorov distance of forces to the most likely inverse Gaussian."""

    def parameters(forces: Floats) -> tuple[Any, ...]:
        shape = 1 / np.mean(1 / forces - 1 / forces.mean())
        return forces.mean() / shape, 0, shape

    return _misfit(adhesion, "invgauss", parameters)


def _misfit(
    adhesion: xr.Dataset, distribution: str, parameters: Callable[[Floats], tuple[Any, ...]]
) -> xr.Dataset:
    """Return the Kolmogorov distance to a distribution of scipy.stats (surface, contact_model).

    `parameters` returns shape, if any, location and scale of the distribution for forces (n,).
    """
    from scipy.stats import kstest

    def distance(forces: Floats) -> float:
        return float(kstest(forces, distribution, parameters(forces), method="asymp").statistic)

    return _force_statistic(adhesion, distance)


def force_decades(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the decades between the smallest and the largest force (surface, contact_model)."""
    return _force_statistic(adhesion, lambda forces: float(np.ptp(np.log10(forces))))


def _force_statistic(adhesion: xr.Dataset, statistic: Callable[[Floats], float]) -> xr.Dataset:
    """Return a statistic of all forces (n,) at the reference range (surface, contact_model)."""
    forces = _forces_at_reference(adhesion)
    return as_estimate(
        xr.apply_ufunc(
            lambda row: statistic(row[np.isfinite(row)]),
            forces.stack(single_force=["scan", "sphere_scan", *CONTACT_AXES]),
            input_core_dims=[["single_force"]],
            vectorize=True,
        )
    )


def _forces_at_reference(adhesion: xr.Dataset) -> xr.DataArray:
    """Return the pull-off forces at the reference range of adhesion."""
    return adhesion["pull_off_force"].sel(rho=adhesion.attrs["rho"], method="nearest", drop=True)


def short_range_force(fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the mean force at published work and longest atomic range (contact_model, surface)."""
    force = variable_estimate(fit, "mean_force")
    atomic_force: xr.Dataset = force.interp(rho=paper["atomic_range_upper_bound"]).drop_vars("rho")
    return paper["work_of_adhesion"] * atomic_force


def short_range_error(fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the smallest error of the fit at the ranges of atomic interactions (contact_model)."""
    is_atomic = fit["rho_fine"] <= paper["atomic_range_upper_bound"]
    return as_estimate(fit["best_error_by_range"].where(is_atomic).min("rho_fine"))


def error_of_second_minimum(fit: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the error at the second-best minimum along the range (contact_model).

    It is infinite without a second minimum, and NaN if nothing fits.
    """
    second_error = fit["error_at_minimum"].sel(minimum=2, drop=True).fillna(np.inf)
    return as_estimate(second_error.where(fit["best_error"] < paper["error_threshold"]))


def minimum_ratio_error(fit: xr.Dataset) -> xr.Dataset:
    """Return the smallest mean relative error of the force ratios (contact_model)."""
    return as_estimate(fit["ratio_error"].min("rho_fine"))


def half_width_of_range(fit: xr.Dataset) -> xr.Dataset:
    """Return half the extent in range of the region of small error (contact_model)."""
    return _half_width(fit["region_range"])


def half_width_of_work(fit: xr.Dataset) -> xr.Dataset:
    """Return half the extent in work of adhesion of the region of small error (contact_model)."""
    return _half_width(fit["region_work"])


def _half_width(region: xr.DataArray) -> xr.Dataset:
    return as_estimate(region.diff("end").squeeze("end", drop=True) / 2)


def strength_over_casimir(paper: xr.Dataset) -> xr.Dataset:
    """Return the largest ratio of the pressure of Eq. 2 to that between ideal metals ().

    Casimir, Proc. K. Ned. Akad. Wet. 51 (1948) 793.
    """
    rho = 1e-9 * paper["range_of_adhesion"]
    gap = 4 * rho  # where the ratio is largest
    pressure = paper["work_of_adhesion"] / rho * np.exp(-gap / rho)
    pressure_of_metals = np.pi**2 * constants.hbar * constants.c / (240 * gap**4)
    return as_estimate(pressure / pressure_of_metals)


def effective_work_decades(classical: xr.Dataset) -> xr.Dataset:
    """Return the decades between the smallest and largest effective work (force_source)."""
    work = variable_estimate(classical, "effective_work_of_adhesion")
    return quotient(work.max("surface"), work.min("surface")).map(np.log10)


def printed_effective_work(classical: xr.Dataset) -> xr.Dataset:
    """Return effective works of adhesion of the published forces, without interval (surface)."""
    work = classical["effective_work_of_adhesion"]
    return as_estimate(work.sel(force_source="published", drop=True))


def tabor_by_convention(classical: xr.Dataset) -> xr.Dataset:
    """Return the Tabor parameter (); its interval reaches to (4RW²/K²z0³)^⅓ (departures.md, 5)."""
    tabor = classical["tabor_parameter"]
    return as_estimate(tabor, tabor, (9 / 4) ** (1 / 3) * tabor)


def classical_over_numerical(classical: xr.Dataset, fit: xr.Dataset) -> xr.Dataset:
    """Return the error of each classical model relative to the fit of each contact model."""
    classical_error = variable_estimate(classical, "mean_relative_error")
    return quotient(classical_error, variable_estimate(fit, "best_error"))
