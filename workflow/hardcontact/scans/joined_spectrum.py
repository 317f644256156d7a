"""One spectrum of a surface from all scans of it: maps of several sizes, and line scans.

Bins are equally wide in ln q. `joined_spectrum` finds one C_iso in each bin, in six steps:

1. Each scan has its C_iso, its number of modes and its reliable bins (`_measured_spectra`).
2. In each bin the reliable C_iso of all scans are averaged twice. The mean of ln C is for the
   curve, because its scatter is known. The mean of C has the variance of heights (`_mean_bins`).
3. Bins with more power than chance gives to a smooth spectrum hold peaks (`_find_peaks`).
4. A smooth curve through the means of ln C, without peaks, bridges gaps (`smooth_curve`). Peaks
   get their mean of C (`_restore_peaks`).
5. The curve changes a little, so that its variance of heights is that of the means of C
   (`_match_height_variance`).
6. The curve is extrapolated to all scales (`_extrapolate_curve`).

`sample_spectra` repeats steps 2 to 4 and 6 with random errors, which show how far C_iso is known.

Arrays called `density` hold C_iso in nm⁴; in datasets ``spectrum``, ``psd`` and ``joined_psd`` do.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.scans.extrapolation import (
    HurstFit,
    RolloffEvidence,
    Tail,
    extrapolate_long_waves,
    extrapolate_short_waves,
    fit_hurst_exponent,
    is_tail_known,
)
from hardcontact.scans.measured_spectrum import (
    CALIBRATION_SCATTER,
    bias_of_log,
    independent_modes,
    isotropic_psd,
    local_slopes,
    variance_of_log,
)
from hardcontact.scans.reliable_wavelengths import ReliableWavelengths, reliable_wavelengths
from hardcontact.scans.spectrum_datasets import add_measurements, scan_properties
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    BIN_WIDTH,
    MIN_BINS,
    WAVEVECTORS,
    Spectrum,
    spectrum_dataset,
    spectrum_of_dataset,
    too_few_bins_message,
)

#: Shortest and longest radius in nm of an unknown tip: a new tip, a blunt tip.
UNKNOWN_TIP_RADII = (5.0, 50.0)
#: Standard deviation of the change of the slope d ln C/d ln q over a decade. A roll-off changes the
#: slope by 2 + 2H, some 3.6, once in three measured decades: 3.6/sqrt(3) is about 2.
SLOPE_CHANGE = 2.0
#: The same from one bin to the next: the changes over a decade are independent.
BEND_STD = SLOPE_CHANGE * np.sqrt(BIN_WIDTH / np.log(10))
#: A bin holds a peak, such as a grating's, if chance gives so much power with less than this
#: probability. Among 60 bins, one in 170 spectra has a false peak.
PEAK_PROBABILITY = 1e-4
#: Bound of the search in `_match_height_variance`: no ln C changes so much.
MAX_LOG_CHANGE = 20.0


class _MeanBins(NamedTuple):
    """The mean of all scans in each bin; NaN in bins in which no scan is reliable."""

    density: Floats  #: (bins,) C_iso in nm⁴ from the mean of ln C, without its bias.
    mode_variance: Floats  #: (bins,) variance of ln C, because modes are few.
    arithmetic_mean: Floats  #: (bins,) C_iso in nm⁴, the mean of C itself.
    is_peak: NDArray[np.bool_]  #: (bins,) True where a grating, for example, adds power.

    @property
    def density_between_peaks(self) -> Floats:
        """C_iso in nm⁴ from the mean of ln C, NaN at peaks, too."""
        return np.where(self.is_peak, np.nan, self.density)


class _Curve(NamedTuple):
    """A spectrum at the centres of the bins, from the lowest to the highest measured bin."""

    wavevector: Floats  #: rad/nm.
    density: Floats  #: C_iso in nm⁴.
    total_variance: Floats  #: Variance of ln C: that of the smooth curve plus the calibration's.


def _mean_bins(reliable: NDArray[np.bool_], density: Floats, modes: Floats) -> _MeanBins:
    """Return the mean over scans of their reliable C_iso (scan, bins) in nm⁴.

    The mean of ln C serves the smooth curve, because the scatter of ln C depends on the number of
    modes alone. The arithmetic mean of C keeps the variance of heights. In each bin a scan has the
    weight 1/variance of its ln C: the more modes it has there, the smaller is the mode variance,
    but the variance of its calibration remains.
    """
    scan_mode_variance = variance_of_log(modes)
    weight = np.where(reliable, 1 / (scan_mode_variance + CALIBRATION_SCATTER**2), 0.0)
    log_density = np.where(reliable, np.log(density) + bias_of_log(modes), 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = weight / weight.sum(axis=0)
    mode_variance = (weight**2 * scan_mode_variance).sum(axis=0)
    arithmetic_mean = (weight * np.where(reliable, density, 0.0)).sum(axis=0)
    mean_density = np.exp((weight * log_density).sum(axis=0))
    is_peak = _find_peaks(mean_density, mode_variance, arithmetic_mean)
    return _MeanBins(mean_density, mode_variance, arithmetic_mean, is_peak)


def _find_peaks(
    density: Floats, mode_variance: Floats, arithmetic_mean: Floats
) -> NDArray[np.bool_]:
    """Return the mask (bins,) of peaks: more power than a smooth spectrum has by chance.

    A smooth curve through `density` gives the mean that each bin should have. A mean over n modes,
    relative to the mean that it should have, is a gamma variable of shape n and mean one. With the
    probability PEAK_PROBABILITY one mode exceeds it 9.2 times, the mean over ten modes 2.6 times.
    A peak also lifts the curve, which hides others. So each round leaves out the peaks found so
    far, until a round finds none.
    """
    inner = np.flatnonzero(np.isfinite(density))[1:-1]  # The curve must reach both end bins.
    modes = 1 / mode_variance[inner] + 0.5  # inverts the variance, trigamma(n) ≈ 1/(n - 0.5)
    is_peak = np.zeros(len(density), bool)
    while True:
        curve = smooth_curve(np.where(is_peak, np.nan, density), mode_variance)
        smooth_density = Spectrum(curve.wavevector, curve.density)(BIN_CENTRES[inner])
        gamma_variable = modes * arithmetic_mean[inner] / smooth_density
        probability = scipy.special.gammaincc(modes, gamma_variable)
        new_peaks = inner[(probability < PEAK_PROBABILITY) & ~is_peak[inner]]
        if not len(new_peaks):
            return is_peak
        is_peak[new_peaks] = True


def smooth_curve(density: Floats, mode_variance: Floats) -> _Curve:
    """Return a smooth curve through bins and across gaps.

    C_iso (bins,) is NaN in gaps. The curve f should lie near ln C, but bend little. A bend is the
    change of the slope df/d ln q from one bin to the next, and has the standard deviation BEND_STD.
    With weight = 1/mode_variance, or 0 in gaps, f minimizes

        sum(weight * (ln C - f)²) + sum((scaled_bends @ f)²),

    so that f = covariance @ (weight * ln C). In eleven bins of one mode each, ln C scatters by 1.3,
    the curve in the middle by 0.5.
    """
    span, weight, covariance = _curve_posterior(density, mode_variance)
    log_density = np.log(np.where(weight > 0, density[span], 1.0))
    return _curve_of(span, covariance @ (weight * log_density), covariance)


def sample_curve(rng: np.random.Generator, density: Floats, mode_variance: Floats) -> _Curve:
    """Return a random curve that the bins permit as well as `smooth_curve`.

    In the words of Bayes, bends are independent and normal: the slope is a Wiener process. Then
    the smooth curve is the posterior mean, `covariance` its covariance, and the random curve is a
    sample of the posterior (Wahba, J. R. Stat. Soc. B 40 (1978) 364).
    """
    span, weight, covariance = _curve_posterior(density, mode_variance)
    # The prior curve has random bends. Noisy values of it differ from the measured ln C. The smooth
    # curve through the differences, added to the prior curve, gives the sample.
    prior_curve = BIN_WIDTH * np.cumsum(np.cumsum(BEND_STD * rng.standard_normal(len(weight))))
    noise_std = np.where(weight > 0, np.sqrt(mode_variance[span]), 0.0)
    log_density = np.log(np.where(weight > 0, density[span], 1.0))
    differences = log_density - prior_curve - noise_std * rng.standard_normal(len(weight))
    return _curve_of(span, prior_curve + covariance @ (weight * differences), covariance)


def _curve_posterior(density: Floats, mode_variance: Floats) -> tuple[slice, Floats, Floats]:
    """Return the span of measured bins, and the weights and the covariance of `smooth_curve`."""
    finite = np.flatnonzero(np.isfinite(density))
    span = slice(finite[0], finite[-1] + 1)
    weight = np.where(np.isfinite(density), 1 / mode_variance, 0.0)[span]
    # A matrix (count - 2, count): its product with a curve is the bends over BEND_STD.
    scaled_bends = np.diff(np.eye(len(weight)), n=2, axis=0) / (BIN_WIDTH * BEND_STD)
    return span, weight, np.linalg.inv(np.diag(weight) + scaled_bends.T @ scaled_bends)


def _curve_of(span: slice, log_curve: Floats, covariance: Floats) -> _Curve:
    """Return the curve exp(log_curve) at the bins of a span."""
    total_variance = np.diag(covariance) + CALIBRATION_SCATTER**2
    return _Curve(BIN_CENTRES[span], np.exp(log_curve), total_variance)


def _restore_peaks(curve: _Curve, mean_bins: _MeanBins) -> _Curve:
    """Return a curve with the power of peaks, through which it was not drawn."""
    is_in_curve = np.isin(BIN_CENTRES, curve.wavevector)
    is_peak = mean_bins.is_peak[is_in_curve]
    density = np.where(is_peak, mean_bins.arithmetic_mean[is_in_curve], curve.density)
    return curve._replace(density=density)


def _match_height_variance(curve: _Curve, arithmetic_mean: Floats) -> _Curve:
    """Return a curve whose variance of heights is that of the `arithmetic_mean` of C_iso.

    A smooth curve has the mean of ln C, but its C_iso need not have the measured mean. So ln C of
    each bin changes by multiplier * log_changes, where

        log_changes = variance of ln C * share of the bin in the variance of heights,

    and one multiplier serves all bins: uncertain bins with much power change most. The variance of
    the calibration is left out, because the calibration changes all bins of a scan alike. If errors
    of bins were independent and the change small, no curve with this variance of heights would be
    more likely. Gaps, in which the mean is NaN, neither count nor change.
    """
    mean_in_curve = arithmetic_mean[np.isin(BIN_CENTRES, curve.wavevector)]
    # Bins are equally wide in ln q, so the variance of heights is the sum of q² C_iso, up to a
    # factor.
    height_variance = np.nansum(mean_in_curve * curve.wavevector**2)
    variance_of_bins = curve.density * curve.wavevector**2
    share = np.where(np.isfinite(mean_in_curve), variance_of_bins / height_variance, 0.0)
    log_changes = (curve.total_variance - CALIBRATION_SCATTER**2) * share

    def relative_excess(multiplier: float) -> float:
        """Return the excess of the curve's variance of heights, relative to what it should be."""
        return float((share * np.exp(multiplier * log_changes)).sum() - 1)

    bound = MAX_LOG_CHANGE / log_changes.max()
    multiplier = scipy.optimize.brentq(relative_excess, -bound, bound)
    return curve._replace(density=curve.density * np.exp(multiplier * log_changes))


