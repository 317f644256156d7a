"""Estimates (`estimates`) about roughness, contact and elasticity, for claims.

Claims name the public functions in their column `quantity` (`judgement.DERIVED_QUANTITIES`).
Lengths are in nm, forces in N, pressures in Pa.
"""

import numpy as np
import xarray as xr

from hardcontact.base.published import effective_modulus
from hardcontact.base.statistics import interval_ends
from hardcontact.base.units import NANOMETRE
from hardcontact.contact.pull_off import mean_over_contacts
from hardcontact.paper.claims.estimates import (
    absolute_value,
    as_estimate,
    mean_over_scans,
    quotient,
    signed_mean_over_scans,
    variable_estimate,
)
from hardcontact.surfaces.metrics import TABLE1_VARIABLES

#: κ: E* h' of a smooth sphere relative to its mean pressure, by Hertz (findings.md).
SLOPE_OVER_PRESSURE = 3 * np.pi / (4 * np.sqrt(2))


def slope_growth(topography: xr.Dataset) -> xr.Dataset:
    """Return the rms slope of all scales relative to the AFM scans (surface)."""
    return _all_over_afm(topography, "slope")


def slope_growth_over_height_growth(topography: xr.Dataset) -> xr.Dataset:
    """Return the growth of rms slope from AFM to all scales, over that of height (surface)."""
    return quotient(_all_over_afm(topography, "slope"), _all_over_afm(topography, "height"))


def curvature_growth_over_height_growth(topography: xr.Dataset) -> xr.Dataset:
    """Return the growth of rms curvature from AFM to all scales, over that of height (surface)."""
    return quotient(_all_over_afm(topography, "curvature"), _all_over_afm(topography, "height"))


def _all_over_afm(topography: xr.Dataset, quantity: str) -> xr.Dataset:
    """Return an rms quantity of all scales relative to the AFM scans (surface)."""
    all_scales = variable_estimate(topography, TABLE1_VARIABLES[f"all_rms_{quantity}"])
    afm = variable_estimate(topography, TABLE1_VARIABLES[f"afm_rms_{quantity}"])
    return quotient(all_scales, afm)


def apex_level(adhesion: xr.Dataset, topography: xr.Dataset) -> xr.Dataset:
    """Return the height of the sphere's apex in rms heights (surface, contact_model)."""
    apex_height = mean_over_contacts(adhesion["apex_height"])
    return mean_over_scans(apex_height / topography["rms_height"], adhesion.attrs["confidence"])


def plastic_contact_area(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the area in nm² of the pixels in contact (contact_model)."""
    return as_estimate(adhesion["contact_pixel_count"] * adhesion.attrs["pixel_size"] ** 2)


def share_of_two_asperities(asperities: xr.Dataset) -> xr.Dataset:
    """Return the share of the force that the two strongest asperities carry (surface, rho)."""
    estimate = variable_estimate(asperities, "two_largest_share")
    low, high = interval_ends(estimate, "value")
    # All asperities together carry the attribute `share`.
    return as_estimate(estimate["value"], low, high.clip(max=asperities.attrs["share"]))


def elastic_change(elastic: xr.Dataset) -> xr.Dataset:
    """Return the magnitude of the relative change of the mean force by elasticity (surface)."""
    elastic_force = mean_over_contacts(elastic["elastic_pull_off_force"])
    rigid_force = mean_over_contacts(elastic["rigid_pull_off_force"])
    change = elastic_force / rigid_force - 1
    return absolute_value(signed_mean_over_scans(change, elastic.attrs["confidence"]))


def median_share_above_hardness(elastic: xr.Dataset) -> xr.Dataset:
    """Return the median over surfaces of the share of contact area above the hardness ()."""
    return variable_estimate(elastic, "share_above_hardness").median("surface", skipna=False)


def median_plastic_over_elastic_area(elastic: xr.Dataset) -> xr.Dataset:
    """Return the median over surfaces of the area of plastic relative to elastic contact ()."""
    plastic_area = elastic.attrs["preload"] / elastic.attrs["hardness"] / NANOMETRE**2
    ratio = plastic_area / mean_over_contacts(elastic["elastic_contact_area"])
    return mean_over_scans(ratio, elastic.attrs["confidence"]).median("surface", skipna=False)


def deformation_over_adhesion(topography: xr.Dataset, elastic: xr.Dataset) -> xr.Dataset:
    """Return the elastic energy of conforming contact relative to the work of adhesion (surface).

    The energy is E*/4 (1/2π) ∫ q² C dq for the AFM scans; Persson and Tosatti, J. Chem. Phys. 115
    (2001) 5597.
    """
    # C is NaN at wavevectors that a scan does not have.
    density = topography["isotropic_psd"].sel(surface=elastic["surface"]).fillna(0)
    moment = (topography["wavevector"] ** 2 * density).integrate("wavevector") / (2 * np.pi)
    energy_per_area = elastic.attrs["effective_modulus"] / 4 * NANOMETRE * moment.where(moment > 0)
    ratio = energy_per_area / elastic.attrs["work_of_adhesion"]
    return mean_over_scans(ratio, elastic.attrs["confidence"])


def elastic_pressure_over_hardness(topography: xr.Dataset, elastic: xr.Dataset) -> xr.Dataset:
    """Return the mean pressure of elastic contact relative to the hardness (surface).

    The pressure is E* h'/κ with the rms slope h' of all scales and the κ of a smooth sphere. For a
    rough flat κ is 1.6 (Persson, J. Chem. Phys. 115 (2001) 3840) to 2.5 (Bush, Gibson and Thomas,
    Wear 35 (1975) 87).
    """
    slope = topography[TABLE1_VARIABLES["all_rms_slope"]].sel(surface=elastic["surface"])
    pressure = elastic.attrs["effective_modulus"] * slope / SLOPE_OVER_PRESSURE
    return as_estimate(pressure / elastic.attrs["hardness"])


def nonstickiness(topography: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the repulsion in contacts relative to the attraction around them (surface).

    Two large rough surfaces stick if it is below one: Pastewka and Robbins, Proceedings of the
    National Academy of Sciences 111 (2014) 3298.
    """
    slope = topography[TABLE1_VARIABLES["all_rms_slope"]]
    curvature = topography[TABLE1_VARIABLES["all_rms_curvature"]]
    adhesion_length = 1e9 * paper["work_of_adhesion"] / effective_modulus(paper)  # nm
    shortest_range = paper["atomic_range_lower_bound"]
    repulsion = slope * shortest_range / (2 * adhesion_length)
    attraction = np.pi * (3 / 16) ** (2 / 3) * (shortest_range * curvature / slope**2) ** (2 / 3)
    return as_estimate(repulsion / attraction)
