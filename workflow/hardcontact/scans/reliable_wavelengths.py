"""The reliable wavelengths of a scan, which show the surface.

Toward long wavelengths they end at a third of the size. Toward short wavelengths they end at the
longest of these: four pixels, the cutoff of the tip (Sanner et al., Appl. Surf. Sci. Adv. 7 (2022)
100190), a noise floor, or smoothing by the microscope.

- A noise floor is flatter than q^-2 (H = 0).
- Smoothing is steeper than q^-5, the limit for surfaces with facets. If C_1D differs between the
  axes, the limit is q^-4 (H = 1), because a lagging feedback smooths along scan lines alone.
- Slopes near a peak, such as a grating's, prove neither.
"""

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_length
from hardcontact.scans.measured_spectrum import (
    axis_ratio,
    independent_modes,
    local_slopes,
    variance_of_log,
)
from hardcontact.surfaces.height_map import HeightMap, to_surface_topography
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectrum import BIN_CENTRES, HALF_DECADE_BINS

#: The shortest reliable wavelength in pixels.
MIN_PIXELS = 4
#: The ratio of the size to the longest reliable wavelength: levelling and the window change longer
#: waves. Without a roll-off C_iso is 1.2 times too large at a third of the size, 2 times at half.
MIN_WAVES_IN_SIZE = 3
#: Slopes of C_iso: the flattest and the steepest of self-affine surfaces, the steepest of facets.
FLATTEST_SLOPE = -2.0
STEEPEST_SELF_AFFINE_SLOPE = -4.0
STEEPEST_FACET_SLOPE = -5.0
#: Standard errors by which a slope must exceed one of these limits.
MIN_STANDARD_ERRORS = 2
#: Largest ratio of C_1D along both axes of a map that shows no smoothing.
MAX_AXIS_RATIO = 2.0
#: Bins before a noise floor that also hold much noise: C ~ q^-3 falls fourfold in two bins.
NOISE_MARGIN_BINS = 2
#: Least factor, and number of standard errors, by which C_iso rises toward short waves at a peak.
MIN_PEAK_RISE = 2.0
MIN_PEAK_ERRORS = 4
#: Relative error of the tip's cutoff, far below the safety factor of its criterion.
TIP_CUTOFF_ERROR = 1e-3
#: Code of a limit: at shorter wavelengths the other body of a contact is rougher.
OTHER_BODY = "other_body"
#: Limits of reliable wavelengths toward short wavelengths, by code, in words for messages.
LIMIT_NAMES = {
    "pixels": f"{MIN_PIXELS} pixels",
    "tip": "the tip",
    "noise": "a noise floor",
    "smoothing": "smoothing by the microscope",
    OTHER_BODY: "the other body, which is rougher",
}


