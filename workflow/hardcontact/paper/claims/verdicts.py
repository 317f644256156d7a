"""Verdicts about claims: from a number, its interval or samples, and the published limits."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import percentile_interval
from hardcontact.inference.edges import last_cutoff

REPRODUCED = "reproduced"
AGREES = "agrees"  # A number without an interval.
UNDECIDED = "undecided"
NOT_REPRODUCED = "not reproduced"
BY_CONSTRUCTION = "by construction"
UNTESTABLE = "not testable"
EXPERIMENT = "model beside experiment"
VERDICTS = (REPRODUCED, AGREES, UNDECIDED, NOT_REPRODUCED, BY_CONSTRUCTION, UNTESTABLE, EXPERIMENT)

#: Rules with a single limit. They reject the limit itself; the other rules accept their limits.
#: `order` is `above` for the smallest ratio of neighbours in a published ranking.
ONE_SIDED = ("below", "above", "order")
#: Share of all possible sets that must agree with a statement, or disagree, and share of the
#: posterior that must agree: the usual 95 %.
REPRODUCED_SHARE = 0.95
#: Columns of the claims.csv of a study. `evidence` says where the limits of the paper come from,
#: `basis` on which scans the computed number rests, `open_end` comes from `find_open_end`.
JUDGED_COLUMNS = (
    "id", "main", "section", "statement", "number", "published", "computed", "low", "high",
    "open_end", "unit", "rule", "evidence", "accepted_low", "accepted_high", "agreeing_share",
    "verdict", "follows_from", "basis", "note",
)  # fmt: skip


@dataclass(frozen=True)
class AcceptedNumbers:
    """The numbers that agree with the paper, in the unit of the published limits."""

    low: float
    high: float
    includes_limits: bool  #: Whether a number at a limit agrees.

    def accepts(self, values: ArrayLike) -> NDArray[np.bool_]:
        """Return whether each number (...) agrees with the paper; NaN does not."""
        values = np.asarray(values)
        if self.includes_limits:
            return (self.low <= values) & (values <= self.high)
        return (self.low < values) & (values < self.high)

    def verdict_of_sets(self, set_values: Floats, confidence: float) -> str:
        """Judge the numbers (set,) of sets by how many agree; a missing number does not."""
        agreeing_sets = self.accepts(set_values).sum()
        needed_sets = sets_needed(len(set_values), confidence)
        if agreeing_sets >= needed_sets:
            return REPRODUCED
        return NOT_REPRODUCED if agreeing_sets <= len(set_values) - needed_sets else UNDECIDED

    def verdict_of_posterior(self, samples: Floats, low: float, high: float) -> str:
        """Judge samples (sample,) of the posterior of a number, and their interval."""
        if self.accepts(samples).mean() >= REPRODUCED_SHARE:
            return REPRODUCED
        # The interval alone decides about a rejection, because few samples agree if the accepted
        # numbers lie close together. `verdict` needs no number besides an interval, so `low` stands
        # for it.
        return NOT_REPRODUCED if self.verdict(low, low, high) == NOT_REPRODUCED else UNDECIDED

    def verdict(self, computed: float, low: float, high: float) -> str:
        """Judge a number, NaN if none exists, and its interval, NaN if it has none."""
        if np.isnan(computed):
            return UNDECIDED
        if np.isnan(low) or np.isnan(high):
            return AGREES if self.accepts(computed) else NOT_REPRODUCED
        if self.accepts([low, high]).all():
            return REPRODUCED
        overlap = min(high, self.high) - max(low, self.low)
        overlaps = overlap >= 0 if self.includes_limits else overlap > 0
        return UNDECIDED if overlaps else NOT_REPRODUCED


def accepted_numbers(rule: str, published_low: float, published_high: float) -> AcceptedNumbers:
    """Return the numbers that agree with the paper by a rule, given the published limits or NaN.

    The rule is ``interval``, ``factor`` and a number, ``below``, ``above`` or ``order``. Raises
    ValueError if it is unknown, or needs a limit that is missing.
    """
    if rule == "interval":
        limits = published_low, published_high
    elif re.fullmatch(r"factor \d+(\.\d+)?", rule):
        factor = float(rule.removeprefix("factor "))
        limits = published_low / factor, published_high * factor
    elif rule == "below":
        limits = -np.inf, published_high
    elif rule in ("above", "order"):
        limits = published_low, np.inf
    else:
        raise ValueError(
            f"rule: expected interval, factor 2, below, above or order, found {rule!r}"
        )
    if np.isnan(limits).any():
        raise ValueError(f"rule: expected the published limits of {rule!r}, found none")
    return AcceptedNumbers(*limits, includes_limits=rule not in ONE_SIDED)


def sets_needed(set_count: int, confidence: float) -> int:
    """Return the fewest agreeing sets that prove that REPRODUCED_SHARE of all possible sets agree.

    The exact binomial interval of the share is then above it: Clopper and Pearson, Biometrika 26
    (1934) 404. At a confidence of 0.95, 100 of 100 sets or 197 of 200 prove it. A number above
    `set_count` says that so few sets decide nothing.
    """
    from scipy.stats import binom

    return int(binom.isf((1 - confidence) / 2, set_count, REPRODUCED_SHARE)) + 1


def sets_interval(samples: Floats, confidence: float) -> Floats:
    """Return the central intervals (..., 2) of numbers (set, ...); NaN if too few are finite."""
    are_enough = np.isfinite(samples).sum(axis=0) >= confidence * len(samples)
    return np.where(are_enough[..., None], percentile_interval(samples, confidence), np.nan)


def stretch_interval(ends: ArrayLike, value: ArrayLike) -> tuple[Floats, Floats]:
    """Return both ends (...) of intervals (..., 2), stretched to contain their values, if any."""
    low, high = np.moveaxis(np.asarray(ends, dtype=float), -1, 0)
    is_missing = np.isnan(value)
    stretched_low = np.where(is_missing, low, np.minimum(low, value))
    stretched_high = np.where(is_missing, high, np.maximum(high, value))
    return stretched_low, stretched_high


def samples_vary(samples: Floats) -> bool:
    """Return whether the finite numbers among samples (n,) differ."""
    return len(np.unique(samples[np.isfinite(samples)])) > 1


def interval_with_samples(
    value: float, interval: tuple[ArrayLike, ArrayLike], samples: Floats, confidence: float
) -> tuple[float, float]:
    """Return both ends of the interval of a number, stretched to contain it.

    The interval is that of the samples (n,) if they vary, otherwise the number's own.
    """
    ends = sets_interval(samples, confidence) if samples_vary(samples) else np.array(interval)
    low, high = stretch_interval(ends, value)
    return float(low), float(high)


def read_judged_claims(path: str | Path) -> pd.DataFrame:
    """Read the claims.csv of a study; raise ValueError if it ends within a line."""
    if not Path(path).read_bytes().endswith(b"\n"):
        raise ValueError(
            f"{path}: expected a complete table, found a part of it; delete it and run again"
        )
    texts = ["main", "open_end", "unit", "follows_from", "note", "verdict"]  # which may be blank
    return pd.read_csv(path, dtype=dict.fromkeys(texts, str)).fillna(dict.fromkeys(texts, ""))


def find_open_end(
    side: str, value: float, low: float, high: float, edge_datasets: Sequence[xr.Dataset]
) -> str:
    """Return which end of an edge's interval (nm) is only a bound: ``"high"``, ``"low"`` or ``""``.

    The search of an edge ends at a last cutoff, the longest of the short side or the shortest of
    the long side. If an edge lies beyond, this cutoff stands for it. So the end of an interval on
    that side is only a bound if it is a last cutoff, of edges.nc or of sets.nc. It is one, too, if
    it is the value itself, which lies at or beyond a last cutoff.
    """
    is_short = side == "short"
    end, limit = ("high", high) if is_short else ("low", low)
    changes = [edges["filtered_force_change"].sel(side=side) for edges in edge_datasets]
    last_cutoffs = np.array([last_cutoff(change, side) for change in changes])
    is_beyond = (value >= last_cutoffs if is_short else value <= last_cutoffs).any()
    is_open = np.isclose(limit, last_cutoffs).any() or (is_beyond and np.isclose(limit, value))
    return end if is_open else ""


def count_verdicts(claims: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each of `VERDICTS`, and the independent statements among them."""
    verdicts = claims["verdict"]
    independent = (claims["follows_from"] == "") & ~verdicts.isin([BY_CONSTRUCTION, EXPERIMENT])
    counts = pd.DataFrame(
        {
            "independent": verdicts[independent].value_counts().reindex(VERDICTS, fill_value=0),
            "claims": verdicts.value_counts().reindex(VERDICTS, fill_value=0),
        }
    )
    return counts.rename_axis("verdict").reset_index()
