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
from hardcontact.surfaces.substitute_scans import ScanGrid, drawn_scan
from hardcontact.surfaces.substitute_spectra import expected_moments, transfer_weights

#: Metrics of isotropic surfaces over the moments: height, gradient, half the Laplacian.
OVER_MOMENTS = {
    "rms_height": 1.0,
    "rms_gradient": 1.0,
    "rms_profile_slope": 1 / np.sqrt(2),
    "rms_half_laplacian": 1.0,
    "rms_laplacian": 2.0,
}
#: Bands whose amplitudes are free.
BANDS = 3
#: Largest ratio of the amplitude of a band to that of the longest wavelengths, or its inverse.
LARGEST_CHANGE = 4.0
#: Relative error at which a target counts as met.
TOLERANCE = 1e-9


class Targets(NamedTuple):
    """The statistics that a group of scans of one surface is given."""

    means: Mapping[str, float]  #: By metric (METRICS): height, slope, curvature, in this order.
    deviation: float  #: Standard deviation of the rms heights in nm (ddof 1).
    rows: tuple[str, ...]  #: Of Table 1, that are met so.


def scan_targets(
    spectrum: xr.Dataset,
    table1: pd.DataFrame,
    constants: pd.DataFrame,
    definitions: Mapping[str, str],
    grid: ScanGrid,
) -> Targets | None:
    """Return the targets of substitute scans on this study's pixels.

    Scans of the paper's pixels and size get the moments that the spectrum expects of a scan. Other
    pixels change slope and curvature to those expected there, another size changes all three. The
    deviation has the ratio to the rms height that its published uncertainty has.

    Parameters
    ----------
    spectrum : xarray.Dataset
        The dataset that `substitute_spectrum` returns.
    table1, constants : pandas.DataFrame
        Table 1 from `rows_of_surface`; `published.constants`, with the paper's pixels and size.
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
    calibrated = rows_met(spectrum.attrs["calibrated_to_table1"])
    names = "rms_height", *(DEFINITIONS[definitions[key]] for key in ("slope", "curvature"))
    return Targets(
        {
            name: float(OVER_MOMENTS[name] * moment)
            for name, moment in zip(names, moments, strict=True)
        },
        float(moments[0] * height["uncertainty"] / height["value"]),
        tuple(row for row, met in zip(AFM_ROWS, is_same, strict=True) if met and row in calibrated),
    )


def group_heights(heights: Floats, mean: float, deviation: float) -> Floats:
    """Return rms heights (scan,) with a mean and a standard deviation (ddof 1), from random ones.

    They keep their order and their relative distances; a single scan gets the mean.
    """
    deviations = heights - heights.mean()
    if len(heights) > 1:
        deviations *= deviation / deviations.std(ddof=1)
    return np.asarray(mean + deviations)


def band_shares(grid: ScanGrid) -> Floats:
    """Return the shares of amplitude of three smooth bands: (3, points of WAVEVECTORS).

    They add up to one, and go over into each other between the size of a scan, its geometric mean
    with two pixels, and two pixels, as sin² in the logarithm of the wavelength.
    """
    longest, shortest = grid.size, 2 * grid.pixel_size
    position = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    long_step, short_step = (
        np.sin(np.pi / 2 * np.clip(2 * position - step, 0, 1)) ** 2 for step in range(BANDS - 1)
    )
    return np.array([1 - long_step, long_step - short_step, short_step])


def amplified(density: Density, gain: Floats) -> Density:
    """Return a spectrum whose amplitudes are multiplied by a gain on WAVEVECTORS."""

    def amplified_density(wavevector: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            gains = np.interp(np.log(wavevector), np.log(WAVEVECTORS), gain)
        return density(wavevector) * gains**2

    return amplified_density


def second_moments(bands: Sequence[HeightMap], names: Sequence[str]) -> Floats:
    """Return matrices G (names, bands, bands): metric(sum a_k h_k)² = a G a, in its unit squared.

    The bands h_k are levelled; the names are of METRICS that are root mean squares of something
    linear in the heights.
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


def _fitted(moments: Floats, targets: Targets) -> tuple[Floats, Floats, Floats]:
    """Return amplitudes (bands,), factors of heights (scan,), relative misses of the means (3,)."""
    from scipy.optimize import least_squares

    means = np.array(list(targets.means.values()))

    def misses(logs: Floats) -> tuple[Floats, Floats]:
        """Return the misses (3,), and the factors (scan,) that give scans their rms heights."""
        amplitudes = np.exp(np.append(0.0, logs))
        values = np.sqrt(np.einsum("smij,i,j->sm", moments, amplitudes, amplitudes))
        heights = values[:, 0]
        factors = group_heights(heights, means[0], targets.deviation) / heights
        return (factors[:, None] * values).mean(axis=0) / means - 1, factors

    def slope_and_curvature_misses(logs: Floats) -> Floats:
        return misses(logs)[0][1:]

    fit = least_squares(
        slope_and_curvature_misses,
        np.zeros(BANDS - 1),
        bounds=(-np.log(LARGEST_CHANGE), np.log(LARGEST_CHANGE)),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    missed, factors = misses(fit.x)
    if factors.min() <= 0:
        raise ValueError(
            f"expected rms heights above zero of {len(moments)} scans that are {means[0]:.3g} +- "
            f"{targets.deviation:.3g} nm, found one below: fewer scans deviate less"
        )
    mean = factors.mean()
    return mean * np.exp(np.append(0.0, fit.x)), factors / mean, missed


def conditioned_group(
    spectrum: xr.Dataset,
    targets: Targets | None,
    generators: Mapping[int, Callable[[], np.random.Generator]],
    grid: ScanGrid,
) -> xr.Dataset:
    """Return the `gain` (wavevector) of amplitudes and the `factor` (scan) of heights of a group.

    Without targets both equal 1. The generators, by number of the scan, draw the same scans as
    later synthesis does. The attribute `calibrated_to_table1` lists the rows of Table 1 that the
    surface meets by construction. Raises ValueError if an rms height would be negative.
    """
    gain, factors = np.ones_like(WAVEVECTORS), np.ones(len(generators))
    calibrated = rows_met(spectrum.attrs["calibrated_to_table1"])
    if targets is not None:
        density = spectrum_from(spectrum)
        shares = band_shares(grid)
        moments = [
            second_moments(
                [level(drawn_scan(draw(), amplified(density, share), grid)) for share in shares],
                list(targets.means),
            )
            for draw in generators.values()
        ]
        amplitudes, factors, misses = _fitted(np.array(moments), targets)
        gain = amplitudes @ shares
        met = {
            row
            for row, miss in zip(AFM_ROWS, misses, strict=True)
            if row in targets.rows and abs(miss) < TOLERANCE
        }
        calibrated = [row for row in calibrated if row in met or row not in AFM_ROWS]
    return xr.Dataset(
        {
            "gain": ("wavevector", gain, {"units": "1", "long_name": "gain of amplitudes"}),
            "factor": ("scan", factors, {"units": "1", "long_name": "factor of heights"}),
        },
        {
            "wavevector": ("wavevector", WAVEVECTORS, {"units": "rad nm-1"}),
            "scan": list(generators),
        },
        {"basis": "substitute", "calibrated_to_table1": ",".join(calibrated)},
    )