class ReliableWavelengths(NamedTuple):
    """The reliable wavelengths (nm) of a scan; empty if shortest exceeds longest."""

    shortest: float
    longest: float
    limited_by: str  #: Limit at short wavelengths, a code of LIMIT_NAMES.

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Mask (bins,) of the bins of a measured spectrum at these wavelengths."""
        wavelength = 2 * np.pi / BIN_CENTRES
        return (self.shortest <= wavelength) & (wavelength <= self.longest)

    def limit_by_tip(self, scan: HeightMap, tip_radius: float) -> Self:
        """Return the reliable wavelengths that end at the cutoff of a tip, if that is longer."""
        topography = to_surface_topography(level_plane(scan))
        cutoff = topography.scanning_probe_reliability_cutoff(tip_radius, rtol=TIP_CUTOFF_ERROR)
        if cutoff is None or cutoff <= self.shortest:
            return self
        return self._replace(shortest=float(cutoff), limited_by="tip")

    def __str__(self) -> str:
        """Return both ends with their limits, in words."""
        limit = LIMIT_NAMES[self.limited_by]
        shortest, longest = format_length(self.shortest), format_length(self.longest)
        if self.shortest > self.longest:
            return f"at no wavelength: {limit} at {shortest}, a third of the size at {longest}"
        return f"from {shortest} ({limit}) to {longest} (a third of the size)"


def reliable_wavelengths(
    scan: HeightMap, tip_radius: float | None, density: Floats
) -> ReliableWavelengths:
    """Return the reliable wavelengths of a scan with C_iso `density` (bins,) in nm⁴."""
    ends = [(MIN_PIXELS * scan.pixel_size, "pixels"), *_spectral_ends(scan, density)]
    shortest, limit = max(ends)
    waves = ReliableWavelengths(shortest, scan.size / MIN_WAVES_IN_SIZE, limited_by=limit)
    return waves if tip_radius is None else waves.limit_by_tip(scan, tip_radius)


def _spectral_ends(scan: HeightMap, density: Floats) -> list[tuple[float, str]]:
    """Return the wavelengths (nm) below which noise or smoothing dominates, with their codes.

    Bins count from long to short waves. Noise and smoothing are sought at their end, because above
    its roll-off a rough surface is flat, too. One may hide the other, so there are three passes,
    each over the bins that the former left: smoothing; a noise floor; and smoothing at longer waves
    than the floor, which comes to the end once the floor is cut off.
    """
    is_resolved = np.isfinite(density) & (BIN_CENTRES * MIN_PIXELS * scan.pixel_size <= 2 * np.pi)
    q = BIN_CENTRES[is_resolved]
    is_smoothed, is_flat = _find_smoothed_and_flat_bins(scan, density, is_resolved)
    unsmoothed_count = _count_unsmoothed(is_smoothed, len(q))
    above_floor_count = _count_above_floor(is_flat, unsmoothed_count)
    reliable_count = _count_unsmoothed(is_smoothed, above_floor_count)
    has_floor = above_floor_count < unsmoothed_count
    ends = []
    if has_floor:
        ends.append((_end_wavelength(q, above_floor_count), "noise"))
    if reliable_count < (above_floor_count if has_floor else len(q)):
        ends.append((_end_wavelength(q, reliable_count), "smoothing"))
    return ends


def _find_smoothed_and_flat_bins(
    scan: HeightMap, density: Floats, is_resolved: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return the masks (resolved bins,) of slopes that are too steep, or too flat, for a surface.

    A slope must exceed its limit by MIN_STANDARD_ERRORS. Slopes near a peak do not count.
    """
    variance = variance_of_log(independent_modes(scan.kind, scan.size)[is_resolved])
    slope, error = local_slopes(BIN_CENTRES[is_resolved], density[is_resolved], variance)
    axes_differ = axis_ratio(scan)[is_resolved] > MAX_AXIS_RATIO
    steepest_slope = np.where(axes_differ, STEEPEST_SELF_AFFINE_SLOPE, STEEPEST_FACET_SLOPE)
    is_smoothed = slope + MIN_STANDARD_ERRORS * error < steepest_slope
    is_flat = slope - MIN_STANDARD_ERRORS * error > FLATTEST_SLOPE
    is_far_from_peaks = ~_find_bins_near_peaks(np.log(density[is_resolved]), variance)
    return is_smoothed & is_far_from_peaks, is_flat & is_far_from_peaks


def _find_bins_near_peaks(log_density: Floats, variance: Floats) -> NDArray[np.bool_]:
    """Return the mask (bins,) of bins within half a decade of a peak.

    The spectrum of a rough surface falls toward short waves. So a bin holds a peak if C_iso rises
    to it, clearly and from a bin at most half a decade before. Entry [i, j] of each matrix compares
    bin j with bin i; for i < j bin i has the longer waves.
    """
    index = np.arange(len(log_density))
    distance = index - index[:, None]
    rise = log_density - log_density[:, None]
    error = np.sqrt(variance + variance[:, None])
    is_rise = (rise > np.log(MIN_PEAK_RISE)) & (rise > MIN_PEAK_ERRORS * error)
    is_peak = (is_rise & (0 < distance) & (distance <= HALF_DECADE_BINS)).any(axis=0)
    return np.asarray((is_peak & (np.abs(distance) <= HALF_DECADE_BINS)).any(axis=1))


def _count_unsmoothed(is_smoothed: NDArray[np.bool_], count: int) -> int:
    """Count the leading bins, at most `count`, whose last half decade shows no smoothing.

    The last bins may look like a rough surface, because the slope turns from steep to flat where
    noise passes the smoothed waves. So any smoothed bin in the last half decade cuts off all bins
    from it on. With x for smoothed bins, ".......xxxx..." is cut to ".......".
    """
    while is_smoothed[max(count - HALF_DECADE_BINS, 0) : count].any():
        start = max(count - HALF_DECADE_BINS, 0)
        count = start + int(np.argmax(is_smoothed[start:count]))
    return count


def _count_above_floor(is_flat: NDArray[np.bool_], count: int) -> int:
    """Count the leading bins, at most `count`, that do not end in a noise floor.

    Before a floor, NOISE_MARGIN_BINS are cut off, too.
    """
    kept_count = count
    while kept_count and is_flat[kept_count - 1]:
        kept_count -= 1
    return kept_count if kept_count == count else max(kept_count - NOISE_MARGIN_BINS, 0)


def _end_wavelength(wavevector: Floats, count: int) -> float:
    """Return the wavelength (nm) at the end of `count` leading bins; of the first bin for 0."""
    if count == 0:
        return float(2 * np.pi / wavevector[0])
    return float(2 * np.pi / np.sqrt(wavevector[count - 1] * wavevector[count]))
