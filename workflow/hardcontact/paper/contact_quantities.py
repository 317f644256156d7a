"""Estimates about contact, classical models and effective works of adhesion.

Lengths in nm, forces in N, pressures in Pa. Each function returns an estimate, a dataset of `value`
and `value_interval` (`paper.estimates`); its dimensions are in brackets.
"""

import numpy as np
import xarray as xr

from hardcontact.base.published import effective_modulus
from hardcontact.base.statistics import interval_ends
from hardcontact.base.units import NANOMETRE
from hardcontact.paper.estimates import (
    absolute_value,
    as_estimate,
    decades,
    mean_over_contacts,
    mean_over_scans,
    quotient,
    signed_mean_over_scans,
    variable_estimate,
)
from hardcontact.surfaces.metrics import TABLE1_VARIABLES

#: E* h' of a smooth sphere relative to its mean pressure, by Hertz.
SLOPE_OVER_PRESSURE = 3 * np.pi / (4 * np.sqrt(2))


def effective_work_decades(classical: xr.Dataset) -> xr.Dataset:
    """Return the decades between the smallest and largest effective work (force_source)."""
    return decades(variable_estimate(classical, "effective_work_of_adhesion"), "surface")


def printed_effective_work(classical: xr.Dataset) -> xr.Dataset:
    """Return effective works of adhesion of the published forces, without interval (surface)."""
    return as_estimate(
        classical["effective_work_of_adhesion"].sel(force_source="published", drop=True)
    )


def tabor_by_convention(classical: xr.Dataset) -> xr.Dataset:
    """Return the Tabor parameter (no dimensions).

    Its interval reaches to its value by another convention: (4 R W²/(K² z0³))^(1/3) with
    K = 4 E*/3 in place of (R W²/(E*² z0³))^(1/3).
    """
    tabor = classical["tabor_parameter"]
    return as_estimate(tabor, tabor, (9 / 4) ** (1 / 3) * tabor)


def classical_over_numerical(classical: xr.Dataset, fit: xr.Dataset) -> xr.Dataset:
    """Return the smallest error of a classical model, relative to the error of the computed forces.

    Its dimensions are metrics, model, force_source and contact_model.
    """
    return quotient(
        variable_estimate(classical, "mean_relative_error"), variable_estimate(fit, "best_error")
    )


def apex_level(adhesion: xr.Dataset, topography: xr.Dataset) -> xr.Dataset:
    """Return the height of the apex of the sphere in contact above the mean plane.

    It is in rms heights of the scan (surface, contact_model). Contact pixels are at least as high,
    because a smooth sphere is lowest at its apex.
    """
    apex_height = mean_over_contacts(adhesion["apex_height"])
    return mean_over_scans(apex_height / topography["rms_height"], adhesion.attrs["confidence"])


