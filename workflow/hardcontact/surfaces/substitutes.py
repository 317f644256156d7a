"""Substitutes: random surfaces in place of surfaces of the paper that were not measured here.

A substitute has a spectrum calibrated on Table 1, a grid of scans, and targets for batches of its
scans. A smooth gain of amplitudes gives a batch the mean rms height, slope and curvature. A factor
on the heights of each scan gives the batch the standard deviation of rms heights. A batch may miss
slope or curvature because the gain is bounded.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import scipy
import xarray as xr

from hardcontact.base import published
from hardcontact.base.arrays import Floats, generator
from hardcontact.base.dataset import read_dataset
from hardcontact.base.units import DIMENSIONLESS, RAD_PER_NM
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    SpectrumFunction,
    spectrum_of_dataset,
)
from hardcontact.surfaces.substitute_spectra import (
    AFM_ROWS,
    FIT_TOLERANCES,
    MET_ERROR,
    expected_scan_rms,
    scan_rms_weights,
)
from hardcontact.surfaces.synthesis import (
    ScanGrid,
    add_sphere_shape,
    sample_scan,
    scan_of_noise,
    white_noise_transform,
)

#: Largest ratio, either way, of the gains of long and of middle or short waves.
MAX_AMPLITUDE_RATIO = 4.0


class Targets(NamedTuple):
    """The statistics to which a batch of scans of one surface is fitted."""

    means: Mapping[str, float]  #: Mean rms height (nm), slope, curvature (1/nm), by TABLE1_METRICS.
    rms_height_std: float  #: Standard deviation of the rms heights in nm (ddof 1).
    met_rows: tuple[str, ...]  #: Names of the rows of Table 1 that the means equal.


@dataclass(frozen=True, eq=False)
class Substitute:
    """A substitute: its spectrum, its published statistics, and the grid of its scans."""

    surface_name: str
    spectrum_data: xr.Dataset  #: Its calibrated spectrum, from `substitute_spectrum`.
    table1: pd.DataFrame  #: Its rows of Table 1, from `rows_of_surface`.
    constants: pd.DataFrame  #: Numbers of the paper, from `read_constants`.
    grid: ScanGrid  #: Pixels and size of its scans.
    seed: int  #: Seed of the study.

    def generator(self, *names: object) -> np.random.Generator:
        """Return the random generator of one sampled quantity of the surface."""
        return generator(self.seed, self.surface_name, *names)

    @cached_property
    def spectrum(self) -> Spectrum:
        """The calibrated C_iso."""
        return spectrum_of_dataset(self.spectrum_data)

    @cached_property
    def targets(self) -> Targets | None:
        """Targets of scans on the study's pixels; None if no rms height is published.

        Calibrated rows of Table 1 give the rms height of scans of the paper's size, and slope and
        curvature if the pixels are the paper's, too. Other means follow from the spectrum.
        """
        if "afm_rms_height" not in self.table1.index:
            return None
        grid = self.grid
        paper_constants = self.constants["value"]
        same_size = math.isclose(grid.size, paper_constants["scan_size"])
        same_pixels = same_size and grid.pixels == paper_constants["scan_pixels"]
        rms_values = np.array(self.spectrum_data.attrs["expected_scan_rms"])
        if not same_pixels:
            # Waves up to four times the scan's width change its heights, although it is levelled.
            weights = scan_rms_weights(4 * grid.pixels, grid.pixel_size, grid.pixels)
            rms_values = expected_scan_rms(self.spectrum, weights)
        calibrated_rows = self.spectrum_data.attrs["table1_rows_met"].split(",")
        holds_on_grid = dict(zip(AFM_ROWS, (same_size, same_pixels, same_pixels), strict=True))
        met_rows = [row for row in AFM_ROWS if holds_on_grid[row] and row in calibrated_rows]
        for row in met_rows:
            rms_values[AFM_ROWS.index(row)] = self.table1.loc[row, "value"]
        height_row = self.table1.loc["afm_rms_height"]
        return Targets(
            means=dict(zip(TABLE1_METRICS.values(), rms_values.tolist(), strict=True)),
            rms_height_std=float(rms_values[0] * height_row["uncertainty"] / height_row["value"]),
            met_rows=tuple(met_rows),
        )


def read_substitute(
    surface_name: str, paths: Sequence[str], grid: Mapping[str, Any], seed: int
) -> Substitute:
    """Read a substitute from the paths of its spectrum, of Table 1 and of the paper's constants."""
    spectrum_path, table1_path, constants_path = paths
    table1 = published.rows_of_surface(published.read_table1(table1_path), surface_name)
    constants = published.read_constants(constants_path)
    spectrum_data = read_dataset(spectrum_path)
    return Substitute(surface_name, spectrum_data, table1, constants, ScanGrid(**grid), seed)


def required_targets(substitute: Substitute) -> Targets:
    """Return the targets of a substitute; raises ValueError if it has no published rms height."""
    if substitute.targets is None:
        raise ValueError(
            f"{substitute.surface_name}: expected afm_rms_height in resources/paper/table1.csv, "
            "found none"
        )
    return substitute.targets


def scale_rms_heights(rms_heights: Floats, mean: float, std: float) -> Floats:
    """Return rms heights (scan,), scaled and shifted to a mean and, if several, a deviation."""
    differences = rms_heights - rms_heights.mean()
    if len(rms_heights) > 1:
        differences *= std / differences.std(ddof=1)
    return np.asarray(mean + differences)


