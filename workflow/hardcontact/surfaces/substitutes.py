"""Substitutes: random surfaces in place of surfaces of the paper that were not measured here.

A substitute gets its scans in three steps, because random scans of a spectrum that agrees with
Table 1 agree with Table 1 only on average:

1. `substitute_spectra` calibrates a spectrum, so that its scans are expected to have the values of
   Table 1: mean rms height, slope and curvature.
2. Random waves with this spectrum make a surface around each scan, and the scan is a corner of it.
   The number of the scan seeds its random numbers, so that the same scan can be made again.
3. `condition_batch` corrects what chance did to a batch, usually five scans. All scans of the batch
   get the same gain, a smooth factor on the amplitudes of waves of each wavelength. Then each scan
   gets a factor on its heights. The batch then has the values of Table 1, and the standard
   deviation of rms heights, too. It may miss slope or curvature, because the gain is bounded.

Two kinds of scans take another third step: sets (`paper.pool`) scale rms heights only, and scans
with bumps or pits (`features`) are the nearest to Table 1 of many, and are not scaled.
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

#: Largest ratio, either way, of the amplitudes of middle or short waves to those of long waves.
MAX_AMPLITUDE_RATIO = 4.0


class Targets(NamedTuple):
    """The statistics to which a batch of scans of one surface is fitted."""

    #: Mean rms height (nm), slope and curvature (1/nm) of the scans, named as in TABLE1_METRICS.
    means: Mapping[str, float]
    rms_height_std: float  #: Standard deviation of the rms heights in nm (ddof 1).
    #: Those of AFM_ROWS whose published value is the target; other targets are expected values.
    published_rows: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Substitute:
    """A substitute: its spectrum, its published statistics, and the grid of its scans."""

    surface: str
    spectrum_data: xr.Dataset  #: Its calibrated spectrum, from `substitute_spectrum`.
    table1: pd.DataFrame  #: Its rows of Table 1, from `rows_of_surface`.
    constants: pd.DataFrame  #: Numbers of the paper, from `read_constants`.
    grid: ScanGrid  #: Pixels and size of its scans.
    seed: int  #: Seed of the study.

    def generator(self, *names: object) -> np.random.Generator:
        """Return the random generator of one sampled quantity of the surface."""
        return generator(self.seed, self.surface, *names)

    @cached_property
    def spectrum(self) -> Spectrum:
        """The calibrated C_iso."""
        return spectrum_of_dataset(self.spectrum_data)

    @property
    def calibrated_rows(self) -> list[str]:
        """Rows of Table 1 on which the spectrum is calibrated, of scans and over all scales."""
        return str(self.spectrum_data.attrs["table1_rows_met"]).split(",")

    @cached_property
    def targets(self) -> Targets | None:
        """Targets of scans on the study's pixels; None if no rms height is published.

        A target is the published value if the spectrum is calibrated on that row of Table 1, and if
        the row holds on the study's pixels. The rms height holds for scans as wide as the paper's,
        because smaller pixels hardly add to it. Slope and curvature need the paper's pixels, too.
        Any other target is the expected value of scans with this spectrum. The standard deviation
        of rms heights has the same ratio to their mean as in Table 1.
        """
        if "afm_rms_height" not in self.table1.index:
            return None
        paper_constants = self.constants["value"]
        same_size = math.isclose(self.grid.size, paper_constants["scan_size"])
        same_pixels = same_size and self.grid.pixels == paper_constants["scan_pixels"]
        holds_on_grid = dict(zip(AFM_ROWS, (same_size, same_pixels, same_pixels), strict=True))
        published_rows = [row for row in self.calibrated_rows if holds_on_grid.get(row)]
        rms_values = self._expected_rms(same_pixels)
        for row in published_rows:
            rms_values[AFM_ROWS.index(row)] = self.table1["value"][row]
        height_row = self.table1.loc["afm_rms_height"]
        return Targets(
            means=dict(zip(TABLE1_METRICS.values(), rms_values.tolist(), strict=True)),
            rms_height_std=float(rms_values[0] * height_row["uncertainty"] / height_row["value"]),
            published_rows=tuple(published_rows),
        )

    def _expected_rms(self, has_paper_pixels: bool) -> Floats:
        """Return the expected rms height (nm), slope and curvature (1/nm) of its scans: (3,)."""
        if has_paper_pixels:  # `substitute_spectrum` computes them for these pixels.
            return np.array(self.spectrum_data.attrs["expected_scan_rms"])
        # Waves up to four times the scan's width change its heights, although it is levelled.
        weights = scan_rms_weights(4 * self.grid.pixels, self.grid.pixel_size, self.grid.pixels)
        return expected_scan_rms(self.spectrum, weights)


def read_substitute(
    surface: str, paths: Sequence[str], grid: Mapping[str, Any], seed: int
) -> Substitute:
    """Read a substitute from the paths of its spectrum, of Table 1 and of the paper's constants."""
    spectrum_path, table1_path, constants_path = paths
    table1 = published.rows_of_surface(published.read_table1(table1_path), surface)
    constants = published.read_constants(constants_path)
    spectrum_data = read_dataset(spectrum_path)
    return Substitute(surface, spectrum_data, table1, constants, ScanGrid(**grid), seed)


