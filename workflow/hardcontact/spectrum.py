"""Power spectral densities: measured, model, calibrated to published moments, joined over scales.

Conventions: C_iso = |h~|²/A in nm⁴ with h_rms² = 1/(2 pi) ∫ q C_iso dq, and C_1D = |h~|²/L in nm³
with h_rms² = (1/pi) ∫ C_1D dq; q = 2 pi/lambda in rad/nm. Source: Jacobs, Junge, Pastewka,
Surf. Topogr.: Metrol. Prop. 5 (2017) 013001.
"""

from pathlib import Path

import numpy as np
import pandas as pd
from scipy.optimize import least_squares
from scipy.special import gamma, spherical_jn
from SurfaceTopography import Topography

__all__ = [
    "WAVEVECTORS",
    "all_scales_moments",
    "as_gradient_and_half_laplacian",
    "at",
    "expected_moments",
    "from_description",
    "from_scans",
    "measure",
    "profile_from_isotropic_power_law",
]

#: The grid on which joined spectra are tabulated: 40 points a decade, wavelengths 1 mm to 0.1 nm.
WAVEVECTORS = 2 * np.pi * np.logspace(-6, 1, 281)

#: Edges of the bins of measured PSDs: ten a decade.
BIN_EDGES = 2 * np.pi * np.logspace(-5, 1, 61)


def measure(heights, pixel_size):
    """Measured PSDs of a levelled, non-periodic scan (y, x) in nm, Hann window.

    Returns wavevector (bins), C_1D along x in nm³ and C_iso in nm⁴ (bins); NaN in empty bins.
    """
    sizes = tuple(count * pixel_size for count in heights.T.shape)
    topography = Topography(np.asarray(heights, float).T, sizes, unit="nm")
    centres = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
    options = {"window": "hann", "reliable": False, "collocation": BIN_EDGES}
    densities = (
        np.asarray(density, float)
        for density in (
            topography.power_spectrum_from_profile(**options)[1],
            topography.power_spectrum_from_area(**options)[1],
        )
    )
    # The library gives 0 for a bin without a wavevector; that is no measurement.
    return centres, *(np.where(density > 0, density, np.nan) for density in densities)


def at(wavevector, table_wavevector, table_density):
    """C_iso at `wavevector` (any shape) by interpolation of a table in log q and log C.

    Constant below the table, zero above it and where the table is zero.
    """
    log_density = np.log(np.maximum(table_density, 1e-290))
    with np.errstate(divide="ignore"):
        log_wavevector = np.log(wavevector)
    return np.exp(np.interp(log_wavevector, np.log(table_wavevector), log_density, right=-np.inf))


def self_affine(wavevector, plateau, rolloff, hurst):
    """C_iso: `plateau` (nm⁴) above the roll-off wavelength (nm), (q/q_r)^(-2-2H) below it."""
    return plateau * np.maximum(wavevector * rolloff / (2 * np.pi), 1.0) ** (-2 - 2 * hurst)


def self_affine_height(plateau, rolloff, hurst):
    """rms height (nm) of `self_affine` over all scales: C_0 q_r² (1 + 1/H)/(4 pi) is its square."""
    return np.sqrt(plateau * (2 * np.pi / rolloff) ** 2 * (1 + 1 / hurst) / (4 * np.pi))


def smooth_rolloff(wavevector, plateau, rolloff, hurst):
    """C_iso: `plateau` (nm⁴) [1 + (q/q_r)²]^(-1-H), roll-off wavelength in nm."""
    return plateau * (1 + (wavevector * rolloff / (2 * np.pi)) ** 2) ** (-1 - hurst)


def profile_from_isotropic_power_law(wavevector, hurst):
    """Ratio C_1D/C_iso in 1/nm of an isotropic C_iso ∝ q^(-2-2H).

    C_1D(q_x) = (1/pi) ∫_0^∞ C_iso(sqrt(q_x² + q_y²)) dq_y, which a power law does in closed form.
    """
    return wavevector / (2 * np.sqrt(np.pi)) * gamma(hurst + 0.5) / gamma(hurst + 1)


def _profile_points(wavevector, table):
    """C_iso through measured points of C_1D; one Hurst exponent, fitted, converts them all."""
    points = np.log(2 * np.pi / table["wavelength_nm"].to_numpy(float))
    level = np.log(table["c1d_nm3"].to_numpy(float))
    hurst = (-np.polyfit(points, level, 1)[0] - 1) / 2
    order = np.argsort(points)
    profile = np.exp(_extended(np.log(wavevector), points[order], level[order]))
    return profile / profile_from_isotropic_power_law(wavevector, hurst)


def _extended(x, points, values):
    """Linear interpolation that continues its first and last segment."""
    segment = np.clip(np.searchsorted(points, x) - 1, 0, len(points) - 2)
    slope = np.diff(values)[segment] / np.diff(points)[segment]
    return values[segment] + slope * (x - points[segment])


