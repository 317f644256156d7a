"""The estimate (`estimates`) that the column `select` of a claim names."""

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.contact.contact import CONTACT_MODELS
from hardcontact.inference.edges import MEAN_GROUP
from hardcontact.paper.claims.estimates import quotient
from hardcontact.paper.claims.verdicts import ONE_SIDED

#: Surfaces of the paper. A study may lack some.
SURFACES = ("polished_uncd", "uncd", "ncd", "mcd", "ruby")
#: The labels of each dimension that claims may select; numbers if there are none.
LABELS: dict[str, Sequence[str]] = {
    "surface": SURFACES, "group": (MEAN_GROUP, *SURFACES), "left_out": ("none", *SURFACES),
    "contact_model": CONTACT_MODELS, "side": ("short", "long"), "pair": ("published", "fitted"),
    "force_source": ("published", "computed"), "metrics": ("afm", "all_scales"),
    "model": ("rumpf_height", "rumpf_curvature", "rabinovich", "fuller_tabor", "maugis"),
    "rms_parameter": ("height", "slope", "curvature"), "cause": ("plasticity", "range"),
    "exponent_of": ("radius", "contact"), "forces_on": ("scans", "whole surfaces"),
    "band": ("published", "computed"),
    "band_part": ("only the band", "no shorter waves", "no longer waves"),
    "rho": (), "preload": (), "minimum": (),
}  # fmt: skip
#: Groups of labels by dimension; `a > b` makes two groups.
SelectedLabels = Mapping[str, list[list[Any]]]


def split_selection(select: str) -> dict[str, list[list[str]]]:
    """Split the column `select` of a claim: ``a=x;b=y,z>w`` means {a: [[x]], b: [[y, z], [w]]}."""
    items = (item.split("=", 1) for item in filter(None, select.split(";")))
    return {dim: [group.split(",") for group in groups.split(">")] for dim, groups in items}


def parse_selection(estimate: xr.Dataset, select: str) -> SelectedLabels | None:
    """Return the selected values of the coordinates; None if a coordinate lacks a label.

    Raises KeyError if the estimate lacks a dimension.
    """
    labels = {
        dim: [[_label(estimate[dim].values, label) for label in group] for group in groups]
        for dim, groups in split_selection(select).items()
    }
    lacks_label = any(None in group for groups in labels.values() for group in groups)
    return None if lacks_label else labels


def _label(coordinate: np.ndarray, label: str) -> Any:
    """Return the value of a coordinate that matches a label, or None."""
    if np.issubdtype(coordinate.dtype, np.number):
        matches = np.isclose(coordinate, float(label), rtol=1e-6, atol=0)
    else:
        matches = coordinate == label
    return coordinate[matches][0] if matches.any() else None


def select_estimate(estimate: xr.Dataset, labels: SelectedLabels, rule: str) -> xr.Dataset:
    """Return the single estimate that is judged, by labels from `parse_selection`.

    For a chain of groups, ``a > b > c``, it is the smallest ratio of values of neighbouring groups.
    A rule with one limit takes the worst value along other dimensions. Raises ValueError if the
    rule has two limits and more than one estimate remains.
    """
    for dim, groups in labels.items():
        selected = [estimate.sel({dim: group}) for group in groups]
        estimate = _smallest_ratio(selected, dim) if len(selected) > 1 else selected[0]
    remaining = estimate["value"].dims
    if estimate["value"].size == 1:
        return estimate.squeeze(remaining, drop=True)
    if rule not in ONE_SIDED:
        raise ValueError(
            f"expected one number for the rule {rule!r}, found several along "
            f"{', '.join(map(str, remaining))}"
        )
    worst = estimate.max(remaining) if rule == "below" else estimate.min(remaining)
    # The worst value has no interval if any value lacks one: that value may be the worst.
    has_interval = estimate["value_interval"].notnull().all("end") | estimate["value"].isnull()
    return worst.assign(value_interval=worst["value_interval"].where(has_interval.all()))


def _smallest_ratio(groups: Iterable[xr.Dataset], dim: str) -> xr.Dataset:
    """Return the smallest ratio of a value to a value of the next group; all are positive."""
    ratios = [
        quotient(upper.min(dim, skipna=False), lower.max(dim, skipna=False))
        for upper, lower in pairwise(groups)
    ]
    return reduce(xr.ufuncs.minimum, ratios)
