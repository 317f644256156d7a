"""Rules that turn a number, its interval and the published limits into a verdict.

Many equally good sets of scans tell the interval of a number, and whether its verdict holds.
"""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.band.critical_band import last_cutoff
from hardcontact.base.statistics import percentile_interval

BY_CONSTRUCTION = "by construction"
UNTESTABLE = "not testable"
EXPERIMENT = "model beside experiment"
VERDICTS = (
    "reproduced", "consistent", "undecided", "not reproduced", BY_CONSTRUCTION, UNTESTABLE,
    EXPERIMENT,
)  # fmt: skip

#: Rules of a single limit. The limit itself is rejected, that of the other rules accepted.
ONE_SIDED = ("below", "above", "order")
#: How often all sets are drawn again: an error of 0.015 of a share near 0.9.
REDRAWS = 400
#: A verdict may change with the seed if less than this share of the redraws gives it.
STABLE = 0.95


def accepted_range(rule: str, published_low: float, published_high: float) -> tuple[float, float]:
    """Return the limits between which a number agrees with the paper, in the unit of the published.

    The rule is `interval`, `factor` and a number, `below`, `above` or `order`. Published limits are
    NaN where the paper has none. An unknown rule, or a limit that the rule needs and is missing, is
    a ValueError.
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


def accepts(
    rule: str, values: ArrayLike, published_low: float, published_high: float
) -> np.ndarray:
    """Return which numbers (...) are in the `accepted_range` of a rule; NaN, no number, is not."""
    lower, upper = accepted_range(rule, published_low, published_high)
    given = np.asarray(values)
    if rule in ONE_SIDED:
        return (lower < given) & (given < upper)
    return (lower <= given) & (given <= upper)


def verdict(
    rule: str, computed: float, low: float, high: float, published_low: float, published_high: float
) -> str:
    """Judge one number and its interval, by the same logic whatever the rule: one of `VERDICTS`.

    Reproduced: all of the interval is accepted. Undecided: it holds accepted and rejected numbers.
    Not reproduced: all of it is rejected. A number without an interval is consistent if it is
    accepted, else not reproduced. Where there is no number nothing is decided.

    The ends are those of the interval that holds the number, in the unit of the limits; NaN ends
    mean no interval, equal ends one that is known to be of zero width. Rule, limits and errors are
    as of `accepted_range`.
    """
    limits = published_low, published_high
    if np.isnan(computed):
        return "undecided"
    if np.isnan(low) or np.isnan(high):
        return "consistent" if accepts(rule, computed, *limits) else "not reproduced"
    if accepts(rule, [low, high], *limits).all():
        return "reproduced"
    lower, upper = accepted_range(rule, *limits)
    if rule in ONE_SIDED:
        overlaps = low < upper and lower < high
    else:
        overlaps = low <= upper and lower <= high
    return "undecided" if overlaps else "not reproduced"


def sets_interval(replicas: np.ndarray, confidence: float) -> np.ndarray:
    """Return the central interval (..., 2) of the numbers (set, ...) of the sets.

    The confidence is the share of the sets inside. A set without a number has NaN; so has the
    interval where fewer sets than that share have one.
    """
    enough = np.isfinite(replicas).sum(axis=0) >= confidence * len(replicas)
    return np.where(enough[..., None], percentile_interval(replicas, confidence), np.nan)


def stretched(ends: ArrayLike, value: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Return an interval that holds its number, so that what is judged is what is printed.

    Ends (..., 2) are NaN where there is no interval; it stays where the number (...) is NaN. The
    low and the high end are returned one by one, (...).
    """
    low, high = np.moveaxis(np.asarray(ends, dtype=float), -1, 0)
    none = np.isnan(value)
    return np.where(none, low, np.minimum(low, value)), np.where(
        none, high, np.maximum(high, value)
    )


def vary(replicas: np.ndarray) -> bool:
    """Return whether the sets (set,) that have a number have different ones."""
    known = replicas[np.isfinite(replicas)]
    return len(known) > 0 and np.ptp(known) > 0


