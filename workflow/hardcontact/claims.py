"""Each statement of the paper against what was computed.

A claim names a number by dataset, quantity and selection, and a rule that turns the number, its
95 % interval and the published limits into a verdict.
"""

from itertools import chain, pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.estimates import estimate
from hardcontact.intervals import attribute, quotient

__all__ = [
    "VERDICTS",
    "accepted_range",
    "evaluate",
    "read_claims",
    "summary",
    "verdict",
]

UNTESTABLE = "not testable on substitutes"
NO_SCAN = "no scan"
VERDICTS = ("reproduced", "consistent", "not reproduced", UNTESTABLE)
ONE_SIDED = ("below", "above", "order")
COLUMNS = (
    "id", "section", "statement", "published", "computed", "low", "high", "unit", "rule",
    "verdict", "basis", "note",
)  # fmt: skip
NUMBERS = ("published", "published_low", "published_high")


def read_claims(path: str | Path) -> pd.DataFrame:
    """Read a table of claims: numbers as float (NaN where blank), everything else as text."""
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    return table.assign(**{name: pd.to_numeric(table[name]) for name in NUMBERS})


def evaluate(claims: pd.DataFrame, datasets: dict[str, xr.Dataset]) -> pd.DataFrame:
    """Set every claim against the computed number.

    claims: as from `read_claims`. datasets: `topography` (always needed, it says which scans are
    substitutes) and whichever else the claims name, each as in the final netCDF files. A claim
    about a surface or contact model that the study does not have is left out. Returns one row
    a claim with the columns `COLUMNS`; raises ValueError naming the claim and what is missing.
    """
    rows = [_evaluate_claim(claim, datasets) for claim in claims.itertuples(index=False)]
    return pd.DataFrame([row for row in rows if row is not None], columns=list(COLUMNS))


