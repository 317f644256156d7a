"""Condition a batch of substitute scans of one surface, so that the batch meets Table 1.

A smooth gain of amplitudes gives the batch the mean rms height, slope and curvature. A factor on
the heights of each scan gives the batch the standard deviation of rms heights. The gain is bounded,
so that a batch may miss slope or curvature.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.units import DIMENSIONLESS, RAD_PER_NM
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import metrics
from hardcontact.surfaces.spectrum import WAVEVECTORS, SpectrumFunction
from hardcontact.surfaces.substitutes import Substitute, Targets
from hardcontact.surfaces.synthesis import (
    ScanGrid,
    add_sphere_shape,
    sample_scan,
    scan_of_noise,
    white_noise_transform,
)
from hardcontact.surfaces.table1_calibration import AFM_ROWS, FIT_TOLERANCES, MET_ERROR

#: Largest ratio of the amplitudes of a component and of the first component, or its inverse.
MAX_AMPLITUDE_RATIO = 4.0


def scale_rms_heights(rms_heights: Floats, mean: float, std: float) -> Floats:
    """Return rms heights (scan,), scaled and shifted to a mean and, if several, a deviation."""
    differences = rms_heights - rms_heights.mean()
    if len(rms_heights) > 1:
        differences *= std / differences.std(ddof=1)
    return np.asarray(mean + differences)


def _component_shares(grid: ScanGrid) -> Floats:
    """Return the shares of amplitude of long, middle and short waves: (3, points of WAVEVECTORS).

    From the size of a scan to two pixels, each share gives way to the next as a squared sine.
    """
    longest, shortest = grid.size, 2 * grid.pixel_size
    log_position = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    long_step = np.sin(np.pi / 2 * np.clip(2 * log_position, 0, 1)) ** 2
    short_step = np.sin(np.pi / 2 * np.clip(2 * log_position - 1, 0, 1)) ** 2
    return np.array([1 - long_step, long_step - short_step, short_step])


def _multiply_amplitudes(spectrum: SpectrumFunction, amplitude_gain: Floats) -> SpectrumFunction:
    def multiplied_spectrum(wavevector: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            factors = np.interp(np.log(wavevector), np.log(WAVEVECTORS), amplitude_gain)
        return spectrum(wavevector) * factors**2

    return multiplied_spectrum


def _scan_components(substitute: Substitute, shares: Floats, scan_number: int) -> list[HeightMap]:
    """Return the levelled components of a scan, whose heights add up to the scan."""
    grid = substitute.grid
    rng = substitute.generator(scan_number, "scan")
    transform = white_noise_transform(rng, grid.surface_pixels)
    spectra = [_multiply_amplitudes(substitute.spectrum, share) for share in shares]
    return [level_plane(scan_of_noise(transform, spectrum, grid)) for spectrum in spectra]


def _metric_matrices(components: Sequence[HeightMap], names: Sequence[str]) -> Floats:
    """Return for each metric a matrix G: the square of the metric of a sum a_k h_k is aᵀ G a."""

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
        target = targets.means["rms_height"], targets.rms_height_std
        factors = scale_rms_heights(rms_heights, *target) / rms_heights
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
    """Return the gain of amplitudes of a batch of scans, and each scan's factor on its heights.

    Both are 1 without targets. Raises ValueError if an rms height would not be positive.
    """
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
