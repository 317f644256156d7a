"""The wavelengths at which a measurement shows the surface and not the microscope.

Toward short wavelengths it ends at four pixels, at the cutoff of the tip (Sanner et al., Appl.
Surf. Sci. Adv. 7 (2022) 100190), at a noise floor or at smoothing, whichever comes first: C_iso is
flatter than q^-2 (H = 0) or steeper than a rough surface has. Surfaces with facets have down to
q^-5; between q^-4 (H = 1) and q^-5 C_1D must be alike along both axes, because a lagging feedback
smooths along the scanned lines alone. Beside a peak, as of a grating, slopes tell neither.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.printing import print_length
from hardcontact.surfaces.measured_spectrum import (
    axis_ratio,
    independent_waves,
    levelled_topography,
    local_slopes,
    measured_psd,
    size_of,
    variance_of_log,
)
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import BIN_CENTRES, HALF_DECADE, Floats

#: The shortest wavelength in pixels, and the part of the size that is the longest: of longer waves
#: there are few, and levelling and the window change them (of self-affine surfaces without roll-off
#: C_iso is 1.2 times too large at a third of the size, and 2 times at half of it).
PIXELS = 4
PARTS = 3
#: Slopes of C_iso: the flattest and the steepest of a self-affine surface, that of facets.
FLATTEST, SELF_AFFINE, FACETS = -2.0, -4.0, -5.0
#: Standard errors by which a slope passes one of these before it says anything.
ERRORS = 2
#: C_1D along both axes of a map differ by no more than this factor where C_iso is steep.
ALIKE = 2.0
#: Bins above a noise floor that still hold much of it: C ~ q^-3 is four times as high two bins on.
MARGIN = 2
#: Factor, and standard errors, by which C_iso rises toward short wavelengths to a peak.
PEAK, PEAK_ERRORS = 2.0, 4
#: Relative error of the tip's cutoff, far below the safety factor of the criterion.
TOLERANCE = 1e-3
#: What ends a band toward short wavelengths, in words for messages.
LIMITS = {
    "pixels": f"{PIXELS} pixels",
    "tip": "the tip",
    "noise": "a noise floor",
    "smoothing": "smoothing by the microscope",
}


class ReliableBand(NamedTuple):
    """The reliable wavelengths (nm) of a measurement; empty if shortest exceeds longest."""

    shortest: float
    longest: float
    limited_by: str  #: What ends the band toward short wavelengths, one of LIMITS.

    @property
    def bins(self) -> NDArray[np.bool_]:
        """Which bins (bins,) of a measured spectrum lie in the band."""
        wavelength = 2 * np.pi / BIN_CENTRES
        return (self.shortest <= wavelength) & (wavelength <= self.longest)

    def __str__(self) -> str:
        """Print both ends with their reasons."""
        if self.shortest > self.longest:
            return (
                f"at no wavelength: {LIMITS[self.limited_by]} at {print_length(self.shortest)}, "
                f"a third of the size at {print_length(self.longest)}"
            )
        return (
            f"from {print_length(self.shortest)} ({LIMITS[self.limited_by]}) "
            f"to {print_length(self.longest)} (a third of the size)"
        )


def reliable_band(
    measurement: Measurement, tip_radius: float | None, density: Floats | None = None
) -> ReliableBand:
    """Return the reliable wavelengths of a measurement, with their limits.

    The radius of the tip is in nm, or None if it is not known. The density is the result of
    `measured_psd`, if the caller has it.
    """
    if density is None:
        _, density = measured_psd(measurement)
    pixels = PIXELS * measurement.pixel_size, "pixels"
    shortest, limit = max([pixels, *_spectral_ends(measurement, density)])
    band = ReliableBand(shortest, size_of(measurement) / PARTS, limit)
    return band if tip_radius is None else with_tip(band, measurement, tip_radius)


def with_tip(band: ReliableBand, measurement: Measurement, tip_radius: float) -> ReliableBand:
    """Return a band of a measurement that ends where a tip of a radius in nm hides the surface."""
    cutoff = levelled_topography(measurement).scanning_probe_reliability_cutoff(
        tip_radius, rtol=TOLERANCE
    )
    if cutoff is None or cutoff <= band.shortest:
        return band
    return band._replace(shortest=float(cutoff), limited_by="tip")


def _spectral_ends(measurement: Measurement, density: Floats) -> list[tuple[float, str]]:
    """Return the wavelengths (nm) of noise and smoothing in a spectrum, with LIMITS."""
    mask = np.isfinite(density) & (BIN_CENTRES * PIXELS * measurement.pixel_size <= 2 * np.pi)
    q, variance = BIN_CENTRES[mask], variance_of_log(independent_waves(measurement)[mask])
    slope, error = local_slopes(q, density[mask], variance)
    differs = axis_ratio(measurement)[mask] > ALIKE
    smoothed = slope + ERRORS * error < np.where(differs, SELF_AFFINE, FACETS)
    flat = slope - ERRORS * error > FLATTEST
    beside_peak = _beside_peaks(np.log(density[mask]), variance)
    smoothed, flat = smoothed & ~beside_peak, flat & ~beside_peak

    unsmoothed = _without_smoothed(smoothed, len(q))
    risen = _without_floor(flat, unsmoothed)
    end = _without_smoothed(smoothed, risen)
    ends = []
    if risen < unsmoothed:
        ends.append((_end(q, risen), "noise"))
    if end < risen or unsmoothed < len(q) and risen == unsmoothed:
        ends.append((_end(q, end), "smoothing"))
    return ends


def _beside_peaks(log_density: Floats, variance: Floats) -> NDArray[np.bool_]:
    """Return which bins lie within half a decade of a peak of the spectrum."""
    place = np.arange(len(log_density))
    distance = place - place[:, None]
    rise = log_density - log_density[:, None]
    error = np.sqrt(variance + variance[:, None])
    risen = (rise > np.log(PEAK)) & (rise > PEAK_ERRORS * error)
    peaks = (risen & (0 < distance) & (distance <= HALF_DECADE)).any(axis=0)
    return np.asarray((peaks & (np.abs(distance) <= HALF_DECADE)).any(axis=1))


def _without_smoothed(smoothed: NDArray[np.bool_], count: int) -> int:
    """Count the first bins, of `count`, whose last half decade is not smoothed."""
    # Where smoothing turns into noise the slope passes through that of a rough surface.
    while smoothed[max(count - HALF_DECADE, 0) : count].any():
        first = max(count - HALF_DECADE, 0)
        count = first + int(np.argmax(smoothed[first:count]))
    return count


def _without_floor(flat: NDArray[np.bool_], count: int) -> int:
    """Count the first bins, of `count`, without a floor at their end."""
    kept_bins = count
    while kept_bins and flat[kept_bins - 1]:
        kept_bins -= 1
    return kept_bins if kept_bins == count else max(kept_bins - MARGIN, 0)


def _end(wavevector: Floats, count: int) -> float:
    """Return the wavelength in nm between the first `count` bins and the others."""
    if count == 0:
        return float(2 * np.pi / wavevector[0])
    return float(2 * np.pi / np.sqrt(wavevector[count - 1] * wavevector[count]))
