"""Conclusions from the numbers of the paper's study, which templates put into words."""

from collections.abc import Mapping
from typing import Any

from hardcontact.base.number import Number

#: Sets of scans below which the ends of a 95 % interval rest on one or two outermost sets.
MIN_SETS = 50
#: Grids whose size the paper prints.
GRIDS = ("scan_pixels", "contacts_per_row")


def draw_conclusions(numbers: Mapping[str, Number]) -> dict[str, Any]:
    """Return what the headline says of the numbers of the whole study, by the template's names."""
    sizes = [(numbers[name].value, numbers[f"{name}_published"].value) for name in GRIDS]
    octaves = [numbers[f"octave_{rank}_sensitivity"].value for rank in (1, 2, 3)]
    shifts = [numbers.get(name) for name in ("plasticity_shift", "range_shift")]
    return {
        "is_coarse": any(size < published for size, published in sizes),
        "has_few_sets": numbers["sets"].value < MIN_SETS,
        "roughness_lowers_force": max(octaves) < 0,
        "reasons_are_resolved": all(shift is not None and shift.low > 1 for shift in shifts),
    }


def most_sensitive_coatings(coatings: Mapping[str, Mapping[str, Number]]) -> dict[str, str]:
    """Return the label of the coating whose force changes first, by the name of the edge.

    `coatings` has the numbers of each coating by its label.
    """
    return {
        "short_edge": min(coatings, key=lambda label: coatings[label]["short_edge"].value),
        "long_edge": max(coatings, key=lambda label: coatings[label]["long_edge"].value),
    }


def features_by_scatter(numbers: Mapping[str, Number]) -> str:
    """Return "bumps" or "pits", whichever scatters ln F more like the published forces."""
    bumps = numbers["bumps_log_force_std"].value
    pits = numbers["pits_log_force_std"].value
    published = numbers["featured_log_force_std_published"].value
    return "bumps" if abs(bumps - published) < abs(pits - published) else "pits"
