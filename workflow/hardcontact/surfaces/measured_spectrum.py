"""C_iso of one measurement, map or profile, and what bears on how far to believe it.

SurfaceTopography and scipy are imported where they are used.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.measurement import Measurement
from hardcontact.surfaces.profile_conversion import isotropic_from_profile
from hardcontact.surfaces.spectrum import BIN_EDGES, measured_psds
from hardcontact.surfaces.topography import level, library_map

if TYPE_CHECKING:
    from SurfaceTopography import UniformLineScan

__all__ = [
    "axis_ratio",
    "bias_of_log",
    "independent_waves",
    "levelled_topography",
    "local_slopes",
    "measured_psd",
    "size_of",
    "variance_of_log",
]

#: Share of the waves of a window of Hann that are independent, along one axis:
#: (mean w²)² / mean w⁴ = (3/8)² / (35/128).
INDEPENDENT = (3 / 8) ** 2 / (35 / 128)
#: Half the width, in ln q, of the piece of a spectrum that a local slope is fitted to: five bins.
HALF_WIDTH = 0.25 * np.log(10)


def size_of(measurement: Measurement) -> float:
    """Return the length of a profile, or the shorter edge of a map, in nm."""
    return float(min(measurement.heights.shape) * measurement.pixel_size)


def levelled_topography(measurement: Measurement) -> "UniformLineScan":
    """Return a measurement as SurfaceTopography knows it, less its plane or straight line."""
    from SurfaceTopography import UniformLineScan

    if measurement.kind == "map":
        return library_map(_levelled_map(measurement))
    return UniformLineScan(
        np.asarray(measurement.heights, float), size_of(measurement), unit="nm"
    ).detrend("height")


def _levelled_map(measurement: Measurement) -> HeightMap:
    return level(HeightMap(measurement.heights, measurement.pixel_size, False, "measured"))


def measured_psd(
    measurement: Measurement,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return C_iso of a levelled measurement, with a Hann window.

    Parameters
    ----------
    measurement : Measurement
        Map, whose PSD is averaged over directions, or profile, whose C_1D is converted.

    Returns
    -------
    wavevector : numpy.ndarray
        (bins,) in rad/nm: the centres of BIN_EDGES.
    density : numpy.ndarray
        C_iso (bins,) in nm⁴; NaN in empty bins.
    """
    if measurement.kind == "map":
        wavevector, _, density = measured_psds(_levelled_map(measurement))
        return wavevector, density
    wavevector = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
    profile = _profile_psd(levelled_topography(measurement))
    return wavevector, isotropic_from_profile(wavevector, profile, independent_waves(measurement))


def _profile_psd(topography: Any) -> NDArray[np.float64]:
    """Return C_1D along x (bins,) in nm³; NaN in empty bins, for which the library gives 0."""
    density = np.asarray(
        topography.power_spectrum_from_profile(
            window="hann", reliable=False, collocation=BIN_EDGES
        )[1],
        float,
    )
    return np.where(density > 0, density, np.nan)


def axis_ratio(measurement: Measurement) -> NDArray[np.float64]:
    """Return how many times C_1D along one axis of a map exceeds that along the other.

    The surface is taken as isotropic: a difference is one of the microscope, which smooths along
    the lines that it scans if its feedback lags, and adds noise from line to line.

    Parameters
    ----------
    measurement : Measurement
        Map or profile.

    Returns
    -------
    numpy.ndarray
        (bins,), 1 or more; 1 in empty bins, and of a profile, which has one axis.
    """
    if measurement.kind != "map":
        return np.ones(len(BIN_EDGES) - 1)
    levelled = _levelled_map(measurement)
    turned = HeightMap(levelled.heights.T, levelled.pixel_size, False, levelled.basis)
    along, across = (_profile_psd(library_map(one)) for one in (levelled, turned))
    ratio = np.maximum(along / across, across / along)
    return np.asarray(np.where(np.isfinite(ratio), ratio, 1.0), float)


def independent_waves(measurement: Measurement) -> NDArray[np.float64]:
    """Return the number of independent waves in each bin of a measured PSD.

    Parameters
    ----------
    measurement : Measurement
        Map or profile.

    Returns
    -------
    numpy.ndarray
        (bins,), at least 1: the number of wavevectors, one of each pair ±q, times the share that
        the Hann window leaves independent.
    """
    lengths = np.array(measurement.heights.shape) * measurement.pixel_size
    if measurement.kind == "map":
        count = np.pi / 2 * np.diff(BIN_EDGES**2) * lengths.prod() / (2 * np.pi) ** 2
    else:
        count = np.diff(BIN_EDGES) * lengths.prod() / (2 * np.pi)
    share = INDEPENDENT**measurement.heights.ndim
    return np.asarray(np.maximum(count * share, 1.0), float)


def variance_of_log(waves: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the variance of ln C of a mean over a number of independent waves.

    Squares of Fourier amplitudes are distributed exponentially, their mean as a gamma variable,
    the variance of whose logarithm is the trigamma function of their number.
    """
    from scipy.special import polygamma

    return np.asarray(polygamma(1, waves), float)


def bias_of_log(waves: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far the mean of ln C lies below ln of the mean of C, for a number of waves.

    For a gamma variable of n waves it is ln n minus the digamma function of n: 0.58 for one wave.
    """
    from scipy.special import digamma

    return np.asarray(np.log(waves) - digamma(waves), float)


def local_slopes(
    wavevector: NDArray[np.float64], density: NDArray[np.float64], variance: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the exponents of the power laws that a spectrum follows locally.

    Parameters
    ----------
    wavevector : numpy.ndarray
        (bins,) in rad/nm.
    density : numpy.ndarray
        (bins,), without gaps.
    variance : numpy.ndarray
        (bins,) of ln C, see `variance_of_log`.

    Returns
    -------
    slope, error : numpy.ndarray
        (bins,) d ln C / d ln q, fitted to half a decade around each bin, and its standard error;
        NaN and infinity where fewer than two bins lie there.
    """
    distance = np.log(wavevector) - np.log(wavevector)[:, None]
    near = np.abs(distance) <= HALF_WIDTH
    weight = np.where(near, 1 / variance, 0.0)
    total = weight.sum(axis=1)
    centred = distance - ((weight * distance).sum(axis=1) / total)[:, None]
    spread = (weight * centred**2).sum(axis=1)
    enough = near.sum(axis=1) > 1
    spread = np.where(enough, spread, np.nan)
    slope = (weight * centred) @ np.log(density) / spread
    return slope, np.where(enough, 1 / np.sqrt(spread), np.inf)
