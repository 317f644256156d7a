"""What many sets of scans say about a number: its interval, and whether its verdict holds."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from hardcontact.numbers.statistics import percentile_interval

#: How often all sets are drawn again: an error of 0.015 of a share near 0.9.
REDRAWS = 400
#: A verdict may change with the seed if less than this share of the redraws gives it.
STABLE = 0.95


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
