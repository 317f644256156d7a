"""One spectrum of a surface from all its measurements: maps of several sizes, line scans."""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.surfaces.extrapolated_spectrum import (
    LongWaves,
    Tail,
    continued_spectrum,
    has_exponent,
    with_rolloff,
)
from hardcontact.surfaces.hurst_exponent import HurstFit, fitted_hurst
from hardcontact.surfaces.mean_spectrum import (
    Curve,
    MeanBins,
    line_bins,
    mean_bins,
    smoothed_without_lines,
    with_power,
)
from hardcontact.surfaces.measured_spectrum import (
    CALIBRATION,
    independent_waves,
    local_slopes,
    measured_psd,
)
from hardcontact.surfaces.reliable_band import ReliableBand, reliable_band, with_tip
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    MIN_BINS,
    WAVEVECTORS,
    Floats,
    Spectrum,
    spectrum_dataset,
)
from hardcontact.surfaces.spectrum_datasets import measurement_descriptions, with_measurements

#: Radii in nm of tips that are not known: from new ones to blunt ones.
TIPS = (5.0, 50.0)


class _MeasuredSpectra(NamedTuple):
    """The measurements of a surface, with their spectra and reliable bands."""

    radii: Sequence[float | None]  #: Of their tips in nm, where they are known.
    densities: Floats  #: (measurement, bins) C_iso in nm⁴, NaN in empty bins.
    waves: Floats  #: (measurement, bins) independent ones.
    bands: Sequence[ReliableBand]
    long_waves: LongWaves

    def reliable(self, bands: Sequence[ReliableBand]) -> NDArray[np.bool_]:
        """Return a mask (measurement, bins) of the bins that are measured within given bands."""
        return np.array([band.bins for band in bands]) & np.isfinite(self.densities)


def _measured_spectra(
    measurements: Sequence[Measurement], tip_radii: Sequence[float | None]
) -> _MeasuredSpectra:
    """Return the spectra of measurements; raises ValueError for fewer than three reliable bins."""
    radii = [
        measurement.tip_radius if radius is None else radius
        for measurement, radius in zip(measurements, tip_radii, strict=True)
    ]
    densities = np.array([measured_psd(measurement)[1] for measurement in measurements])
    bands = [
        reliable_band(*arguments) for arguments in zip(measurements, radii, densities, strict=True)
    ]
    waves = np.array([independent_waves(measurement) for measurement in measurements])
    spectra = _MeasuredSpectra(
        radii, densities, waves, bands, LongWaves(measurements, densities, bands)
    )
    count = int(spectra.reliable(bands).any(axis=0).sum())
    if count < MIN_BINS:
        listing = "; ".join(
            f"{measurement.path} {measurement.dataset}".strip() + f" {band}"
            for measurement, band in zip(measurements, bands, strict=True)
        )
        raise ValueError(
            f"expected measurements that are reliable in at least {MIN_BINS} bins of wavelengths "
            f"(ten a decade from 0.1 nm to 100 µm), found {count}: {listing}"
        )
    return spectra