class _MeasuredSpectra(NamedTuple):
    """The spectra of the scans of a surface."""

    tip_radii: Sequence[float | None]  #: In nm, from the user or the file; None if unknown.
    densities: Floats  #: (scan, bins) C_iso in nm⁴, NaN in empty bins.
    modes: Floats  #: (scan, bins) numbers of independent modes.
    scan_waves: list[ReliableWavelengths]  #: The reliable ones of each scan.
    rolloff_evidence: RolloffEvidence


def _reliable_mask(densities: Floats, scan_waves: list[ReliableWavelengths]) -> NDArray[np.bool_]:
    """Return the mask (scan, bins) of nonempty bins at the reliable wavelengths of each scan."""
    return np.array([waves.mask for waves in scan_waves]) & np.isfinite(densities)


def _measured_spectra(
    scans: Sequence[HeightMap], given_tip_radii: Sequence[float | None]
) -> _MeasuredSpectra:
    """Return the spectra of scans; raises ValueError if fewer than MIN_BINS bins are reliable."""
    tip_radii = [
        scan.tip_radius if given_radius is None else given_radius
        for scan, given_radius in zip(scans, given_tip_radii, strict=True)
    ]
    densities = np.array([isotropic_psd(scan) for scan in scans])
    properties = zip(scans, tip_radii, densities, strict=True)
    scan_waves = [reliable_wavelengths(*row) for row in properties]
    modes = np.array([independent_modes(scan.kind, scan.size) for scan in scans])
    rolloff_evidence = RolloffEvidence(scans, densities, scan_waves)
    count = int(_reliable_mask(densities, scan_waves).any(axis=0).sum())
    if count < MIN_BINS:
        lines = [f"{scan.name} {waves}" for scan, waves in zip(scans, scan_waves, strict=True)]
        is_too_large = min(waves.shortest for waves in scan_waves) > 2 * np.pi / BIN_CENTRES[0]
        remedy = ": is the unit of length right?" if is_too_large else ""
        raise ValueError(too_few_bins_message("measurements", count, lines) + remedy)
    return _MeasuredSpectra(tip_radii, densities, modes, scan_waves, rolloff_evidence)


