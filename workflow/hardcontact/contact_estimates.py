"""Derived numbers about contact: where it is, what deforms in it, what classical models make of it.

As in `estimates`: every function returns a number with its interval; in brackets its dimensions.
"""

import json

import numpy as np
import xarray as xr

from hardcontact.intervals import (
    attribute,
    decades,
    interval,
    magnitude,
    mean_over_contacts,
    mean_over_scans,
    quotient,
    variable,
)

__all__ = [
    "FUNCTIONS",
    "classical_over_numerical",
    "contact_height",
    "curvature_over_height",
    "deformation_over_adhesion",
    "effective_work_decades",
    "elastic_change",
    "peak_over_hardness",
    "plastic_contact_area",
    "plastic_over_elastic_area",
    "slope_by_scales",
    "slope_over_height",
    "touching_share",
]

NM2 = 1e-18  # in m²


# --- roughness --------------------------------------------------------------------------------


def slope_by_scales(topography: xr.Dataset) -> xr.Dataset:
    """Rms slope of all scales over that of the AFM scans (surface)."""
    return _all_over_afm(topography, "slope")


def slope_over_height(topography: xr.Dataset) -> xr.Dataset:
    """How much more than the rms height the rms slope grows with all scales (surface)."""
    return quotient(_all_over_afm(topography, "slope"), _all_over_afm(topography, "height"))


def curvature_over_height(topography: xr.Dataset) -> xr.Dataset:
    """As `slope_over_height`, for the rms curvature (surface)."""
    return quotient(_all_over_afm(topography, "curvature"), _all_over_afm(topography, "height"))


def _all_over_afm(topography: xr.Dataset, quantity: str) -> xr.Dataset:
    names = json.loads(attribute(topography, "table1_variables"))
    return quotient(
        *(variable(topography, names[f"{scales}_rms_{quantity}"]) for scales in ("all", "afm"))
    )


def contact_height(adhesion: xr.Dataset, topography: xr.Dataset) -> xr.Dataset:
    """Height of the touching sphere's apex over the mean plane (surface, contact_model).

    In rms heights of the scan; what touches is at least as high, but for the sphere's roughness.
    """
    approach = mean_over_contacts(adhesion["closest_approach"])
    return mean_over_scans(-approach / topography["rms_height"])


# --- plastic contact --------------------------------------------------------------------------


def plastic_contact_area(adhesion: xr.Dataset) -> xr.Dataset:
    """Area in nm² of the pixels that touch (contact_model)."""
    return interval(_touching_area(adhesion), np.nan, np.nan)


def touching_share(adhesion: xr.Dataset) -> xr.Dataset:
    """Share of the force on touching pixels at the smallest range (surface, contact_model).

    A touching pixel of area A attracts with W A / rho (Eq. 3 at gap zero).
    """
    force = mean_over_contacts(adhesion["pull_off_force"]).sortby("rho").isel(rho=0)
    work, rho = attribute(adhesion, "work_of_adhesion"), 1e-9 * force["rho"]
    share = work * NM2 * _touching_area(adhesion) / rho / force
    return mean_over_scans(share.drop_vars("rho")).clip(0)


def _touching_area(adhesion: xr.Dataset) -> xr.DataArray:
    return adhesion["contact_pixels"] * attribute(adhesion, "pixel_size") ** 2


# --- elastic contact --------------------------------------------------------------------------


def elastic_change(elastic: xr.Dataset) -> xr.Dataset:
    """Relative difference of the mean elastic and rigid pull-off force, either sign (surface)."""
    soft, rigid = (
        mean_over_contacts(elastic[f"{model}_pull_off_force"]) for model in ("elastic", "rigid")
    )
    return magnitude(mean_over_scans(soft / rigid - 1))


def peak_over_hardness(elastic: xr.Dataset) -> xr.Dataset:
    """Greatest pressure of an elastic contact over the hardness (surface)."""
    return variable(elastic, "peak_pressure") / attribute(elastic, "hardness")


def plastic_over_elastic_area(elastic: xr.Dataset) -> xr.Dataset:
    """Area that bears the preload at the hardness over that of elastic contact (surface)."""
    plastic = attribute(elastic, "preload") / attribute(elastic, "hardness") / NM2
    return mean_over_scans(plastic / mean_over_contacts(elastic["contact_area"]))


def deformation_over_adhesion(topography: xr.Dataset, elastic: xr.Dataset) -> xr.Dataset:
    """Elastic energy of conforming contact over the work of adhesion (surface).

    E*/4 (1/2π) ∫ q² C dq of a surface's AFM scans, those of one body; Persson and Tosatti,
    J. Chem. Phys. 115 (2001) 5597. Wavelengths beyond the scans would add to it.
    """
    spectrum = topography["psd_isotropic"].sel(surface=elastic["surface"]).fillna(0)
    moment = (topography["wavevector"] ** 2 * spectrum).integrate("wavevector") / (2 * np.pi)
    energy = attribute(elastic, "effective_modulus") / 4 * 1e-9 * moment.where(moment > 0)
    return mean_over_scans(energy / attribute(elastic, "work_of_adhesion"))


# --- classical models -------------------------------------------------------------------------


def effective_work_decades(classical: xr.Dataset) -> xr.Dataset:
    """Decades between the effective works of adhesion of the surfaces (against, tabor)."""
    return decades(variable(classical, "effective_work_of_adhesion"), "surface")


def classical_over_numerical(classical: xr.Dataset, inference: xr.Dataset) -> xr.Dataset:
    """Least error of a classical model over that of the force sum.

    (metrics, model, against, contact_model); the error of the force sum has no interval.
    """
    return variable(classical, "mean_relative_error") / inference["best_error"]


FUNCTIONS = (
    slope_by_scales,
    slope_over_height,
    curvature_over_height,
    contact_height,
    plastic_contact_area,
    touching_share,
    elastic_change,
    peak_over_hardness,
    plastic_over_elastic_area,
    deformation_over_adhesion,
    effective_work_decades,
    classical_over_numerical,
)