def summary(evaluated: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each verdict: columns `verdict` and `claims`, every verdict listed."""
    counts = evaluated["verdict"].value_counts().reindex(VERDICTS, fill_value=0)
    return counts.rename_axis("verdict").rename("claims").reset_index()


def accepted_range(rule: str, published_low: float, published_high: float) -> tuple[float, float]:
    """Limits between which a number agrees with the paper, in the unit of the claim.

    Raises ValueError for an unknown rule and for a limit that the rule needs and is blank.
    """
    name, _, factor = rule.partition(" ")
    if rule == "interval":
        limits = published_low, published_high
    elif name == "factor" and factor:
        limits = published_low / float(factor), published_high * float(factor)
    elif rule == "below":
        limits = -np.inf, published_high
    elif rule in ("above", "order"):
        limits = published_low, np.inf
    else:
        raise ValueError(f"unknown rule {rule!r}")
    if np.isnan(limits).any():
        raise ValueError(f"rule {rule!r} lacks a published limit")
    return limits


def verdict(
    rule: str,
    computed: float,
    low: float,
    high: float,
    published_low: float,
    published_high: float,
) -> str:
    """Judge one number and its 95 % interval [low, high]; NaN low and high mean no interval.

    Rules with two limits (`interval`, `factor`): reproduced when the number lies between them,
    consistent when only its interval reaches them. Rules with one (`below`, `above`, `order`):
    reproduced when the whole interval keeps the limit, consistent when only the number does.
    A number that is NaN is not reproduced.
    """
    lower, upper = accepted_range(rule, published_low, published_high)
    if np.isnan(computed):
        return "not reproduced"
    low = computed if np.isnan(low) else low
    high = computed if np.isnan(high) else high
    if rule in ONE_SIDED:
        weakly = lower < computed < upper
        strongly = weakly and lower < low and high < upper
    else:
        strongly = lower <= computed <= upper
        weakly = strongly or (low <= upper and high >= lower)
    return "reproduced" if strongly else "consistent" if weakly else "not reproduced"


def _evaluate_claim(claim, datasets: dict[str, xr.Dataset]) -> dict | None:
    """One row of the result, or None when the study lacks what the claim is about."""
    try:
        parts = {name: _dataset(datasets, name) for name in claim.dataset.split("+")}
        topography = _dataset(datasets, "topography")
        estimated = estimate(claim.quantity, *parts.values())
        selection = _selection(estimated, _parse_selection(claim.select))
        if selection is None:
            return None
        found = _worst(_pick(estimated, selection), claim.rule)
        computed, low, high = (float(found[name]) for name in ("value", "low", "high"))
        limits = claim.published_low, claim.published_high
        judged = verdict(claim.rule, computed, low, high, *limits)
        scans = claim.needs != NO_SCAN
        substitutes = _substitutes(parts, selection, topography) if scans else []
        reason = _untestable(claim, substitutes, topography)
    except (KeyError, ValueError) as error:
        raise ValueError(f"claim {claim.id}: {_first_sentence(error)}") from error
    no_value = "No value exists." if np.isnan(computed) else ""
    result = claim._asdict() | {
        "computed": computed,
        "low": low,
        "high": high,
        "verdict": UNTESTABLE if reason else judged,
        "basis": ("substitute scans" if substitutes else "measured") if scans else NO_SCAN,
        "note": " ".join(filter(None, (claim.note, reason, no_value))),
    }
    return {name: result[name] for name in COLUMNS}


def _first_sentence(error: Exception) -> str:
    return str(error.args[0]).partition(". ")[0].splitlines()[0]


def _substitutes(
    parts: dict[str, xr.Dataset], selection: dict, topography: xr.Dataset
) -> list[str]:
    """Substitute surfaces the claim touches.

    These are the surfaces it selects, or all of its datasets when it selects none; whatever is
    not topography alone touches the sphere as well.
    """
    known = set(topography["surface"].values)
    selected = [label for groups in selection.values() for label in chain.from_iterable(groups)]
    touched = [label for label in selected if label in known]
    if not touched:
        touched = list(next(iter(parts.values()))["surface"].values)
    if set(parts) != {"topography"}:
        touched.append(attribute(topography, "sphere_surface"))
    basis = topography["basis"].sel(surface=touched)
    return [str(surface) for surface in basis["surface"].values[basis.values == "substitute"]]


def _untestable(claim, substitutes: list[str], topography: xr.Dataset) -> str:
    """Why substitute scans cannot test the claim; empty when they can."""
    if claim.needs == "measured" and substitutes:
        return "The substitute scans assume this."
    for surface in substitutes:
        calibrated = str(topography["calibrated_to_table1"].sel(surface=surface).item())
        if claim.quantity in [name.strip() for name in calibrated.split(",")]:
            return "The substitute scans are calibrated to this."
    return ""


def _dataset(datasets: dict[str, xr.Dataset], name: str) -> xr.Dataset:
    """A dataset; one about a single surface names it in an attribute and gets the dimension."""
    if name not in datasets:
        raise KeyError(f"no dataset named {name!r}")
    found = datasets[name]
    if "surface" not in found.dims:
        found = found.expand_dims(surface=[attribute(found, "surface")])
    return found


def _parse_selection(select: str) -> dict[str, list[list[str]]]:
    """Labels by dimension: `a=x;b=y,z>w` is {a: [[x]], b: [[y, z], [w]]}."""
    pairs = (item.split("=", 1) for item in select.split(";") if item)
    return {dim: [group.split(",") for group in labels.split(">")] for dim, labels in pairs}


def _selection(found: xr.Dataset, selection: dict) -> dict | None:
    """The selection with labels as the number has them, or None where it lacks one.

    Raises KeyError for a dimension that does not exist.
    """
    labels = {
        dim: [[_label(found[dim].values, label) for label in group] for group in groups]
        for dim, groups in selection.items()
    }
    missing = any(None in group for groups in labels.values() for group in groups)
    return None if missing else labels


def _label(coordinate: np.ndarray, label: str):
    """The value of a coordinate that a label means, or None."""
    if np.issubdtype(coordinate.dtype, np.number):
        same = np.isclose(coordinate, float(label), rtol=1e-6, atol=0)
    else:
        same = coordinate == label
    return coordinate[same][0] if same.any() else None


def _pick(found: xr.Dataset, selection: dict[str, list[list]]) -> xr.Dataset:
    """Apply the selection; a chain of groups becomes its weakest link."""
    for dim, groups in selection.items():
        members = [found.sel({dim: group}) for group in groups]
        found = _weakest_link(members, dim) if len(members) > 1 else members[0]
    return found


def _weakest_link(groups: list[xr.Dataset], dim: str) -> xr.Dataset:
    """Smallest ratio of a member of a group to one of the next; the numbers are positive."""
    links = [
        quotient(upper.min(dim, skipna=False), lower.max(dim, skipna=False))
        for upper, lower in pairwise(groups)
    ]
    return xr.concat(links, dim="link").min("link", skipna=False)


def _worst(found: xr.Dataset, rule: str) -> xr.Dataset:
    """Reduce what the selection leaves open to the value that keeps the rule least."""
    if found["value"].size == 1:
        return found.squeeze(drop=True)
    if rule == "below":
        return found.max()
    if rule in ONE_SIDED:
        return found.min()
    raise ValueError(f"rule {rule!r} needs one number, open: {', '.join(found['value'].dims)}")
