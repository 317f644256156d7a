"""What the headline of your surfaces says. Its words are in own_headline.txt."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from hardcontact.base.number import Number
from hardcontact.inference.edges import EDGE_NAMES
from hardcontact.report.own_surfaces.cautions import Caution


def surface_facts(
    numbers: Mapping[str, Number], cautions: Sequence[Caution], band_status: str, source: str
) -> dict[str, Any]:
    """Return the facts of one surface that only own_headline.txt shows, by the names that it uses.

    `band_status` is that of the `Conclusion`, `source` is "measured" or "substitute".
    """
    small_scans = [caution for caution in cautions if caution.code == "small_scan"]
    return {
        # If a band is found, its edges say what is extrapolated.
        "says_if_answered": source == "measured" and band_status != "found",
        "edges_overlap": edges_overlap(numbers),
        "other_pairs": known_pairs(numbers),
        # A hindcast without a ratio tested no octave.
        "failed_hindcasts": [
            caution
            for caution in cautions
            if caution.code.startswith("hindcast_")
            and caution.grave
            and math.isfinite(caution.numbers["ratio"].value)
        ],
        "small_scan_ratio": small_scans[0].numbers["ratio"] if small_scans else None,
    }


def edges_overlap(numbers: Mapping[str, Number]) -> bool:
    """Return whether the short edge may be longer than the long edge.

    Of an edge without an interval the cutoffs around it count.
    """
    short, long = (numbers.get(f"{edge}_cutoffs", numbers[edge]) for edge in EDGE_NAMES.values())
    return short.high > long.low


def known_pairs(numbers: Mapping[str, Number]) -> list[str]:
    """Return the names of the known forces at other pairs of range and work of adhesion."""
    return [
        name
        for name, number in numbers.items()
        if name.startswith("force_of_pair_")
        and f"{name}_share" in numbers
        and math.isfinite(number.value)
    ]