def joined_spectrum(scans: Sequence[HeightMap], tip_radii: Sequence[float | None]) -> xr.Dataset:
    """Return the spectrum of a surface, joined from levelled scans at their reliable wavelengths.

    In each bin the scans are averaged. A smooth curve then replaces the mean of each bin, except of
    peaks, bridges gaps and keeps the variance of heights. It is extrapolated to all scales.

    If a tip radius (nm) is None, the file may state one. ``spectrum`` (wavevector) has all scales;
    ``joined_psd`` (bin_wavevector) is NaN in unreliable bins. Raises ValueError, in one line, if
    fewer than MIN_BINS bins are reliable.
    """
    measured = _measured_spectra(scans, tip_radii)
    reliable = _reliable_mask(measured.densities, measured.scan_waves)
    mean_bins = _mean_bins(reliable, measured.densities, measured.modes)
    smooth = smooth_curve(mean_bins.density_between_peaks, mean_bins.mode_variance)
    curve = _restore_peaks(smooth, mean_bins)
    curve = _match_height_variance(curve, mean_bins.arithmetic_mean)
    curve_density = Spectrum(curve.wavevector, curve.density)(BIN_CENTRES)
    joined_density = np.where(reliable.any(axis=0), curve_density, np.nan)
    hurst_fit = _fit_hurst_without_peaks(mean_bins)
    density, tail, rolloff = _extrapolate_curve(curve, hurst_fit, measured.rolloff_evidence)
    pairs = zip(measured.scan_waves, reliable, strict=True)
    used_waves = [waves for waves, mask in pairs if mask.any()]
    return add_measurements(
        spectrum_dataset(density),
        joined_density,
        measured.densities,
        reliable,
        scan_properties(scans, measured.tip_radii, measured.scan_waves),
    ).assign_attrs(
        source="measured",
        table1_rows_met="",
        shortest_measured=min(waves.shortest for waves in used_waves),
        longest_measured=max(waves.longest for waves in used_waves),
        rolloff=rolloff,
        tail_known=int(is_tail_known(tail)),
        **tail._asdict(),
    )


