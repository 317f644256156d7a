"""Rules that turn a number, its interval and the published limits into a verdict."""

from pathlib import Path

import numpy as np
import pandas as pd

__all__ = [
    "ONE_SIDED",
    "UNTESTABLE",
    "VERDICTS",
    "accepted_range",
    "read_verdicts",
    "summary",
    "verdict",
]

UNTESTABLE = "not testable on substitutes"
VERDICTS = ("reproduced", "consistent", "not reproduced", UNTESTABLE)

#: Rules of a single limit.
ONE_SIDED = ("below", "above", "order")


def accepted_range(rule: str, published_low: float, published_high: float) -> tuple[float, float]:
    """Return the limits between which a number agrees with the paper.

    Parameters
    ----------
    rule : str
        `interval`, `factor` and a number, `below`, `above` or `order`.
    published_low, published_high : float
        Published limits, NaN where the paper has none.

    Returns
    -------
    low, high : float
        In the unit of the published limits.

    Raises
    ------
    ValueError
        For an unknown rule and for a limit that the rule needs and is missing.
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
    """Judge one number and its interval.

    Rules with two limits (`interval`, `factor`): reproduced when the number lies between them,
    consistent when only its interval overlaps theirs. Rules with one (`below`, `above`, `order`):
    reproduced when the whole interval is on the right side, consistent when only the number is.
    A number that is NaN is not reproduced.

    Parameters
    ----------
    rule : str
        As in `accepted_range`.
    computed, low, high : float
        The number and the ends of its interval, in the unit of the limits; NaN ends mean no
        interval.
    published_low, published_high : float
        As in `accepted_range`.

    Returns
    -------
    str
        One of `VERDICTS`.

    Raises
    ------
    ValueError
        As `accepted_range`.
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


def read_verdicts(path: str | Path) -> pd.DataFrame:
    """Read the table of claims with their verdicts.

    Parameters
    ----------
    path : str or Path
        The claims.csv of a study.

    Returns
    -------
    pandas.DataFrame
        As from `evaluation.evaluate`.

    Raises
    ------
    ValueError
        If the file ends within a line.
    """
    if not Path(path).read_bytes().endswith(b"\n"):
        raise ValueError(
            f"{path}: expected a whole table, found one that is cut short; delete it and run again"
        )
    return pd.read_csv(path)


def summary(evaluated: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each verdict.

    Parameters
    ----------
    evaluated : pandas.DataFrame
        As from `evaluation.evaluate`.

    Returns
    -------
    pandas.DataFrame
        Columns `verdict` and `claims`; every verdict is listed.
    """
    counts = evaluated["verdict"].value_counts().reindex(VERDICTS, fill_value=0)
    return counts.rename_axis("verdict").rename("claims").reset_index()
