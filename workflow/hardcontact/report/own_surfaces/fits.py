"""Measured forces on the user's surfaces as numbers, and the ranges and works that fit them."""

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, NumberStatus
from hardcontact.report.own_surfaces.datasets import Datasets, preferred_model
from hardcontact.report.own_surfaces.forces import differing_sides, extrapolated_number
from hardcontact.report.quantities import NoValue, number_of, number_without_value


def preferred_fit(fit: xr.Dataset) -> xr.Dataset:
    """Return the fit of the preferred contact model."""
    return fit.sel(contact_model=preferred_model(fit))


def measured_numbers(fit: xr.Dataset, data: Datasets) -> list[Number]:
    """Return the force measured on one surface, and the works that fit it at the given range."""
    fit_at_range = fit.sel(rho_fine=fit.attrs["rho"], method="nearest")
    numbers = [
        number_of(fit, "measured_force", source="measured"),
        Number("measured_force_count", int(fit["force_count"].item())),
        Number("measured_force_sites", int(fit["site_count"].item())),
        Number("measured_force_looks_repeated", int(fit["look_repeated"].item())),
        number_of(fit_at_range, "work_by_range", name="measured_work", source="from_measured"),
    ]
    for side in differing_sides(fit):
        side_fit = fit.sel(side=side)
        name = f"extrapolated_work_{side}"
        numbers += [
            extrapolated_number(side_fit, "extrapolated_work", name, data),
            number_of(side_fit, "transition", "nm", name=f"{name}_start"),
        ]
    return numbers


def fit_numbers(fit: xr.Dataset) -> list[Number]:
    """Return the ranges and works of adhesion that agree with all measured forces.

    The fit is the part of fit.nc for one contact model. `fit_exact_pairs` counts the pairs that
    give the forces of two surfaces by construction. `fit_gap` lies between ranges that agree.
    `fit_agrees` is 1 if the configured range agrees, otherwise 0.
    """
    rho = fit["rho_fine"].values
    agrees = np.isfinite(fit["region"].values).all(axis=-1)
    shortest, longest = fit["region_range"].values.tolist()
    weakest, strongest = fit["region_work"].values.tolist()
    region = number_without_value("fit_region_range", shortest, longest, "nm")
    if fit.sizes["surface"] == 1:
        region = region._replace(status=NoValue.ONE_FORCE)
    elif fit["work_by_range_interval"].isnull().any():
        region = region._replace(status=NumberStatus.NO_INTERVAL)
    elif not agrees.any():
        region = region._replace(status=NoValue.NO_AGREEMENT)
    nearest = np.abs(rho - fit.attrs["rho"]).argmin()
    return [
        Number("fit_best_range", fit["range_of_adhesion"].item(), "nm"),
        Number("fit_best_work", fit["work_of_adhesion"].item(), "J m-2"),
        Number("fit_best_error", fit["best_error"].item()),
        region,
        number_without_value("fit_region_work", weakest, strongest, "J m-2"),
        Number("fit_exact_pairs", int(fit["exact_pairs"].item())),
        _widest_gap(rho, agrees),
        Number("fit_range", fit.attrs["rho"], "nm"),
        Number("fit_agrees", int(agrees[nearest])),
    ]


def _widest_gap(rho: np.ndarray, agrees: np.ndarray) -> Number:
    """Return the ranges (nm) beside the widest gap between ranges that agree, NaN without a gap."""
    indices = np.flatnonzero(agrees)
    steps = np.diff(indices)
    if not (steps > 1).any():
        return Number("fit_gap", np.nan, "nm")
    widest = steps.argmax()
    low, high = rho[indices[widest : widest + 2]].tolist()
    return number_without_value("fit_gap", low, high, "nm")
