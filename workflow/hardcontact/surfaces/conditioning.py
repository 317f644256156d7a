"""Substitute scans of one surface, conditioned together on Table 1.

A smooth gain of the amplitudes and one factor for each scan give a group of random scans exactly
the published mean and standard deviation of rms heights, and mean slope and curvature.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base import dataset, published
from hardcontact.base.arrays import Floats
from hardcontact.base.random import generator
from hardcontact.base.units import DIMENSIONLESS, RAD_PER_NM
from hardcontact.surfaces.descriptions import AFM_ROWS
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    SpectrumFunction,
    spectrum_of_dataset,
)
from hardcontact.surfaces.substitute_spectra import MET_ERROR, expected_scan_rms, transfer_weights
from hardcontact.surfaces.synthesis import (
    ScanGrid,
    add_sphere,
    sample_scan,
    scan_of_noise,
    white_noise,
)

#: Number of components of the gain, one for each AFM row of Table 1. The amplitudes of the second
#: and the third component relative to the first are fitted.
COMPONENT_COUNT = 3
#: Largest ratio of the amplitudes of a component and of the first component, or its inverse.
MAX_AMPLITUDE_RATIO = 4.0


class Targets(NamedTuple):
    """The statistics that a group of scans of one surface meets."""

    means: Mapping[str, float]  #: Mean height, slope and curvature, by `metrics.METRICS`.
    rms_height_std: float  #: Standard deviation of the rms heights in nm (ddof 1).
    met_rows: tuple[str, ...]  #: Names of the rows of Table 1 that these targets meet.


@dataclass(frozen=True, eq=False)
class Substitute:
    """Everything from which the scans of a substitute are made."""

    surface: str  #: Name of the surface.
    spectrum_data: xr.Dataset  #: Its calibrated spectrum.
    table1: pd.DataFrame  #: From `rows_of_surface`.
    constants: pd.DataFrame  #: From `read_constants`.
    grid: ScanGrid
    seed: int  #: Seed of the study.

    def generator(self, *names: object) -> np.random.Generator:
        """Return the random generator of one sampled quantity of the surface."""
        return generator(self.seed, self.surface, *names)

    @cached_property
    def spectrum(self) -> Spectrum:
        """The calibrated C_iso."""
        return spectrum_of_dataset(self.spectrum_data)

    @cached_property
    def targets(self) -> Targets | None:
        """The targets of scans on the study's pixels; None if no rms height is published.

        On the paper's pixels and size, rows to which the spectrum is calibrated are taken from
        Table 1. Other targets are what the spectrum gives on average.
        """
        if "afm_rms_height" not in self.table1.index:
            return None
        grid, paper_grid = self.grid, self.constants["value"]
        same_size = math.isclose(grid.size, paper_grid["scan_size"])
        same_pixels = same_size and grid.pixels == paper_grid["scan_pixels"]
        rms_values = np.array(self.spectrum_data.attrs["expected_scan_rms"])
        if not same_pixels:
            weights = transfer_weights(4 * grid.pixels, grid.pixel_size, grid.pixels)
            rms_values = expected_scan_rms(self.spectrum, weights)
        calibrated_rows = published.rows_met(self.spectrum_data.attrs["table1_rows_met"])
        met_rows = []
        for i, (row, is_published) in enumerate(
            zip(AFM_ROWS, (same_size, same_pixels, same_pixels), strict=True)
        ):
            if is_published and row in calibrated_rows:
                rms_values[i] = self.table1.loc[row, "value"]
                met_rows.append(row)
        height = self.table1.loc["afm_rms_height"]
        return Targets(
            dict(zip(TABLE1_METRICS.values(), rms_values.tolist(), strict=True)),
            float(rms_values[0] * height["uncertainty"] / height["value"]),
            tuple(met_rows),
        )


def read_substitute(surface: str, paths: Any, grid: Mapping[str, Any], seed: int) -> Substitute:
    """Read what the scans of a substitute are made of.

    `paths` has the attributes `spectrum`, `published_table1` and `published_constants`; `grid`
    has the fields of a `ScanGrid`.
    """
    spectrum_data = dataset.read(paths.spectrum)
    table1 = published.rows_of_surface(published.read_table1(paths.published_table1), surface)
    constants = published.read_constants(paths.published_constants)
    return Substitute(surface, spectrum_data, table1, constants, ScanGrid(**grid), seed)


def required_targets(substitute: Substitute) -> Targets:
    """Return the targets of a substitute; raises ValueError if it has no published rms height."""
    if substitute.targets is None:
        raise ValueError(f"{substitute.surface}: expected a published rms height, found none")
    return substitute.targets


def scale_rms_heights(rms_heights: Floats, mean: float, std: float) -> Floats:
    """Return rms heights (scan,) in nm, scaled and shifted to a mean and a standard deviation.

    The heights keep their order and relative distances. A single scan gets the mean. The deviation
    has ddof 1.
    """
    differences = rms_heights - rms_heights.mean()
    if len(rms_heights) > 1:
        differences *= std / differences.std(ddof=1)
    return np.asarray(mean + differences)


def component_shares(grid: ScanGrid) -> Floats:
    """Return the shares of amplitude of three smooth components: (3, points of WAVEVECTORS).

    They add up to one. Towards shorter wavelengths each component gives way to the next as sin²,
    linear in the logarithm of wavelength: the first to the second between the size L of a scan and
    sqrt(2 p L), then to the third at 2 p; p is the width of a pixel.
    """
    longest, shortest = grid.size, 2 * grid.pixel_size
    log_position = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    long_step = np.sin(np.pi / 2 * np.clip(2 * log_position, 0, 1)) ** 2
    short_step = np.sin(np.pi / 2 * np.clip(2 * log_position - 1, 0, 1)) ** 2
    return np.array([1 - long_step, long_step - short_step, short_step])


def multiply_amplitudes(spectrum: SpectrumFunction, amplitude_gain: Floats) -> SpectrumFunction:
    """Return a spectrum whose amplitudes are multiplied by a gain, and C_iso by its square.

    The gain (points of WAVEVECTORS) is interpolated between them.
    """

    def amplified_spectrum(wavevector: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            factors = np.interp(np.log(wavevector), np.log(WAVEVECTORS), amplitude_gain)
        return spectrum(wavevector) * factors**2

    return amplified_spectrum


def metric_matrices(components: Sequence[HeightMap], names: Sequence[str]) -> Floats:
    """Return a matrix G for each metric (metric, component, component), in its unit squared.

    The squared metric of the sum of a_k h_k is aᵀ G a, where h_k are the levelled components. The
    names are `metrics.METRICS` whose square is quadratic in the heights.
    """

    def squared_metrics(heights: np.ndarray) -> Floats:
        scan_metrics = metrics(replace(components[0], heights=heights))
        return np.array([scan_metrics[name] ** 2 for name in names])

    count = len(components)
    squares = [squared_metrics(component.heights) for component in components]
    matrices = np.zeros((len(names), count, count))
    for i in range(count):
        matrices[:, i, i] = squares[i]
        for j in range(i):
            square_of_sum = squared_metrics(components[i].heights + components[j].heights)
            matrices[:, i, j] = matrices[:, j, i] = (square_of_sum - squares[i] - squares[j]) / 2
    return matrices


def _fit_group(matrices: Floats, targets: Targets) -> tuple[Floats, Floats, Floats]:
    """Return amplitudes (component,), factors of heights (scan,), relative errors of means (3,).

    `matrices` (scan, metric, component, component) come from `metric_matrices`.
    """
    from scipy.optimize import least_squares

    means = np.array(list(targets.means.values()))

    def errors_and_factors(log_amplitudes: Floats) -> tuple[Floats, Floats]:
        """Return the errors (3,), and the factors (scan,) that give scans their rms heights."""
        amplitudes = np.exp(np.append(0.0, log_amplitudes))
        scan_rms = np.sqrt(np.einsum("smij,i,j->sm", matrices, amplitudes, amplitudes))
        rms_heights = scan_rms[:, 0]
        factors = scale_rms_heights(rms_heights, means[0], targets.rms_height_std) / rms_heights
        return (factors[:, None] * scan_rms).mean(axis=0) / means - 1, factors

    def slope_and_curvature_errors(log_amplitudes: Floats) -> Floats:
        return errors_and_factors(log_amplitudes)[0][1:]

    fit = least_squares(
        slope_and_curvature_errors,
        np.zeros(COMPONENT_COUNT - 1),
        bounds=(-np.log(MAX_AMPLITUDE_RATIO), np.log(MAX_AMPLITUDE_RATIO)),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    mean_errors, factors = errors_and_factors(fit.x)
    if factors.min() <= 0:
        raise ValueError(
            f"expected rms heights above zero of {len(matrices)} scans with the mean "
            f"{means[0]:.3g} nm and the deviation {targets.rms_height_std:.3g} nm, found one of "
            "zero or below: use fewer scans of this surface, whose rms heights deviate less"
        )
    # The mean factor goes into the gain, so that the factors of the scans have the mean 1.
    mean_factor = factors.mean()
    return mean_factor * np.exp(np.append(0.0, fit.x)), factors / mean_factor, mean_errors


def condition_group(
    substitute: Substitute, targets: Targets | None, scans: Sequence[int]
) -> xr.Dataset:
    """Return the gain of amplitudes of a group of scans, and the factor of heights of each scan.

    ``amplitude_gain`` (wavevector) and ``factor`` (scan) are 1 without targets. The attribute
    ``table1_rows_met`` lists the rows met by construction. Raises ValueError if an rms height would
    be negative.
    """
    grid = substitute.grid
    amplitude_gain = np.ones_like(WAVEVECTORS)
    factors = np.ones(len(scans))
    met_rows = published.rows_met(substitute.spectrum_data.attrs["table1_rows_met"])
    if targets is not None:
        shares = component_shares(grid)
        spectra = [multiply_amplitudes(substitute.spectrum, share) for share in shares]
        matrices = []
        for scan in scans:
            noise = white_noise(substitute.generator(scan, "scan"), grid.surface_pixels)
            components = [level(scan_of_noise(noise, spectrum, grid)) for spectrum in spectra]
            matrices.append(metric_matrices(components, list(targets.means)))
        amplitudes, factors, mean_errors = _fit_group(np.array(matrices), targets)
        amplitude_gain = amplitudes @ shares
        rows_within_tolerance = {
            row
            for row, error in zip(AFM_ROWS, mean_errors, strict=True)
            if row in targets.met_rows and abs(error) < MET_ERROR
        }
        met_rows = [row for row in met_rows if row in rows_within_tolerance or row not in AFM_ROWS]
    return xr.Dataset(
        {
            "amplitude_gain": ("wavevector", amplitude_gain, DIMENSIONLESS),
            "factor": ("scan", factors, DIMENSIONLESS),
        },
        {"wavevector": ("wavevector", WAVEVECTORS, RAD_PER_NM), "scan": list(scans)},
        {"source": "substitute", "table1_rows_met": ",".join(met_rows)},
    )


def conditioned_scan(
    substitute: Substitute, scan: int, conditioning: xr.Dataset, sphere_radius: float | None = None
) -> HeightMap:
    """Return a scan, by its number, with the gain and its factor from `condition_group`.

    `sphere_radius` is the radius in nm of a sphere that the scan shows; None for a flat surface.
    """
    rng = substitute.generator(scan, "scan")
    spectrum = multiply_amplitudes(substitute.spectrum, conditioning["amplitude_gain"].values)
    factor = conditioning["factor"].sel(scan=scan).item()
    flat_scan = sample_scan(rng, spectrum, substitute.grid, factor)
    return flat_scan if sphere_radius is None else add_sphere(rng, flat_scan, sphere_radius)


def conditioned_group(
    substitute: Substitute, scans: Sequence[int], sphere_radius: float | None
) -> tuple[xr.Dataset, list[HeightMap]]:
    """Return the conditioning of a group of scans, by their numbers, and these scans.

    `sphere_radius` is as in `conditioned_scan`.
    """
    conditioning = condition_group(substitute, substitute.targets, scans)
    return conditioning, [
        conditioned_scan(substitute, scan, conditioning, sphere_radius) for scan in scans
    ]
