"""What would narrow the answer of a surface, as codes with numbers, what tells most first."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from hardcontact.answer.datasets import Datasets, at_range
from hardcontact.answer.facts import ends, percent
from hardcontact.insight.next_measurement import FACTOR, AtHand, scans, widths_left
from hardcontact.numbers.number import Number
from hardcontact.own_surfaces.scan_parts import UNBOUNDED

#: Standard errors from one end of an interval of 95 % to the other.
ERRORS = 2 * 1.96


def next_measurements(of: Datasets) -> list[Mapping[str, Any]]:
    """Return measurements of one surface, each with what is `left` of the widths of intervals.

    The first leaves least, of all intervals together. There are none of a surface that is described
    and not measured, of which nothing was drawn.
    """
    if "true_outcome" not in of.force or not of.force["true_outcome"].notnull().any():
        return []
    low, high = ends(at_range(of.force), "force")
    width = np.log(high / low) if 0 < low < high < np.inf else 2 * UNBOUNDED
    at_hand = AtHand(float(width) / ERRORS, int(of.force["interval_scans"]), of.fit is not None)
    possible = scans(*(float(of.spectra[f"{end}_measured"]) for end in ("shortest", "longest")))
    found = []
    for code, left in widths_left(of.force, possible, at_hand).items():
        scan = possible.get(code)
        numbers = {
            "size": Number("size", scan.size if scan else np.nan, "nm"),
            "shortest": Number("shortest", scan.shortest if scan else np.nan, "nm"),
            "factor": Number("factor", FACTOR),
            "places": Number("places", scan.places if scan else 0),
        }
        shares = {name: percent(Number(name, share)) for name, share in left.items()}
        found.append(
            (np.nansum(np.log(list(left.values()))), {"code": code, **numbers, "left": shares})
        )
    return [one for _, one in sorted(found, key=lambda ranked: ranked[0])]
