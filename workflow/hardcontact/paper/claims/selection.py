"""The estimate (`estimates`) that a claim selects, and the surfaces on which it rests."""

from collections.abc import Hashable, Iterable, Mapping, Sequence
from functools import reduce
from itertools import chain, pairwise
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact.contact import CONTACT_MODELS
from hardcontact.inference.edges import AVERAGED
from hardcontact.paper.claims.estimates import quotient
from hardcontact.paper.claims.verdicts import BY_CONSTRUCTION, EXPERIMENT, ONE_SIDED, UNTESTABLE

#: Surfaces of the paper. A study may lack some.
SURFACES = ("polished_uncd", "uncd", "ncd", "mcd", "ruby")
#: The labels of each dimension that claims may select; an empty entry stands for numbers.
LABELS: dict[str, Sequence[str]] = {
    "surface": SURFACES, "group": (AVERAGED, *SURFACES), "left_out": ("none", *SURFACES),
    "contact_model": CONTACT_MODELS, "side": ("short", "long"), "pair": ("published", "fitted"),
    "force_source": ("published", "computed"), "metrics": ("afm", "all_scales"),
    "model": ("rumpf_height", "rumpf_curvature", "rabinovich", "fuller_tabor", "maugis"),
    "rms_parameter": ("height", "slope", "curvature"), "cause": ("plasticity", "range"),
    "exponent_of": ("radius", "contact"), "forces_on": ("scans", "whole surfaces"),
    "band": ("published", "computed"),
    "band_part": ("only the band", "no shorter waves", "no longer waves"),
    "rho": (), "preload": (), "minimum": (),
}  # fmt: skip
#: Groups of labels by dimension; `a > b` makes two groups, each a list of labels.
SelectedLabels = Mapping[str, list[list[Any]]]
#: Words in the column `needs` for a claim that needs no scan; they are also its basis.
WITHOUT_SCAN = ("no scan", "no scan; assumed asperities")
#: Quantities that depend on the size of a pixel, and are compared with numbers of Table 1.
PIXEL_QUANTITIES = ("afm_rms_slope", "afm_rms_curvature", "slope_growth")
#: Why PIXEL_QUANTITIES are not testable on larger pixels.
LARGER_PIXELS = "It depends on the size of a pixel, which is larger than the paper's."


class Claim(NamedTuple):
    """The columns of a row of resources/paper/claims.csv that decide its estimate and verdict.

    resources/paper/README.md explains the columns. Sets estimate claims without judging them, so
    they need only the columns without defaults.
    """

    id: str
    dataset: str
    quantity: str
    select: str
    rule: str
    unit: str = ""
    needs: str = ""
    samples_from: str = ""
    published_low: float = np.nan
    published_high: float = np.nan
    note: str = ""

    @classmethod
    def from_row(cls, row: Mapping[Hashable, Any]) -> "Claim":
        """Return the claim of a row, which has more columns or only those without defaults."""
        return cls(**{name: row[name] for name in cls._fields if name in row})


def split_selection(select: str) -> dict[str, list[list[str]]]:
    """Split the column `select` of a claim: ``a=x;b=y,z>w`` means {a: [[x]], b: [[y, z], [w]]}."""
    items = (item.split("=", 1) for item in filter(None, select.split(";")))
    return {dim: [group.split(",") for group in groups.split(">")] for dim, groups in items}


def parse_selection(estimate: xr.Dataset, select: str) -> SelectedLabels | None:
    """Return the selected values of the coordinates; None if a coordinate lacks a label."""
    labels = {
        dim: [[_matching_label(estimate[dim].values, label) for label in group] for group in groups]
        for dim, groups in split_selection(select).items()
    }
    lacks_label = any(None in group for groups in labels.values() for group in groups)
    return None if lacks_label else labels


def only_label(labels: SelectedLabels, dim: str) -> Any:
    """Return the label of a dimension of which a claim selects a single label."""
    ((label,),) = labels[dim]  # one group of one label; otherwise a ValueError
    return label


def _matching_label(coordinate: np.ndarray, label: str) -> Any:
    """Return the value of a coordinate that matches a label, or None."""
    if np.issubdtype(coordinate.dtype, np.number):
        matches = np.isclose(coordinate, float(label), rtol=1e-6, atol=0)
    else:
        matches = coordinate == label
    return coordinate[matches][0] if matches.any() else None


