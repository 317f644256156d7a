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
    """Return the central interval of the numbers of the sets.

    Parameters
    ----------
    replicas : ndarray (set, ...)
        The numbers of the sets, NaN where one has none.
    confidence : float
        Share of the sets inside.

    Returns
    -------
    ndarray (..., 2)
        Low and high end; NaN where fewer sets than that share have a number.
    """
    enough = np.isfinite(replicas).sum(axis=0) >= confidence * len(replicas)
    return np.where(enough[..., None], percentile_interval(replicas, confidence), np.nan)


def stretched(ends: ArrayLike, value: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Return an interval that holds its number: what is judged is what is printed.

    Parameters
    ----------
    ends : array_like (..., 2)
        Low and high end, NaN where there is no interval.
    value : array_like (...)
        The numbers, NaN where there is none: the interval then stays.

    Returns
    -------
    low, high : ndarray (...)
        NaN where there is no interval.
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
    """Return how often the verdict stays when all sets are drawn again.

    Another seed gives other sets, and another set as the study's own. The sets at hand stand for
    both: they are drawn again with replacement, and one of them is the study's own (the bootstrap:
    B. Efron, The Annals of Statistics 7, 1979, 1).

    Parameters
    ----------
    judge : callable
        Takes a number and the ends of its interval, returns a verdict.
    given : str
        The verdict of the sets at hand.
    replicas : ndarray (set,)
        The numbers of the sets, NaN where one has none.
    confidence : float
        Share of the sets inside the interval.
    rng : numpy.random.Generator
        Draws the sets.

    Returns
    -------
    float
        Share of `REDRAWS` redraws with the same verdict.
    """
    drawn = rng.choice(replicas, size=(len(replicas), REDRAWS))
    own = rng.choice(replicas, size=REDRAWS)
    low, high = stretched(sets_interval(drawn, confidence), own)
    redraws = zip(own.tolist(), low.tolist(), high.tolist(), strict=True)
    return float(np.mean([judge(*redraw) == given for redraw in redraws]))