def joined_spectrum(
    measurements: Sequence[Measurement], tip_radii: Sequence[float | None]
) -> xr.Dataset:
    """Return the spectrum of a surface, joined of its measurements within their reliable bands.

    Parameters
    ----------
    measurements : sequence of Measurement
        Levelled maps and line scans.
    tip_radii : sequence of float or None
        In nm, by measurement; None to use the radius that its file states, if any.

    Returns
    -------
    xarray.Dataset
        `spectrum` (wavevector) in nm⁴ over all scales; `joined` (bin_wavevector) in nm⁴, the mean
        logarithm of the reliable densities, weighted by independent waves, freed of the bias of the
        logarithm and smoothed where waves are few, NaN in other bins; `psd` and `reliable`
        (measurement, bin_wavevector), and properties of each measurement.

    Raises
    ------
    ValueError
        If fewer than three bins of wavelengths are reliable, in one line.
    """
    measured = _measured_spectra(measurements, tip_radii)
    reliable = measured.reliable(measured.bands)
    bins = mean_bins(reliable, measured.densities, measured.waves)
    lines = line_bins(bins)
    curve = with_power(smoothed_without_lines(bins, lines), bins.power)
    density = Spectrum(curve.wavevector, curve.density)(BIN_CENTRES)
    joined = np.where(reliable.any(axis=0), density, np.nan)
    hurst = _hurst_without_lines(bins, lines)
    spectrum, tail, rolloff = _continued(curve, hurst, measured.long_waves)
    used_bands = [band for band, used in zip(measured.bands, reliable, strict=True) if used.any()]
    has_edges = any("edges" in measurement.defects for measurement in measurements)
    return with_measurements(
        spectrum_dataset(spectrum),
        joined,
        measured.densities,
        reliable,
        measurement_descriptions(measurements, measured.radii, measured.bands),
    ).assign_attrs(
        basis="measured",
        calibrated_to_table1="",
        shortest_measured=min(band.shortest for band in used_bands),
        longest_measured=max(band.longest for band in used_bands),
        rolloff=rolloff,
        tail_known=int(has_exponent(tail) and not has_edges),
        **tail._asdict(),
    )


def drawn_spectra(
    rngs: Iterable[np.random.Generator],
    measurements: Sequence[Measurement],
    tip_radii: Sequence[float | None],
) -> Iterator[tuple[Spectrum, Floats]]:
    """Draw spectra of a surface within the uncertainty of its measurements, one by each generator.

    Measurements and radii are the arguments of `joined_spectrum`. Random are the power of the few
    waves in each bin and the bends between them; the calibrations; the radii of tips that are not
    known, uniform in their logarithm within TIPS; the Hurst exponent of the tail; and the roll-off.
    Yields each spectrum with the factors (measurement,) by which it takes heights to be wrong.
    """
    measured = _measured_spectra(measurements, tip_radii)
    for rng in rngs:
        bands = [
            band
            if radius is not None or measurement.kind != "map"
            else with_tip(band, measurement, float(np.exp(rng.uniform(*np.log(TIPS)))))
            for measurement, radius, band in zip(
                measurements, measured.radii, measured.bands, strict=True
            )
        ]
        reliable = measured.reliable(bands)
        if reliable.any(axis=0).sum() < MIN_BINS:
            reliable = measured.reliable(measured.bands)
        calibration = CALIBRATION * rng.standard_normal(len(bands))
        common = calibration.mean()
        densities = measured.densities * np.exp(calibration - common)[:, None]
        bins = mean_bins(reliable, densities, measured.waves)
        lines = line_bins(bins)
        curve = smoothed_without_lines(bins, lines, rng)
        hurst = _hurst_without_lines(bins, lines)
        change = hurst.error * rng.standard_normal()
        spectrum, *_ = _continued(curve, hurst, measured.long_waves, rng.uniform(), change)
        yield Spectrum(WAVEVECTORS, spectrum * np.exp(common)), np.exp(calibration / 2)


def _hurst_without_lines(bins: MeanBins, lines: NDArray[np.bool_]) -> HurstFit:
    """Return the Hurst exponent of the bins without lines."""
    fitted = np.isfinite(bins.density) & ~lines
    return fitted_hurst(BIN_CENTRES[fitted], bins.density[fitted], bins.variance[fitted])


def _continued(
    curve: Curve,
    hurst: HurstFit,
    long_waves: LongWaves,
    probability: float = 0.5,
    hurst_change: float = 0.0,
) -> tuple[Floats, Tail, float]:
    """Return C_iso (nm⁴) extrapolated from a curve to WAVEVECTORS, its tail and roll-off in nm."""
    density, tail = continued_spectrum(curve.wavevector, curve.density, hurst, hurst_change)
    slopes, _ = local_slopes(*curve)
    slope, longest = float(slopes[0]), float(2 * np.pi / curve.wavevector[0])
    rolloff = long_waves.rolloff(density, longest, slope, probability)
    return with_rolloff(density, longest, slope, rolloff), tail, rolloff
