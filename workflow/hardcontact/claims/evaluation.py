"""Statements of the paper, each compared with a computed number.

A claim names a number by dataset, quantity and selection, and a rule that turns the number, its
interval and the published limits into a verdict.
"""

from collections.abc import Iterable, Mapping
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.claims.numbers import quotient
from hardcontact.claims.quantities import estimate
from hardcontact.claims.verdicts import ONE_SIDED, UNTESTABLE, verdict
from hardcontact.statistics import bounds

__all__ = ["COLUMNS", "DATASETS", "evaluate", "read_statements"]

#: Datasets of a study that claims are about. A claim may also name `paper`.
DATASETS = (
    "topography", "adhesion", "scales", "band", "inference", "elastic", "indent", "asperities",
    "classical",
)  # fmt: skip
NO_SCAN = "no scan"
COLUMNS = (
    "id", "section", "statement", "published", "computed", "low", "high", "unit", "rule",
    "verdict", "basis", "note",
)  # fmt: skip
NUMBERS = ("published", "published_low", "published_high")

#: Labels by dimension; `a > b` makes two groups.
Selection = Mapping[str, list[list[Any]]]


def read_statements(path: str | Path) -> pd.DataFrame:
    """Read the statements of the paper.

    Parameters
    ----------
    path : str or Path
        The table resources/paper/claims.csv.

    Returns
    -------
    pandas.DataFrame
        Published numbers as float (NaN where blank), everything else as text.
    """
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    return table.assign(**{name: pd.to_numeric(table[name]) for name in NUMBERS})


def evaluate(
    statements: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    constants: pd.DataFrame,
    confidence: float,
) -> pd.DataFrame:
    """Compare every claim with the computed number.

    Parameters
    ----------
    statements : pandas.DataFrame
        As from `read_statements`. One about a surface or contact model that the study does not have
        is left out.
    datasets : mapping of str to xarray.Dataset
        `topography`, which says what scans are substitutes, and whichever else the claims name,
        each as in the final netCDF files.
    constants : pandas.DataFrame
        As from `published.constants`: the dataset `paper` of the claims.
    confidence : float
        Of the intervals over scans that are computed here.

    Returns
    -------
    pandas.DataFrame
        One row a claim with the columns `COLUMNS`.

    Raises
    ------
    ValueError
        With the name of the claim and what is missing.
    """
    complete = {
        name: _with_surface(data).assign_attrs(confidence=confidence)
        for name, data in datasets.items()
    }
    complete["paper"] = xr.Dataset(constants["value"].to_dict())
    rows = [_evaluate_claim(claim, complete) for claim in statements.itertuples(index=False)]
    return pd.DataFrame([row for row in rows if row is not None], columns=list(COLUMNS))


def _with_surface(data: xr.Dataset) -> xr.Dataset:
    """Add the dimension `surface` to a dataset about the one surface that its attribute names."""
    if "surface" in data.dims or "surface" not in data.attrs:
        return data
    return data.expand_dims(surface=[data.attrs["surface"]])


def _evaluate_claim(claim: Any, datasets: Mapping[str, xr.Dataset]) -> dict[str, Any] | None:
    """Return one row of the result, or None if the study lacks what the claim is about."""
    try:
        parts = {name: _dataset(datasets, name) for name in claim.dataset.split("+")}
        topography = _dataset(datasets, "topography")
        estimated = estimate(claim.quantity, *parts.values())
        selection = _selection(estimated, _parse_selection(claim.select))
        if selection is None:
            return None
        number = _worst(_pick(estimated, selection), claim.rule)
        computed, low, high = (float(end) for end in (number["value"], *bounds(number, "value")))
        limits = claim.published_low, claim.published_high
        judged = verdict(claim.rule, computed, low, high, *limits)
        scans = claim.needs != NO_SCAN
        substitutes = _substitutes(parts, selection, topography) if scans else []
        reason = _untestable(claim, substitutes, topography)
    except (KeyError, ValueError) as error:
        raise ValueError(f"claim {claim.id}: {_reason(error)}") from error
    no_value = "No value exists." if np.isnan(computed) else ""
    row = claim._asdict() | {
        "computed": computed,
        "low": low,
        "high": high,
        "verdict": UNTESTABLE if reason else judged,
        "basis": ("substitute scans" if substitutes else "measured") if scans else NO_SCAN,
        "note": " ".join(filter(None, (claim.note, reason, no_value))),
    }
    return {name: row[name] for name in COLUMNS}