def transfer_weights(pixels, pixel_size, window_pixels, bins=4000):
    """Weights that turn C_iso into the expected squared moments of a scan.

    A scan of `window_pixels` is cut out of a realization of `pixels` (periodic) and levelled. Its
    height variance lacks what a plane takes out of the window (Legendre functions of degree 0
    and 1, whose transforms are spherical Bessel functions); its derivatives are differences of
    neighbouring pixels. Returns wavevector (bins,) and weights (3, bins) for rms height²,
    gradient² and half-Laplacian²: moments = weights @ C_iso(wavevector).
    """
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
    kept = 1 - mean_y * mean_x - tilt_y * mean_x - mean_y * tilt_x
    radius = np.hypot(wave, half)
    radius[0, 0] = radius[0, 1]  # the mean carries no weight, and log 0 no bin
    edges = np.geomspace(radius.min() * 0.999, radius.max() * 1.001, bins + 1)
    index = np.searchsorted(edges, radius.ravel()) - 1
    area = (pixels * pixel_size) ** 2
    weights = np.array(
        [
            np.bincount(index, (count * factor).ravel(), bins) / area
            for factor in (kept, difference, difference**2 / 4)
        ]
    )
    return np.sqrt(edges[1:] * edges[:-1]), weights


def expected_moments(table_wavevector, table_density, weights):
    """Expected rms height (nm), gradient and half-Laplacian (1/nm) of a scan of that spectrum.

    weights: what `transfer_weights` returned.
    """
    wavevector, factors = weights
    return np.sqrt(factors @ at(wavevector, table_wavevector, table_density))


#: Rows of Table 1 that fix a self-affine spectrum, and those that fix the tail below it.
SELF_AFFINE_ROWS = ("afm_rms_height", "afm_rms_slope", "afm_rms_curvature", "all_rms_height")
TAIL_ROWS = ("all_rms_slope", "all_rms_curvature")


def as_gradient_and_half_laplacian(table1, slope, curvature):
    """Rows of Table 1 with slopes as rms gradients and curvatures as half rms Laplacians.

    table1: DataFrame indexed by quantity with value and uncertainty; slope: "gradient" or
    "profile", curvature: "half_laplacian" or "laplacian", what the rows are taken to be. On an
    isotropic surface the gradient is sqrt(2) times the slope of profiles.
    """
    factor = {
        "slope": {"gradient": 1.0, "profile": np.sqrt(2)}[slope],
        "curvature": {"half_laplacian": 1.0, "laplacian": 0.5}[curvature],
    }
    factors = [factor.get(quantity.rsplit("_", 1)[-1], 1.0) for quantity in table1.index]
    return table1.assign(value=table1.value * factors, uncertainty=table1.uncertainty * factors)


def calibrate_self_affine(table1, weights):
    """Plateau (nm⁴), roll-off (nm) and Hurst exponent that fit Table 1 best.

    table1: DataFrame indexed by quantity with value and uncertainty; the three moments of the
    scans and the rms height over all scales are fitted by least squares, each in units of its
    own uncertainty; weights: see `transfer_weights`.
    Raises ValueError if the fit misses one of them by more than three of its uncertainties.
    """
    wavevector, factors = weights
    value = table1.loc[list(SELF_AFFINE_ROWS), "value"].to_numpy(float)
    error = table1.loc[list(SELF_AFFINE_ROWS), "uncertainty"].to_numpy(float) / value

    def mismatch(parameters):
        shape = np.exp(parameters[0]), np.exp(parameters[1]), parameters[2]
        scan = np.sqrt(factors @ self_affine(wavevector, *shape))
        height = self_affine_height(*shape)
        return np.log(np.append(scan, height) / value) / error

    start = (2 * np.log(value[0] * 1000), np.log(1000), 0.9)
    fit = least_squares(mismatch, start, x_scale=(1, 1, 0.1), xtol=1e-12, ftol=1e-12)
    if np.abs(fit.fun).max() > 3:
        worst = int(np.abs(fit.fun).argmax())
        raise ValueError(
            f"expected Table 1 of a self-affine surface, found {SELF_AFFINE_ROWS[worst]}"
            f" = {value[worst]}, missed by {fit.fun[worst]:+.1f} of its uncertainties"
        )
    return float(np.exp(fit.x[0])), float(np.exp(fit.x[1])), float(fit.x[2])


def all_scales_moments(wavevector, density):
    """rms height (nm), gradient, half-Laplacian (1/nm) of an isotropic C_iso, all scales."""
    powers = (density * wavevector**n for n in (1, 3, 5))
    height, gradient, laplacian = (np.trapezoid(p * wavevector, np.log(wavevector)) for p in powers)
    return np.sqrt(np.array([height, gradient, laplacian / 4]) / (2 * np.pi))


