"""Extrapolation of a joined spectrum beyond the wavelengths that its measurements show.

The spectrum is self-affine from the shortest wavelength down to atoms, with the Hurst exponent of
its last decade, within bounds on slope and curvature. It rises from the longest wavelength up to a
roll-off, and is constant beyond. The roll-off follows from the variance of the levelled heights by
Bayes' rule.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from hardcontact.surfaces.hurst_exponent import ROLLOFF_COUNT, HurstFit
from hardcontact.surfaces.measured_spectrum import levelled_topography, size_of
from hardcontact.surfaces.reliable_band import ReliableBand
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    BIN_WIDTH,
    MIN_BINS,
    WAVEVECTORS,
    Floats,
    Spectrum,
    power_law_tail,
)

#: The shortest wave of a row of atoms in nm: two bonds of diamond, 0.154 nm each.
ATOMIC = 0.3
#: The largest rms gradient, and half-Laplacian in 1/nm, over all scales: those of UNCD, the
#: roughest hard surface of Table 1 of the paper, with their uncertainties (1.17 + 0.28, 6.32 +
#: 1.20). A sphere of such a curvature has the radius of an atom.
GRADIENT, HALF_LAPLACIAN = 1.45, 7.52
#: The longest roll-off wavelength that is considered, over the size of the scan: slower waves are
#: slopes to it, which levelling removes.
MAX_ROLLOFF = 10.0
#: Decades that the Hurst exponent is fitted to at least: five bins.
FITTED_DECADES = 0.39
#: Directions that waves are averaged over.
DIRECTIONS = 64
#: The steepest rise toward long wavelengths: that of a self-affine surface with H = 1.
STEEPEST = -4.0
LOG_WAVEVECTORS = np.log(WAVEVECTORS)


class Tail(NamedTuple):
    """How a spectrum goes on below the shortest wavelength measured; NaN where it does not."""

    tail_hurst: float = np.nan
    tail_hurst_error: float = np.nan  #: Its standard error.
    tail_fit_shortest: float = np.nan  #: Wavelengths in nm that the Hurst exponent is fitted to.
    tail_fit_longest: float = np.nan
    tail_ended_by: str = ""  #: "gradient", "half_laplacian", "atoms", or "" of a description.


def has_exponent(tail: Tail) -> bool:
    """Return whether a Hurst exponent within 0 to 1 fits half a decade of bins or more, if any.

    Otherwise roughness below the wavelengths measured is a guess.
    """
    decades = np.log10(tail.tail_fit_longest / tail.tail_fit_shortest)
    within = 0 < tail.tail_hurst < 1
    return bool(np.isnan(tail.tail_hurst) or (within and decades >= FITTED_DECADES))


def continued_spectrum(
    wavevector: Floats, density: Floats, hurst: HurstFit, change: float = 0.0
) -> tuple[Floats, Tail]:
    """Return C_iso (nm⁴) on WAVEVECTORS from measured points, and how it was continued.

    The points, at least three without gaps, are wavevectors (rad/nm) and C_iso (nm⁴). C_iso is
    constant above them. It is self-affine below, with the fitted Hurst exponent, changed by a
    number and held within 0 to 1. The tail ends at the distance of atoms, or where the rms gradient
    or half-Laplacian of all scales would exceed that of the roughest hard surface known.
    """
    # A point of the table at the last wavevector may lie beyond it by rounding.
    table = Spectrum(wavevector, density)(np.minimum(WAVEVECTORS, wavevector[-1]))
    measured = np.where(wavevector[-1] * (1 + 1e-9) >= WAVEVECTORS, table, 0.0)
    exponent = float(np.clip(hurst.exponent + change, 0, 1))
    # The tail begins with the log-mean of the last points along it.
    relative = wavevector[-MIN_BINS:] / wavevector[-1]
    level = float(np.exp(np.mean(np.log(density[-MIN_BINS:] * relative ** (2 + 2 * exponent)))))
    last = measured.nonzero()[0][-1]
    start = measured.copy()
    start[last] = level * (WAVEVECTORS[last] / wavevector[-1]) ** (-2 - 2 * exponent)
    spectrum = measured + power_law_tail(start, exponent, ATOMIC)
    end, ended_by = _bounded(spectrum)
    spectrum = np.where(np.arange(len(WAVEVECTORS)) <= max(end, last), spectrum, 0.0)
    if end <= last:
        return spectrum, Tail(tail_ended_by=ended_by)
    return spectrum, Tail(exponent, hurst.error, hurst.shortest, hurst.longest, ended_by)


def _bounded(density: Floats) -> tuple[int, str]:
    """Return the last index of WAVEVECTORS within the bounds, and `tail_ended_by`."""
    from scipy.integrate import cumulative_trapezoid

    def rms(power: int, divisor: int) -> Floats:
        square = density * WAVEVECTORS**power / divisor / (2 * np.pi)
        return np.sqrt(cumulative_trapezoid(square, LOG_WAVEVECTORS, initial=0))

    exceeded = {
        "gradient": rms(4, 1) > GRADIENT,
        "half_laplacian": rms(6, 4) > HALF_LAPLACIAN,
        "atoms": density == 0,
    }
    # An appended True stands after the last wave, where no wave is beyond a bound.
    first_exceeded = {
        bound: int(np.argmax(np.append(waves, True))) for bound, waves in exceeded.items()
    }
    ended_by = min(first_exceeded, key=first_exceeded.__getitem__)
    return first_exceeded[ended_by] - 1, ended_by


def with_rolloff(density: Floats, longest: float, slope: float, rolloff: float) -> Floats:
    """Return C_iso (nm⁴) on WAVEVECTORS that rises above the longest wavelength measured (nm).

    It rises with d ln C/d ln q = `slope`, held within STEEPEST and 0, up to the roll-off (nm).
    """
    relative = np.maximum(2 * np.pi / WAVEVECTORS / longest, 1.0)
    rise = np.minimum(relative, max(rolloff / longest, 1.0)) ** -np.clip(slope, STEEPEST, 0.0)
    return np.asarray(density * rise)


def levelled_share(wavevector: Floats, size: float, kind: str) -> Floats:
    """Return the share of the variance of random waves (q,) that levelling leaves in a scan.

    Waves have all directions and phases, a scan has a size in nm. Levelling removes the squares of
    the projections on 1, sqrt(12) x/L and, of a map, sqrt(12) y/L, in closed form.
    """
    angle = (np.arange(DIRECTIONS) + 0.5) * np.pi / 2 / DIRECTIONS
    half = np.maximum(wavevector[:, None] * size / 2, 1e-3)
    mean_x, slope_x = _projections(half * np.cos(angle))
    if kind == "profile":
        return np.asarray((1 - mean_x - slope_x).mean(axis=1))
    mean_y, slope_y = _projections(half * np.sin(angle))
    removed = mean_x * mean_y + slope_x * mean_y + mean_x * slope_y
    return np.asarray((1 - removed).mean(axis=1))


def _projections(half: Floats) -> tuple[Floats, Floats]:
    """Return the squared projections of exp(2iau), |u| <= 1/2, on 1 and sqrt(12) u."""
    slope = np.sqrt(3) * (np.sin(half) - half * np.cos(half)) / half**2
    return (np.sin(half) / half) ** 2, slope**2


class LongWaves:
    """The farthest-reaching scans of a surface, and the evidence of their rms height."""

    def __init__(
        self, scans: Sequence[Measurement], densities: Floats, bands: Sequence[ReliableBand]
    ) -> None:
        """Take all scans of a surface, their `measured_psd` (scan, bins) in nm⁴ and their bands."""
        longest = max(band.longest for band in bands)
        widest = [number for number, band in enumerate(bands) if band.longest == longest]
        self.kind = scans[widest[0]].kind
        self.size = size_of(scans[widest[0]])
        self.count = len(widest)
        heights = [np.asarray(levelled_topography(scans[number]).heights()) for number in widest]
        #: The mean variance of the levelled heights in nm².
        self.variance = float(np.mean([float(values.var()) for values in heights]))
        self._density = np.nan_to_num(densities[widest]).mean(axis=0)
        shortest = min(bands[number].shortest for number in widest)
        self._unreliable = 2 * np.pi / BIN_CENTRES < shortest
        self._share = levelled_share(WAVEVECTORS, self.size, self.kind)

    def rolloff(self, density: Floats, longest: float, slope: float, probability: float) -> float:
        """Return the roll-off wavelength in nm that is not exceeded with a probability.

        The density is C_iso (nm⁴) on WAVEVECTORS, constant above the longest wavelength measured
        (nm), where d ln C/d ln q is the slope. All roll-offs from there to MAX_ROLLOFF times the
        scan are equally likely beforehand in their logarithm.
        """
        if slope >= 0:
            return longest
        rolloffs = np.geomspace(
            longest, max(MAX_ROLLOFF * self.size, 1.01 * longest), ROLLOFF_COUNT
        )
        likelihood = np.array(
            [
                self._log_likelihood(with_rolloff(density, longest, slope, rolloff))
                for rolloff in rolloffs
            ]
        )
        posterior = np.exp(likelihood - likelihood.max())
        cumulative = (np.cumsum(posterior) - posterior / 2) / posterior.sum()
        return float(np.exp(np.interp(probability, cumulative, np.log(rolloffs))))

    def _log_likelihood(self, density: Floats) -> float:
        """Return the logarithm of the likelihood of the variance, less a constant."""
        from scipy.special import gammaln

        # The power of each of N independent waves is distributed exponentially: theirs is a gamma
        # variable of the relative variance 1/N. N per ln q is q²L²/4π in a map and qL/2π along a
        # line, and 1 for waves longer than the scan, which are a bow.
        waves = WAVEVECTORS * self.size / (2 * np.pi)
        number = np.maximum(waves if self.kind == "profile" else np.pi * waves**2, 1)
        power = density * WAVEVECTORS**2 * self._share / (2 * np.pi)
        # Heights that are not of the surface, at wavelengths too short to be reliable, are added.
        excess = self._density - np.interp(BIN_CENTRES, WAVEVECTORS, density)
        noise = (
            (np.maximum(excess, 0) * BIN_CENTRES**2)[self._unreliable].sum()
            * BIN_WIDTH
            / (2 * np.pi)
        )
        expected_variance = np.trapezoid(power, LOG_WAVEVECTORS) + noise
        shape = expected_variance**2 / np.trapezoid(power**2 / number, LOG_WAVEVECTORS) * self.count
        scale = expected_variance / shape
        ratio = self.variance / scale
        return float((shape - 1) * np.log(ratio) - ratio - gammaln(shape) - np.log(scale))
