"""Judge the claims: compare what the paper states with what the study computed.

A claim is a row of resources/paper/claims.csv. It becomes a row of the claims.csv of a study in
five steps. The claim `outermost_short_edge` is the example: the outermost short edge is 43 nm.

1. Its columns name datasets and a quantity, here the dataset `edges` and `outermost_edge`. The
   quantity is a variable of the dataset or, as here, a function of one of three modules, here of
   `band_quantities`. All public functions of these modules are in DERIVED_QUANTITIES.
2. `_estimate_quantity` calls the function with the datasets. It returns an estimate, which is
   values with intervals, here of both sides of the band.
3. `select_estimate` takes the value that the column `select` names, here by `side=short`: 37 nm.
4. `_judge` adds what sets of scans show. Here the values of 100 sets give the interval, 34 to 45
   nm. The column `rule`, here `factor 1.25`, and the published limits, 42.5 and 43.5 nm, give the
   accepted numbers, 34.0 to 54.4 nm. Only 97 of the 100 values are accepted, not all, so the
   verdict is undecided.
5. `judge_claims` adds the basis, here substitute scans. Some claims have a fixed verdict, such as
   "by construction", which replaces that of step 4.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from inspect import getmembers, isfunction
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import interval_ends
from hardcontact.paper.claims import band_quantities, contact_quantities, force_quantities
from hardcontact.paper.claims.estimates import variable_estimate
from hardcontact.paper.claims.selection import (
    WITHOUT_SCAN,
    Claim,
    SelectedLabels,
    claim_basis,
    claim_surfaces,
    fixed_verdict,
    only_label,
    parse_selection,
    select_estimate,
)
from hardcontact.paper.claims.verdicts import (
    JUDGED_COLUMNS,
    accepted_numbers,
    find_open_end,
    interval_with_samples,
    samples_vary,
)
from hardcontact.surfaces.metrics import TABLE1_VARIABLES


def _public_functions(module: ModuleType) -> dict[str, Callable[..., xr.Dataset]]:
    """Return the public functions that a module defines, by name, without those it imports."""
    return {
        name: function
        for name, function in getmembers(module, isfunction)
        if function.__module__ == module.__name__ and not name.startswith("_")
    }


#: Functions of datasets that the column `quantity` may name.
DERIVED_QUANTITIES = {
    **_public_functions(band_quantities),
    **_public_functions(contact_quantities),
    **_public_functions(force_quantities),
}


def claim_values(
    claims: pd.DataFrame, datasets: Mapping[str, xr.Dataset], constants: pd.DataFrame
) -> xr.DataArray:
    """Return the value (set, claim) of each claim in datasets of sets; NaN without a value."""
    values = {
        claim.id: np.nan if result is None else result.estimate["value"].reset_coords(drop=True)
        # Without a confidence, values have no intervals.
        for claim, result in _estimate_claims(claims, datasets, constants, confidence=np.nan)
    }
    return xr.Dataset(values).to_dataarray("claim").transpose("set", "claim")


def judge_claims(
    claims: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    constants: pd.DataFrame,
    confidence: float,
    sets: xr.Dataset,
) -> pd.DataFrame:
    """Return one row for each claim, with JUDGED_COLUMNS.

    A claim about a surface or another label that the study lacks is left out. Raises ValueError
    with the claim's id if anything else is missing.
    """
    topography = datasets["topography"]
    rows = []
    estimated_claims = _estimate_claims(claims, datasets, constants, confidence)
    for row, (claim, result) in zip(claims.to_dict("records"), estimated_claims, strict=True):
        if result is None:
            continue
        with _prefix_errors(claim):
            surfaces = claim_surfaces(claim, result.datasets, result.labels, topography)
            verdict, reason = fixed_verdict(claim, surfaces, topography, constants)
            judgement = _judge(claim, result, sets, confidence)
        no_value = "No value exists." if np.isnan(judgement["computed"]) else ""
        judgement["verdict"] = verdict or judgement["verdict"]
        judgement["basis"] = claim_basis(claim, surfaces, topography)
        judgement["note"] = " ".join(filter(None, (claim.note, reason, no_value)))
        rows.append(row | judgement)
    return pd.DataFrame(rows, columns=list(JUDGED_COLUMNS))


class _ClaimResult(NamedTuple):
    """The estimate of a claim, the datasets from which it is computed, and the selected labels."""

    estimate: xr.Dataset
    datasets: dict[str, xr.Dataset]
    labels: SelectedLabels


def _estimate_claims(
    claims: pd.DataFrame,
    datasets: Mapping[str, xr.Dataset],
    constants: pd.DataFrame,
    confidence: float,
) -> Iterator[tuple[Claim, _ClaimResult | None]]:
    """Yield each claim and its result, None if the datasets lack a selected label."""
    all_datasets = {"paper": xr.Dataset(constants["value"].to_dict())}
    for name, dataset in datasets.items():
        all_datasets[name] = dataset.assign_attrs(confidence=confidence)
        # A dataset of a single surface names it in an attribute.
        if "surface" not in dataset.dims and "surface" in dataset.attrs:
            all_datasets[name] = all_datasets[name].expand_dims(surface=[dataset.attrs["surface"]])
    # Many claims select from the same estimate.
    estimates: dict[tuple[str, str], xr.Dataset] = {}
    for row in claims.to_dict("records"):
        claim = Claim.from_row(row)
        with _prefix_errors(claim):
            claim_datasets = {name: all_datasets[name] for name in claim.dataset.split("+")}
            key = claim.dataset, claim.quantity
            if key not in estimates:
                estimates[key] = _estimate_quantity(claim.quantity, *claim_datasets.values())
            labels = parse_selection(estimates[key], claim.select)
            result = None
            if labels is not None:
                selected = select_estimate(estimates[key], labels, claim.rule)
                result = _ClaimResult(selected, claim_datasets, labels)
        yield claim, result


def _estimate_quantity(quantity: str, dataset: xr.Dataset, *others: xr.Dataset) -> xr.Dataset:
    """Return the estimate of a derived quantity, or else of a variable or a row of Table 1."""
    if quantity in DERIVED_QUANTITIES:
        return DERIVED_QUANTITIES[quantity](dataset, *others)
    return variable_estimate(dataset, TABLE1_VARIABLES.get(quantity, quantity))


@contextmanager
def _prefix_errors(claim: Claim) -> Iterator[None]:
    """Put the name of the claim before the first sentence of an error."""
    try:
        yield
    except (KeyError, TypeError, ValueError) as error:
        message = str(error.args[0]).partition(". ")[0].splitlines()[0]
        # A KeyError of a missing dataset or attribute has only its name as its message.
        reason = message if " " in message else f"expected {message}, found none"
        raise ValueError(f"claim {claim.id}: {reason}") from error


def _judge(
    claim: Claim, result: _ClaimResult, sets: xr.Dataset, confidence: float
) -> dict[str, Any]:
    """Return the columns of a claim that follow from its estimate, samples and limits."""
    value = float(result.estimate["value"])
    samples = _claim_samples(claim, result, sets)
    ends = interval_ends(result.estimate, "value")
    low, high = interval_with_samples(value, ends, samples, confidence)
    if claim.needs in WITHOUT_SCAN and np.isnan(low):
        low = high = value  # because without scans nothing scatters
    accepted = accepted_numbers(claim.rule, claim.published_low, claim.published_high)
    if claim.samples_from == "posterior":
        verdict = accepted.verdict_of_posterior(samples, low, high)
    elif samples_vary(samples):
        verdict = accepted.verdict_of_sets(samples, confidence)
    else:
        verdict = accepted.verdict(value, low, high)
    open_end = ""
    if claim.dataset == "edges" and claim.unit == "nm":  # an edge of the band
        side = only_label(result.labels, "side")
        open_end = find_open_end(side, value, low, high, [result.datasets["edges"], sets])
    return {
        "computed": value,
        "low": low,
        "high": high,
        "open_end": open_end,
        "accepted_low": accepted.low,
        "accepted_high": accepted.high,
        "agreeing_share": accepted.accepts(samples).mean() if len(samples) else np.nan,
        "verdict": verdict,
    }


def _claim_samples(claim: Claim, result: _ClaimResult, sets: xr.Dataset) -> Floats:
    """Return the samples of a claim's value, from sets or from the posterior; empty if none."""
    if claim.samples_from == "posterior":
        posterior = next(iter(result.datasets.values()))
        labels = {dim: only_label(result.labels, dim) for dim in result.labels}
        return np.asarray(posterior[f"sampled_{claim.quantity}"].sel(labels))
    if claim.samples_from != "sets":
        return np.empty(0)
    if claim.id not in sets["claim"]:
        raise KeyError("expected its values in sets.nc, found none")
    return np.asarray(sets["value"].sel(claim=claim.id))