def plastic_contact_area(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the area in nm² of the pixels in contact (contact_model)."""
    pixel_area: float = adhesion.attrs["pixel_size"] ** 2
    return as_estimate(adhesion["contact_pixel_count"] * pixel_area)


def finer_pixel_ratio(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the plastic force on finer pixels relative to the pixels of the study (surface).

    The force is taken at the smallest computed range. The finer pixels have half the width.
    """
    return mean_over_scans(adhesion["finer_pixel_ratio"], adhesion.attrs["confidence"])


def elastic_change(elastic: xr.Dataset) -> xr.Dataset:
    """Return the magnitude of the relative change of the mean force by elasticity (surface)."""
    elastic_force = mean_over_contacts(elastic["elastic_pull_off_force"])
    rigid_force = mean_over_contacts(elastic["rigid_pull_off_force"])
    change = elastic_force / rigid_force - 1
    return absolute_value(signed_mean_over_scans(change, elastic.attrs["confidence"]))


def median_share_above_hardness(elastic: xr.Dataset) -> xr.Dataset:
    """Return the share of the contact area whose pressure exceeds the hardness (no dimensions).

    It is the median over the surfaces.
    """
    return variable_estimate(elastic, "share_above_hardness").median("surface", skipna=False)


def share_of_two_asperities(asperities: xr.Dataset) -> xr.Dataset:
    """Return the share of the force that the two strongest asperities carry (surface, rho).

    All asperities together carry the attribute ``share`` of the force: the interval ends there.
    """
    share = variable_estimate(asperities, "two_largest_share")
    low, high = interval_ends(share, "value")
    return as_estimate(share["value"], low, high.clip(max=asperities.attrs["share"]))


def median_plastic_over_elastic_area(elastic: xr.Dataset) -> xr.Dataset:
    """Return the area of plastic contact relative to elastic contact (no dimensions).

    It is the median over the surfaces; the area of plastic contact is preload/hardness.
    """
    plastic_area = elastic.attrs["preload"] / elastic.attrs["hardness"] / NANOMETRE**2
    ratio = plastic_area / mean_over_contacts(elastic["elastic_contact_area"])
    return mean_over_scans(ratio, elastic.attrs["confidence"]).median("surface", skipna=False)


def deformation_over_adhesion(topography: xr.Dataset, elastic: xr.Dataset) -> xr.Dataset:
    """Return the elastic energy of conforming contact relative to the work of adhesion (surface).

    The energy is E*/4 (1/2π) ∫ q² C dq for the AFM scans of one body; Persson and Tosatti, J. Chem.
    Phys. 115 (2001) 5597. Wavelengths beyond the scans would add to it.
    """
    spectrum = topography["isotropic_psd"].sel(surface=elastic["surface"]).fillna(0)
    moment = (topography["wavevector"] ** 2 * spectrum).integrate("wavevector") / (2 * np.pi)
    energy_per_area = elastic.attrs["effective_modulus"] / 4 * NANOMETRE * moment.where(moment > 0)
    ratio = energy_per_area / elastic.attrs["work_of_adhesion"]
    return mean_over_scans(ratio, elastic.attrs["confidence"])


def median_force_exponent(exponents: xr.Dataset) -> xr.Dataset:
    """Return d ln(force)/d ln(radius), the median over the surfaces (no dimensions)."""
    return variable_estimate(exponents, "force_exponent").median("surface", skipna=False)


def median_edge_exponent(exponents: xr.Dataset) -> xr.Dataset:
    """Return d ln(edge)/d ln(root of a quantity), the median over surfaces (side, exponent_of).

    NaN if the edges of a surface determine no exponent. The interval is the median over the
    surfaces with an interval.
    """
    exponent = variable_estimate(exponents, "edge_exponent")
    is_known = exponent["value"].notnull().all("surface")
    return exponent.median("surface").where(is_known)


def elastic_pressure_over_hardness(topography: xr.Dataset, elastic: xr.Dataset) -> xr.Dataset:
    """Return the mean pressure of elastic contact relative to the hardness (surface).

    The pressure is E* h'/k with the rms slope h' of all scales and the k of a smooth sphere. For a
    rough flat k is 1.6 (Persson, J. Chem. Phys. 115 (2001) 3840) to 2.5 (Bush, Gibson and Thomas,
    Wear 35 (1975) 87).
    """
    slope = topography[TABLE1_VARIABLES["all_rms_slope"]].sel(surface=elastic["surface"])
    pressure = elastic.attrs["effective_modulus"] * slope / SLOPE_OVER_PRESSURE
    return as_estimate(pressure / elastic.attrs["hardness"])


def nonstickiness(topography: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the repulsion in contacts relative to the attraction around them (surface).

    Two large rough surfaces stick if it is below one. It is h' ρ E*/(2 W) divided by
    π (3/16)^(2/3) (ρ h''/h'²)^(2/3), with the rms slope h' and the rms curvature h'' of all scales.
    The range of adhesion ρ is the shortest range of atomic interactions. Pastewka and Robbins,
    Proceedings of the National Academy of Sciences 111 (2014) 3298.
    """
    slope = topography[TABLE1_VARIABLES["all_rms_slope"]]
    curvature = topography[TABLE1_VARIABLES["all_rms_curvature"]]
    adhesion_length = 1e9 * paper["work_of_adhesion"] / effective_modulus(paper)  # nm
    shortest_range = paper["atomic_range_lower_bound"]
    repulsion = slope * shortest_range / (2 * adhesion_length)
    attraction = np.pi * (3 / 16) ** (2 / 3) * (shortest_range * curvature / slope**2) ** (2 / 3)
    return as_estimate(repulsion / attraction)


#: The functions that claims name.
QUANTITIES = (
    effective_work_decades, printed_effective_work, tabor_by_convention,
    classical_over_numerical, apex_level, plastic_contact_area, finer_pixel_ratio,
    elastic_change, median_share_above_hardness, share_of_two_asperities,
    median_plastic_over_elastic_area,
    deformation_over_adhesion, median_force_exponent, median_edge_exponent,
    elastic_pressure_over_hardness, nonstickiness,
)  # fmt: skip