def required_targets(substitute: Substitute) -> Targets:
    """Return the targets of a substitute; raises ValueError if it has no published rms height."""
    if substitute.targets is None:
        raise ValueError(
            f"{substitute.surface}: expected afm_rms_height in resources/paper/table1.csv, "
            "found none"
        )
    return substitute.targets


def scale_rms_heights(rms_heights: Floats, mean: float, std: float) -> Floats:
    """Return rms heights (scan,) with a given mean and, if there are several, a given deviation.

    Their order and the ratios of their differences stay. For example, 8 and 12 nm become 16.5 and
    23.5 nm for a mean of 20 nm and a deviation of 5 nm.
    """
    differences = rms_heights - rms_heights.mean()
    if len(rms_heights) > 1:
        differences *= std / differences.std(ddof=1)
    return np.asarray(mean + differences)


def _component_shares(grid: ScanGrid) -> Floats:
    """Return the shares of long, middle and short waves in amplitudes at WAVEVECTORS: (3, points).

    Waves as wide as the scan or wider are all long, waves of two pixels or less all short. Waves of
    the geometric mean of both wavelengths are all middle. Elsewhere two shares add up to 1.
    """
    longest, shortest = grid.size, 2 * grid.pixel_size
    log_position = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    # Each share gives way to the next as a squared sine.
    middle_step = np.sin(np.pi / 2 * np.clip(2 * log_position, 0, 1)) ** 2
    short_step = np.sin(np.pi / 2 * np.clip(2 * log_position - 1, 0, 1)) ** 2
    return np.array([1 - middle_step, middle_step - short_step, short_step])


