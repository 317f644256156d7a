"""One spectrum of a surface from all scans of it: maps of several sizes, and line scans.

`density`, `densities`, ``spectrum`` and ``joined_psd`` all hold C_iso in nm⁴ (`surfaces.spectrum`).
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
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
from hardcontact.scans.mean_spectrum import (
    Curve,
    MeanBins,
    match_height_variance,
    mean_bins,
    smooth_curve_without_peaks,
)
from hardcontact.scans.measured_spectrum import (
    CALIBRATION_SCATTER,
    independent_modes,
    isotropic_psd,
    local_slopes,
)
from hardcontact.scans.reliable_band import ReliableBand, limit_by_tip, reliable_band
from hardcontact.scans.spectrum_datasets import add_measurements, scan_properties
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    MIN_BINS,
    WAVEVECTORS,
    Spectrum,
    spectrum_dataset,
    spectrum_of_dataset,
    too_few_bins_message,
)

#: Shortest and longest radius in nm of an unknown tip: a new tip, a blunt tip.
UNKNOWN_TIP_RADII = (5.0, 50.0)


class _MeasuredSpectra(NamedTuple):
    """The spectra of the scans of a surface."""

    radii: Sequence[float | None]  #: Radii of the tips in nm; None if unknown.
    densities: Floats  #: (scan, bins) C_iso in nm⁴, NaN in empty bins.
    modes: Floats  #: (scan, bins) numbers of independent modes.
    bands: Sequence[ReliableBand]
    rolloff_evidence: RolloffEvidence


def _reliable_mask(densities: Floats, bands: Sequence[ReliableBand]) -> NDArray[np.bool_]:
    """Return the mask (scan, bins) of nonempty bins within the reliable band of each scan."""
    return np.array([band.bins for band in bands]) & np.isfinite(densities)


def _measured_spectra(
    scans: Sequence[HeightMap], tip_radii: Sequence[float | None]
) -> _MeasuredSpectra:
    """Return the spectra of scans; raises ValueError if fewer than MIN_BINS are reliable."""
    radii = [
        scan.tip_radius if radius is None else radius
        for scan, radius in zip(scans, tip_radii, strict=True)
    ]
    densities = np.array([isotropic_psd(scan) for scan in scans])
    bands = [reliable_band(*row) for row in zip(scans, radii, densities, strict=True)]
    modes = np.array([independent_modes(scan.kind, scan.size) for scan in scans])
    rolloff_evidence = RolloffEvidence(scans, densities, bands)
    count = int(_reliable_mask(densities, bands).any(axis=0).sum())
    if count < MIN_BINS:
        listing = "; ".join(f"{scan.name} {band}" for scan, band in zip(scans, bands, strict=True))
        is_too_large = min(band.shortest for band in bands) > 2 * np.pi / BIN_CENTRES[0]
        remedy = ": is the unit of length right?" if is_too_large else ""
        raise ValueError(too_few_bins_message("measurements", count, listing) + remedy)
    return _MeasuredSpectra(radii, densities, modes, bands, rolloff_evidence)


def joined_spectrum(scans: Sequence[HeightMap], tip_radii: Sequence[float | None]) -> xr.Dataset:
    """Return the spectrum of a surface, joined from levelled scans at their reliable wavelengths.

    If a tip radius is None, the file may state one. ``spectrum`` (wavevector) has all scales;
    ``joined_psd`` (bin_wavevector) is NaN in unreliable bins. Raises ValueError, in one line, if
    fewer than MIN_BINS bins are reliable.
    """
    measured = _measured_spectra(scans, tip_radii)
    reliable = _reliable_mask(measured.densities, measured.bands)
    bins = mean_bins(reliable, measured.densities, measured.modes)
    curve = match_height_variance(smooth_curve_without_peaks(bins), bins.power)
    mean_density = Spectrum(curve.wavevector, curve.density)(BIN_CENTRES)
    joined_density = np.where(reliable.any(axis=0), mean_density, np.nan)
    hurst = _fit_hurst_without_peaks(bins)
    density, tail, rolloff = _extrapolate_curve(curve, hurst, measured.rolloff_evidence)
    used_bands = [band for band, mask in zip(measured.bands, reliable, strict=True) if mask.any()]
    return add_measurements(
        spectrum_dataset(density),
        joined_density,
        measured.densities,
        reliable,
        scan_properties(scans, measured.radii, measured.bands),
    ).assign_attrs(
        source="measured",
        table1_rows_met="",
        shortest_measured=min(band.shortest for band in used_bands),
        longest_measured=max(band.longest for band in used_bands),
        rolloff=rolloff,
        tail_known=int(is_tail_known(tail)),
        **tail._asdict(),
    )


def sample_spectra(
    rngs: Iterable[np.random.Generator],
    scans: Sequence[HeightMap],
    tip_radii: Sequence[float | None],
) -> Iterator[tuple[Spectrum, Floats]]:
    """Yield, for each random generator, a spectrum within the uncertainty of levelled scans.

    Also yields factors (scan,) from measured to true heights.
    """
    measured = _measured_spectra(scans, tip_radii)
    for rng in rngs:
        bands = [
            _sample_reliable_band(rng, *properties)
            for properties in zip(scans, measured.radii, measured.bands, strict=True)
        ]
        reliable = _reliable_mask(measured.densities, bands)
        # A blunt tip may leave too few bins: then the sampled tips limit no scan of this sample.
        if reliable.any(axis=0).sum() < MIN_BINS:
            reliable = _reliable_mask(measured.densities, measured.bands)
        log_power_factors = CALIBRATION_SCATTER * rng.standard_normal(len(bands))
        # The mean calibration error scales the whole spectrum, so it is applied after the
        # extrapolation.
        mean_log = log_power_factors.mean()
        densities = measured.densities * np.exp(log_power_factors - mean_log)[:, None]
        bins = mean_bins(reliable, densities, measured.modes)
        curve = smooth_curve_without_peaks(bins, rng)
        hurst = _fit_hurst_without_peaks(bins)
        hurst_deviation = hurst.error * rng.standard_normal()
        density, *_ = _extrapolate_curve(
            curve, hurst, measured.rolloff_evidence, rng.uniform(), hurst_deviation
        )
        yield Spectrum(WAVEVECTORS, density * np.exp(mean_log)), np.exp(log_power_factors / 2)


def _sample_reliable_band(
    rng: np.random.Generator, scan: HeightMap, radius: float | None, band: ReliableBand
) -> ReliableBand:
    """Return the reliable band of a scan; an unknown tip of a map gets a sampled radius."""
    if radius is not None or scan.kind != "map":
        return band
    tip_radius = float(np.exp(rng.uniform(*np.log(UNKNOWN_TIP_RADII))))
    return limit_by_tip(band, scan, tip_radius)


def _fit_hurst_without_peaks(bins: MeanBins) -> HurstFit:
    is_fitted = np.isfinite(bins.density) & ~bins.is_peak
    return fit_hurst_exponent(
        BIN_CENTRES[is_fitted], bins.density[is_fitted], bins.variance[is_fitted]
    )


def _extrapolate_curve(
    curve: Curve,
    hurst: HurstFit,
    rolloff_evidence: RolloffEvidence,
    rolloff_probability: float = 0.5,
    hurst_deviation: float = 0.0,
) -> tuple[Floats, Tail, float]:
    """Return C_iso (nm⁴) on WAVEVECTORS, extrapolated from a curve, its tail and roll-off (nm).

    The roll-off is the quantile of its distribution at `rolloff_probability`.
    """
    density, tail = extrapolate_short_waves(curve.wavevector, curve.density, hurst, hurst_deviation)
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
        """Return C_iso extrapolated beyond the reliable wavelengths, as in spectra of masters."""
        spectrum = spectrum_of_dataset(self.joined_dataset)
        return replace(self, **vars(spectrum), is_extrapolated=True)


def reliable_spectrum(joined_dataset: xr.Dataset, skewness: float) -> ScanSpectrum:
    """Return a joined spectrum at the reliable wavelengths of its scans."""
    density = joined_dataset["joined_psd"].dropna("bin_wavevector")
    wavevector = density["bin_wavevector"].values
    return ScanSpectrum(wavevector, density.values, joined_dataset, skewness, is_extrapolated=False)