def select_estimate(estimate: xr.Dataset, labels: SelectedLabels, rule: str) -> xr.Dataset:
    """Return the single estimate that is judged, by labels from `parse_selection`.

    With a dimension ``set`` it is an estimate for each set. A chain of groups, ``a > b,c``, gives
    the smallest ratio of a value to a value of the next group: forces of 4 for a, 2 for b and 1 for
    c give 4/2. A rule with one limit takes the worst value along other dimensions. With two limits,
    more than one estimate raises ValueError.
    """
    for dim, groups in labels.items():
        selected = [estimate.sel({dim: group}) for group in groups]
        estimate = _smallest_ratio(selected, dim) if len(selected) > 1 else selected[0]
    remaining = [dim for dim in estimate["value"].dims if dim != "set"]
    if all(estimate.sizes[dim] == 1 for dim in remaining):
        return estimate.squeeze(remaining, drop=True)
    if rule not in ONE_SIDED:
        raise ValueError(
            f"expected one number for the rule {rule!r}, found several along "
            f"{', '.join(map(str, remaining))}"
        )
    worst = estimate.max(remaining) if rule == "below" else estimate.min(remaining)
    # Missing values do not count. Any other value may be the worst, so each must have an interval.
    has_interval = estimate["value_interval"].notnull().all("end") | estimate["value"].isnull()
    return worst.assign(value_interval=worst["value_interval"].where(has_interval.all(remaining)))


def _smallest_ratio(groups: Iterable[xr.Dataset], dim: str) -> xr.Dataset:
    """Return the smallest ratio of a value to a value of the next group; values are positive."""
    ratios = [
        quotient(group.min(dim, skipna=False), next_group.max(dim, skipna=False))
        for group, next_group in pairwise(groups)
    ]
    return reduce(xr.ufuncs.minimum, ratios)


def claim_surfaces(
    claim: Claim, datasets: Mapping[str, xr.Dataset], labels: SelectedLabels, topography: xr.Dataset
) -> list[str]:
    """Return the names of the surfaces on which a claim depends.

    They are those that the claim selects, or all of its first dataset if it selects none, and the
    sphere, unless `topography` is its only dataset. A claim without scans depends on none.
    """
    if claim.needs in WITHOUT_SCAN:
        return []
    study_surfaces = set(topography["surface"].values)
    # Labels of `left_out` select no surface.
    groups = chain.from_iterable(groups for dim, groups in labels.items() if dim != "left_out")
    surfaces = [label for label in chain.from_iterable(groups) if label in study_surfaces]
    if not surfaces:
        surfaces = list(next(iter(datasets.values()))["surface"].values)
    if set(datasets) != {"topography"}:
        surfaces.append(topography.attrs["sphere_surface"])
    return [str(surface) for surface in surfaces]


def claim_basis(claim: Claim, surfaces: list[str], topography: xr.Dataset) -> str:
    """Return the basis of a claim: ``measured``, ``substitute scans`` or one of WITHOUT_SCAN."""
    if claim.needs in WITHOUT_SCAN:
        return claim.needs
    sources = topography["source"].sel(surface=surfaces).values
    return "substitute scans" if "substitute" in sources else "measured"


def fixed_verdict(
    claim: Claim, surfaces: list[str], topography: xr.Dataset, constants: pd.DataFrame
) -> tuple[str, str]:
    """Return a verdict that does not depend on the estimate, and its reason, or empty texts."""
    if claim.needs == "construction":
        return BY_CONSTRUCTION, ""
    if claim.needs == "experiment":
        return EXPERIMENT, "The paper says this of its experiment."
    selected = topography.sel(surface=surfaces)
    is_substitute = selected["source"].values == "substitute"
    if claim.needs == "measured" and is_substitute.any():
        return UNTESTABLE, "The substitute scans decide this."
    is_met = [claim.quantity in str(rows).split(",") for rows in selected["table1_rows_met"].values]
    if surfaces and np.logical_and(is_substitute, is_met).all():
        return BY_CONSTRUCTION, "The substitute scans of the study are made to meet this."
    if claim.quantity in PIXEL_QUANTITIES:
        published_pixel = constants["value"]["scan_size"] / constants["value"]["scan_pixels"]
        # Sizes within 1 % count as equal, because they may be rounded.
        if topography["pixel_size"].max() > 1.01 * published_pixel:
            return UNTESTABLE, LARGER_PIXELS
    return "", ""