def calibrate_tail(joined, start, level, gradient, half_laplacian):
    """Hurst exponent and shortest wavelength (nm) of a power law that completes a spectrum.

    joined: C_iso on WAVEVECTORS down to the wavelength `start` (nm), where it has `level` (nm⁴);
    gradient, half_laplacian: the moments over all scales that the whole shall have.
    Raises ValueError if the part above `start` already exceeds one of them.
    """
    _, gradient_above, laplacian_above = all_scales_moments(WAVEVECTORS, joined)
    missing = np.array([gradient**2 - gradient_above**2, half_laplacian**2 - laplacian_above**2])
    if missing.min() <= 0:
        raise ValueError(
            f"expected an all-scales slope and curvature above {gradient_above:.3g} "
            f"and {laplacian_above:.3g} nm-1, found {gradient} and {half_laplacian}"
        )
    first = 2 * np.pi / start

    def mismatch(parameters):
        hurst, log_last = parameters
        last = np.exp(log_last)
        wave = np.geomspace(first, last, 2000)
        tail = level * (wave / first) ** (-2 - 2 * hurst)
        _, slope, curvature = all_scales_moments(wave, tail)
        return np.log([slope, curvature]) - np.log(missing) / 2

    fit = least_squares(mismatch, (0.6, np.log(2 * np.pi / 0.3)), xtol=1e-12, ftol=1e-12)
    if np.abs(fit.fun).max() > 1e-6:
        raise ValueError(
            "expected an all-scales slope and curvature that a power law "
            f"below {start} nm can add, found {gradient} and {half_laplacian}"
        )
    return float(fit.x[0]), float(2 * np.pi / np.exp(fit.x[1]))


#: Columns of a description that hold numbers.
PARAMETERS = ("longest_nm", "shortest_nm", "plateau_nm4", "rolloff_nm", "hurst")


def from_description(path, table1, weights):
    """C_iso on WAVEVECTORS from the description of a surface, and what it was calibrated to.

    path: CSV of bands from long to short wavelengths, each with its model, parameters and basis;
    a self-affine band or a power law without Hurst exponent is calibrated to `table1` (DataFrame
    indexed by quantity with value and uncertainty); weights: see `transfer_weights`.
    Returns the density (nm⁴), the bands with all parameters filled in, and the quantities of
    Table 1 that were used.

    Raises ValueError naming the file and the band if one cannot be made.
    """
    bands = pd.read_csv(path).astype(dict.fromkeys(PARAMETERS, float))
    density, calibrated = np.zeros_like(WAVEVECTORS), []
    for i, band in bands.iterrows():
        try:
            filled, used = _calibrated(band, density, table1, weights)
            density += _band_density(filled, density, Path(path).parent)
        except (KeyError, ValueError, OSError) as error:
            raise ValueError(f"{path}: band from {band.longest_nm:g} nm: {error}") from None
        bands.loc[i] = filled
        calibrated += used
    return density, bands, calibrated


def _calibrated(band, density, table1, weights):
    """The band with its blank parameters filled in, and the rows of Table 1 that filled them."""
    if not pd.isna(band.hurst) or band.model not in ("self-affine", "power law"):
        return band, []
    if band.model == "self-affine":
        names = ("plateau_nm4", "rolloff_nm", "hurst")
        values = calibrate_self_affine(table1, weights)
        used = SELF_AFFINE_ROWS
    else:
        names = ("hurst", "shortest_nm")
        gradient, half_laplacian = table1.loc[list(TAIL_ROWS), "value"]
        values = calibrate_tail(
            density, band.longest_nm, _level_above(band, density), gradient, half_laplacian
        )
        used = TAIL_ROWS
    return pd.Series({**band, **dict(zip(names, values, strict=True))}), list(used)


def _level_above(band, density):
    """C_iso at the short end of what lies above a band."""
    return density[WAVEVECTORS < 2 * np.pi / band.longest_nm][-1]


def _band_density(band, density, folder):
    """C_iso of one band on WAVEVECTORS, zero outside it."""
    wavelength = 2 * np.pi / WAVEVECTORS
    inside = (wavelength <= band.longest_nm) & (wavelength > band.shortest_nm)
    if band.model == "self-affine":
        model = self_affine(WAVEVECTORS, band.plateau_nm4, band.rolloff_nm, band.hurst)
    elif band.model == "smooth roll-off":
        model = smooth_rolloff(WAVEVECTORS, band.plateau_nm4, band.rolloff_nm, band.hurst)
    elif band.model == "power law":
        relative = WAVEVECTORS * band.longest_nm / (2 * np.pi)
        model = _level_above(band, density) * relative ** (-2 - 2 * band.hurst)
    elif band.model == "profile":
        model = _profile_points(WAVEVECTORS, pd.read_csv(folder / band.table))
    else:
        raise ValueError(
            "expected the model self-affine, smooth roll-off, profile or power law, "
            f"found {band.model!r}"
        )
    return np.where(inside, model, 0.0)


def from_scans(wavevector, densities):
    """C_iso on WAVEVECTORS from the measured PSDs (scan, wavevector) of a surface's scans.

    Averaged over scans; constant above the largest wavelength measured, and below the smallest a
    power law through the last decade of the data.
    """
    known = np.isfinite(densities).any(axis=0)
    wave, mean = wavevector[known], np.nanmean(densities[:, known], axis=0)
    last = wave > wave[-1] / 10
    slope, level = np.polyfit(np.log(wave[last]), np.log(mean[last]), 1)
    tail = np.exp(level + slope * np.log(WAVEVECTORS))
    return np.where(wave[-1] < WAVEVECTORS, tail, at(WAVEVECTORS, wave, mean))
