"""How well contacts on a map of forces tell its mean: at random places, in arrays, correlated.

Forces here are maps (n, n) of the pull-off force at every pixel of a scan, in any unit; errors are
standard deviations over the mean of the map.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

__all__ = [
    "Correlation",
    "array_error",
    "contacts_for_error",
    "correlation",
    "deviation_interval",
    "variation",
]

Floats = NDArray[np.float64]


def variation(forces: Floats) -> float:
    """Return the standard deviation of forces over their mean: the error of a single contact."""
    return float(forces.std() / forces.mean())


def array_error(forces: Floats, count: int) -> float:
    """Return the error of the mean of a square array of contacts on the scan and its mirror images.

    It is that of all arrays there are: the same array at every shift within one of its steps.

    Parameters
    ----------
    forces : numpy.ndarray
        (n, n) at every pixel of the scan.
    count : int
        Contacts along an edge of the array, which spans the period of 2n pixels of the stitched
        scan, as `contact_positions` does.

    Returns
    -------
    float
        Root mean square of array mean over map mean minus one.
    """
    period = 2 * len(forces)
    shifts = np.arange(-(-period // count))
    places = (shifts[:, None] + np.arange(count) * period // count) % period
    on_scan = np.minimum(places, period - 1 - places)
    rows = forces[on_scan].mean(axis=1)
    means = rows[:, on_scan].mean(axis=2)
    return float(np.sqrt(np.mean((means / forces.mean() - 1) ** 2)))


def contacts_for_error(contacts: ArrayLike, errors: ArrayLike, error: float) -> float:
    """Return the number of contacts beyond which errors stay within a limit.

    Parameters
    ----------
    contacts : array_like
        (k,) numbers of contacts, ascending.
    errors : array_like
        (k,) of each.
    error : float
        The limit.

    Returns
    -------
    float
        Interpolated in the logarithms; the first number if all errors are within the limit, NaN if
        the last one is not.
    """
    numbers, found = np.asarray(contacts, float), np.asarray(errors, float)
    (beyond,) = np.nonzero(found > error)
    if not beyond.size:
        return float(numbers[0])
    if beyond[-1] == len(found) - 1:
        return float("nan")
    ends = [beyond[-1] + 1, beyond[-1]]  # errors ascend from the first to the second
    with np.errstate(divide="ignore"):
        at = np.interp(np.log(error), np.log(found[ends]), np.log(numbers[ends]))
    return float(np.exp(at))


class Correlation(NamedTuple):
    """How far the force at one place tells that at another.

    Attributes
    ----------
    length : float
        Distance at which the correlation, averaged over directions, falls to 1/e; NaN where it
        does not within half the scan.
    area : float
        Integral of the correlation over the plane, up to its first zero: an area much larger than
        it has as many independent contacts as it holds such areas.
    """

    length: float
    area: float


def correlation(forces: Floats, pixel_size: float) -> Correlation:
    """Return the correlation of a map of forces.

    Parameters
    ----------
    forces : numpy.ndarray
        (n, n); it does not continue itself beyond its edges.
    pixel_size : float
        Edge of a pixel in nm.

    Returns
    -------
    Correlation
        In nm and nm².
    """
    half = len(forces) // 2
    lags = _autocorrelation(forces)[: half + 1, : 2 * half + 1]
    rows, columns = np.arange(half + 1)[:, None], np.arange(-half, half + 1)
    # The map of lags is symmetric about zero: rows of negative lag count with those of positive.
    weight = np.where(rows > 0, 2.0, 1.0) * np.ones_like(columns)
    distance = np.rint(np.hypot(rows, columns)).astype(int)
    near = distance <= half
    number = np.bincount(distance[near], weight[near])
    integral = np.bincount(distance[near], (weight * lags)[near])
    radial = integral / number
    (negative,) = np.nonzero(radial <= 0)
    end = negative[0] if negative.size else len(radial)
    return Correlation(
        _first_crossing(radial, np.exp(-1)) * pixel_size, integral[:end].sum() * pixel_size**2
    )


def _autocorrelation(forces: Floats) -> Floats:
    """Return the correlation at lags (row, column) from 0 to n/2 and from -n/2 to n/2.

    Each lag is averaged over the pairs of pixels that it has on the map.
    """
    pixels = len(forces)
    half = pixels // 2
    padded = np.fft.rfft2(forces - forces.mean(), s=(2 * pixels, 2 * pixels))
    products = np.fft.irfft2(np.abs(padded) ** 2, s=(2 * pixels, 2 * pixels))
    columns = np.arange(-half, half + 1)
    pairs = (pixels - np.arange(half + 1))[:, None] * (pixels - np.abs(columns))
    covariance = products[: half + 1, columns] / pairs
    return np.asarray(covariance / covariance[0, half])


def _first_crossing(curve: Floats, level: float) -> float:
    """Return the index, interpolated, at which a curve first falls below a level; NaN if never."""
    (below,) = np.nonzero(curve < level)
    if not below.size:
        return float("nan")
    end = int(below[0])
    return float(end - (level - curve[end]) / (curve[end - 1] - curve[end]))


def deviation_interval(deviation: ArrayLike, count: int, confidence: float) -> Floats:
    """Return the interval of a standard deviation of a normal distribution, by chi-squared.

    Parameters
    ----------
    deviation : array_like
        (...) of `count` values, with the divisor count - 1.
    count : int
        Number of independent values.
    confidence : float
        Probability that the interval holds the deviation.

    Returns
    -------
    numpy.ndarray
        (..., 2) low and high end; NaN of fewer than two values.
    """
    found = np.asarray(deviation, float)
    if count < 2:
        return np.full((*found.shape, 2), np.nan)
    tails = np.array([1 + confidence, 1 - confidence]) / 2
    return np.asarray(found[..., None] * np.sqrt((count - 1) / stats.chi2.ppf(tails, count - 1)))
