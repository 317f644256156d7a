"""The answer in words: the band and the force of a surface, the fit of its own forces."""

import re

import numpy as np
import xarray as xr

from hardcontact.answer.force_curve import at_range
from hardcontact.answer.quantities import print_bounded, print_length, print_quantity
from hardcontact.answer.ratios import SIDES
from hardcontact.figures.style import print_share

__all__ = [
    "added_forces",
    "band_sentences",
    "edge_words",
    "fit_sentences",
    "force_sentences",
    "is_open",
    "one_sentence",
    "pooled_sentence",
    "printed_added_forces",
    "printed_force",
    "printed_pair",
]

#: The text of an open edge: bound, reason, and what is said of its interval.
OPEN_TEXT = re.compile(r"^(.+?): (.+?)( \[.*\])?$")
#: What an edge without an interval ends with.
NO_INTERVAL = ", no interval"

#: The wavelengths that are added beyond the scans at each side.
ADDED = {"small": "shorter", "large": "longer"}

#: The end of the band at each side.
ENDS = {"small": "shortest", "large": "longest"}


def is_open(edges: xr.Dataset, side: str) -> bool:
    """Return whether the edge at one side of a surface lies beyond what was computed."""
    return bool(edges["edge_status"].sel(side=side).item() != "found")


def one_sentence(label: str, edges: xr.Dataset, force: xr.Dataset) -> str:
    """Return the answer of a surface in one sentence: its band and its force.

    Parameters
    ----------
    label : str
        Of the surface.
    edges : xarray.Dataset
        Part of edges.nc of the surface: `edge_text` and `unfiltered_force` (side).
    force : xarray.Dataset
        Part of force.nc of the surface.

    Returns
    -------
    str
        Plain text.
    """
    added = printed_added_forces(edges, force)
    if added:
        added = f" with the wavelengths that its scans show, {added} added,"
    return (
        f"How {label} sticks is decided by roughness with wavelengths {_from_to(edges)}; its "
        f"predicted pull-off force is {printed_force(force)}{added} {printed_pair(force)}."
    )


def added_forces(edges: xr.Dataset, force: xr.Dataset) -> dict[str, float]:
    """Return the mean force in N with roughness added that the scans do not show, by side.

    Parameters
    ----------
    edges : xarray.Dataset
        Part of edges.nc of a surface: `unfiltered_force` (side) at 1 J/m².
    force : xarray.Dataset
        Part of force.nc of the surface.

    Returns
    -------
    dict
        Of each side on which it changes the force by more than the tolerance of the band.
    """
    mean, work = at_range(force)["force"].item(), force.attrs["work_of_adhesion"]
    forces = {side: edges["unfiltered_force"].sel(side=side).item() * work for side in SIDES}
    tolerance = edges.attrs["tolerance"]
    return {side: value for side, value in forces.items() if abs(value / mean - 1) > tolerance}


def printed_added_forces(edges: xr.Dataset, force: xr.Dataset) -> str:
    """Return `added_forces` as "97 nN with shorter and 0.3 µN with longer ones", or nothing."""
    forces = added_forces(edges, force)
    texts = [f"{print_quantity(forces[side], 'N')} with {ADDED[side]}" for side in forces]
    return f"{' and '.join(texts)} ones" if texts else ""


def band_sentences(label: str, edges: xr.Dataset) -> str:
    """Return the band of a surface in words, what it means, and which of its ends are open.

    Parameters
    ----------
    label : str
        Of the surface.
    edges : xarray.Dataset
        Part of edges.nc of the surface: `edge_text` and `edge_status` (side), `interval_note`,
        `scale_ratio_interval`,
        the attributes `tolerance` and `confidence`.

    Returns
    -------
    str
        Plain text.
    """
    tolerance = print_share(edges.attrs["tolerance"])
    opened = [
        f" The {name} of these wavelengths is open, not found: {edge_words(edges, side)}."
        for side, name in ENDS.items()
        if is_open(edges, side)
    ]
    remainder = (
        f"If all roughness below this band, or all above it, is removed, the force changes by less "
        f"than {tolerance}."
        if not opened
        else f"An end of the band is where the force begins to change by more than {tolerance} "
        "when all roughness beyond it is removed."
    )
    note = str(edges["interval_note"].item())
    intervals = f"{_capital(note)}."
    if np.isfinite(edges["scale_ratio_interval"]).any():
        intervals = f"Brackets are {print_share(edges.attrs['confidence'])} intervals, {note}."
    return (
        f"The pull-off force of {label} is decided by roughness with wavelengths "
        f"{_from_to(edges)}. {remainder}{''.join(opened)} {intervals}"
    )


