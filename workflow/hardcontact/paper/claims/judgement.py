"""Compare each claim, a row of resources/paper/claims.csv, with a computed estimate (`estimates`).

`dataset`, `quantity` and `select` name the estimate. Rule and limits turn it into a verdict.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
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
    parse_selection,
    select_estimate,
)
from hardcontact.paper.claims.verdicts import (
    JUDGED_COLUMNS,
    accepted_range,
    find_open_end,
    interval_with_samples,
    samples_vary,
)
from hardcontact.surfaces.metrics import TABLE1_VARIABLES

#: Functions of datasets that the column `quantity` may name: all public ones of these modules.
DERIVED_QUANTITIES: dict[str, Callable[..., xr.Dataset]] = {
    name: function
    for module in (band_quantities, contact_quantities, force_quantities)
    for name, function in vars(module).items()
    if getattr(function, "__module__", "") == module.__name__ and not name.startswith("_")
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
    for claim, result in _estimate_claims(claims, datasets, constants, confidence):
        if result is None:
            continue
        with _prefix_errors(claim):
            surfaces = claim_surfaces(claim, result.datasets, result.labels, topography)
            verdict, reason = fixed_verdict(claim, surfaces, topography, constants)
            judgement = _judge(claim, result, sets, confidence)
        no_value = "No value exists." if np.isnan(judgement["computed"]) else ""
        row = claim._asdict() | judgement
        row["verdict"] = verdict or judgement["verdict"]
        row["basis"] = claim_basis(claim, surfaces, topography)
        row["note"] = " ".join(filter(None, (claim.note, reason, no_value)))
        rows.append(row)
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
    """Yield each claim and its estimate, None if the datasets lack a selected label."""
    all_datasets = {"paper": xr.Dataset(constants["value"].to_dict())}
    for name, dataset in datasets.items():
        all_datasets[name] = dataset.assign_attrs(confidence=confidence)
        # A dataset of a single surface names it in an attribute.
        if "surface" not in dataset.dims and "surface" in dataset.attrs:
            all_datasets[name] = all_datasets[name].expand_dims(surface=[dataset.attrs["surface"]])
    estimates: dict[tuple[str, str], xr.Dataset] = {}
    claim: Claim
    for claim in claims.itertuples(index=False):
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
    accepted = accepted_range(claim.rule, claim.published_low, claim.published_high)
    if claim.samples_from == "posterior":
        verdict = accepted.verdict_of_posterior(samples, low, high)
    elif samples_vary(samples):
        verdict = accepted.verdict_of_sets(samples, confidence)
    else:
        verdict = accepted.verdict(value, low, high)
    open_end = ""
    if claim.dataset == "edges" and claim.unit == "nm":  # an edge of the band, of one side
        ((side,),) = result.labels["side"]
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
        # Each dimension has one group of one label.
        labels = {dimension: label for dimension, ((label,),) in result.labels.items()}
        return np.asarray(posterior[f"sampled_{claim.quantity}"].sel(labels))
    if claim.samples_from != "sets":
        return np.empty(0)
    if claim.id not in sets["claim"]:
        raise KeyError("expected its values in sets.nc, found none")
    return np.asarray(sets["value"].sel(claim=claim.id))
