"""Numbers about contact (height, area, deformation), classical models and effective works.

Lengths in nm, forces in N, pressures in Pa. Each function returns a number as `numbers.number`
does; in brackets its dimensions.
"""

import json

import numpy as np
import xarray as xr

from hardcontact.contact.smooth_sphere import Material, effective_modulus
from hardcontact.paper.numbers import (
    absolute_value,
    decades,
    mean_over_contacts,
    mean_over_scans,
    number,
    quotient,
    signed_mean_over_scans,
    variable_as_number,
)

NM2 = 1e-18  # in m²
#: nm; the wavelengths that decide are some 2 µm.
LARGE_RADIUS = 50e3


def effective_work_decades(classical: xr.Dataset) -> xr.Dataset:
    """Return the decades between effective works of adhesion of the surfaces (against)."""
    return decades(variable_as_number(classical, "effective_work_of_adhesion"), "surface")


def printed_effective_work(classical: xr.Dataset) -> xr.Dataset:
    """Return effective works of adhesion of printed forces, without their rounding (surface)."""
    return number(classical["effective_work_of_adhesion"].sel(against="published", drop=True))


def tabor_by_convention(classical: xr.Dataset) -> xr.Dataset:
    """Return the Tabor parameter, up to that by another convention of the same symbols ().

    It is (4 R W²/(K² z0³))^(1/3) with K = 4 E*/3, in place of (R W²/(E*² z0³))^(1/3).
    """
    tabor = classical["tabor_parameter"]
    return number(tabor, tabor, (9 / 4) ** (1 / 3) * tabor)


def classical_over_numerical(classical: xr.Dataset, inference: xr.Dataset) -> xr.Dataset:
    """Return the least error of a classical model over that of the force sum.

    Over metrics, model, against and contact_model.
    """
    return quotient(
        variable_as_number(classical, "mean_relative_error"),
        variable_as_number(inference, "best_error"),
    )


def contact_height(adhesion: xr.Dataset, topography: xr.Dataset) -> xr.Dataset:
    """Return the height of the sphere's apex in contact over the mean plane.

    In rms heights of the scan (surface, contact_model). Under a smooth sphere all contact pixels
    are at least as high.
    """
    approach = mean_over_contacts(adhesion["closest_approach"])
    return mean_over_scans(-approach / topography["rms_height"], adhesion.attrs["confidence"])


def plastic_contact_area(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the area in nm² of the pixels in contact (contact_model)."""
    pixel_area: float = adhesion.attrs["pixel_size"] ** 2
    return number(adhesion["contact_pixels"] * pixel_area)


def finer_pixel_change(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the plastic force at the smallest range on finer pixels over the study's (surface)."""
    return mean_over_scans(adhesion["finer_pixel_change"], adhesion.attrs["confidence"])


def elastic_change(elastic: xr.Dataset) -> xr.Dataset:
    """Return the difference of mean elastic and rigid force over the rigid one (surface)."""
    soft, rigid = (
        mean_over_contacts(elastic[f"{model}_pull_off_force"]) for model in ("elastic", "rigid")
    )
    return absolute_value(signed_mean_over_scans(soft / rigid - 1, elastic.attrs["confidence"]))


def typical_hard_share(elastic: xr.Dataset) -> xr.Dataset:
    """Return the share of the contact area that bears more than the hardness ().

    It is the median over the surfaces.
    """
    return variable_as_number(elastic, "hard_share").median("surface", skipna=False)


def typical_plastic_over_elastic_area(elastic: xr.Dataset) -> xr.Dataset:
    """Return the area that carries the preload at the hardness over the elastic one ().

    It is the median over the surfaces.
    """
    plastic = elastic.attrs["preload"] / elastic.attrs["hardness"] / NM2
    ratio = plastic / mean_over_contacts(elastic["contact_area"])
    return mean_over_scans(ratio, elastic.attrs["confidence"]).median("surface", skipna=False)


def deformation_over_adhesion(topography: xr.Dataset, elastic: xr.Dataset) -> xr.Dataset:
    """Return the elastic energy of conforming contact over the work of adhesion (surface).

    E*/4 (1/2π) ∫ q² C dq of a surface's AFM scans, those of one body; Persson and Tosatti,
    J. Chem. Phys. 115 (2001) 5597. Wavelengths beyond the scans would add to it.
    """
    spectrum = topography["psd_isotropic"].sel(surface=elastic["surface"]).fillna(0)
    moment = (topography["wavevector"] ** 2 * spectrum).integrate("wavevector") / (2 * np.pi)
    energy = elastic.attrs["effective_modulus"] / 4 * 1e-9 * moment.where(moment > 0)
    ratio = energy / elastic.attrs["work_of_adhesion"]
    return mean_over_scans(ratio, elastic.attrs["confidence"])


def typical_force_exponent(scaling: xr.Dataset) -> xr.Dataset:
    """Return the exponent of the force against the radius, the median over the surfaces ()."""
    return variable_as_number(scaling, "force_exponent").median("surface", skipna=False)


def typical_long_edge_exponent(scaling: xr.Dataset) -> xr.Dataset:
    """Return the exponent of the long edge against the root of the radius ().

    It is the median over the surfaces, for spheres much larger than scales of the roughness, of
    R >= LARGE_RADIUS. The interval takes the edges of the smallest and the largest at their worst.
    """
    case = {name: scaling.attrs[name] for name in ("rho", "area")}
    large = scaling.sel(side="large").sel(case, method="nearest")
    large = large.sel(radius=large["radius"] >= LARGE_RADIUS)
    smallest, largest = large.isel(radius=0), large.isel(radius=-1)
    ratio = quotient(variable_as_number(largest, "edge"), variable_as_number(smallest, "edge"))
    root = (largest["radius"] / smallest["radius"]) ** 0.5
    return (ratio.map(np.log) / np.log(root)).median("surface", skipna=False)


def nonstickiness(topography: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return how far a surface is from sticking, with the roughness of all scales (surface).

    Two large rough surfaces do not stick above one, which balances attraction beside the contacts
    and repulsion in them: h' r/(k l) (h' d/(4 r))^(2/3) / (pi (3/16)^(2/3)) with the rms slope h',
    the rms curvature h'', d = 4 h'/h'', l = W/E*, k = 2 and r the range of adhesion, here the
    smallest of atomic interactions. Pastewka and Robbins, Proceedings of the National Academy of
    Sciences 111 (2014) 3298.
    """
    names = json.loads(topography.attrs["table1_variables"])
    slope, curvature = (topography[names[f"all_rms_{name}"]] for name in ("slope", "curvature"))
    bodies = (
        Material(
            modulus=paper[f"{body}_youngs_modulus"].item(),
            poisson_ratio=paper[f"{body}_poisson_ratio"].item(),
        )
        for body in ("sphere", "substrate")
    )
    length = 1e9 * paper["work_of_adhesion"] / effective_modulus(*bodies)  # nm
    reach = paper["atomic_range_lower_bound"]
    repulsion = slope * reach / (2 * length)
    attraction = np.pi * (3 / 16) ** (2 / 3) * (reach * curvature / slope**2) ** (2 / 3)
    return number(repulsion / attraction)
