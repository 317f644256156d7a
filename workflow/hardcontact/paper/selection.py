"""What a claim selects of a quantity, and what scans and construction decide beforehand."""

from collections.abc import Iterable, Mapping
from itertools import chain, pairwise
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.published import rows_met
from hardcontact.paper.numbers import quotient
from hardcontact.paper.verdicts import BY_CONSTRUCTION, EXPERIMENT, ONE_SIDED, UNTESTABLE

#: Labels by dimension; `a > b` makes two groups.
Selection = Mapping[str, list[list[Any]]]


def selection(number: xr.Dataset, select: str) -> Selection | None:
    """Return labels of a number by dimension, as the number has them; None where it lacks one.

    ``a=x;b=y,z>w`` is {a: [[x]], b: [[y, z], [w]]}. A dimension that does not exist is a KeyError.
    """
    pairs = (item.split("=", 1) for item in select.split(";") if item)
    labels = {
        dim: [[_label(number[dim].values, label) for label in group.split(",")] for group in groups]
        for dim, groups in ((dim, named.split(">")) for dim, named in pairs)
    }
    missing = any(None in group for groups in labels.values() for group in groups)
    return None if missing else labels


def _label(coordinate: np.ndarray, label: str) -> Any:
    """Return the value of a coordinate that a label means, or None."""
    if np.issubdtype(coordinate.dtype, np.number):
        same = np.isclose(coordinate, float(label), rtol=1e-6, atol=0)
    else:
        same = coordinate == label
    return coordinate[same][0] if same.any() else None


def selected_number(number: xr.Dataset, chosen: Selection, rule: str) -> xr.Dataset:
    """Return the one number that is judged, with its interval.

    Of an order of groups, `a > b > c`, it is the least ratio of a member of one group to one of the
    next. What the selection leaves open is reduced to the worst value under the rule, as in
    `verdicts.accepted_range`; a ValueError says if the rule has two limits and more than one number
    is left.
    """
    for dim, groups in chosen.items():
        members = [number.sel({dim: group}) for group in groups]
        number = _least_ratio(members, dim) if len(members) > 1 else members[0]
    open_dimensions = number["value"].dims
    if number["value"].size == 1:
        return number.squeeze(open_dimensions, drop=True)
    if rule not in ONE_SIDED:
        raise ValueError(
            f"rule {rule!r} needs one number, open: {', '.join(map(str, open_dimensions))}"
        )
    worst = number.max(open_dimensions) if rule == "below" else number.min(open_dimensions)
    # Where one of the numbers lacks an interval, so does the worst: the ends of the others say
    # nothing about it.
    with_interval = number["value_interval"].notnull().all("bound") | number["value"].isnull()
    return worst.assign(value_interval=worst["value_interval"].where(with_interval.all()))


def _least_ratio(groups: Iterable[xr.Dataset], dim: str) -> xr.Dataset:
    """Return the least ratio of a number of a group to one of the next; all are positive."""
    ratios = [
        quotient(upper.min(dim, skipna=False), lower.max(dim, skipna=False))
        for upper, lower in pairwise(groups)
    ]
    return xr.concat(ratios, dim="pair_of_groups").min("pair_of_groups", skipna=False)


NO_SCAN = "no scan"


def surfaces_of(
    claim: Any, parts: Mapping[str, xr.Dataset], chosen: Selection, topography: xr.Dataset
) -> list[str]:
    """Return the surfaces that a claim depends on.

    These are the surfaces it selects, or all of its first dataset when it selects none. A claim
    about more than topography depends on the sphere as well, one that needs no scan on none.
    """
    if claim.needs == NO_SCAN:
        return []
    known = set(topography["surface"].values)
    labels = chain.from_iterable(group for groups in chosen.values() for group in groups)
    surfaces = [label for label in labels if label in known]
    if not surfaces:
        surfaces = list(next(iter(parts.values()))["surface"].values)
    if set(parts) != {"topography"}:
        surfaces.append(topography.attrs["sphere_surface"])
    return [str(surface) for surface in surfaces]


def basis(surfaces: list[str], topography: xr.Dataset) -> str:
    """Return what a number stands on: `measured`, `substitute scans` or `no scan`."""
    if not surfaces:
        return NO_SCAN
    return "substitute scans" if any(_is_substitute(surfaces, topography)) else "measured"


def _is_substitute(surfaces: list[str], topography: xr.Dataset) -> list[bool]:
    return [of == "substitute" for of in topography["basis"].sel(surface=surfaces).values]


#: Quantities of Table 1 that depend on the size of a pixel.
OF_PIXEL = ("afm_rms_slope", "afm_rms_curvature", "slope_by_scales")


def fixed_verdict(
    claim: Any, surfaces: list[str], topography: xr.Dataset, constants: pd.DataFrame
) -> tuple[str, str]:
    """Return a verdict that no number decides, and why; both empty where the number decides.

    `calibrated_to_table1` names the rows of Table 1 that the scans of a surface meet by
    construction. Constants are those of `published.constants`.
    """
    if claim.needs == "construction":
        return BY_CONSTRUCTION, ""
    if claim.needs == "experiment":
        return EXPERIMENT, "The paper says this of its experiment."
    substitutes = _is_substitute(surfaces, topography)
    if claim.needs == "measured" and any(substitutes):
        return UNTESTABLE, "The substitute scans decide this."
    met = topography["calibrated_to_table1"].sel(surface=surfaces).values
    by_construction = [
        substitute and claim.quantity in rows_met(str(rows))
        for substitute, rows in zip(substitutes, met, strict=True)
    ]
    if surfaces and all(by_construction):
        return BY_CONSTRUCTION, "The substitute scans are made to meet this."
    if claim.quantity in OF_PIXEL and _is_coarse(topography, constants["value"]):
        return UNTESTABLE, "It depends on the size of a pixel, which is larger than the paper's."
    return "", ""


def _is_coarse(topography: xr.Dataset, published: "pd.Series[float]") -> bool:
    """Return whether the pixels of the scans are larger than those of the paper."""
    pixel_size = topography["scan_size"].max().item() / topography.sizes["row"]
    return bool(pixel_size > 1.01 * published["scan_size"] / published["scan_pixels"])
