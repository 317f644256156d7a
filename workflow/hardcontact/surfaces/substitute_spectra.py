"""Spectra of substitutes from descriptions: segments of wavelengths, each with its model.

Parameters that a description leaves blank are calibrated, so that scans of the spectrum have the
rms height, slope and curvature of the paper's Table 1.
"""

from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.descriptions import (
    AFM_ROWS,
    CALIBRATION_ROWS,
    SPECTRAL_MODELS,
    TAIL_ROWS,
    read_segments,
)
from hardcontact.surfaces.levelling import squared_projections
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    SpectrumFunction,
    all_scales_rms,
    isotropic_through_points,
    kept_shares,
    power_law_extrapolation,
    power_law_tail,
    spectrum_dataset,
)

#: Wavevectors (bins,) in rad/nm, and the weights (3, bins) of C_iso at them.
Weights = tuple[Floats, Floats]
#: Bins of wavevectors in which weights are added up, and rows added at a time.
BIN_COUNT = 4000
BLOCK_ROWS = 512
#: Relative error at which a number of Table 1 counts as met: far below its digits.
MET_ERROR = 1e-9
#: Calibrated parameters by model, and parameters whose logarithms are searched.
SEARCHED_PARAMETERS = {
    "self-affine": ("plateau_nm4", "rolloff_nm", "hurst"),
    "varying Hurst": ("plateau_nm4", "hurst", "hurst_change"),
}
LOGARITHMIC_PARAMETERS = ("plateau_nm4", "rolloff_nm")
#: Largest factor on an assumed roll-off: NCD and MCD then reach their longest wave. Largest number
#: of samples until one can be calibrated: every second sample of NCD and MCD can.
ROLLOFF_FACTOR = 1.5
MAX_SAMPLES = 100
#: Bounds of the Hurst exponent of a tail.
TAIL_HURST_BOUNDS = (-6.0, 5.0)