def _component_shares(grid: ScanGrid) -> Floats:
    """Return the shares of long, middle and short waves in amplitudes: (3, points)."""
    longest, shortest = grid.size, 2 * grid.pixel_size
    log_position = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    # Each share gives way to the next as a squared sine.
    long_step = np.sin(np.pi / 2 * np.clip(2 * log_position, 0, 1)) ** 2
    short_step = np.sin(np.pi / 2 * np.clip(2 * log_position - 1, 0, 1)) ** 2
    return np.array([1 - long_step, long_step - short_step, short_step])


def _multiply_amplitudes(spectrum: SpectrumFunction, amplitude_gain: Floats) -> SpectrumFunction:
    """Return the spectrum of waves whose amplitudes are multiplied by a gain on WAVEVECTORS."""

    def multiplied_spectrum(wavevector: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            factors = np.interp(np.log(wavevector), np.log(WAVEVECTORS), amplitude_gain)
        return spectrum(wavevector) * factors**2

    return multiplied_spectrum


def _scan_components(substitute: Substitute, shares: Floats, scan_number: int) -> list[HeightMap]:
    """Return the long, middle and short waves of a scan, levelled; they add up to the scan."""
    grid = substitute.grid
    rng = substitute.generator(scan_number, "scan")
    transform = white_noise_transform(rng, grid.surface_pixels)
    spectra = [_multiply_amplitudes(substitute.spectrum, share) for share in shares]
    return [level_plane(scan_of_noise(transform, spectrum, grid)) for spectrum in spectra]


def _metric_matrices(components: Sequence[HeightMap], names: Sequence[str]) -> Floats:
    """Return a matrix G for each metric: on heights Σ a_k h_k its square is aᵀ G a.

    With these matrices a fit of the amplitudes a needs no new scans.
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


def _fit_batch(matrices: Floats, targets: Targets) -> tuple[Floats, Floats, Floats]:
    """Return the amplitudes (component,) and factors (scan,) that make scans meet their targets.

    Also returns the relative errors (3,) of the mean rms height, slope and curvature. The
    `matrices` are (scan, metric, component, component).
    """
    means = np.array(list(targets.means.values()))

    def errors_and_factors(log_amplitudes: Floats) -> tuple[Floats, Floats]:
        amplitudes = np.exp(np.append(0.0, log_amplitudes))
        scan_rms = np.sqrt(np.einsum("smij,i,j->sm", matrices, amplitudes, amplitudes))
        rms_heights = scan_rms[:, 0]
        scaled_rms_heights = scale_rms_heights(rms_heights, means[0], targets.rms_height_std)
        factors = scaled_rms_heights / rms_heights
        return (factors[:, None] * scan_rms).mean(axis=0) / means - 1, factors

    def slope_and_curvature_errors(log_amplitudes: Floats) -> Floats:
        mean_errors, _ = errors_and_factors(log_amplitudes)
        return mean_errors[1:]

    bound = np.log(MAX_AMPLITUDE_RATIO)
    fit = scipy.optimize.least_squares(
        slope_and_curvature_errors, np.zeros(2), bounds=(-bound, bound), **FIT_TOLERANCES
    )
    mean_errors, factors = errors_and_factors(fit.x)
    mean_factor = factors.mean()
    amplitudes = mean_factor * np.exp(np.append(0.0, fit.x))
    return amplitudes, factors / mean_factor, mean_errors


def condition_batch(
    substitute: Substitute, targets: Targets | None, scan_numbers: Sequence[int]
) -> xr.Dataset:
    """Return the gain of amplitudes of a batch of scans, and each scan's factor on its heights."""
    amplitude_gain = np.ones_like(WAVEVECTORS)
    factors = np.ones(len(scan_numbers))
    met_rows = substitute.spectrum_data.attrs["table1_rows_met"].split(",")
    if targets is not None:
        shares = _component_shares(substitute.grid)
        matrices = [
            _metric_matrices(_scan_components(substitute, shares, number), list(targets.means))
            for number in scan_numbers
        ]
        amplitudes, factors, mean_errors = _fit_batch(np.array(matrices), targets)
        if factors.min() <= 0:
            raise ValueError(
                f"{substitute.surface_name}: expected rms heights above zero of {len(factors)} "
                f"scans with the mean {targets.means['rms_height']:.3g} nm and the standard "
                f"deviation {targets.rms_height_std:.3g} nm, found one of zero or below: use fewer "
                "scans of this surface, whose rms heights differ less"
            )
        amplitude_gain = amplitudes @ shares
        missed_rows = {
            row
            for row, error in zip(AFM_ROWS, mean_errors, strict=True)
            if row not in targets.met_rows or abs(error) >= MET_ERROR
        }
        met_rows = [row for row in met_rows if row not in missed_rows]
    return xr.Dataset(
        {
            "amplitude_gain": ("wavevector", amplitude_gain, DIMENSIONLESS),
            "factor": ("scan", factors, DIMENSIONLESS),
        },
        {"wavevector": ("wavevector", WAVEVECTORS, RAD_PER_NM), "scan": list(scan_numbers)},
        {"source": "substitute", "table1_rows_met": ",".join(met_rows)},
    )


def conditioned_scan(
    substitute: Substitute,
    scan_number: int,
    conditioning: xr.Dataset,
    sphere_radius: float | None = None,
) -> HeightMap:
    """Return a conditioned scan: flat, or of a sphere if a radius (nm) is given."""
    rng = substitute.generator(scan_number, "scan")
    spectrum = _multiply_amplitudes(substitute.spectrum, conditioning["amplitude_gain"].values)
    factor = conditioning["factor"].sel(scan=scan_number).item()
    flat_scan = sample_scan(rng, spectrum, substitute.grid, factor)
    return flat_scan if sphere_radius is None else add_sphere_shape(rng, flat_scan, sphere_radius)
