"""Spectra of substitutes from descriptions: segments of wavelengths, each with its model.

Blank parameters are calibrated on the paper's Table 1. A model of the waves that scans show is
fitted to the rms height, slope and curvature of scans. A power law for shorter waves, the tail, is
fitted to slope and curvature over all scales.
"""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import scipy
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.levelling import squared_projections
from hardcontact.surfaces.metrics import TABLE1_METRICS
from hardcontact.surfaces.spectral_models import (
    SPECTRAL_MODELS,
    isotropic_through_points,
    power_law_extrapolation,
    power_law_tail,
    shares_of_longer_waves,
)
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    SpectrumFunction,
    all_scales_rms,
    spectrum_dataset,
)

#: Columns of descriptions that hold numbers.
DESCRIPTION_NUMBERS = (
    "longest_nm", "shortest_nm", "plateau_nm4", "rolloff_nm", "hurst", "hurst_change",
)  # fmt: skip
#: Values of `evidence` of segments that come from data, not from inference or assumption.
DATA_EVIDENCE = ("published", "measured")
#: Largest factor on an assumed roll-off: NCD and MCD then reach their longest wave, 3 µm.
ROLLOFF_FACTOR = 1.5
#: Largest number of samples until one can be calibrated: every second sample of NCD and MCD can.
MAX_SAMPLES = 100
#: Rows of Table 1 to which the spectrum of scans and the tail are fitted.
AFM_ROWS = tuple(TABLE1_METRICS)
TAIL_ROWS = ("all_rms_slope", "all_rms_curvature")
#: Rows of Table 1 to which a model is calibrated if its Hurst exponent is blank.
CALIBRATION_ROWS = {"self-affine": AFM_ROWS, "varying Hurst": AFM_ROWS, "power law": TAIL_ROWS}
#: Wavevectors (bins,) in rad/nm, and the weights (3, bins) of C_iso at them.
Weights = tuple[Floats, Floats]
#: Number of bins of wavevectors, each 0.2 % wide.
BIN_COUNT = 4000
#: Rows of the grid of wavevectors that are added at a time.
ROWS_AT_A_TIME = 512
#: Relative error below which a number of Table 1 counts as met: far below the printed digits.
MET_ERROR = 1e-9
#: Calibrated parameters by model, and parameters whose logarithms are searched.
SEARCHED_PARAMETERS = {
    "self-affine": ("plateau_nm4", "rolloff_nm", "hurst"),
    "varying Hurst": ("plateau_nm4", "hurst", "hurst_change"),
}
LOGARITHMIC_PARAMETERS = ("plateau_nm4", "rolloff_nm")
#: First guesses (the roll-off as a logarithm) of all but the plateau: a typical polished surface.
FIRST_GUESSES = {"rolloff_nm": np.log(1000.0), "hurst": 0.9, "hurst_change": 0.0}
#: A fit ends when only rounding changes it, so that rows of Table 1 are met to MET_ERROR.
FIT_TOLERANCES: dict[str, Any] = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15}
#: Bounds of the Hurst exponent of a tail: wide, since published numbers may fit none in 0 to 1.
TAIL_HURST_BOUNDS = (-6.0, 5.0)


