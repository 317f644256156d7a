"""Substitute scans of one surface, conditioned together on Table 1.

A smooth gain of the spectrum and one factor for each scan give a group of random scans exactly the
published mean and standard deviation of rms heights, and mean slope and curvature.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.published import rows_met
from hardcontact.surfaces.height_map import DEFINITIONS, HeightMap, level, metrics
from hardcontact.surfaces.spectrum import AFM_ROWS, WAVEVECTORS, Density, Floats, spectrum_from
from hardcontact.surfaces.substitute_scans import ScanGrid, draw_scan
from hardcontact.surfaces.substitute_spectra import expected_moments, transfer_weights

#: Ratio of metrics of isotropic surfaces to moments: height, gradient, half-Laplacian.
METRIC_PER_MOMENT = {
    "rms_height": 1.0,
    "rms_gradient": 1.0,
    "rms_profile_slope": 1 / np.sqrt(2),
    "rms_half_laplacian": 1.0,
    "rms_laplacian": 2.0,
}
#: Bands whose amplitudes are free.
BAND_COUNT = 3
#: Largest ratio of the amplitude of a band to that of the longest wavelengths, or its inverse.
MAX_AMPLITUDE_RATIO = 4.0
#: Relative error at which a target counts as met.
TOLERANCE = 1e-9


class Targets(NamedTuple):
    """The statistics that a group of scans of one surface meets."""

    means: Mapping[str, float]  #: Mean height, slope and curvature, by METRICS.
    deviation: float  #: Standard deviation of the rms heights in nm (ddof 1).
    rows: tuple[str, ...]  #: Rows of Table 1 that these targets meet.


def scan_targets(
    spectrum: xr.Dataset,
    table1: pd.DataFrame,
    constants: pd.DataFrame,
    definitions: Mapping[str, str],
    grid: ScanGrid,
) -> Targets | None:
    """Return the targets of substitute scans on this study's pixels.

    Scans with the paper's pixels and size get the expected moments that the spectrum states. With
    other pixels, slope and curvature are the moments expected on these pixels; with another size,
    all three are. The ratio of deviation to rms height is the published one.

    Parameters
    ----------
    spectrum : xarray.Dataset
        The dataset that `substitute_spectrum` returns.
    table1, constants : pandas.DataFrame
        Table 1 from `rows_of_surface`, and the constants with the paper's pixels and size, which
        `published.constants` returns.
    definitions : mapping of str to str
        Meaning of ``slope`` and ``curvature`` in Table 1: keys of DEFINITIONS.
    grid : ScanGrid
        Pixels and size of the scans.

    Returns
    -------
    Targets or None
        None for a surface without a published rms height.
    """
    if "afm_rms_height" not in table1.index:
        return None
    pixels, size = int(constants["value"]["scan_pixels"]), float(constants["value"]["scan_size"])
    moments = np.array(spectrum.attrs["expected_scan_moments"])
    same_size = math.isclose(grid.size, size)
    same_pixels = same_size and grid.pixels == pixels
    is_same = np.array([same_size, same_pixels, same_pixels])
    if not is_same.all():
        density = spectrum_from(spectrum)
        weights = transfer_weights(4 * grid.pixels, grid.pixel_size, grid.pixels)
        moments = np.where(is_same, moments, expected_moments(density, weights))
    height = table1.loc["afm_rms_height"]
    calibrated = rows_met(spectrum.attrs["table1_rows_met"])
    names = "rms_height", *(DEFINITIONS[definitions[key]] for key in ("slope", "curvature"))
    return Targets(
        {
            name: float(METRIC_PER_MOMENT[name] * moment)
            for name, moment in zip(names, moments, strict=True)
        },
        float(moments[0] * height["uncertainty"] / height["value"]),
        tuple(row for row, met in zip(AFM_ROWS, is_same, strict=True) if met and row in calibrated),
    )


def group_heights(heights: Floats, mean: float, deviation: float) -> Floats:
    """Return rms heights (scan,) in nm, shifted and stretched to a mean and a standard deviation.

    The standard deviation has ddof 1. The heights keep their order and relative distances. A single
    scan gets the mean.
    """
    deviations = heights - heights.mean()
    if len(heights) > 1:
        deviations *= deviation / deviations.std(ddof=1)
    return np.asarray(mean + deviations)


def band_shares(grid: ScanGrid) -> Floats:
    """Return the shares of amplitude of three smooth bands: (3, points of WAVEVECTORS).

    The shares add up to one. Each band passes into the next as sin² of the logarithm of wavelength:
    the first from the size of a scan to its geometric mean with two pixels, the second from there
    to two pixels.
    """
    longest, shortest = grid.size, 2 * grid.pixel_size
    position = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    long_step = np.sin(np.pi / 2 * np.clip(2 * position, 0, 1)) ** 2
    short_step = np.sin(np.pi / 2 * np.clip(2 * position - 1, 0, 1)) ** 2
    return np.array([1 - long_step, long_step - short_step, short_step])


def multiply_amplitudes(density: Density, gain: Floats) -> Density:
    """Return a spectrum whose amplitudes are multiplied by a gain on WAVEVECTORS."""

    def amplified_density(wavevector: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            gains = np.interp(np.log(wavevector), np.log(WAVEVECTORS), gain)
        return density(wavevector) * gains**2

    return amplified_density


def second_moments(bands: Sequence[HeightMap], names: Sequence[str]) -> Floats:
    """Return matrices G (names, bands, bands): metric(sum a_k h_k)² = a G a, in its unit squared.

    The bands h_k are levelled. The names are METRICS whose square is quadratic in the heights.
    """

    def squares(heights: np.ndarray) -> Floats:
        values = metrics(replace(bands[0], heights=heights))
        return np.array([values[name] ** 2 for name in names])

    powers = [squares(band.heights) for band in bands]
    matrices = np.zeros((len(names), len(bands), len(bands)))
    for i in range(len(bands)):
        matrices[:, i, i] = powers[i]
        for j in range(i):
            power_of_sum = squares(bands[i].heights + bands[j].heights)
            matrices[:, i, j] = matrices[:, j, i] = (power_of_sum - powers[i] - powers[j]) / 2
    return matrices


def _fit_group(moments: Floats, targets: Targets) -> tuple[Floats, Floats, Floats]:
    """Return amplitudes (bands,), factors of heights (scan,), relative errors of the means (3,)."""
    from scipy.optimize import least_squares

    means = np.array(list(targets.means.values()))

    def relative_errors(logs: Floats) -> tuple[Floats, Floats]:
        """Return the errors (3,), and the factors (scan,) that give scans their rms heights."""
        amplitudes = np.exp(np.append(0.0, logs))
        values = np.sqrt(np.einsum("smij,i,j->sm", moments, amplitudes, amplitudes))
        heights = values[:, 0]
        factors = group_heights(heights, means[0], targets.deviation) / heights
        return (factors[:, None] * values).mean(axis=0) / means - 1, factors

    def slope_and_curvature_errors(logs: Floats) -> Floats:
        return relative_errors(logs)[0][1:]

    fit = least_squares(
        slope_and_curvature_errors,
        np.zeros(BAND_COUNT - 1),
        bounds=(-np.log(MAX_AMPLITUDE_RATIO), np.log(MAX_AMPLITUDE_RATIO)),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    mean_errors, factors = relative_errors(fit.x)
    if factors.min() <= 0:
        raise ValueError(
            f"expected rms heights above zero of {len(moments)} scans that are {means[0]:.3g} +- "
            f"{targets.deviation:.3g} nm, found one below: fewer scans deviate less"
        )
    mean = factors.mean()
    return mean * np.exp(np.append(0.0, fit.x)), factors / mean, mean_errors


def conditioned_group(
    spectrum: xr.Dataset,
    targets: Targets | None,
    generators: Mapping[int, Callable[[], np.random.Generator]],
    grid: ScanGrid,
) -> xr.Dataset:
    """Return the `gain` (wavevector) of amplitudes and the `factor` (scan) of heights of a group.

    Parameters
    ----------
    spectrum : xarray.Dataset
        The dataset that `substitute_spectrum` returns.
    targets : Targets or None
        The targets that `scan_targets` returns; with None, gain and factors equal 1.
    generators : mapping of int to callable
        By number of the scan: returns a new generator that draws the scan.
    grid : ScanGrid
        Pixels and size of the scans.

    Returns
    -------
    xarray.Dataset
        The attribute `table1_rows_met` lists the rows of Table 1 that the surface meets by
        construction.

    Raises
    ------
    ValueError
        If an rms height would be negative.
    """
    gain, factors = np.ones_like(WAVEVECTORS), np.ones(len(generators))
    calibrated = rows_met(spectrum.attrs["table1_rows_met"])
    if targets is not None:
        density = spectrum_from(spectrum)
        shares = band_shares(grid)
        moments = [
            second_moments(
                [
                    level(draw_scan(draw(), multiply_amplitudes(density, share), grid))
                    for share in shares
                ],
                list(targets.means),
            )
            for draw in generators.values()
        ]
        amplitudes, factors, mean_errors = _fit_group(np.array(moments), targets)
        gain = amplitudes @ shares
        met_rows = {
            row
            for row, error in zip(AFM_ROWS, mean_errors, strict=True)
            if row in targets.rows and abs(error) < TOLERANCE
        }
        calibrated = [row for row in calibrated if row in met_rows or row not in AFM_ROWS]
    return xr.Dataset(
        {
            "gain": ("wavevector", gain, {"units": "1", "long_name": "gain of amplitudes"}),
            "factor": ("scan", factors, {"units": "1", "long_name": "factor of heights"}),
        },
        {
            "wavevector": ("wavevector", WAVEVECTORS, {"units": "rad nm-1"}),
            "scan": list(generators),
        },
        {"basis": "substitute", "table1_rows_met": ",".join(calibrated)},
    )