def interval_with_sets(
    value: float, interval: tuple[ArrayLike, ArrayLike], replicas: np.ndarray, confidence: float
) -> tuple[float, float]:
    """Return the ends of the interval of a number, stretched to hold it; NaN if there is none.

    It is the spread of the numbers (set,) of all sets where they vary, otherwise the interval that
    the number has without them.
    """
    ends = sets_interval(replicas, confidence) if vary(replicas) else np.array(interval)
    low, high = stretched(ends, value)
    return float(low), float(high)


def stability(
    judge: Callable[[float, float, float], str],
    given: str,
    replicas: np.ndarray,
    confidence: float,
    rng: np.random.Generator,
) -> float:
    """Return the share of `REDRAWS` redraws of all sets in which the verdict stays as given.

    Another seed gives other sets, and another set as the study's own. The sets at hand stand for
    both: they are drawn again with replacement, and one of them is the study's own (the bootstrap:
    B. Efron, The Annals of Statistics 7, 1979, 1). The judge takes a number and the ends of its
    interval and returns a verdict; the numbers (set,) of the sets are NaN where one has none, and
    the confidence is the share of the sets inside the interval.
    """
    drawn = rng.choice(replicas, size=(len(replicas), REDRAWS))
    own = rng.choice(replicas, size=REDRAWS)
    low, high = stretched(sets_interval(drawn, confidence), own)
    redraws = zip(own.tolist(), low.tolist(), high.tolist(), strict=True)
    return float(np.mean([judge(*redraw) == given for redraw in redraws]))


def read_verdicts(path: str | Path) -> pd.DataFrame:
    """Read the claims.csv of a study: claims with their verdicts, as from `evaluation.evaluate`.

    A file that ends within a line is a ValueError.
    """
    if not Path(path).read_bytes().endswith(b"\n"):
        raise ValueError(
            f"{path}: expected a whole table, found one that is cut short; delete it and run again"
        )
    text = dict.fromkeys(["unit", "follows_from", "note"], str)
    return pd.read_csv(path, dtype=text).fillna({"follows_from": "", "note": ""})


def summary(evaluated: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each verdict, and the independent findings among them.

    No independent finding is a claim that follows from another one, that holds by construction, or
    that tells measured forces, beside which the model stands. Every verdict is listed, in the
    columns `verdict`, `independent` and `claims`.
    """
    verdicts = evaluated["verdict"]
    independent = (evaluated["follows_from"] == "") & ~verdicts.isin([BY_CONSTRUCTION, EXPERIMENT])
    counts = {
        name: counted.value_counts().reindex(VERDICTS, fill_value=0)
        for name, counted in (("independent", verdicts[independent]), ("claims", verdicts))
    }
    return pd.DataFrame(counts).rename_axis("verdict").reset_index()


#: The end of the interval of an edge that may lie beyond the cutoffs, by the side of the edge.
OPEN_END = {"small": "high", "large": "low"}


def open_end(side: str, value: float, low: float, high: float, bands: Sequence[xr.Dataset]) -> str:
    """Return the end of the interval of an edge beyond which no cutoff was computed, or "".

    Edges are in nm. Bands are as for `with_open_ends`.
    """
    end = OPEN_END[side]
    limit = high if end == "high" else low
    last = np.array([last_cutoff(band["scale_change"].sel(side=side), side) for band in bands])
    beyond = value >= last if end == "high" else value <= last
    at_last = np.isclose(limit, last).any() or (beyond.any() and np.isclose(limit, value))
    return end if at_last else ""


def with_open_ends(claims: pd.DataFrame, bands: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Add the column `open_end`: "low" or "high" where no cutoff was computed beyond it, or "".

    An edge beyond the cutoffs counts as the last one. Sets have fewer cutoffs than the study, whose
    own number may lie beyond theirs: an interval that is stretched to it is open there too. The
    intervals come from band.nc and sets.nc: scale_change (..., side, group, cutoff_wavelength).
    """
    sides = claims["id"].str.extract("^(?:edge|critical_wavelength)_(small|large)_", expand=False)
    rows = zip(sides, claims["computed"], claims["low"], claims["high"], strict=True)
    ends = [open_end(*row, bands) if isinstance(row[0], str) else "" for row in rows]
    return claims.assign(open_end=ends)
