"""Scans of one surface, conditioned together on what Table 1 says of five.

Random scans of one spectrum differ, and so do their means over a few of them. A smooth gain of the
spectrum and one factor for each scan give a group of scans exactly the mean and the standard
deviation of the rms heights, and the mean slope and curvature, that are published.

`scipy` and `xarray` are imported where they are used.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.calibration import AFM_ROWS, rows_met
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.scan_targets import Targets, group_heights
from hardcontact.surfaces.spectral_gain import BANDS, amplified, band_shares
from hardcontact.surfaces.spectrum import WAVEVECTORS, spectrum_from
from hardcontact.surfaces.substitute_scans import ScanGrid, drawn_scan
from hardcontact.surfaces.topography import level, metrics

if TYPE_CHECKING:
    import xarray as xr

__all__ = [
    "Conditioning",
    "conditioned",
    "conditioned_group",
    "second_moments",
]

#: Largest ratio of the amplitude of a band to that of the longest wavelengths, or its inverse.
LARGEST_CHANGE = 4.0

#: Relative error at which a target counts as met.
TOLERANCE = 1e-9


def second_moments(bands: Sequence[HeightMap], names: Sequence[str]) -> NDArray[np.float64]:
    """Return the matrices whose quadratic forms are the squared metrics of sums of bands.

    Parameters
    ----------
    bands : sequence of HeightMap
        Levelled, not periodic, on the same pixels.
    names : sequence of str
        Of METRICS that are root mean squares of something linear in the heights.

    Returns
    -------
    numpy.ndarray
        (names, bands, bands): metric(sum a_k h_k)² = a G a, in the squared unit of the metric.
    """

    def squares(heights: np.ndarray) -> NDArray[np.float64]:
        values = metrics(replace(bands[0], heights=heights))
        return np.array([values[name] ** 2 for name in names])

    own = [squares(band.heights) for band in bands]
    matrices = np.zeros((len(names), len(bands), len(bands)))
    for i in range(len(bands)):
        matrices[:, i, i] = own[i]
        for j in range(i):
            both = squares(bands[i].heights + bands[j].heights)
            matrices[:, i, j] = matrices[:, j, i] = (both - own[i] - own[j]) / 2
    return matrices


class Conditioning(NamedTuple):
    """What meets the targets of a group of scans.

    Attributes
    ----------
    amplitudes, factors : numpy.ndarray
        (bands,), those of the spectrum, and (scan,), those of heights, of mean one.
    misses : numpy.ndarray
        (3,), relative: mean rms height, slope and curvature over their targets, less one.
    """

    amplitudes: NDArray[np.float64]
    factors: NDArray[np.float64]
    misses: NDArray[np.float64]


def conditioned(moments: NDArray[np.float64], targets: Targets) -> Conditioning:
    """Return the amplitudes of bands and the factors of scans that meet the targets.

    The rms heights keep their order and their relative distances, and are met always. Mean slope
    and curvature are met as nearly as amplitudes within LARGEST_CHANGE allow: exactly, but for
    single scans that are far from what is expected.

    Parameters
    ----------
    moments : numpy.ndarray
        (scan, 3, bands, bands), of `second_moments` for the metrics of the targets.
    targets : Targets
        With one scan the standard deviation is left out.

    Returns
    -------
    Conditioning
        Amplitudes, factors and misses.

    Raises
    ------
    ValueError
        If an rms height would be negative.
    """
    from scipy.optimize import least_squares

    means = np.array(list(targets.means.values()))

    def measured(logs: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the metrics (scan, 3) without and the factors with which heights are met."""
        amplitudes = np.exp(np.append(0.0, logs))
        values = np.sqrt(np.einsum("smij,i,j->sm", moments, amplitudes, amplitudes))
        heights = values[:, 0]
        return values, group_heights(heights, means[0], targets.deviation) / heights

    def misses(logs: NDArray[np.float64]) -> NDArray[np.float64]:
        values, factors = measured(logs)
        return np.asarray((factors[:, None] * values).mean(axis=0) / means - 1)

    def missed(logs: NDArray[np.float64]) -> NDArray[np.float64]:
        return misses(logs)[1:]

    fit = least_squares(
        missed,
        np.zeros(BANDS - 1),
        bounds=(-np.log(LARGEST_CHANGE), np.log(LARGEST_CHANGE)),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    _, factors = measured(fit.x)
    if factors.min() <= 0:
        raise ValueError(
            f"expected rms heights above zero of {len(moments)} scans that are {means[0]:.3g} +- "
            f"{targets.deviation:.3g} nm, found one below: fewer scans deviate less"
        )
    mean = factors.mean()
    return Conditioning(mean * np.exp(np.append(0.0, fit.x)), factors / mean, misses(fit.x))


def conditioned_group(
    spectrum: "xr.Dataset",
    targets: Targets | None,
    generators: Mapping[int, Callable[[], np.random.Generator]],
    grid: ScanGrid,
) -> "xr.Dataset":
    """Return the gain of the spectrum and the factor of each scan of a group.

    Parameters
    ----------
    spectrum : xarray.Dataset
        Of `substitute_spectra.substitute_spectrum`.
    targets : Targets or None
        Of `scan_targets`; None of a surface that nothing is published of: gain and factors are one.
    generators : mapping of int to callable
        By number of the scan: returns a new generator, the one that the scan is drawn with.
    grid : ScanGrid
        Of the scans.

    Returns
    -------
    xarray.Dataset
        `gain` (wavevector) of amplitudes and `factor` (scan) of heights; in the attribute
        `calibrated_to_table1` the rows of Table 1 that the surface meets by construction.
    """
    import xarray as xr

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
        amplitudes, factors, misses = conditioned(np.array(moments), targets)
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