def _reason(error: Exception) -> str:
    """Return the first sentence of an error; that of a missing attribute is its name alone."""
    message = str(error.args[0]).partition(". ")[0].splitlines()[0]
    return message if " " in message else f"expected {message}, found none"


def _dataset(datasets: Mapping[str, xr.Dataset], name: str) -> xr.Dataset:
    if name not in datasets:
        raise KeyError(f"no dataset named {name!r}")
    return datasets[name]


# --- what a claim is about --------------------------------------------------------------------


def _parse_selection(select: str) -> dict[str, list[list[str]]]:
    """Return labels by dimension: `a=x;b=y,z>w` is {a: [[x]], b: [[y, z], [w]]}."""
    pairs = (item.split("=", 1) for item in select.split(";") if item)
    return {dim: [group.split(",") for group in labels.split(">")] for dim, labels in pairs}


def _selection(number: xr.Dataset, selection: Selection) -> Selection | None:
    """Return the selection with labels as the number has them, or None where it lacks one.

    Raises KeyError for a dimension that does not exist.
    """
    labels = {
        dim: [[_label(number[dim].values, label) for label in group] for group in groups]
        for dim, groups in selection.items()
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


def _pick(number: xr.Dataset, selection: Selection) -> xr.Dataset:
    """Apply the selection; of an order of groups, `a > b > c`, return the least ratio of two."""
    for dim, groups in selection.items():
        members = [number.sel({dim: group}) for group in groups]
        number = _least_ratio(members, dim) if len(members) > 1 else members[0]
    return number


def _least_ratio(groups: Iterable[xr.Dataset], dim: str) -> xr.Dataset:
    """Return the least ratio of a number of a group to one of the next; all are positive."""
    ratios = [
        quotient(upper.min(dim, skipna=False), lower.max(dim, skipna=False))
        for upper, lower in pairwise(groups)
    ]
    return xr.concat(ratios, dim="pair").min("pair", skipna=False)


def _worst(number: xr.Dataset, rule: str) -> xr.Dataset:
    """Reduce the dimensions that the selection leaves to the worst value under the rule."""
    open_dimensions = number["value"].dims
    if number["value"].size == 1:
        return number.squeeze(open_dimensions, drop=True)
    if rule == "below":
        return number.max(open_dimensions)
    if rule in ONE_SIDED:
        return number.min(open_dimensions)
    raise ValueError(
        f"rule {rule!r} needs one number, open: {', '.join(map(str, open_dimensions))}"
    )


# --- what substitute scans cannot test --------------------------------------------------------


def _substitutes(
    parts: Mapping[str, xr.Dataset], selection: Selection, topography: xr.Dataset
) -> list[str]:
    """Return the substitute surfaces that the claim depends on.

    These are the surfaces it selects, or all of its first dataset when it selects none. A claim
    about more than topography depends on the sphere as well.
    """
    known = set(topography["surface"].values)
    selected = [label for groups in selection.values() for label in chain.from_iterable(groups)]
    surfaces = [label for label in selected if label in known]
    if not surfaces:
        surfaces = list(next(iter(parts.values()))["surface"].values)
    if set(parts) != {"topography"}:
        surfaces.append(topography.attrs["sphere_surface"])
    basis = topography["basis"].sel(surface=surfaces)
    return [str(surface) for surface in basis["surface"].values[basis.values == "substitute"]]


def _untestable(claim: Any, substitutes: list[str], topography: xr.Dataset) -> str:
    """Return why substitute scans cannot test the claim; empty when they can."""
    if claim.needs == "measured" and substitutes:
        return "The substitute scans assume this."
    for surface in substitutes:
        calibrated = str(topography["calibrated_to_table1"].sel(surface=surface).item())
        if claim.quantity in [name.strip() for name in calibrated.split(",")]:
            return "The substitute scans are calibrated to this."
    return ""
