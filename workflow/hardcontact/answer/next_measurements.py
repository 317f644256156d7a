"""What would narrow the answer of a surface, as codes with numbers, what tells most first."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from hardcontact.answer.artificial import reliable_measurements
from hardcontact.answer.datasets import Datasets, at_range
from hardcontact.answer.facts import between, ends, percent
from hardcontact.insight.next_measurement import (
    FACTOR,
    AtHand,
    Scan,
    present_intervals,
    scans,
    widths_left,
)
from hardcontact.numbers.number import Number
from hardcontact.own_surfaces.scan_parts import UNBOUNDED

UNITS = {"short_edge": "nm", "long_edge": "nm", "force": "N", "range": "nm", "work": "J m-2"}
#: Standard errors from one end of an interval of 95 % to the other.
ERRORS = 2 * 1.96


def next_measurements(of: Datasets) -> list[Mapping[str, Any]]:
    """Return measurements of one surface, each with what is `left` of the widths of intervals.

    The first row, "now", has the intervals that spectra and pairs leave open at present; the next
    leaves least of all of them together. There are none of a surface that is described
    and not measured, of which nothing was drawn.
    """
    if "true_outcome" not in of.force or not of.force["true_outcome"].notnull().any():
        return []
    low, high = ends(at_range(of.force), "force")
    width = np.log(high / low) if 0 < low < high < np.inf else 2 * UNBOUNDED
    at_hand = AtHand(float(width) / ERRORS, int(of.force["interval_scans"]), of.fit is not None)
    shortest, longest = (float(of.spectra[f"{end}_measured"]) for end in ("shortest", "longest"))
    size = float(of.topography["scan_size"])
    reliable = reliable_measurements(of.spectra)
    alike = np.isclose(reliable["size"], size, rtol=0.01)
    finest = reliable["shortest_reliable"].values[alike].min(initial=size)
    possible = scans(shortest, longest, size, float(finest))
    found = []
    for code, left in widths_left(of.force, possible, at_hand).items():
        shares = {name: percent(Number(name, share)) for name, share in left.items()}
        row = {"code": code, **_numbers(possible.get(code)), "left": shares}
        found.append((np.nansum(np.log(list(left.values()))), row))
    present = present_intervals(of.force, at_hand, of.force.attrs["confidence"])
    now = {name: between(name, *ends, UNITS[name]) for name, ends in present.items()}
    ranked = [row for _, row in sorted(found, key=lambda one: one[0])]
    return [{"code": "now", **_numbers(None), "left": now}, *ranked]


def _numbers(scan: Scan | None) -> dict[str, Number]:
    """Return what a scan is like; NaN of what is none."""
    return {
        "size": Number("size", scan.size if scan else np.nan, "nm"),
        "shortest": Number("shortest", scan.shortest if scan else np.nan, "nm"),
        "factor": Number("factor", FACTOR),
        "places": Number("places", scan.places if scan else 0),
    }
