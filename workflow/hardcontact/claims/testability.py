"""What of a claim is decided beforehand, by scans that are substitutes or by construction."""

from collections.abc import Mapping
from typing import Any

import xarray as xr

from hardcontact.claims.selection import Selection, selected_labels
from hardcontact.claims.verdicts import BY_CONSTRUCTION, UNTESTABLE
from hardcontact.surfaces.calibration import rows_met

__all__ = ["NO_SCAN", "basis", "fixed_verdict", "surfaces_of"]

NO_SCAN = "no scan"


def surfaces_of(
    claim: Any, parts: Mapping[str, xr.Dataset], chosen: Selection, topography: xr.Dataset
) -> list[str]:
    """Return the surfaces that a claim depends on.

    These are the surfaces it selects, or all of its first dataset when it selects none. A claim
    about more than topography depends on the sphere as well.

    Parameters
    ----------
    claim : tuple
        A row of resources/paper/claims.csv.
    parts : mapping of str to xarray.Dataset
        The datasets of the claim by name.
    chosen : Selection
        As from `selection.selection`.
    topography : xarray.Dataset
        As in topography.nc.

    Returns
    -------
    list of str
        Empty for a claim that needs no scan.
    """
    if claim.needs == NO_SCAN:
        return []
    known = set(topography["surface"].values)
    surfaces = [label for label in selected_labels(chosen) if label in known]
    if not surfaces:
        surfaces = list(next(iter(parts.values()))["surface"].values)
    if set(parts) != {"topography"}:
        surfaces.append(topography.attrs["sphere_surface"])
    return [str(surface) for surface in surfaces]


def basis(surfaces: list[str], topography: xr.Dataset) -> str:
    """Return what a number about surfaces stands on.

    Parameters
    ----------
    surfaces : list of str
        As from `surfaces_of`.
    topography : xarray.Dataset
        As in topography.nc.

    Returns
    -------
    str
        `measured`, `substitute scans` or `no scan`.
    """
    if not surfaces:
        return NO_SCAN
    return "substitute scans" if any(_is_substitute(surfaces, topography)) else "measured"


def _is_substitute(surfaces: list[str], topography: xr.Dataset) -> list[bool]:
    return [of == "substitute" for of in topography["basis"].sel(surface=surfaces).values]


def fixed_verdict(claim: Any, surfaces: list[str], topography: xr.Dataset) -> tuple[str, str]:
    """Return a verdict that no number decides, and why.

    Parameters
    ----------
    claim : tuple
        A row of resources/paper/claims.csv.
    surfaces : list of str
        As from `surfaces_of`.
    topography : xarray.Dataset
        As in topography.nc: `calibrated_to_table1` names the rows of Table 1 that the scans of a
        surface meet by construction.

    Returns
    -------
    verdict, reason : str
        Both empty where the number decides.
    """
    if claim.needs == "construction":
        return BY_CONSTRUCTION, ""
    substitutes = _is_substitute(surfaces, topography)
    if claim.needs == "measured" and any(substitutes):
        return UNTESTABLE, "The substitute scans assume this."
    met = topography["calibrated_to_table1"].sel(surface=surfaces).values
    by_construction = [
        substitute and claim.quantity in rows_met(str(rows))
        for substitute, rows in zip(substitutes, met, strict=True)
    ]
    if surfaces and all(by_construction):
        return BY_CONSTRUCTION, "The substitute scans are made to meet this."
    return "", ""
