"""The surfaces on which a claim rests, and the verdicts that follow from these surfaces alone."""

from collections.abc import Mapping
from itertools import chain
from typing import Any

import pandas as pd
import xarray as xr

from hardcontact.base.published import rows_met
from hardcontact.paper.claims.selection import SelectedLabels
from hardcontact.paper.claims.verdicts import BY_CONSTRUCTION, EXPERIMENT, UNTESTABLE

#: Words in the column `needs` for a claim that needs no scan; they are also its basis.
WITHOUT_SCAN = ("no scan", "no scan; assumed asperities")
#: Quantities of Table 1 that depend on the size of a pixel.
PIXEL_QUANTITIES = ("afm_rms_slope", "afm_rms_curvature", "slope_growth")
#: Why these quantities are not testable on larger pixels.
LARGER_PIXELS = "It depends on the size of a pixel, which is larger than the paper's."


def claim_surfaces(
    claim: Any, datasets: Mapping[str, xr.Dataset], labels: SelectedLabels, topography: xr.Dataset
) -> list[str]:
    """Return the names of the surfaces on which a claim depends.

    A claim depends on the surfaces that it selects. If it selects none, it depends on all surfaces
    of its first dataset. Unless it is about topography alone, it depends on the sphere, too. A
    claim that needs no scan depends on no surface.
    """
    if claim.needs in WITHOUT_SCAN:
        return []
    study_surfaces = set(topography["surface"].values)
    all_labels = chain.from_iterable(group for groups in labels.values() for group in groups)
    surfaces = [label for label in all_labels if label in study_surfaces]
    if not surfaces:
        surfaces = list(next(iter(datasets.values()))["surface"].values)
    if set(datasets) != {"topography"}:
        surfaces.append(topography.attrs["sphere_surface"])
    return [str(surface) for surface in surfaces]


def claim_basis(claim: Any, surfaces: list[str], topography: xr.Dataset) -> str:
    """Return the basis of a claim: ``measured``, ``substitute scans`` or one of WITHOUT_SCAN."""
    if claim.needs in WITHOUT_SCAN:
        return str(claim.needs)
    return "substitute scans" if any(_are_substitutes(surfaces, topography)) else "measured"


def _are_substitutes(surfaces: list[str], topography: xr.Dataset) -> list[bool]:
    return [source == "substitute" for source in topography["source"].sel(surface=surfaces).values]


def fixed_verdict(
    claim: Any, surfaces: list[str], topography: xr.Dataset, constants: pd.DataFrame
) -> tuple[str, str]:
    """Return a verdict that does not depend on the estimate, and its reason, or empty texts.

    ``table1_rows_met`` of topography.nc names the rows of Table 1 that the scans of a surface meet
    by construction.
    """
    if claim.needs == "construction":
        return BY_CONSTRUCTION, ""
    if claim.needs == "experiment":
        return EXPERIMENT, "The paper says this of its experiment."
    substitutes = _are_substitutes(surfaces, topography)
    if claim.needs == "measured" and any(substitutes):
        return UNTESTABLE, "The substitute scans decide this."
    rows_by_surface = topography["table1_rows_met"].sel(surface=surfaces).values
    meets_by_construction = [
        is_substitute and claim.quantity in rows_met(str(rows))
        for is_substitute, rows in zip(substitutes, rows_by_surface, strict=True)
    ]
    if surfaces and all(meets_by_construction):
        return BY_CONSTRUCTION, "The substitute scans of the study are made to meet this."
    if claim.quantity in PIXEL_QUANTITIES and _has_larger_pixels(topography, constants["value"]):
        return UNTESTABLE, LARGER_PIXELS
    return "", ""


def _has_larger_pixels(topography: xr.Dataset, published_constants: "pd.Series[float]") -> bool:
    """Return whether the scans have larger pixels than the paper's."""
    pixel_size = published_constants["scan_size"] / published_constants["scan_pixels"]
    return bool(topography["pixel_size"].max() > 1.01 * pixel_size)
