"""The answer in words: the band and the force of a surface."""

import re

import numpy as np
import xarray as xr

from hardcontact.answer.datasets import at_range
from hardcontact.numbers.printing import print_bounded, print_length, print_quantity, print_share

#: The text of an open edge: its bound with what is known of its interval, and the reason.
OPEN_TEXT = re.compile(r"^(.+?): (.+)$")
#: What an edge without an interval ends with.
NO_INTERVAL = ", no interval"

#: Where the wavelengths lie that continue the roughness of the scans at each side, and their end.
BEYOND = {"small": "below", "large": "above"}
LAST = {"small": "down to", "large": "up to"}

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
        Part of edges.nc of the surface: `edge_text` and `edge_status` (side).
    force : xarray.Dataset
        Part of force.nc of the surface.

    Returns
    -------
    str
        Plain text.
    """
    return (
        f"How {label} sticks is decided by roughness with wavelengths {_from_to(edges)}; its "
        f"predicted pull-off force is {_force_or_two(edges, force)} {printed_pair(force)}."
    )


def _force_or_two(edges: xr.Dataset, force: xr.Dataset) -> str:
    """Return the force of a surface; with continued roughness too, where that differs.

    Where the band is open at a side, the force with roughness continued there has not settled.
    """
    sides = differing_sides(force)
    if not sides:
        return printed_force(force)
    continued = " and ".join(
        f"{printed_continued_force(force, side)} if it goes on {continued_words(force, side)}"
        + (", where it still changes," if is_open(edges, side) else "")
        for side in sides
    )
    return (
        f"{printed_force(force)} with the roughness that its scans show, but {continued} as its "
        "spectrum does (the scans that contacts are made on do not tell),"
    )


def differing_sides(data: xr.Dataset) -> list[str]:
    """Return the sides on which continued roughness changes the force beyond its interval.

    Parameters
    ----------
    data : xarray.Dataset
        Part of force.nc or fit.nc of a surface: `continued_differs` (side).

    Returns
    -------
    list of str
        Of `small` and `large`.
    """
    return [side for side in ENDS if data["continued_differs"].sel(side=side).item() == 1]


def transition_words(data: xr.Dataset, side: str) -> str:
    """Return from where on roughness follows the spectrum: "below 200 nm"."""
    return f"{BEYOND[side]} {print_length(data['transition'].sel(side=side).item())}"


def continued_words(force: xr.Dataset, side: str) -> str:
    """Return where roughness follows the spectrum: "below 200 nm down to 9.8 nm"."""
    end = print_length(force["continued_end"].sel(side=side).item())
    return f"{transition_words(force, side)} {LAST[side]} {end}"


def printed_continued_force(force: xr.Dataset, side: str) -> str:
    """Return the force with roughness continued at one side, with its interval if it has one."""
    return print_bounded(force.sel(side=side), "continued_force", "N")


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
    intervals = f"{capital(note)}."
    if np.isfinite(edges["scale_ratio_interval"]).any():
        intervals = (
            f"Brackets are {print_share(edges.attrs['confidence'])} intervals, {note}; their ends "
            "are cutoffs that were computed."
        )
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
    return OPEN_TEXT.sub(r"\1 (\2)", text)


def _from_to(edges: xr.Dataset) -> str:
    """Return both edges as "from 37 [31, 44] nm to at least 5 µm (the scans end here)"."""
    first, last = (edge_words(edges, side) for side in ENDS)
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
    """Return the predicted force of a surface, its uncertainty and its spread over contacts."""
    here = at_range(force)
    certainty = str(force["interval_note"].item())
    low, high = here["force_interval"].values
    bounded = np.isfinite([low, high]).all()
    if bounded:
        share = print_share(force.attrs["confidence"])
        certainty = f"brackets: {share} interval of the mean, {certainty}"
    least, most = here["force_quantile"].isel(quantile=[0, -1]).values
    share = print_share(float(np.ptp(here["quantile"].values)))
    model = str(here["contact_model"].item())
    wider = (
        ": less than the interval of the mean, as contacts on the same scan share its summits, and "
        "scans are few"
        if bounded and low < least and most < high
        else ""
    )
    return (
        f"The mean pull-off force of {label} is {printed_force(force)} {printed_pair(force)}, for "
        f"{model} contact ({certainty}). Of single contacts {share} lie between "
        f"{print_quantity(least, 'N')} and {print_quantity(most, 'N')}{wider}."
        f"{_continued_sentences(force)} The force is proportional to the work of adhesion."
    )


def _continued_sentences(force: xr.Dataset) -> str:
    """Return what the force is once roughness goes on where the scans do not show it."""
    continued = [
        f"with roughness {continued_words(force, side)}, it is "
        f"{printed_continued_force(force, side)}"
        for side in differing_sides(force)
    ]
    if not continued:
        return ""
    return (
        f" This is the force of the scans as they are; {', and '.join(continued)}, if that follows "
        "the joined spectrum."
    )


def capital(text: str) -> str:
    """Return a text that begins with a capital letter."""
    return text[:1].upper() + text[1:]
