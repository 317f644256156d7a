"""Spectra of substitutes from descriptions: bands of wavelengths, each with its model.

Parameters that a description leaves blank are calibrated to the paper's Table 1: scans of the
spectrum have its rms height, slope and curvature.
"""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.surfaces.spectrum import (
    AFM_ROWS,
    CALIBRATED,
    MODELS,
    TAIL_ROWS,
    WAVEVECTORS,
    Density,
    Floats,
    Spectrum,
    all_scales_moments,
    continued,
    power_law_tail,
    profile_points,
    read_bands,
    share_of_cells,
    spectrum_dataset,
)

#: Wavevectors (bins,) in rad/nm, and the weights (3, bins) of C_iso at them.
Weights = tuple[Floats, Floats]
#: Bins of wavevectors in which weights are added up, and rows that are added at a time.
BINS, ROWS = 4000, 512
#: Relative error at which a number of Table 1 counts as met.
TOLERANCE = 1e-9
#: Parameters that are calibrated, by model, and those that are searched by their logarithms.
SEARCHED = {
    "self-affine": ("plateau_nm4", "rolloff_nm", "hurst"),
    "varying Hurst": ("plateau_nm4", "hurst", "hurst_change"),
}
LOGARITHMIC = ("plateau_nm4", "rolloff_nm")
#: Hurst exponents between which that of a tail is sought.
TAIL_HURST = (-6.0, 5.0)


