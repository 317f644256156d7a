"""Numbers about contact (height, area, deformation), classical models and effective works.

Lengths in nm, forces in N, pressures in Pa. Each function returns a number as `base.number`
does; in brackets its dimensions.
"""

import numpy as np
import xarray as xr

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


def effective_work_decades(classical: xr.Dataset) -> xr.Dataset:
    """Return the decades between effective works of adhesion of the surfaces (against)."""
    return decades(variable_as_number(classical, "effective_work_of_adhesion"), "surface")


def classical_over_numerical(classical: xr.Dataset, inference: xr.Dataset) -> xr.Dataset:
    """Return the least error of a classical model over that of the force sum.

    Over metrics, model, against and contact_model.
    """
    return quotient(
        variable_as_number(classical, "mean_relative_error"),
        variable_as_number(inference, "best_error"),
    )


def tabor_at_range(classical: xr.Dataset, paper: xr.Dataset) -> xr.Dataset:
    """Return the Tabor parameter with the published range of adhesion as the spacing ().

    It is inversely proportional to the spacing.
    """
    wider = paper["range_of_adhesion"] / paper["equilibrium_spacing"]
    at_range: xr.Dataset = variable_as_number(classical, "tabor_parameter") / wider
    return at_range


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


def peak_over_hardness(elastic: xr.Dataset) -> xr.Dataset:
    """Return the greatest pressure of an elastic contact over the hardness (surface)."""
    hardness: float = elastic.attrs["hardness"]
    return variable_as_number(elastic, "peak_pressure") / hardness


def plastic_over_elastic_area(elastic: xr.Dataset) -> xr.Dataset:
    """Return the area that carries the preload at the hardness over the elastic one (surface)."""
    plastic = elastic.attrs["preload"] / elastic.attrs["hardness"] / NM2
    ratio = plastic / mean_over_contacts(elastic["contact_area"])
    return mean_over_scans(ratio, elastic.attrs["confidence"])


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
