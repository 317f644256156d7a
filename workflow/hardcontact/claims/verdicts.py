"""Rules that turn a number, its interval and the published limits into a verdict."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.scales.critical_band import last_cutoff

BY_CONSTRUCTION = "by construction"
UNTESTABLE = "not testable on substitutes"
VERDICTS = (
    "reproduced", "consistent", "undecided", "not reproduced", BY_CONSTRUCTION, UNTESTABLE,
)  # fmt: skip

#: Rules of a single limit. The limit itself is rejected, that of the other rules accepted.
ONE_SIDED = ("below", "above", "order")


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
    """Judge one number and its interval, by the same logic whatever the rule.

    Reproduced: all of the interval is accepted. Undecided: it holds accepted and rejected numbers.
    Not reproduced: all of it is rejected, or there is no number. A number without an interval is
    consistent if it is accepted, else not reproduced.

    Parameters
    ----------
    rule : str
        As in `accepted_range`.
    computed, low, high : float
        The number and the ends of the interval that holds it, in the unit of the limits; NaN ends
        mean no interval, equal ends one that is known to be of zero width.
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
    limits = published_low, published_high
    if np.isnan(computed):
        return "not reproduced"
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


def read_verdicts(path: str | Path) -> pd.DataFrame:
    """Read the claims.csv of a study: claims with their verdicts, as from `evaluation.evaluate`.

    A file that ends within a line is a ValueError.
    """
    if not Path(path).read_bytes().endswith(b"\n"):
        raise ValueError(
            f"{path}: expected a whole table, found one that is cut short; delete it and run again"
        )
    text = ["follows_from", "note"]
    return pd.read_csv(path, dtype=dict.fromkeys(text, str)).fillna(dict.fromkeys(text, ""))


def summary(evaluated: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each verdict, and the independent findings among them.

    A claim that follows from another one, or that holds by construction, is no independent finding.
    Every verdict is listed, in the columns `verdict`, `independent` and `claims`.
    """
    verdicts = evaluated["verdict"]
    independent = (evaluated["follows_from"] == "") & (verdicts != BY_CONSTRUCTION)
    counts = {
        name: counted.value_counts().reindex(VERDICTS, fill_value=0)
        for name, counted in (("independent", verdicts[independent]), ("claims", verdicts))
    }
    return pd.DataFrame(counts).rename_axis("verdict").reset_index()


#: The end of the interval of an edge that may lie beyond the cutoffs, by the side of the edge.
OPEN_END = {"small": "high", "large": "low"}


def with_open_ends(claims: pd.DataFrame, bands: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Add which end of each interval is open, because no cutoff was computed beyond it.

    An edge beyond the cutoffs counts as the last one. Sets have fewer cutoffs than the study, whose
    own number may lie beyond theirs: an interval that is stretched to it is open there too.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `verdicts.read_verdicts`.
    bands : sequence of xarray.Dataset
        What the intervals come from, band.nc and sets.nc: scale_change (..., side, group,
        cutoff_wavelength).

    Returns
    -------
    pandas.DataFrame
        The claims with the column `open_end`: "low", "high" or "".
    """
    marked = claims.assign(open_end="")
    for side, end in OPEN_END.items():
        last = np.array([last_cutoff(band["scale_change"].sel(side=side), side) for band in bands])
        for group in bands[0]["group"].values:
            place = marked["id"] == f"critical_wavelength_{side}_{group}"
            for number, limit in marked.loc[place, ["computed", end]].values:
                beyond = number >= last if end == "high" else number <= last
                if np.isclose(limit, last).any() or (beyond.any() and np.isclose(limit, number)):
                    marked.loc[place, "open_end"] = end
    return marked