def transfer_weights(pixels: int, pixel_size: float, window_pixels: int) -> Weights:
    """Return wavevectors (bins,) in rad/nm and weights (3, bins): moments = weights @ C_iso.

    The moments are the expected squares of a scan: rms height², gradient² and half-Laplacian². The
    scan is cut out of a larger periodic surface, of `pixels` of a size in nm, and levelled, which
    removes what a plane fits (Legendre functions of degree 0 and 1, whose transforms are spherical
    Bessel functions).
    """
    from scipy.special import spherical_jn

    wave = 2 * np.pi * np.abs(np.fft.fftfreq(pixels, pixel_size))
    half = wave[: pixels // 2 + 1]
    count = np.where((half == 0) | (half == half.max()), 1.0, 2.0)
    shortest = np.hypot(wave.max(), half.max())
    edges = np.geomspace(half[1] * 0.999, shortest * 1.001, BINS + 1)
    # Along one axis: the shares that mean and tilt fit, and the squared difference.
    phase = wave * window_pixels * pixel_size / 2
    mean, tilt = spherical_jn(0, phase) ** 2, 3 * spherical_jn(1, phase) ** 2
    difference = (2 * np.sin(wave * pixel_size / 2) / pixel_size) ** 2
    along = slice(0, len(half))
    weights = np.zeros((3, BINS))
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        mean_y, tilt_y, difference_y = (factor[rows, None] for factor in (mean, tilt, difference))
        fitted = mean_y * mean[along] + tilt_y * mean[along] + mean_y * tilt[along]
        laplacian = difference_y + difference[along]
        radius = np.hypot(wave[rows, None], half)
        if start == 0:
            radius[0, 0] = half[1]  # the mean carries no weight, and log 0 no bin
        index = np.searchsorted(edges, radius.ravel()) - 1
        for k, factor in enumerate((1 - fitted, laplacian, laplacian**2 / 4)):
            weights[k] += np.bincount(index, (count * factor).ravel(), BINS)
    return np.sqrt(edges[1:] * edges[:-1]), weights / (pixels * pixel_size) ** 2


def expected_moments(density: Density, weights: Weights) -> Floats:
    """Return the expected rms height (nm), gradient and half-Laplacian (1/nm) of a scan: (3,)."""
    wavevector, factors = weights
    return np.sqrt(factors @ density(wavevector))


def rows_of_surface(table1: pd.DataFrame, surface: str, slope: str, curvature: str) -> pd.DataFrame:
    """Return Table 1 of a surface, slopes as rms gradients, curvatures as half rms Laplacians.

    The slope of `published.table1` is read as ``"gradient"`` or ``"profile"`` (smaller by sqrt(2)
    on an isotropic surface), its curvature as ``"half_laplacian"`` or ``"laplacian"``. The rows,
    value and uncertainty by quantity, are empty for other surfaces.
    """
    rows = table1[table1["surface"] == surface].set_index("quantity")
    factor = {
        "slope": {"gradient": 1.0, "profile": np.sqrt(2)}[slope],
        "curvature": {"half_laplacian": 1.0, "laplacian": 0.5}[curvature],
    }
    factors = [factor.get(quantity.rsplit("_", 1)[-1], 1.0) for quantity in rows.index]
    return rows.assign(value=rows["value"] * factors, uncertainty=rows["uncertainty"] * factors)


def calibrate_model(band: pd.Series, table1: pd.DataFrame, weights: Weights) -> dict[str, float]:
    """Return the parameters that give scans of a band of a model of SEARCHED their Table 1.

    Raises ValueError if no such spectrum has the three moments.
    """
    from scipy.optimize import least_squares

    model, names = MODELS[band.model]
    searched = SEARCHED[band.model]
    values = table1.loc[list(AFM_ROWS), "value"].to_numpy(float)

    def parameters(solution: Floats) -> dict[str, float]:
        return {
            name: np.exp(value) if name in LOGARITHMIC else value
            for name, value in zip(searched, solution, strict=True)
        }

    def mismatch(solution: Floats) -> Floats:
        band_parameters = dict(band) | parameters(solution)
        table = Spectrum(
            WAVEVECTORS, model(WAVEVECTORS, *(band_parameters[name] for name in names))
        )
        return np.asarray(np.log(expected_moments(table, weights) / values))

    start = {
        "plateau_nm4": 2 * np.log(values[0] * 1000),
        "rolloff_nm": np.log(1000.0),
        "hurst": 0.9,
        "hurst_change": 0.0,
    }
    fit = least_squares(
        mismatch,
        [start[name] for name in searched],
        x_scale=(1, 0.3, 0.3),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    if np.abs(fit.fun).max() > TOLERANCE:
        worst = int(np.abs(fit.fun).argmax())
        raise ValueError(
            "expected three numbers of Table 1 that a spectrum of this model has, found "
            f"{AFM_ROWS[worst]} = {values[worst]:.3g}, missed by {100 * fit.fun[worst]:+.1f} %"
        )
    return {name: float(value) for name, value in parameters(fit.x).items()}


def calibrate_tail(above: Floats, gradient: float, half_laplacian: float) -> tuple[float, float]:
    """Return Hurst exponent and shortest wavelength (nm) of a power law that ends a spectrum.

    The spectrum `above` (nm⁴ on WAVEVECTORS) is zero below the wavelength where the power law
    begins; gradient and half-Laplacian (1/nm) are those over all scales of both. Raises ValueError
    if no power law adds the missing part of both.
    """
    from scipy.optimize import brentq

    _, *moments_above = all_scales_moments(Spectrum(WAVEVECTORS, above))
    missing = [gradient**2 - moments_above[0] ** 2, half_laplacian**2 - moments_above[1] ** 2]
    ends = 2 * np.pi / WAVEVECTORS[above.nonzero()[0][-1] + 1 :]
    refusal = ValueError(
        f"expected an all-scales slope and curvature that a power law below {ends[0]:.3g} nm can "
        f"add, found {gradient} and {half_laplacian}"
    )
    if min(missing) <= 0:
        raise refusal

    def excess(moment: int, hurst: float, shortest: float) -> float:
        tail = power_law_tail(above, hurst, shortest)
        added = all_scales_moments(Spectrum(WAVEVECTORS, tail))[1 + moment]
        return float(np.log(added**2 / missing[moment]))

    def hurst_of(shortest: float) -> float:
        return float(brentq(lambda hurst: excess(0, hurst, shortest), *TAIL_HURST, xtol=1e-14))

    # Of the tails that add the gradient, those that end later add more to the half-Laplacian.
    possible = [
        end for end in ends if excess(0, TAIL_HURST[0], end) > 0 > excess(0, TAIL_HURST[1], end)
    ]
    excesses = [excess(1, hurst_of(end), end) for end in possible]
    if not excesses or not excesses[0] < 0 < excesses[-1]:
        raise refusal
    shortest = brentq(
        lambda end: excess(1, hurst_of(end), end), possible[0], possible[-1], xtol=1e-14
    )
    return hurst_of(shortest), float(shortest)


def from_description(
    path: str | Path, table1: pd.DataFrame, weights: Weights
) -> tuple[Floats, pd.DataFrame, list[str]]:
    """Return C_iso (nm⁴) on WAVEVECTORS, its bands with all parameters, rows of Table 1 used.

    The file is a CSV of bands from long to short wavelengths, each with its model, parameters and
    basis. A band of CALIBRATED without Hurst exponent is calibrated to the rows of Table 1 from
    `rows_of_surface`. Raises ValueError that names the file and the band that cannot be made.
    """
    bands = read_bands(path)
    density, calibrated = np.zeros_like(WAVEVECTORS), list[str]()
    for i, band in bands.iterrows():
        try:
            if pd.isna(band.hurst) and band.model in CALIBRATED:
                if band.model in MODELS:
                    parameters = calibrate_model(band, table1, weights)
                else:
                    hurst, shortest = calibrate_tail(density, *table1.loc[list(TAIL_ROWS), "value"])
                    parameters = {"hurst": hurst, "shortest_nm": shortest}
                band = pd.Series(dict(band) | parameters)
                calibrated += CALIBRATED[band.model]
            density += _band_density(band, density, Path(path).parent)
        except (KeyError, ValueError, OSError) as error:
            raise ValueError(f"{path}: band from {band.longest_nm:g} nm: {error}") from None
        bands.loc[i] = band
    last = bands.iloc[-1]
    if last.model == "power law":
        density *= share_of_cells(last.shortest_nm)
    return density, bands, calibrated


def _band_density(band: pd.Series, above: Floats, folder: Path) -> Floats:
    """Return C_iso of one band on WAVEVECTORS, zero outside it."""
    if band.model == "power law":
        return continued(above, band.hurst) * (share_of_cells(band.shortest_nm) > 0)
    if band.model == "profile":
        columns = ["wavelength_nm", "c1d_nm3"]
        points = pd.read_csv(folder / band.table, usecols=columns, dtype=float)[columns]
        wavelengths, profile = points.to_numpy().T
        model = profile_points(WAVEVECTORS, wavelengths, profile)
    else:
        density, parameters = MODELS[band.model]
        model = density(WAVEVECTORS, *(band[name] for name in parameters))
    wavelength = 2 * np.pi / WAVEVECTORS
    return np.where((wavelength <= band.longest_nm) & (wavelength > band.shortest_nm), model, 0.0)


def described_rms_height(path: str | Path, longest: float) -> float:
    """Return the rms height (nm) of the waves up to a wavelength (nm), from a description alone.

    The description leaves no parameters to Table 1.
    """
    no_weights = np.empty(0), np.empty((3, 0))
    density, _, _ = from_description(path, pd.DataFrame(), no_weights)
    short_enough = 2 * np.pi / WAVEVECTORS <= longest
    return float(all_scales_moments(Spectrum(WAVEVECTORS, density * short_enough))[0])


def substitute_spectrum(
    description: str | Path, table1: pd.DataFrame, constants: pd.DataFrame
) -> xr.Dataset:
    """Return the spectrum of a substitute from a description.

    Table 1, from `rows_of_surface` or empty, is for scans of the paper's pixels and size, which the
    constants have. Attributes are the bands, the rows of Table 1 that they were calibrated to, and
    the expected moments of a scan of the paper.
    """
    window = int(constants["value"]["scan_pixels"])
    weights = transfer_weights(4 * window, constants["value"]["scan_size"] / window, window)
    density, bands, calibrated = from_description(description, table1, weights)
    return spectrum_dataset(density).assign_attrs(
        basis="substitute",
        calibrated_to_table1=",".join(calibrated),
        bands=bands.to_csv(index=False),
        expected_scan_moments=expected_moments(Spectrum(WAVEVECTORS, density), weights),
    )
