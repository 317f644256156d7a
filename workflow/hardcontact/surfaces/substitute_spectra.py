"""Spectra of substitutes from descriptions: segments of wavelengths, each with its model.

Blank parameters are calibrated on the paper's Table 1 (`table1_calibration`).
"""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.spectral_models import (
    SPECTRAL_MODELS,
    isotropic_through_points,
    power_law_extrapolation,
    shares_of_longer_waves,
)
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_rms, spectrum_dataset
from hardcontact.surfaces.table1_calibration import (
    AFM_ROWS,
    CALIBRATION_ROWS,
    TAIL_ROWS,
    Weights,
    calibrate_model,
    calibrate_tail,
    expected_scan_rms,
    paper_scan_weights,
)

#: Columns of descriptions that hold numbers.
DESCRIPTION_NUMBERS = (
    "longest_nm", "shortest_nm", "plateau_nm4", "rolloff_nm", "hurst", "hurst_change",
)  # fmt: skip
#: Values of `evidence` of segments that come from data, not from inference or assumption.
DATA_EVIDENCE = ("published", "measured")
#: Largest factor on an assumed roll-off: NCD and MCD then reach their longest wave.
ROLLOFF_FACTOR = 1.5
#: Largest number of samples until one can be calibrated: every second one of NCD and MCD can.
MAX_SAMPLES = 100


def read_segments(path: str | Path) -> pd.DataFrame:
    """Read the segments of a description of a spectrum, without blanks around its cells."""
    cells: pd.DataFrame = pd.read_csv(path, dtype=str).apply(lambda column: column.str.strip())
    return cells.replace("", np.nan).astype(dict.fromkeys(DESCRIPTION_NUMBERS, float))


def needs_calibration(segments: pd.DataFrame) -> bool:
    """Return True if a description leaves parameters to a calibration on Table 1."""
    return bool((segments.hurst.isna() & segments.model.isin(CALIBRATION_ROWS)).any())


def spectrum_from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights, segments: pd.DataFrame | None = None
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return C_iso (nm⁴) on WAVEVECTORS, calibrated segments, and the rows of Table 1 they meet.

    Given `segments` replace those of the file. Raises ValueError if a calibration fails.
    """
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
    """Return C_iso of one segment on WAVEVECTORS, zero outside it."""
    if segment.model == "power law":
        return power_law_extrapolation(longer_waves, segment.hurst) * (
            shares_of_longer_waves(segment.shortest_nm) > 0
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


def sample_permitted_spectrum(
    rng: np.random.Generator, description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> Spectrum:
    """Sample a spectrum that Table 1 permits: that of the description, if it has no blanks.

    AFM rows get random errors like those of means over the paper's scans. Raises ValueError if no
    sample can be calibrated.
    """
    segments = read_segments(description)
    weights = paper_scan_weights(constants)
    rows = list(AFM_ROWS)
    scan_count = constants["value"]["scans_per_surface"]
    is_free = segments.hurst.isna() & segments.model.isin(SPECTRAL_MODELS)
    for _ in range(MAX_SAMPLES):
        sampled_table1, sampled_segments = table1.copy(), segments.copy()
        if is_free.any():
            errors = table1.loc[rows, "uncertainty"] / np.sqrt(scan_count)
            sampled_table1.loc[rows, "value"] += rng.standard_normal(len(rows)) * errors
            sampled_segments.loc[is_free, "rolloff_nm"] *= ROLLOFF_FACTOR ** rng.uniform(-1, 1)
        try:
            with np.errstate(over="ignore"):  # A search may try absurd parameters.
                density, *_ = spectrum_from_description(
                    description, sampled_table1, weights, sampled_segments
                )
        except ValueError as error:
            refusal = error
        else:
            return Spectrum(WAVEVECTORS, density)
    raise refusal


def described_rms_height(path: str | Path, longest: float) -> float:
    """Return the rms height of waves up to a wavelength (nm), from a description without blanks."""
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