@cache
def transfer_weights(pixels: int, pixel_size: float, window_pixels: int) -> Weights:
    """Return wavevectors (bins,) and weights (3, bins) for the expected rms values of a scan.

    Squares of rms height, gradient and half-Laplacian are weights @ C_iso. The scan of
    `window_pixels` is cut out of a periodic surface of `pixels` (both per row) and levelled.
    """
    wave = 2 * np.pi * np.abs(np.fft.fftfreq(pixels, pixel_size))
    half = wave[: pixels // 2 + 1]
    count = np.where((half == 0) | (half == half.max()), 1.0, 2.0)
    shortest = np.hypot(wave.max(), half.max())
    edges = np.geomspace(half[1] * 0.999, shortest * 1.001, BIN_COUNT + 1)
    mean, slope = squared_projections(wave * window_pixels * pixel_size / 2)
    # The squared difference operator along one axis.
    difference = (2 * np.sin(wave * pixel_size / 2) / pixel_size) ** 2
    mean_x, slope_x, difference_x = (values[: len(half)] for values in (mean, slope, difference))
    weights = np.zeros((3, BIN_COUNT))
    for start in range(0, pixels, BLOCK_ROWS):
        rows = slice(start, start + BLOCK_ROWS)
        mean_y, slope_y = mean[rows, None], slope[rows, None]
        removed = mean_y * mean_x + slope_y * mean_x + mean_y * slope_x
        laplacian = difference[rows, None] + difference_x
        radius = np.hypot(wave[rows, None], half)
        if start == 0:
            radius[0, 0] = half[1]  # The mean has no weight, but needs a bin.
        index = np.searchsorted(edges, radius.ravel()) - 1
        for k, factor in enumerate((1 - removed, laplacian, laplacian**2 / 4)):
            weights[k] += np.bincount(index, (count * factor).ravel(), BIN_COUNT)
    return np.sqrt(edges[1:] * edges[:-1]), weights / (pixels * pixel_size) ** 2


def expected_scan_rms(spectrum: SpectrumFunction, weights: Weights) -> Floats:
    """Return the expected rms height (nm), gradient and half-Laplacian (1/nm) of a scan: (3,)."""
    wavevector, factors = weights
    return np.sqrt(factors @ spectrum(wavevector))


def calibrate_model(segment: pd.Series, table1: pd.DataFrame, weights: Weights) -> dict[str, float]:
    """Return the parameters of a segment with which its scans meet AFM_ROWS of Table 1.

    Raises ValueError if no parameters meet the rows.
    """
    from scipy.optimize import least_squares

    model, names = SPECTRAL_MODELS[segment.model]
    searched = SEARCHED_PARAMETERS[segment.model]
    published_rms = table1.loc[list(AFM_ROWS), "value"].to_numpy(float)

    def parameters(solution: Floats) -> dict[str, float]:
        return {
            name: np.exp(value) if name in LOGARITHMIC_PARAMETERS else value
            for name, value in zip(searched, solution, strict=True)
        }

    def mismatch(solution: Floats) -> Floats:
        segment_parameters = dict(segment) | parameters(solution)
        density = model(WAVEVECTORS, *(segment_parameters[name] for name in names))
        scan_rms = expected_scan_rms(Spectrum(WAVEVECTORS, density), weights)
        return np.asarray(np.log(scan_rms / published_rms))

    start = {
        "plateau_nm4": 2 * np.log(published_rms[0] * 1000),
        "rolloff_nm": np.log(1000.0),
        "hurst": 0.9,
        "hurst_change": 0.0,
    }
    first_guess = [start[name] for name in searched]
    fit = least_squares(
        mismatch, first_guess, x_scale=(1, 0.3, 0.3), xtol=1e-15, ftol=1e-15, gtol=1e-15
    )
    if np.abs(fit.fun).max() > MET_ERROR:
        worst = int(np.abs(fit.fun).argmax())
        raise ValueError(
            "expected three numbers of Table 1 that a spectrum of this model has, found "
            f"{AFM_ROWS[worst]} = {published_rms[worst]:.3g}, missed by "
            f"{100 * fit.fun[worst]:+.1f} %"
        )
    return {name: float(value) for name, value in parameters(fit.x).items()}


def calibrate_tail(
    longer_waves: Floats, gradient: float, half_laplacian: float
) -> dict[str, float]:
    """Return Hurst exponent and shortest wavelength (nm) of a power law below a spectrum.

    The tail adds the rms gradient and the half-Laplacian (1/nm) that the spectrum `longer_waves`
    (nm⁴ on WAVEVECTORS, zero below its end) lacks. Raises ValueError if no power law adds both.
    """
    from scipy.optimize import brentq

    _, *longer_rms = all_scales_rms(Spectrum(WAVEVECTORS, longer_waves))
    missing_squares = [gradient**2 - longer_rms[0] ** 2, half_laplacian**2 - longer_rms[1] ** 2]
    ends = 2 * np.pi / WAVEVECTORS[longer_waves.nonzero()[0][-1] + 1 :]
    refusal = ValueError(
        f"expected an all-scales slope and curvature that a power law below {ends[0]:.3g} nm can "
        f"add, found {gradient} and {half_laplacian}"
    )
    if min(missing_squares) <= 0:
        raise refusal

    def excess(index: int, hurst: float, shortest: float) -> float:
        tail = power_law_tail(longer_waves, hurst, shortest)
        added = all_scales_rms(Spectrum(WAVEVECTORS, tail))[1 + index]
        return float(np.log(added**2 / missing_squares[index]))

    def find_hurst(shortest: float) -> float:
        search = brentq(lambda hurst: excess(0, hurst, shortest), *TAIL_HURST_BOUNDS, xtol=1e-14)
        return float(search)

    def laplacian_excess(shortest: float) -> float:
        return excess(1, find_hurst(shortest), shortest)

    # If tails add the same gradient, the tail that ends later adds more to the half-Laplacian.
    possible_ends = [
        end
        for end in ends
        if excess(0, TAIL_HURST_BOUNDS[0], end) > 0 > excess(0, TAIL_HURST_BOUNDS[1], end)
    ]
    if not possible_ends:
        raise refusal
    longest_end, shortest_end = possible_ends[0], possible_ends[-1]
    if not laplacian_excess(longest_end) < 0 < laplacian_excess(shortest_end):
        raise refusal
    shortest = float(brentq(laplacian_excess, longest_end, shortest_end, xtol=1e-14))
    return {"hurst": find_hurst(shortest), "shortest_nm": shortest}


def spectrum_from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return C_iso (nm⁴) on WAVEVECTORS of a description, its segments, the rows of Table 1 met.

    The CSV has segments from long to short wavelengths. A segment without a Hurst exponent is
    calibrated if its model is in CALIBRATION_ROWS. Raises ValueError, with file and segment, if
    this fails.
    """
    return _spectrum_of_segments(read_segments(path), Path(path), table1, weights)


def _spectrum_of_segments(
    segments: pd.DataFrame, path: Path, table1: pd.DataFrame, weights: Weights
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return the results of `spectrum_from_description` for segments from this path."""
    segments = segments.copy()
    density = np.zeros_like(WAVEVECTORS)
    calibrated = list[str]()
    for i, segment in segments.iterrows():
        try:
            if pd.isna(segment.hurst) and segment.model in CALIBRATION_ROWS:
                if segment.model in SPECTRAL_MODELS:
                    parameters = calibrate_model(segment, table1, weights)
                else:
                    parameters = calibrate_tail(density, *table1.loc[list(TAIL_ROWS), "value"])
                segment = pd.Series(dict(segment) | parameters)
                calibrated += CALIBRATION_ROWS[segment.model]
            density += _segment_density(segment, density, path.parent)
        except (KeyError, ValueError, OSError) as error:
            raise ValueError(f"{path}: segment from {segment.longest_nm:g} nm: {error}") from None
        segments.loc[i] = segment
    last_segment = segments.iloc[-1]
    if last_segment.model == "power law":
        density *= kept_shares(last_segment.shortest_nm)
    return density, segments, calibrated


def _segment_density(segment: pd.Series, longer_waves: Floats, folder: Path) -> Floats:
    """Return C_iso of one segment on WAVEVECTORS, zero outside it."""
    if segment.model == "power law":
        return power_law_extrapolation(longer_waves, segment.hurst) * (
            kept_shares(segment.shortest_nm) > 0
        )
    if segment.model == "profile":
        columns = ["wavelength_nm", "c1d_nm3"]
        points = pd.read_csv(folder / segment.table, usecols=columns, dtype=float)[columns]
        wavelengths, profile = points.to_numpy().T
        model = isotropic_through_points(WAVEVECTORS, wavelengths, profile)
    else:
        model_function, names = SPECTRAL_MODELS[segment.model]
        model = model_function(WAVEVECTORS, *(segment[name] for name in names))
    wavelength = 2 * np.pi / WAVEVECTORS
    return np.where(
        (wavelength <= segment.longest_nm) & (wavelength > segment.shortest_nm), model, 0.0
    )


def paper_weights(constants: pd.DataFrame) -> Weights:
    """Return the `transfer_weights` of a scan with the paper's pixels and size."""
    pixels = int(constants["value"]["scan_pixels"])
    return transfer_weights(4 * pixels, constants["value"]["scan_size"] / pixels, pixels)


def sample_permitted_spectrum(
    rng: np.random.Generator, description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> Spectrum:
    """Sample a spectrum that Table 1 permits. A description without blanks permits only itself.

    AFM rows get the errors of means over the paper's scans. A given roll-off is multiplied by a
    factor up to ROLLOFF_FACTOR or its inverse. Raises ValueError if no sample can be calibrated.
    """
    segments = read_segments(description)
    weights = paper_weights(constants)
    rows = list(AFM_ROWS)
    scan_count = constants["value"]["scans_per_surface"]
    is_free = segments.hurst.isna() & segments.model.isin(SPECTRAL_MODELS)
    for _ in range(MAX_SAMPLES):
        drawn_rows, drawn_segments = table1.copy(), segments.copy()
        if is_free.any():
            errors = table1.loc[rows, "uncertainty"] / np.sqrt(scan_count)
            drawn_rows.loc[rows, "value"] += rng.standard_normal(len(rows)) * errors
            drawn_segments.loc[is_free, "rolloff_nm"] *= ROLLOFF_FACTOR ** rng.uniform(-1, 1)
        try:
            with np.errstate(over="ignore"):  # A search may try absurd parameters.
                density, *_ = _spectrum_of_segments(
                    drawn_segments, Path(description), drawn_rows, weights
                )
        except ValueError as error:
            refusal = error
        else:
            return Spectrum(WAVEVECTORS, density)
    raise refusal


def described_rms_height(path: str | Path, longest: float) -> float:
    """Return the rms height (nm) of the waves up to a wavelength (nm), from a description.

    The description must not leave parameters to Table 1.
    """
    no_weights = np.empty(0), np.empty((3, 0))
    density, _, _ = spectrum_from_description(path, pd.DataFrame(), no_weights)
    short_enough = 2 * np.pi / WAVEVECTORS <= longest
    return float(all_scales_rms(Spectrum(WAVEVECTORS, density * short_enough))[0])


def substitute_spectrum(
    description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> xr.Dataset:
    """Return the spectrum of a substitute from a description.

    Attributes of `spectrum` (nm⁴) are the segments, the rows of Table 1 to which they were
    calibrated, and the expected rms values of a scan with the paper's pixels and size.
    """
    weights = paper_weights(constants)
    density, segments, calibrated = spectrum_from_description(description, table1, weights)
    return spectrum_dataset(density).assign_attrs(
        source="substitute",
        table1_rows_met=",".join(calibrated),
        segments=segments.to_csv(index=False),
        expected_scan_rms=expected_scan_rms(Spectrum(WAVEVECTORS, density), weights),
    )