def sample_spectra(
    rngs: Iterable[np.random.Generator],
    scans: Sequence[HeightMap],
    tip_radii: Sequence[float | None],
) -> Iterator[tuple[Spectrum, Floats]]:
    """Yield random spectra that the scans permit, and true relative to measured heights (scan,).

    Each `rng` draws in turn all that is uncertain: the radii of unknown tips, the calibration of
    each scan, the curve through the bins, the Hurst exponent of the tail, and the roll-off. Random
    curves do not keep the measured variance of heights, because few modes carry it: it is
    uncertain, too.
    """
    measured = _measured_spectra(scans, tip_radii)
    for rng in rngs:
        properties = zip(scans, measured.tip_radii, measured.scan_waves, strict=True)
        sampled_waves = [_sample_reliable_wavelengths(rng, *row) for row in properties]
        reliable = _reliable_mask(measured.densities, sampled_waves)
        # A blunt tip may leave too few bins: then the sampled tips limit no scan of this sample.
        if reliable.any(axis=0).sum() < MIN_BINS:
            reliable = _reliable_mask(measured.densities, measured.scan_waves)
        # Logarithms of true relative to measured C_iso (scan,).
        log_power_factors = CALIBRATION_SCATTER * rng.standard_normal(len(scans))
        # Their mean scales the whole spectrum, but only after the extrapolation, because the
        # evidence of the roll-off compares spectra with heights as measured.
        mean_log_factor = log_power_factors.mean()
        densities = measured.densities * np.exp(log_power_factors - mean_log_factor)[:, None]
        mean_bins = _mean_bins(reliable, densities, measured.modes)
        curve = sample_curve(rng, mean_bins.density_between_peaks, mean_bins.mode_variance)
        curve = _restore_peaks(curve, mean_bins)
        hurst_fit = _fit_hurst_without_peaks(mean_bins)
        hurst_deviation = hurst_fit.error * rng.standard_normal()
        density, *_ = _extrapolate_curve(
            curve, hurst_fit, measured.rolloff_evidence, rng.uniform(), hurst_deviation
        )
        spectrum = Spectrum(WAVEVECTORS, density * np.exp(mean_log_factor))
        # C_iso is a square of heights.
        yield spectrum, np.exp(log_power_factors / 2)


