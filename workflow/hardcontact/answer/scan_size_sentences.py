"""How large a scan must be, in sentences of plain text."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import (
    DIGITS,
    NEAR_ONE,
    labels,
    listed,
    print_bounded_as_paper,
    print_each,
    print_percent,
)
from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.statistics import bounds

__all__ = ["force_on_scans_sentence", "on_scans", "scan_size_sentences"]

OTHER_EDGES = (
    "Fig. 6 and the scaling of the band have other long edges of the same surfaces, as their "
    "masters, pixels, contacts and cutoffs are others. The intervals say how well each is known."
)


def scan_size_sentences(scan_size: xr.Dataset) -> list[str]:
    """Return how wrong forces and long edges on small scans are, the rule, and the sizes needed.

    Parameters
    ----------
    scan_size : xarray.Dataset
        As `fig_scan_size.draw` takes it.

    Returns
    -------
    list of str
        The answer first.
    """
    at_range = scan_size.sel(rho=scan_size.attrs["rho"], method="nearest")
    return [
        _excess(at_range),
        _edges(scan_size),
        *_edges_of_others(scan_size),
        OTHER_EDGES,
        _forces(scan_size),
        _needed(at_range),
        _rule(scan_size),
        _error(scan_size),
    ]


def on_scans(scan_size: xr.Dataset) -> xr.Dataset:
    """Return what edges and forces are on mirrored windows of the size of the study's scans.

    Parameters
    ----------
    scan_size : xarray.Dataset
        As `fig_scan_size.draw` takes it.

    Returns
    -------
    xarray.Dataset
        At one `edge_size`.
    """
    windows = scan_size.sel(edge_size=scan_size["mirrored"] == 1)
    return windows.sel(edge_size=scan_size.attrs["scan_size"], method="nearest")


def force_on_scans_sentence(scan_size: xr.Dataset) -> str:
    """Return by how much forces on mirrored scans differ from those on large surfaces.

    Parameters
    ----------
    scan_size : xarray.Dataset
        As `fig_scan_size.draw` takes it.

    Returns
    -------
    str
        Each surface with its interval.
    """
    of_scan, larger = on_scans(scan_size), scan_size.isel(edge_size=-1)
    return (
        f"The mean force on mirrored scans of {_size(of_scan)} over that on surfaces of "
        f"{_size(larger)} with the same spectrum, at a range of "
        f"{print_as_paper(scan_size.attrs['rho'], 'nm')}, is: "
        f"{print_each(of_scan, 'force_over_largest')} "
        f"({print_percent(scan_size.attrs['confidence'])} intervals over realizations)."
    )


def _excess(at_range: xr.Dataset) -> str:
    at_size = at_range.sel(scan_size=at_range.attrs["scan_size"], method="nearest")
    said = []
    for surface in at_size["surface"].values:
        one = at_size.sel(surface=surface)
        said.append(f"{one['label'].item()} {print_bounded_as_paper(one, 'excess', '1')}")
    return (
        f"On mirrored scans of {print_as_paper(at_size['scan_size'].item(), 'nm')} the mean force "
        f"is larger than on surfaces of {print_as_paper(at_size.attrs['surface_size'], 'nm')} with "
        f"the same spectrum, by the factor {'; '.join(said)} at a range of "
        f"{print_as_paper(at_size['rho'].item(), 'nm')}."
    )


def _edges(scan_size: xr.Dataset) -> str:
    of_scan = on_scans(scan_size)
    of_whole = scan_size.isel(edge_size=-1)
    said = "; ".join(
        f"{label} {found} instead of {true}"
        for label, found, true in zip(
            scan_size["label"].values,
            of_scan["long_edge_text"].values,
            of_whole["long_edge_text"].values,
            strict=True,
        )
    )
    return (
        f"Long edge of the band from mirrored scans of {_size(of_scan)} alone, without artificial "
        f"roughness, instead of that from whole surfaces of {_size(of_whole)}: {said}."
    )


def _edges_of_others(scan_size: xr.Dataset) -> Iterator[str]:
    """Yield the edges on windows of the other sizes, and on the smaller whole surfaces."""
    sizes = scan_size["edge_size"].values
    windows = sizes[scan_size["mirrored"].values == 1]
    of_scan = windows[np.abs(windows - scan_size.attrs["scan_size"]).argmin()]
    for size, mirrored in zip(sizes[:-1], scan_size["mirrored"].values, strict=False):
        of_size = scan_size.sel(edge_size=size)
        what = "mirrored scans" if mirrored else "whole surfaces"
        if size != of_scan:
            edges = zip(of_size["label"].values, of_size["long_edge_text"].values, strict=True)
            said = "; ".join(f"{label} {text}" for label, text in edges)
            yield f"The same edge from {what} of {_size(of_size)}: {said}."


def _forces(scan_size: xr.Dataset) -> str:
    """Return forces over those on the larger whole surfaces, and whether the smaller are enough."""
    of_scan = on_scans(scan_size)
    smaller, larger = scan_size.isel(edge_size=-2), scan_size.isel(edge_size=-1)
    low, high = bounds(smaller, "force_over_largest")
    differ = smaller["surface"].values[((low > 1) | (high < 1)).values]
    said = (
        f"these are too small for {labels(scan_size, differ)}"
        if len(differ)
        else f"all intervals hold 1 and leave open up to {_farthest(low, high)}"
    )
    return (
        f"Force over that on whole surfaces of {_size(larger)}: on mirrored scans of "
        f"{_size(of_scan)} {print_each(of_scan, 'force_over_largest')}; on whole surfaces of "
        f"{_size(smaller)} {print_each(smaller, 'force_over_largest', NEAR_ONE)}; {said}."
    )


def _farthest(low: xr.DataArray, high: xr.DataArray) -> str:
    """Return how far the ends of intervals lie from one at most, in percent."""
    ends = xr.concat([low, high], "bound")
    return print_percent(float(abs(ends - 1).max()))


def _size(scan_size: xr.Dataset) -> str:
    return print_as_paper(scan_size["edge_size"].item(), "nm")


def _needed(at_range: xr.Dataset) -> str:
    sizes = zip(at_range["label"].values, at_range["size_needed"].values.tolist(), strict=True)
    said = "; ".join(
        f"{label} {print_as_paper(size, 'nm', digits=DIGITS)}" for label, size in sizes
    )
    allowed = print_percent(at_range.attrs["allowed_excess"] - 1)
    return f"By the rule, a force that is too large by {allowed} takes scans of: {said}."


def _rule(scan_size: xr.Dataset) -> str:
    powers = listed(
        f"({ratio})^{exponent:.{DIGITS}g}"
        for ratio, exponent in zip(
            scan_size["ratio"].values, scan_size["exponent"].values.tolist(), strict=True
        )
    )
    return (
        f"The rule: the logarithm of the factor is {scan_size['strength'].item():.{DIGITS}g} times "
        f"the product of {powers}, the draw size 2√(2Rσ)."
    )


def _error(scan_size: xr.Dataset) -> str:
    said = []
    for tested, name in (
        ("random surfaces", "random surfaces that it was not fitted to"),
        ("surfaces", "the surfaces of the study"),
    ):
        corrected, uncorrected = (
            f"{np.exp(scan_size['error'].sel(tested=tested, kind=kind).item()):.3g}"
            for kind in ("corrected", "uncorrected")
        )
        said.append(f"{uncorrected} to {corrected} on {name}")
    return (
        f"Divided by what the rule says, forces are off by a factor that falls from {listed(said)}."
    )
