"""Statements of the paper, each compared with a computed number.

A claim names a number by dataset, quantity (a variable or a derived one) and selection, and a rule
that turns the number, its interval and the published limits into a verdict. A number is a dataset
of `value` and `value_interval`, as `base.number` returns it.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from inspect import getmembers, isfunction
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.random import generator
from hardcontact.base.statistics import bounds
from hardcontact.paper import contact_quantities, force_quantities, inference_quantities
from hardcontact.paper.numbers import variable_as_number
from hardcontact.paper.selection import (
    NO_SCAN,
    Selection,
    basis,
    fixed_verdict,
    selected_number,
    selection,
    surfaces_of,
)
from hardcontact.paper.verdicts import (
    BY_CONSTRUCTION,
    EXPERIMENT,
    UNTESTABLE,
    accepted_range,
    accepts,
    interval_with_sets,
    stability,
    vary,
    verdict,
)

#: Functions of one dataset or several, by the name that a claim gives the quantity: all that these
#: modules define for others.
DERIVED = {
    name: function
    for module in (contact_quantities, force_quantities, inference_quantities)
    for name, function in getmembers(module, isfunction)
    if function.__module__ == module.__name__ and not name.startswith("_")
}


def estimate(quantity: str, dataset: xr.Dataset, *others: xr.Dataset) -> xr.Dataset:
    """Return a derived quantity of one dataset or several, or a variable of one, with its interval.

    The quantity is a key of `DERIVED`, a variable, or a row of Table 1: the variable that the
    attribute `table1_variables` of the dataset names. A variable or an attribute that is needed and
    does not exist is a KeyError.
    """
    if quantity in DERIVED:
        result: xr.Dataset = DERIVED[quantity](dataset, *others)
        return result
    rows_of_table1 = json.loads(dataset.attrs.get("table1_variables", "{}"))
    return variable_as_number(dataset, rows_of_table1.get(quantity, quantity))


#: Datasets that the claims are about. A claim may also name `paper`.
DATASETS = (
    "topography", "adhesion", "scales", "band", "inference", "elastic", "indent",
    "repeated_contact", "asperities", "classical", "enhancement", "leave_one_out", "protruded",
)  # fmt: skip
#: Datasets that the claims of the chapter on what decides the band are about.
INSIGHT_DATASETS = ("topography", "elastic_limit", "laws", "scaling")
COLUMNS = (
    "id", "section", "statement", "published", "computed", "low", "high", "unit", "rule",
    "accepted_low", "accepted_high", "frequency", "verdict", "stability", "follows_from", "basis",
    "note",
)  # fmt: skip
NUMBERS = ("published", "published_low", "published_high")
#: Verdicts that no number decides.
FIXED = (BY_CONSTRUCTION, UNTESTABLE, EXPERIMENT)


def read_statements(path: str | Path) -> pd.DataFrame:
    """Read the statements of the paper from the table resources/paper/claims.csv.

    Published numbers are floats (NaN where blank), everything else is text.
    """
    table = pd.read_csv(path, dtype=str, keep_default_na=False)
    return table.assign(**{name: pd.to_numeric(table[name]) for name in NUMBERS})


def replicated_statements(path: str | Path) -> list[dict[str, str]]:
    """Return what sets need of the statements that they replicate, without words for readers."""
    table = read_statements(path)
    replicated = table[table["replicated"] == "yes"]
    columns = ["id", "dataset", "quantity", "select", "rule"]
    return [dict(zip(columns, row, strict=True)) for row in replicated[columns].values.tolist()]


def values(
    statements: pd.DataFrame, datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame
) -> pd.Series:
    """Compute the number of every claim, without its interval: a float by `id`.

    It is NaN where no number exists or the datasets lack a label. Statements and constants are
    those of `read_statements` and `published.constants`, the dataset `paper` of the claims; the
    datasets that they name are as in the final netCDF files. A ValueError names the claim and what
    is missing.
    """
    found = {
        claim.id: np.nan if computed is None else float(computed.number["value"])
        for claim, computed in _all_computed(statements, datasets, constants, np.nan)
    }
    return pd.Series(found, dtype=float).rename_axis("id")


def evaluate(
    statements: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    constants: pd.DataFrame,
    confidence: float,
    sets: xr.Dataset,
    seed: int,
) -> pd.DataFrame:
    """Compare every claim with the computed number: one row a claim with the columns `COLUMNS`.

    Arguments and errors are as of `values`; a claim about a surface or contact model that the study
    does not have is left out. The dataset `topography` says what scans are substitutes. `sets` is
    as in sets.nc: `value` (set, claim), the numbers of many equally good sets of scans. Those of a
    replicated claim give its frequency and, if they vary, its interval, with this confidence, and
    the stability of its verdict.
    """
    rows = []
    for claim, computed in _all_computed(statements, datasets, constants, confidence):
        if computed is not None:
            with _named(claim):
                row = _row(claim, computed, datasets["topography"], constants, sets, confidence)
                rows.append(row | {"stability": _stability(claim, row, sets, confidence, seed)})
    return pd.DataFrame(rows, columns=list(COLUMNS))


class _Computed(NamedTuple):
    """The number of a claim, the datasets it is computed from, and what is selected of them."""

    number: xr.Dataset
    parts: dict[str, xr.Dataset]
    chosen: Selection


def _all_computed(
    statements: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    constants: pd.DataFrame,
    confidence: float,
) -> Iterator[tuple[Any, _Computed | None]]:
    """Yield each claim and what is computed for it, None where the datasets lack a label."""
    complete = {
        name: _with_surface(data).assign_attrs(confidence=confidence)
        for name, data in datasets.items()
    }
    complete["paper"] = xr.Dataset(constants["value"].to_dict())
    estimates: dict[tuple[str, str], xr.Dataset] = {}
    claims: Iterable[Any] = statements.itertuples(index=False)
    for claim in claims:
        with _named(claim):
            parts = {name: _dataset(complete, name) for name in claim.dataset.split("+")}
            key = claim.dataset, claim.quantity
            if key not in estimates:
                estimates[key] = estimate(claim.quantity, *parts.values())
            chosen = selection(estimates[key], claim.select)
            computed = None
            if chosen is not None:
                number = selected_number(estimates[key], chosen, claim.rule)
                computed = _Computed(number, parts, chosen)
        yield claim, computed


def _with_surface(data: xr.Dataset) -> xr.Dataset:
    """Add the dimension `surface` to a dataset about the one surface that its attribute names."""
    if "surface" in data.dims or "surface" not in data.attrs:
        return data
    return data.expand_dims(surface=[data.attrs["surface"]])


def _dataset(datasets: Mapping[str, xr.Dataset], name: str) -> xr.Dataset:
    if name not in datasets:
        raise KeyError(f"no dataset named {name!r}")
    return datasets[name]


@contextmanager
def _named(claim: Any) -> Iterator[None]:
    """Put the name of the claim before the first sentence of an error.

    The message of a missing attribute is its name alone.
    """
    try:
        yield
    except (KeyError, TypeError, ValueError) as error:
        message = str(error.args[0]).partition(". ")[0].splitlines()[0]
        reason = message if " " in message else f"expected {message}, found none"
        raise ValueError(f"claim {claim.id}: {reason}") from error


def _row(
    claim: Any,
    computed: _Computed,
    topography: xr.Dataset,
    constants: pd.DataFrame,
    sets: xr.Dataset,
    confidence: float,
) -> dict[str, Any]:
    """Return one row of the result, without the stability of its verdict."""
    surfaces = surfaces_of(claim, computed.parts, computed.chosen, topography)
    value, limits = float(computed.number["value"]), (claim.published_low, claim.published_high)
    accepted = accepted_range(claim.rule, *limits)
    replicas = _replicas(claim, sets)
    low, high = _interval(claim, computed.number, replicas, confidence)
    fixed, reason = fixed_verdict(claim, surfaces, topography, constants)
    no_value = "No value exists." if np.isnan(value) else ""
    row = claim._asdict() | {
        "computed": value,
        "low": low,
        "high": high,
        "accepted_low": accepted[0],
        "accepted_high": accepted[1],
        "frequency": accepts(claim.rule, replicas, *limits).mean() if len(replicas) else np.nan,
        "verdict": fixed or verdict(claim.rule, value, low, high, *limits),
        "basis": basis(surfaces, topography),
        "note": " ".join(filter(None, (claim.note, reason, no_value))),
    }
    return {name: row[name] for name in COLUMNS if name in row}


def _replicas(claim: Any, sets: xr.Dataset) -> np.ndarray:
    """Return the numbers of all sets, none if the claim is not replicated."""
    if claim.replicated != "yes":
        return np.empty(0)
    if claim.id not in sets["claim"]:
        raise KeyError("expected its numbers in sets.nc, found none")
    replicas: np.ndarray = sets["value"].sel(claim=claim.id).values
    return replicas


def _interval(
    claim: Any, number: xr.Dataset, replicas: np.ndarray, confidence: float
) -> tuple[float, float]:
    """Return the ends of the interval of a number, NaN where none can be given.

    It is that of `interval_with_sets`; of zero width if no scan enters it.
    """
    value = float(number["value"])
    ends = interval_with_sets(value, bounds(number, "value"), replicas, confidence)
    return (value, value) if claim.needs == NO_SCAN and np.isnan(ends[0]) else ends


def _stability(
    claim: Any, row: Mapping[str, Any], sets: xr.Dataset, confidence: float, seed: int
) -> float:
    """Return how often the verdict stays with other sets, NaN if it does not depend on them."""
    replicas = _replicas(claim, sets)
    if not vary(replicas) or row["verdict"] in FIXED:
        return np.nan

    def judge(value: float, low: float, high: float) -> str:
        return verdict(claim.rule, value, low, high, claim.published_low, claim.published_high)

    rng = generator(seed, claim.id, "stability")
    return stability(judge, row["verdict"], replicas, confidence, rng)
