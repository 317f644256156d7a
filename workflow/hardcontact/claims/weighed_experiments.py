"""Published experiments beside the law: predictive intervals, and verdicts by the claims' rules."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from scipy import stats

from hardcontact.claims.verdicts import accepted_range, accepts, verdict
from hardcontact.insight.experiments import HEIGHT, RATIO, Experiment
from hardcontact.insight.ledger import ERRORS, drawn, numbers_of_law
from hardcontact.numbers.random import generator
from hardcontact.numbers.statistics import interval_between, percentile_interval
from hardcontact.surfaces.spectrum import Floats

#: Verdicts beside those of the claims: what is stated tests nothing; the law was not tried there.
NOT_TESTABLE, NOT_TRIED = "not testable", "not tried"
#: Least share of the draws in which the error of the law is known that a verdict rests on.
LEAST_TRIED = 0.5
#: What decides the width where that is the error of the law itself.
OF_LAW = "law"
#: Draws of each experiment: a share of 0.025 beyond an end is known to 0.016.
DRAWS = 100
#: Intervals, as of `weighed`.
INTERVALS = ("predicted", "accepted")


def weighed(
    experiments: Sequence[Experiment], draws: int, seed: int, confidence: float
) -> xr.Dataset:
    """Return what the law says of each `experiment` beside what was measured.

    `predicted` is the median of the draws, with an interval of this confidence. `accepted` has the
    limits within which the rule finds agreement, `agreement` is the share of the draws in them;
    `tried` is that of draws for which the law's error is known. `decided_by` names what moves the
    prediction most. What is not testable has NaN and names in `missing` what it lacks: a negative
    control that sticks more than a smooth sphere would fail whatever the law says.
    """
    rows = [_weighed(one, draws, seed, confidence) for one in experiments]
    frame = pd.DataFrame(rows, index=pd.Index([one.id for one in experiments], name="experiment"))
    found = frame.drop(columns=[*INTERVALS]).to_xarray().rename(median="predicted")
    for name in INTERVALS:
        low, high = np.transpose(frame[name].tolist())
        ends = (xr.DataArray(one, dims="experiment") for one in (low, high))
        found[f"{name}_interval"] = interval_between(*ends)
    return found.assign_attrs(confidence=confidence, draws=draws)


def _weighed(experiment: Experiment, count: int, seed: int, confidence: float) -> dict[str, Any]:
    """Return the variables of one experiment, those of INTERVALS as pairs of ends."""
    rule, limits = experiment.rule, (experiment.low, experiment.high)
    row: dict[str, Any] = experiment._asdict() | {
        "height_basis": experiment.cells[HEIGHT].basis,
        "missing": ",".join(experiment.missing),
        "verdict": NOT_TESTABLE,
        "decided_by": "",
        **dict.fromkeys(("median", "agreement", "tried"), np.nan),
        **dict.fromkeys(INTERVALS, (np.nan, np.nan)),
    }
    for name in ("id", "cells", "low", "high"):
        del row[name]
    if rule:
        row["accepted"] = accepted_range(rule, *limits)
    if experiment.missing:
        return row
    if experiment.contact != "hard" and experiment.statement == RATIO and row["accepted"][0] >= 1:
        return row | {"missing": "below_smooth"}
    draws = drawn(experiment, count, generator(seed, "ledger", experiment.id))
    numbers, tried = numbers_of_law(experiment, draws)
    rough = np.isfinite(numbers)
    if not rough.any():
        return row | {"missing": "rough_contact"}
    numbers, draws = numbers[rough], {name: values[rough] for name, values in draws.items()}
    median, (least, most) = float(np.median(numbers)), percentile_interval(numbers, confidence)
    agrees, known = accepts(rule, numbers, *limits), tried[rough].mean()
    judged = verdict(rule, median, least, most, *limits)
    return row | {
        "median": median,
        "predicted": (least, most),
        "agreement": agrees.mean(),
        "tried": known,
        "verdict": judged if known >= LEAST_TRIED else NOT_TRIED,
        "decided_by": _deciding(draws, numbers),
    }


def _deciding(draws: Mapping[str, Floats], numbers: Floats) -> str:
    """Return the quantity whose draws have the largest rank correlation with the numbers."""
    correlations = {
        name: abs(float(stats.spearmanr(values, numbers).statistic))
        for name, values in draws.items()
        if np.ptp(values) > 0 and np.ptp(numbers) > 0
    }
    strongest = max(correlations, key=correlations.__getitem__, default="")
    return OF_LAW if strongest in ERRORS else strongest