def _sample_reliable_wavelengths(
    rng: np.random.Generator, scan: HeightMap, tip_radius: float | None, waves: ReliableWavelengths
) -> ReliableWavelengths:
    """Return the reliable wavelengths of a scan; an unknown tip of a map gets a sampled radius."""
    if tip_radius is not None or scan.kind != "map":
        return waves
    return waves.limit_by_tip(scan, float(np.exp(rng.uniform(*np.log(UNKNOWN_TIP_RADII)))))


def _fit_hurst_without_peaks(mean_bins: _MeanBins) -> HurstFit:
    """Return the Hurst exponent that fits the bins without a peak."""
    density = mean_bins.density_between_peaks
    is_fitted = np.isfinite(density)
    mode_variance = mean_bins.mode_variance[is_fitted]
    return fit_hurst_exponent(BIN_CENTRES[is_fitted], density[is_fitted], mode_variance)


def _extrapolate_curve(
    curve: _Curve,
    hurst_fit: HurstFit,
    rolloff_evidence: RolloffEvidence,
    rolloff_probability: float = 0.5,
    hurst_deviation: float = 0.0,
) -> tuple[Floats, Tail, float]:
    """Return C_iso (nm⁴) on WAVEVECTORS, extrapolated from a curve, its tail and roll-off (nm)."""
    density, tail = extrapolate_short_waves(
        curve.wavevector, curve.density, hurst_fit, hurst_deviation
    )
    slopes, _ = local_slopes(*curve)
    slope = float(slopes[0])
    longest = float(2 * np.pi / curve.wavevector[0])
    rolloff = rolloff_evidence.rolloff_quantile(density, longest, slope, rolloff_probability)
    return extrapolate_long_waves(density, longest, slope, rolloff), tail, rolloff


@dataclass(frozen=True, eq=False, repr=False)
class ScanSpectrum(Spectrum):
    """C_iso in nm⁴ of the scans of a surface, over growing wavevectors in rad/nm."""

    joined_dataset: xr.Dataset  #: From `joined_spectrum`.
    skewness: float  #: Skewness of heights, the largest of all maps by magnitude; 0 without a map.
    is_extrapolated: bool  #: Whether C_iso continues beyond the reliable wavelengths.

    def extrapolated(self) -> "ScanSpectrum":
        """Return C_iso extrapolated beyond the reliable wavelengths."""
        spectrum = spectrum_of_dataset(self.joined_dataset)
        return replace(self, **vars(spectrum), is_extrapolated=True)


def reliable_spectrum(joined_dataset: xr.Dataset, skewness: float) -> ScanSpectrum:
    """Return a joined spectrum at the reliable wavelengths of its scans."""
    density = joined_dataset["joined_psd"].dropna("bin_wavevector")
    wavevector = density["bin_wavevector"].values
    return ScanSpectrum(wavevector, density.values, joined_dataset, skewness, is_extrapolated=False)