def _multiply_amplitudes(spectrum: SpectrumFunction, amplitude_gain: Floats) -> SpectrumFunction:
    """Return the spectrum of waves whose amplitudes are multiplied by a gain on WAVEVECTORS."""

    def multiplied_spectrum(wavevector: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            factors = np.interp(np.log(wavevector), np.log(WAVEVECTORS), amplitude_gain)
        return spectrum(wavevector) * factors**2

    return multiplied_spectrum


def _scan_components(substitute: Substitute, shares: Floats, scan_number: int) -> list[HeightMap]:
    """Return the long, middle and short waves of a scan, levelled: its components.

    They add up to the levelled scan that `conditioned_scan` makes without gain and factor.
    """
    grid = substitute.grid
    rng = substitute.generator(scan_number, "scan")
    transform = white_noise_transform(rng, grid.surface_pixels)
    spectra = [_multiply_amplitudes(substitute.spectrum, share) for share in shares]
    return [level_plane(scan_of_noise(transform, spectrum, grid)) for spectrum in spectra]


def _metric_matrices(components: Sequence[HeightMap], names: Sequence[str]) -> Floats:
    """Return a matrix G for each metric of a scan: (metric, component, component).

    If the amplitudes of the components are multiplied by a, the squared metric becomes aᵀ G a. So a
    fit of a makes no new scans. For heights h_i and h_j of two components, G_ii is the squared
    metric of h_i. G_ij is half of what the squared metric of h_i + h_j has beyond G_ii + G_jj.
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


class _BatchFit(NamedTuple):
    """What makes the scans of a batch meet their targets."""

    amplitudes: Floats  #: Factors (component,) on the amplitudes of long, middle and short waves.
    factors: Floats  #: Factors (scan,) on the heights of each scan, of mean 1.
    #: Errors (3,) of mean rms height, slope and curvature, relative to their targets.
    mean_errors: Floats


def _fit_batch(matrices: Floats, targets: Targets) -> _BatchFit:
    """Fit the amplitudes of components and the factors of scans to the targets of a batch.

    The `matrices` (scan, metric, component, component) are those of `_metric_matrices`. Two numbers
    are searched, the amplitudes of middle and of short waves relative to long waves, because two
    targets need a search, slope and curvature. The rms heights need none, because factors give them
    any mean and deviation. For each try,

    1. the matrices give the rms height, slope and curvature of each scan;
    2. factors give the rms heights their targets: if scans of 8 and 12 nm need 16.5 and 23.5 nm,
       the factors are 2.06 and 1.96. They scale slope and curvature, too;
    3. the mean slope and curvature then have errors, which the search makes zero, or as small as
       MAX_AMPLITUDE_RATIO permits.

    At the end the mean of the factors moves into the amplitudes of all three components, because
    it changes all scans alike.
    """
    target_means = np.array(list(targets.means.values()))

    def errors_and_factors(log_ratios: Floats) -> tuple[Floats, Floats]:
        amplitudes = np.exp(np.append(0.0, log_ratios))
        scan_rms = np.sqrt(np.einsum("smij,i,j->sm", matrices, amplitudes, amplitudes))
        rms_heights = scan_rms[:, 0]
        target_heights = scale_rms_heights(rms_heights, target_means[0], targets.rms_height_std)
        factors = target_heights / rms_heights
        return (factors[:, None] * scan_rms).mean(axis=0) / target_means - 1, factors

    def slope_and_curvature_errors(log_ratios: Floats) -> Floats:
        mean_errors, _ = errors_and_factors(log_ratios)
        return mean_errors[1:]

    bound = np.log(MAX_AMPLITUDE_RATIO)
    fit = scipy.optimize.least_squares(
        slope_and_curvature_errors, np.zeros(2), bounds=(-bound, bound), **FIT_TOLERANCES
    )
    mean_errors, factors = errors_and_factors(fit.x)
    mean_factor = factors.mean()
    amplitudes = mean_factor * np.exp(np.append(0.0, fit.x))
    return _BatchFit(amplitudes, factors / mean_factor, mean_errors)


def condition_batch(
    substitute: Substitute, targets: Targets | None, scan_numbers: Sequence[int]
) -> xr.Dataset:
    """Return the gain and factors with which the scans of a batch meet their targets.

    ``amplitude_gain`` (wavevector) multiplies the amplitudes of waves in all scans, ``factor``
    (scan) the heights of each. Without targets all are 1. ``table1_rows_met`` names the rows of
    Table 1 that the scans meet, and rows over all scales that the spectrum meets.
    """
    amplitude_gain = np.ones_like(WAVEVECTORS)
    factors = np.ones(len(scan_numbers))
    met_rows = substitute.calibrated_rows
    if targets is not None:
        shares = _component_shares(substitute.grid)
        matrices = [
            _metric_matrices(_scan_components(substitute, shares, number), list(targets.means))
            for number in scan_numbers
        ]
        amplitudes, factors, mean_errors = _fit_batch(np.array(matrices), targets)
        if factors.min() <= 0:
            raise ValueError(
                f"{substitute.surface}: expected rms heights above zero of {len(factors)} "
                f"scans with the mean {targets.means['rms_height']:.3g} nm and the standard "
                f"deviation {targets.rms_height_std:.3g} nm, found one of zero or below: use fewer "
                "scans of this surface, whose rms heights differ less"
            )
        amplitude_gain = amplitudes @ shares
        is_met = dict(zip(AFM_ROWS, np.abs(mean_errors) < MET_ERROR, strict=True))
        met_rows = [
            row
            for row in substitute.calibrated_rows
            if row not in AFM_ROWS or (row in targets.published_rows and is_met[row])
        ]
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