def pooled_sentence(edges: xr.Dataset) -> str:
    """Return the band of the mean change over all surfaces: edges.nc with `pooled_edge_text`."""
    pooled = edges[["pooled_edge_text"]].rename(pooled_edge_text="edge_text")
    return (
        "The mean over all surfaces of the relative change of the force gives the band "
        f"{_from_to(pooled)}."
    )


def edge_words(edges: xr.Dataset, side: str) -> str:
    """Return the edge at one side as a sentence holds it: "at least 5 µm (the scans end here)".

    That there is no interval is said once for all.
    """
    text = str(edges["edge_text"].sel(side=side).item()).removesuffix(NO_INTERVAL)
    return OPEN_TEXT.sub(r"\1\3 (\2)", text)


def _from_to(edges: xr.Dataset) -> str:
    """Return both edges as "from 37 nm [31, 44] to at least 5 µm (the scans end here)"."""
    first, last = (edge_words(edges, side) for side in SIDES)
    return f"from {first} to {last}"


def printed_force(force: xr.Dataset) -> str:
    """Return the force of a surface at the range asked for, with its interval if it has one."""
    return print_bounded(at_range(force), "force", "N")


def printed_pair(force: xr.Dataset) -> str:
    """Return the range and the work of adhesion that a force stands at."""
    return (
        f"at a range of adhesion of {print_length(force.attrs['range_of_adhesion'])} and a work "
        f"of adhesion of {print_quantity(force.attrs['work_of_adhesion'], 'J m-2')}"
    )


def force_sentences(label: str, force: xr.Dataset) -> str:
    """Return the predicted force of a surface, its uncertainty and its spread over contacts.

    Parameters
    ----------
    label : str
        Of the surface.
    force : xarray.Dataset
        Part of force.nc of the surface.

    Returns
    -------
    str
        Plain text.
    """
    here = at_range(force)
    certainty = str(force["interval_note"].item())
    if np.isfinite(here["force_interval"]).all():
        share = print_share(force.attrs["confidence"])
        certainty = f"brackets: {share} interval of the mean, {certainty}"
    least, most = here["force_quantile"].isel(quantile=[0, -1]).values
    share = print_share(float(np.ptp(here["quantile"].values)))
    model = str(here["contact_model"].item())
    return (
        f"The mean pull-off force of {label} is {printed_force(force)} {printed_pair(force)}, for "
        f"{model} contact ({certainty}). Of single contacts {share} lie between "
        f"{print_quantity(least, 'N')} and {print_quantity(most, 'N')}. The force is proportional "
        "to the work of adhesion."
    )


def fit_sentences(fit: xr.Dataset) -> str:
    """Return what the user's own forces say about range and work of adhesion.

    Parameters
    ----------
    fit : xarray.Dataset
        Part of fit.nc of one contact model: `measured_force` in N with its interval, `tests`,
        `label` and `interval_note` (surface), `work_of_adhesion` (surface, rho), `fit_text`.

    Returns
    -------
    str
        Plain text.
    """
    surfaces = [fit.sel(surface=surface) for surface in fit["surface"].values]
    forces = ", ".join(
        f"{print_bounded(one, 'measured_force', 'N')} on {one['label'].item()} "
        f"({one['interval_note'].item()})"
        for one in surfaces
    )
    text = f"Measured: {forces}. {_capital(str(fit['fit_text'].item()))}."
    if len(surfaces) == 1:
        first, last = (_work_at_range(surfaces[0].isel(rho=place)) for place in (0, -1))
        text += f" It runs from {first} to {last}."
    return f"{text} Brackets: {print_share(fit.attrs['confidence'])} intervals."


def _work_at_range(fit: xr.Dataset) -> str:
    """Return the work of adhesion that fits at one range, as printed."""
    work = print_bounded(fit, "work_of_adhesion", "J m-2")
    return f"{work} at a range of {print_length(fit['rho'].item())}"


def _capital(text: str) -> str:
    """Return a text that begins with a capital letter."""
    return text[:1].upper() + text[1:]
