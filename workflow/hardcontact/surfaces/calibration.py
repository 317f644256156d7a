"""Calibration to the paper's Table 1: what a scan of a spectrum would show, and fits to it.

`scipy` is imported where it is used, because the configuration reads the names of rows here.
"""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from hardcontact.surfaces import spectrum
from hardcontact.surfaces.spectrum import WAVEVECTORS, Density, Spectrum

__all__ = [
    "SELF_AFFINE_ROWS",
    "TAIL_ROWS",
    "Weights",
    "calibrate_self_affine",
    "calibrate_tail",
    "expected_moments",
    "rows_of_surface",
    "transfer_weights",
]

#: Rows of Table 1 that fix a self-affine spectrum, and those that fix the tail below it.
SELF_AFFINE_ROWS = ("afm_rms_height", "afm_rms_slope", "afm_rms_curvature", "all_rms_height")
TAIL_ROWS = ("all_rms_slope", "all_rms_curvature")

#: Wavevectors (bins,) in rad/nm, and the weights (3, bins) of C_iso at them.
Weights = tuple[NDArray[np.float64], NDArray[np.float64]]

#: Bins of wavevectors in which weights are added up.
BINS = 4000


def transfer_weights(pixels: int, pixel_size: float, window_pixels: int) -> Weights:
    """Return weights that turn C_iso into the expected squared moments of a scan.

    The scan is cut out of a larger periodic surface and levelled. Levelling takes from its
    height variance what a plane fits (Legendre functions of degree 0 and 1, whose transforms are
    spherical Bessel functions); its derivatives are differences of neighbouring pixels.

    Parameters
    ----------
    pixels, window_pixels : int
        Along an edge of the surface, and of the scan.
    pixel_size : float
        In nm.

    Returns
    -------
    wavevector : numpy.ndarray
        (bins,) in rad/nm.
    weights : numpy.ndarray
        (3, bins) for rms height², gradient² and half-Laplacian²:
        moments = weights @ C_iso(wavevector).
    """
    from scipy.special import spherical_jn

    wave = 2 * np.pi * np.fft.fftfreq(pixels, pixel_size)[:, None]
    half = np.abs(wave[: pixels // 2 + 1].T)
    count = np.where((half == 0) | (half == half.max()), 1.0, 2.0)
    difference = sum((2 * np.sin(q * pixel_size / 2) / pixel_size) ** 2 for q in (wave, half))
    mean_y, mean_x = (
        spherical_jn(0, q * window_pixels * pixel_size / 2) ** 2 for q in (np.abs(wave), half)
    )
    tilt_y, tilt_x = (
        3 * spherical_jn(1, q * window_pixels * pixel_size / 2) ** 2 for q in (np.abs(wave), half)
    )
    levelled = 1 - mean_y * mean_x - tilt_y * mean_x - mean_y * tilt_x
    radius = np.hypot(wave, half)
    radius[0, 0] = radius[0, 1]  # the mean carries no weight, and log 0 no bin
    edges = np.geomspace(radius.min() * 0.999, radius.max() * 1.001, BINS + 1)
    index = np.searchsorted(edges, radius.ravel()) - 1
    area = (pixels * pixel_size) ** 2
    weights = np.array(
        [
            np.bincount(index, (count * factor).ravel(), BINS) / area
            for factor in (levelled, difference, difference**2 / 4)
        ]
    )
    return np.sqrt(edges[1:] * edges[:-1]), weights


def expected_moments(density: Density, weights: Weights) -> NDArray[np.float64]:
    """Return the expected rms height (nm), gradient and half-Laplacian (1/nm) of a scan: (3,)."""
    wavevector, factors = weights
    return np.sqrt(factors @ density(wavevector))


def rows_of_surface(table1: pd.DataFrame, surface: str, slope: str, curvature: str) -> pd.DataFrame:
    """Return Table 1 of a surface, slopes as rms gradients, curvatures as half rms Laplacians.

    On an isotropic surface the gradient is sqrt(2) times the slope of profiles.

    Parameters
    ----------
    table1 : pandas.DataFrame
        Of `published.table1`.
    surface : str
        Its name in the table.
    slope, curvature : str
        What the rows are taken to be: ``"gradient"`` or ``"profile"``, ``"half_laplacian"`` or
        ``"laplacian"``.

    Returns
    -------
    pandas.DataFrame
        Indexed by quantity, with value and uncertainty; empty for another surface.
    """
    rows = table1[table1["surface"] == surface].set_index("quantity")
    factor = {
        "slope": {"gradient": 1.0, "profile": np.sqrt(2)}[slope],
        "curvature": {"half_laplacian": 1.0, "laplacian": 0.5}[curvature],
    }
    factors = [factor.get(quantity.rsplit("_", 1)[-1], 1.0) for quantity in rows.index]
    return rows.assign(value=rows["value"] * factors, uncertainty=rows["uncertainty"] * factors)


def calibrate_self_affine(table1: pd.DataFrame, weights: Weights) -> tuple[float, float, float]:
    """Return plateau (nm⁴), roll-off (nm) and Hurst exponent that fit Table 1 best.

    The three moments of the scans and the rms height over all scales are fitted by least
    squares, each in units of its own uncertainty.

    Parameters
    ----------
    table1 : pandas.DataFrame
        Of `rows_of_surface`.
    weights : Weights
        Of `transfer_weights`.

    Returns
    -------
    tuple of float
        Parameters of `spectrum.self_affine`.

    Raises
    ------
    ValueError
        If the fit misses one of the numbers by more than three of its uncertainties.
    """
    from scipy.optimize import least_squares

    wavevector, factors = weights
    value = table1.loc[list(SELF_AFFINE_ROWS), "value"].to_numpy(float)
    error = table1.loc[list(SELF_AFFINE_ROWS), "uncertainty"].to_numpy(float) / value

    def mismatch(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        shape = np.exp(parameters[0]), np.exp(parameters[1]), parameters[2]
        scan = np.sqrt(factors @ spectrum.self_affine(wavevector, *shape))
        height = spectrum.self_affine_height(*shape)
        return np.asarray(np.log(np.append(scan, height) / value) / error)

    start = (2 * np.log(value[0] * 1000), np.log(1000), 0.9)
    fit = least_squares(mismatch, start, x_scale=(1, 1, 0.1), xtol=1e-12, ftol=1e-12)
    if np.abs(fit.fun).max() > 3:
        worst = int(np.abs(fit.fun).argmax())
        raise ValueError(
            f"expected Table 1 of a self-affine surface, found {SELF_AFFINE_ROWS[worst]}"
            f" = {value[worst]}, missed by {fit.fun[worst]:+.1f} of its uncertainties"
        )
    return float(np.exp(fit.x[0])), float(np.exp(fit.x[1])), float(fit.x[2])


def calibrate_tail(
    above: NDArray[np.float64], start: float, level: float, moments: tuple[float, float]
) -> tuple[float, float]:
    """Return Hurst exponent and shortest wavelength (nm) of a power law that ends a spectrum.

    Parameters
    ----------
    above : numpy.ndarray
        C_iso in nm⁴ on WAVEVECTORS, down to the wavelength `start`.
    start : float
        Wavelength in nm at which the power law begins.
    level : float
        C_iso in nm⁴ there.
    moments : tuple of float
        Gradient and half-Laplacian (1/nm) over all scales of the whole spectrum.

    Returns
    -------
    tuple of float
        Hurst exponent and wavelength in nm.

    Raises
    ------
    ValueError
        If the part above `start` already exceeds one of the moments, or no power law adds them.
    """
    from scipy.optimize import least_squares

    gradient, half_laplacian = moments
    _, *moments_above = spectrum.all_scales_moments(Spectrum(WAVEVECTORS, above))
    missing = np.array(
        [whole**2 - part**2 for whole, part in zip(moments, moments_above, strict=True)]
    )
    if missing.min() <= 0:
        raise ValueError(
            f"expected an all-scales slope and curvature above {moments_above[0]:.3g} "
            f"and {moments_above[1]:.3g} nm-1, found {gradient} and {half_laplacian}"
        )
    first = 2 * np.pi / start

    def mismatch(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        hurst, log_last = parameters
        wave = np.geomspace(first, np.exp(log_last), 2000)
        tail = Spectrum(wave, level * (wave / first) ** (-2 - 2 * hurst))
        return np.asarray(np.log(spectrum.all_scales_moments(tail)[1:]) - np.log(missing) / 2)

    fit = least_squares(mismatch, (0.6, np.log(2 * np.pi / 0.3)), xtol=1e-12, ftol=1e-12)
    if np.abs(fit.fun).max() > 1e-6:
        raise ValueError(
            "expected an all-scales slope and curvature that a power law "
            f"below {start} nm can add, found {gradient} and {half_laplacian}"
        )
    return float(fit.x[0]), float(2 * np.pi / np.exp(fit.x[1]))