@cache
def scan_rms_weights(pixels: int, pixel_size: float, window_pixels: int) -> Weights:
    """Return wavevectors (bins,) and weights (3, bins) for the expected rms values of a scan.

    With C_iso at these wavevectors, weights @ C_iso are the expected squares of rms height,
    gradient and half-Laplacian. So a calibration can try many spectra without random surfaces.

    The scan of `window_pixels` per row is cut out of a periodic surface of `pixels` per row, and
    levelled. Each wave of the surface has the mean square C_iso/area. It adds to the square of the
    rms height what levelling leaves of it, to the others what finite differences make of it. Bins
    collect the factors of waves with nearly the same wavenumber.
    """
    q_y = 2 * np.pi * np.abs(np.fft.fftfreq(pixels, pixel_size))
    q_x = q_y[: pixels // 2 + 1]
    # An entry of the transform of a real map stands for both waves of a pair of opposite q_x.
    waves_per_entry = np.where((q_x == 0) | (q_x == q_x.max()), 1.0, 2.0)
    highest_q = np.hypot(q_y.max(), q_x.max())
    # Margins keep the lowest and the highest wavevector within the bins.
    edges = np.geomspace(q_x[1] * 0.999, highest_q * 1.001, BIN_COUNT + 1)
    # Shares of a wave that levelling removes with the mean and slope along one axis.
    mean, slope = squared_projections(q_y * window_pixels * pixel_size / 2)
    # Finite differences along one axis multiply squared amplitudes by this.
    difference = (2 * np.sin(q_y * pixel_size / 2) / pixel_size) ** 2
    mean_x, slope_x, difference_x = (factor[: len(q_x)] for factor in (mean, slope, difference))
    weights = np.zeros((3, BIN_COUNT))
    for start in range(0, pixels, ROWS_AT_A_TIME):
        rows = slice(start, start + ROWS_AT_A_TIME)
        mean_y, slope_y = mean[rows, None], slope[rows, None]
        removed = mean_y * mean_x + slope_y * mean_x + mean_y * slope_x
        squared_gradient = difference[rows, None] + difference_x
        wavenumber = np.hypot(q_y[rows, None], q_x)
        if start == 0:
            wavenumber[0, 0] = q_x[1]  # The mean height has no weight, but needs a bin.
        bin_index = np.searchsorted(edges, wavenumber.ravel()) - 1
        for k, factor in enumerate((1 - removed, squared_gradient, squared_gradient**2 / 4)):
            weights[k] += np.bincount(bin_index, (waves_per_entry * factor).ravel(), BIN_COUNT)
    return np.sqrt(edges[1:] * edges[:-1]), weights / (pixels * pixel_size) ** 2


def expected_scan_rms(spectrum: SpectrumFunction, weights: Weights) -> Floats:
    """Return the expected rms height (nm), gradient and half-Laplacian (1/nm) of a scan: (3,)."""
    wavevector, factors = weights
    return np.sqrt(factors @ spectrum(wavevector))


def paper_scan_weights(constants: pd.DataFrame) -> Weights:
    """Return the `scan_rms_weights` of a scan with the paper's pixels and size."""
    pixels = int(constants["value"]["scan_pixels"])
    return scan_rms_weights(4 * pixels, constants["value"]["scan_size"] / pixels, pixels)


def calibrate_model(segment: pd.Series, table1: pd.DataFrame, weights: Weights) -> dict[str, float]:
    """Return parameters with which scans meet AFM_ROWS; raises ValueError if no parameters do."""
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

    # The plateau follows from the rms height and a roll-off of 1000 nm; x_scale has typical steps.
    log_plateau = 2 * np.log(published_rms[0] * 1000)
    first_guess = [log_plateau, *(FIRST_GUESSES[name] for name in searched[1:])]
    fit = scipy.optimize.least_squares(
        mismatch, first_guess, x_scale=(1, 0.3, 0.3), **FIT_TOLERANCES
    )
    if np.abs(fit.fun).max() > MET_ERROR:
        worst = int(np.abs(fit.fun).argmax())
        raise ValueError(
            f"expected a model that meets {', '.join(AFM_ROWS)} of Table 1, found "
            f"{AFM_ROWS[worst]} = {published_rms[worst]:.3g} missed by {100 * fit.fun[worst]:+.1f} "
            "%: choose another model, or state its Hurst exponent"
        )
    return {name: float(value) for name, value in parameters(fit.x).items()}


def calibrate_tail(
    longer_waves: Floats, gradient: float, half_laplacian: float
) -> dict[str, float]:
    """Return Hurst exponent and shortest wavelength (nm) of the tail below C_iso `longer_waves`.

    The tail adds what `longer_waves` lack of the rms gradient and half-Laplacian (1/nm). Both are
    found by nested searches:

    1. For a tried shortest wavelength, the Hurst exponent is that which adds the gradient. A larger
       exponent makes the tail steeper, and adds less.
    2. Of these tails, one that ends at a shorter wave adds more half-Laplacian. So the shortest
       wavelength is searched between the longest and the shortest for which an exponent exists.
    """
    _, *longer_rms = all_scales_rms(Spectrum(WAVEVECTORS, longer_waves))
    missing_squares = [gradient**2 - longer_rms[0] ** 2, half_laplacian**2 - longer_rms[1] ** 2]
    ends = 2 * np.pi / WAVEVECTORS[longer_waves.nonzero()[0][-1] + 1 :]
    refusal = ValueError(
        f"expected a slope and a curvature over all scales that a power law below {ends[0]:.3g} nm "
        f"can add, found {gradient} and {half_laplacian}: state its Hurst exponent"
    )
    if min(missing_squares) <= 0:
        raise refusal

    def excess(hurst: float, shortest: float, index: int) -> float:
        """Return ln of the added over the missing square of gradient (0) or half-Laplacian (1)."""
        tail = power_law_tail(longer_waves, hurst, shortest)
        added = all_scales_rms(Spectrum(WAVEVECTORS, tail))[1 + index]
        return float(np.log(added**2 / missing_squares[index]))

    def find_hurst(shortest: float) -> float:
        root = scipy.optimize.brentq(excess, *TAIL_HURST_BOUNDS, args=(shortest, 0), xtol=1e-14)
        return float(root)

    def laplacian_excess(shortest: float) -> float:
        return excess(find_hurst(shortest), shortest, 1)

    low, high = TAIL_HURST_BOUNDS
    # These are sorted from long to short.
    possible_ends = [end for end in ends if excess(low, end, 0) > 0 > excess(high, end, 0)]
    if not possible_ends:
        raise refusal
    longest_end, shortest_end = possible_ends[0], possible_ends[-1]
    if not laplacian_excess(longest_end) < 0 < laplacian_excess(shortest_end):
        raise refusal
    shortest = float(scipy.optimize.brentq(laplacian_excess, longest_end, shortest_end, xtol=1e-14))
    return {"hurst": find_hurst(shortest), "shortest_nm": shortest}


def read_segments(path: str | Path) -> pd.DataFrame:
    """Read the segments of a description of a spectrum, without blanks around the cells."""
    cells: pd.DataFrame = pd.read_csv(path, dtype=str).apply(lambda column: column.str.strip())
    return cells.replace("", np.nan).astype(dict.fromkeys(DESCRIPTION_NUMBERS, float))


def needs_calibration(segments: pd.DataFrame) -> bool:
    """Return True if a description leaves parameters to calibration on Table 1."""
    return bool((segments.hurst.isna() & segments.model.isin(CALIBRATION_ROWS)).any())


def spectrum_from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights, segments: pd.DataFrame | None = None
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return C_iso (nm⁴) on WAVEVECTORS, segments after calibration, and their CALIBRATION_ROWS."""
    segments = read_segments(path) if segments is None else segments.copy()
    density = np.zeros_like(WAVEVECTORS)
    calibrated_rows = list[str]()
    for i, segment in segments.iterrows():
        try:
            if pd.isna(segment.hurst) and segment.model in CALIBRATION_ROWS:
                if segment.model in SPECTRAL_MODELS:
                    parameters = calibrate_model(segment, table1, weights)
                else:
                    parameters = calibrate_tail(density, *table1.loc[list(TAIL_ROWS), "value"])
                segment = pd.Series(dict(segment) | parameters)
                calibrated_rows += CALIBRATION_ROWS[segment.model]
            density += _segment_density(segment, density, Path(path).parent)
        except (KeyError, ValueError, OSError) as error:
            raise ValueError(f"{path}: segment from {segment.longest_nm:g} nm: {error}") from None
        segments.loc[i] = segment
    last_segment = segments.iloc[-1]
    if last_segment.model == "power law":
        density *= shares_of_longer_waves(last_segment.shortest_nm)
    return density, segments, calibrated_rows


def _segment_density(segment: pd.Series, longer_waves: Floats, folder: Path) -> Floats:
    """Return C_iso of one segment on WAVEVECTORS, zero outside the segment."""
    if segment.model == "power law":
        return power_law_extrapolation(longer_waves, segment.hurst) * (
            shares_of_longer_waves(segment.shortest_nm) > 0
        )
    if segment.model == "profile":
        columns = ["wavelength_nm", "c1d_nm3"]
        points = pd.read_csv(folder / segment.table, usecols=columns, dtype=float)[columns]
        wavelengths, profile = points.to_numpy().T
        density = isotropic_through_points(WAVEVECTORS, wavelengths, profile)
    else:
        model, names = SPECTRAL_MODELS[segment.model]
        density = model(WAVEVECTORS, *(segment[name] for name in names))
    wavelength = 2 * np.pi / WAVEVECTORS
    is_inside = (wavelength <= segment.longest_nm) & (wavelength > segment.shortest_nm)
    return np.where(is_inside, density, 0.0)


def sample_permitted_spectrum(
    rng: np.random.Generator, description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> Spectrum:
    """Sample a spectrum that Table 1 permits; only blank models of scans are sampled."""
    segments = read_segments(description)
    weights = paper_scan_weights(constants)
    rows = list(AFM_ROWS)
    scan_count = constants["value"]["scans_per_surface"]
    is_free = segments.hurst.isna() & segments.model.isin(SPECTRAL_MODELS)
    for _ in range(MAX_SAMPLES):
        sampled_table1, sampled_segments = table1.copy(), segments.copy()
        if is_free.any():
            # Standard errors of means over the paper's scans.
            errors = table1.loc[rows, "uncertainty"] / np.sqrt(scan_count)
            sampled_table1.loc[rows, "value"] += rng.standard_normal(len(rows)) * errors
            sampled_segments.loc[is_free, "rolloff_nm"] *= ROLLOFF_FACTOR ** rng.uniform(-1, 1)
        try:
            with np.errstate(over="ignore"):  # A fit may try absurd parameters.
                density, *_ = spectrum_from_description(
                    description, sampled_table1, weights, sampled_segments
                )
        except ValueError as error:
            refusal = error
        else:
            return Spectrum(WAVEVECTORS, density)
    raise refusal


def described_rms_height(path: str | Path, longest: float) -> float:
    """Return the rms height (nm) of waves up to a wavelength (nm); no parameter may be blank."""
    no_weights = np.empty(0), np.empty((3, 0))
    density, _, _ = spectrum_from_description(path, pd.DataFrame(), no_weights)
    is_kept = 2 * np.pi / WAVEVECTORS <= longest
    return float(all_scales_rms(Spectrum(WAVEVECTORS, density * is_kept))[0])


def substitute_spectrum(
    description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> xr.Dataset:
    """Return the spectrum of a substitute from a description."""
    weights = paper_scan_weights(constants)
    density, segments, calibrated_rows = spectrum_from_description(description, table1, weights)
    return spectrum_dataset(density).assign_attrs(
        source="substitute",
        table1_rows_met=",".join(calibrated_rows),
        segments=segments.to_csv(index=False),
        expected_scan_rms=expected_scan_rms(Spectrum(WAVEVECTORS, density), weights),
    )
