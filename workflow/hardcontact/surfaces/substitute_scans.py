"""Substitute scans: cut out of random surfaces, with the spread of scans, flat or of the sphere.

`scipy` and `xarray` are imported where they are used.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Density, Spectrum
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.surfaces.topography import level

if TYPE_CHECKING:
    import xarray as xr

__all__ = [
    "scan_to_scan_spread",
    "skewed_surface",
    "sphere_scan",
    "substitute_scan",
    "synthesized_scan",
]

#: Random surfaces from whose windows the scan-to-scan spread is computed.
REALIZATIONS = 4

#: How often `skewed_surface` remaps heights and restores amplitudes.
REMAPPINGS = 20


def skewed_surface(surface: HeightMap, skewness: float) -> HeightMap:
    """Return a surface with a Pearson III height distribution and the spectrum it had.

    Heights are remapped by rank and the Fourier amplitudes restored, in turn, until both hold
    (amplitude-adjusted surrogate; Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635). The
    last step restores the amplitudes, so the spectrum is exact and the distribution nearly so.

    Parameters
    ----------
    surface : HeightMap
        Periodic.
    skewness : float
        Of the distribution of heights.

    Returns
    -------
    HeightMap
        Heights in float64.
    """
    from scipy import fft
    from scipy.stats import pearson3

    heights = surface.heights.astype(float)
    amplitude = np.abs(fft.rfft2(heights))
    probability = np.linspace(0, 1, 4097)[1:-1]
    rank = (np.arange(heights.size) + 0.5) / heights.size
    quantiles = np.interp(rank, probability, pearson3.ppf(probability, skewness))
    quantiles *= surface.heights.std()
    for _ in range(REMAPPINGS):
        remapped = np.empty(heights.size)
        remapped[np.argsort(heights, axis=None)] = quantiles
        transform = fft.rfft2(remapped.reshape(heights.shape))
        size = np.abs(transform)
        transform *= np.divide(amplitude, size, out=np.zeros_like(size), where=size > 0)
        heights = fft.irfft2(transform, s=heights.shape)
    return replace(surface, heights=heights)


def _levelled_windows(surface: HeightMap, pixels: int) -> list[HeightMap]:
    """Return all windows of a surface that do not overlap, each levelled."""
    starts = [i * pixels for i in range(surface.pixels // pixels)]
    return [
        level(replace(surface, heights=surface.heights[y : y + pixels, x : x + pixels]))
        for y in starts
        for x in starts
    ]


def scan_to_scan_spread(
    rng: np.random.Generator,
    pixels: int,
    pixel_size: float,
    window_pixels: int,
    density: Density,
    relative_uncertainty: float,
) -> float:
    """Return the shape of the amplitude factor that widens the spread of scans to a published one.

    Windows of one random surface already differ; the log-normal factor adds what is missing to
    the published relative uncertainty of the rms height.

    Parameters
    ----------
    rng : numpy.random.Generator
        Of the random surfaces.
    pixels, window_pixels : int
        Along an edge of a random surface, and of a scan.
    pixel_size : float
        In nm.
    density : callable
        C_iso in nm⁴ as a function of the wavevector in rad/nm.
    relative_uncertainty : float
        Of the rms height, as published.

    Returns
    -------
    float
        Standard deviation of the logarithm of the factor; zero if scans differ enough.
    """
    rms_heights = [
        window.heights.std()
        for _ in range(REALIZATIONS)
        for window in _levelled_windows(
            random_surface(rng, pixels, pixel_size, density), window_pixels
        )
    ]
    missing = np.log1p(relative_uncertainty**2) - np.log(rms_heights).var(ddof=1)
    return float(np.sqrt(max(missing, 0.0)))


def substitute_scan(
    rng: np.random.Generator,
    surface: HeightMap,
    pixels: int,
    skewness: float = 0.0,
    spread: float = 0.0,
) -> HeightMap:
    """Return a scan that is cut out of a larger random surface.

    Parameters
    ----------
    rng : numpy.random.Generator
        Of the amplitude factor: the generator that the surface was drawn from.
    surface : HeightMap
        Periodic.
    pixels : int
        Along an edge of the scan.
    skewness : float
        Of the heights of the surface; zero leaves them as they are.
    spread : float
        Log-normal shape of the amplitude factor, whose mean is one.

    Returns
    -------
    HeightMap
        Not periodic; heights (pixels, pixels) in float64.
    """
    if skewness:
        surface = skewed_surface(surface, skewness)
    factor = np.exp(spread * rng.standard_normal() - spread**2 / 2)
    return replace(surface, heights=factor * surface.heights[:pixels, :pixels], periodic=False)


def sphere_scan(rng: np.random.Generator, roughness: HeightMap, radius: float) -> HeightMap:
    """Return a scan of the top of a sphere: its shape and its roughness.

    The apex lies somewhere within the middle half of the scan.

    Parameters
    ----------
    rng : numpy.random.Generator
        Of the position of the apex.
    roughness : HeightMap
        Of the sphere.
    radius : float
        Of the sphere in nm.

    Returns
    -------
    HeightMap
        On the pixels of the roughness.
    """
    apex = rng.uniform(-0.25, 0.25, 2) * roughness.size
    y, x = (
        (np.arange(roughness.pixels) + 0.5) * roughness.pixel_size - roughness.size / 2 - shift
        for shift in apex
    )
    heights = roughness.heights - (y[:, None] ** 2 + x**2) / (2 * radius)
    return replace(roughness, heights=heights)


def synthesized_scan(
    rng: np.random.Generator,
    description: "xr.Dataset",
    pixels: int,
    size: float,
    realization_pixels: int,
    sphere_radius: float | None = None,
) -> "xr.Dataset":
    """Return a substitute scan as SurfaceTopography reads it from a file.

    Parameters
    ----------
    rng : numpy.random.Generator
        Of everything that is random in the scan.
    description : xarray.Dataset
        Of `substitute_spectra.substitute_spectrum`.
    pixels, realization_pixels : int
        Along an edge of the scan, and of the random surface that it is cut out of.
    size : float
        Edge of the scan in nm.
    sphere_radius : float or None
        In nm, of a scan of the sphere; None of a flat surface.

    Returns
    -------
    xarray.Dataset
        `heights` (x, y) in nm, in float64, for a file in netCDF's classic format.
    """
    density = Spectrum(description["wavevector"].values, description["spectrum"].values)
    surface = random_surface(rng, realization_pixels, size / pixels, density)
    scan = substitute_scan(
        rng, surface, pixels, description.attrs["skewness"], description.attrs["spread"]
    )
    if sphere_radius is not None:
        scan = sphere_scan(rng, scan, sphere_radius)
    return _classic_dataset(scan)


def _classic_dataset(scan: HeightMap) -> "xr.Dataset":
    """Return a scan as SurfaceTopography reads it from classic netCDF; the first axis is x."""
    import xarray as xr

    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    axis = {"length": scan.size, "unit": "nm", "units": "nm", "periodic": np.int32(scan.periodic)}
    return xr.Dataset(
        {"heights": (("x", "y"), scan.heights.T, {"unit": "nm", "units": "nm"})},
        {"x": ("x", position, axis), "y": ("y", position, axis)},
        {"basis": "substitute: synthesised, not measured"},
    )
