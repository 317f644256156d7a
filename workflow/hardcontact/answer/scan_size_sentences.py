"""How large a scan must be, in sentences of plain text."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import NEAR_ONE, differs_from_one, labels, listed, print_each
from hardcontact.numbers.printing import (
    DIGITS,
    print_as_paper,
    print_bounded_as_paper,
    print_percent,
)
from hardcontact.numbers.statistics import bounds

OTHER_EDGES = (
    "Fig. 6 and the scaling of the band take the long edge of the same surfaces from other "
    "masters, pixels, contacts and cutoffs, so that theirs need not be the same."
)


def scan_size_sentences(scan_size: xr.Dataset) -> list[str]:
    """Return how wrong forces and long edges on small scans are, the rule, and the sizes needed."""
    at_range = scan_size.sel(rho=scan_size.attrs["rho"], method="nearest")
    return [
        _forces(scan_size),
        _excess(at_range),
        _edges(scan_size),
        *_edges_of_others(scan_size),
        OTHER_EDGES,
        _needed(at_range),
        *_of_windows(at_range),
        _rule(scan_size),
        *_trend(scan_size),
        _error(scan_size),
    ]


def on_scans(scan_size: xr.Dataset) -> xr.Dataset:
    """Return what edges and forces are on mirrored windows of the size of the study's scans."""
    windows = scan_size.sel(edge_size=scan_size["mirrored"] == 1)
    return windows.sel(edge_size=scan_size.attrs["scan_size"], method="nearest")


def force_on_scans_sentence(scan_size: xr.Dataset) -> str:
    """Return by how much forces on mirrored scans differ from those on large surfaces."""
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
    return (
        f"Where mirrored scans of {print_as_paper(at_size['scan_size'].item(), 'nm')} are cut out "
        f"of surfaces of {print_as_paper(at_size.attrs['surface_size'], 'nm')}, the force on them "
        f"over that on these is, at a range of {print_as_paper(at_size['rho'].item(), 'nm')}: "
        f"{print_each(at_size, 'excess')}; {_compared(at_size, 'excess')}."
    )


def _compared(ratios: xr.Dataset, name: str) -> str:
    """Return where intervals of ratios (surface,) lie above one, below one, or hold it."""
    low, high = (end.values for end in bounds(ratios, name))
    of_kinds = {
        "larger": low > 1,
        "smaller": high < 1,
        "not decided": ~differs_from_one(ratios, name).values,
    }
    names = ratios["label"].values
    return ", ".join(
        f"{kind} on {listed(names[chosen])}" for kind, chosen in of_kinds.items() if chosen.any()
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
    name = "force_over_largest"
    low, high = bounds(smaller, name)
    differ = smaller["surface"].values[differs_from_one(smaller, name).values]
    if len(differ):
        said = f"whole surfaces of {_size(smaller)} are too small for {labels(scan_size, differ)}"
    elif np.isnan([low, high]).any():
        said = f"whether whole surfaces of {_size(smaller)} are enough is not known of all"
    else:
        said = (
            f"all intervals of whole surfaces of {_size(smaller)} hold 1 and leave open up to "
            f"{_farthest(low, high)}"
        )
    return (
        f"Mean force over that on whole surfaces of {_size(larger)} with the same spectrum: on "
        f"mirrored scans of {_size(of_scan)} {print_each(of_scan, name, NEAR_ONE)}; "
        f"{_compared(of_scan, name)}. On whole surfaces of {_size(smaller)} "
        f"{print_each(smaller, name, NEAR_ONE)}; {said}."
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
    excess = at_range.attrs["allowed_excess"] - 1
    error = np.exp(_error_of_rule(at_range, "surfaces", "corrected"))
    follows = "more than this, so that sizes are rough" if error - 1 > excess else "less than this"
    return (
        f"By the rule, a force that is too large by {print_percent(excess)} takes scans of: "
        f"{said}. On these surfaces the rule is off by a factor of {error:.3g}, {follows}."
    )


def _of_windows(at_range: xr.Dataset) -> Iterator[str]:
    """Yield what the forces on windows alone say of the sizes needed, and where they refute these.

    A window whose interval lies above the allowed excess is too small; one below it is enough.
    """
    windows = at_range.sel(edge_size=at_range["mirrored"] == 1)
    low, high = bounds(windows, "force_over_largest")
    allowed, sizes = at_range.attrs["allowed_excess"], windows["edge_size"]
    above = sizes.where(low > allowed).max("edge_size")
    enough = sizes.where(high < allowed).min("edge_size")
    said = []
    for surface in at_range["surface"].values:
        least, most = (print_as_paper(one.sel(surface=surface).item(), "nm") for one in
                       (above, enough))  # fmt: skip
        limits = [f"more than {least}"] * bool(least) + [f"at most {most}"] * bool(most)
        if limits:
            said.append(f"{labels(at_range, [surface])} {' and '.join(limits)}")
    if said:
        needed = at_range["size_needed"]
        refuted = at_range["surface"].values[((needed <= above) | (needed > enough)).values]
        follows = f", against the rule on {labels(at_range, refuted)}" if len(refuted) else ""
        yield f"The intervals of forces on windows alone ask for: {'; '.join(said)}{follows}."


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


def _trend(scan_size: xr.Dataset) -> Iterator[str]:
    """Yield where the factor changes with the range against what the rule says."""
    smallest = scan_size.isel(scan_size=0)
    first, last = (smallest.isel(rho=end) for end in (0, -1))
    changes = (last[name] - first[name] for name in ("excess", "predicted_excess"))
    computed, by_rule = (change.values for change in changes)
    against = scan_size["surface"].values[computed * by_rule < 0]
    if len(against):
        ranges = " to ".join(print_as_paper(one["rho"].item(), "nm") for one in (first, last))
        said = []
        for surface in against:
            ends = [one.sel(surface=surface) for one in (first, last)]
            found = " to ".join(print_bounded_as_paper(one, "excess", "1") for one in ends)
            rule = " to ".join(f"{one['predicted_excess'].item():.{DIGITS}g}" for one in ends)
            said.append(f"{labels(scan_size, [surface])} {found}, by the rule {rule}")
        yield (
            f"Against the rule the factor on scans of "
            f"{print_as_paper(smallest['scan_size'].item(), 'nm')} changes with ranges from "
            f"{ranges} the other way: {'; '.join(said)}."
        )


def _error_of_rule(scan_size: xr.Dataset, tested: str, kind: str) -> float:
    return float(scan_size["error"].sel(tested=tested, kind=kind).item())


def _error(scan_size: xr.Dataset) -> str:
    said = []
    for tested, name in (
        ("random surfaces", "random surfaces that it was not fitted to"),
        ("surfaces", "the surfaces of the study"),
    ):
        corrected, uncorrected = (
            f"{np.exp(_error_of_rule(scan_size, tested, kind)):.3g}"
            for kind in ("corrected", "uncorrected")
        )
        said.append(f"{uncorrected} to {corrected} on {name}")
    return (
        f"Divided by what the rule says, forces are off by a factor that falls from {listed(said)}."
    )
