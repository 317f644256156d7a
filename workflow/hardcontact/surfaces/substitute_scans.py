"""Substitute scans: cut out of random surfaces, flat or of the sphere, of any skewness."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.lib.stride_tricks import sliding_window_view

from hardcontact.surfaces.height_map import HeightMap, level, skewness_and_kurtosis
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import Density, Floats
from hardcontact.surfaces.synthesis import random_surface


class ScanGrid(NamedTuple):
    """The pixels and size of substitute scans."""

    pixels: int  #: Along an edge.
    size: float  #: Edge of a scan in nm.
    realization_pixels: int  #: Along an edge of the random surfaces that scans are cut out of.

    @property
    def pixel_size(self) -> float:
        """Edge of a pixel in nm."""
        return self.size / self.pixels


def substitute_scan(surface: HeightMap, pixels: int, factor: float = 1.0) -> HeightMap:
    """Return the corner (pixels, pixels) of a periodic surface, its heights times a factor."""
    heights = factor * surface.heights[:pixels, :pixels].astype(float)
    return replace(surface, heights=heights, periodic=False)


def drawn_scan(rng: np.random.Generator, density: Density, grid: ScanGrid) -> HeightMap:
    """Return a scan as it is drawn: the corner of a random surface of C_iso `density` in nm⁴."""
    surface = random_surface(rng, grid.realization_pixels, grid.pixel_size, density)
    return substitute_scan(surface, grid.pixels)


def sphere_scan(rng: np.random.Generator, roughness: HeightMap, radius: float) -> HeightMap:
    """Return a scan of a sphere of a radius in nm, its apex within the middle half of the scan."""
    apex = rng.uniform(-0.25, 0.25, 2) * roughness.size
    y, x = (
        (np.arange(roughness.pixels) + 0.5) * roughness.pixel_size - roughness.size / 2 - shift
        for shift in apex
    )
    heights = roughness.heights - (y[:, None] ** 2 + x**2) / (2 * radius)
    return replace(roughness, heights=heights)


def synthesized_scan(
    rng: np.random.Generator,
    density: Density,
    grid: ScanGrid,
    factor: float = 1.0,
    *,
    sphere_radius: float | None = None,
    skewness: float = 0.0,
) -> xr.Dataset:
    """Return a substitute scan as SurfaceTopography reads it from a file.

    Parameters
    ----------
    rng : numpy.random.Generator
        Of everything that is random in the scan.
    density, factor : callable, float
        C_iso in nm⁴, and the factor of the heights.
    grid : ScanGrid
        Of the scan.
    sphere_radius : float or None
        Of the sphere that the scan shows, in nm.
    skewness : float
        Of the heights; a skewed scan has the rms height of the Gaussian one.

    Returns
    -------
    xarray.Dataset
        `heights` (x, y) in nm, in float64, for a file in netCDF's classic format.
    """
    surface = random_surface(rng, grid.realization_pixels, grid.pixel_size, density)
    scan = substitute_scan(surface, grid.pixels, factor)
    if skewness:
        surface = skewed_surface(surface, skewness)
        skewed = substitute_scan(surface, grid.pixels, factor)
        factor *= float(level(scan).heights.std() / level(skewed).heights.std())
        scan = substitute_scan(surface, grid.pixels, factor)
    if sphere_radius is not None:
        scan = sphere_scan(rng, scan, sphere_radius)
    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    axis = {"length": scan.size, "unit": "nm", "units": "nm", "periodic": np.int32(scan.periodic)}
    return xr.Dataset(
        {"heights": (("x", "y"), scan.heights.T, {"unit": "nm", "units": "nm"})},
        {"x": ("x", position, axis), "y": ("y", position, axis)},
        {"basis": "substitute: synthesised, not measured"},
    )


def as_measurement(synthesized: xr.Dataset, path: str) -> Measurement:
    """Return a synthesized scan as `read_measurement` reads it from its file, in less time."""
    heights = synthesized["heights"].values.T
    pixel_size = float(synthesized["x"].attrs["length"] / len(heights))
    return Measurement(path, "", "Default", "nm", "map", heights, pixel_size, None, (), 0)


#: Radius of the paraboloid that tops are rounded with, times the rms half-Laplacian. A fit to one
#: AFM scan of UNCD (10 µm, 19.5 nm pixels), whose forces and summits it reproduces.
BLUNTNESS = 0.9
#: How often tops are rounded, heights remapped and amplitudes restored: a part of the same fit.
ROUNDS = 10
#: Depth of the paraboloid over the rms height: a deeper one changes forces by some 2 %.
DEPTH = 2.0
#: Intervals of heights in which their distribution is counted, and of its probabilities.
INTERVALS = 4096


def skewed_surface(surface: HeightMap, skewness: float) -> HeightMap:
    """Return a surface with the same spectrum, heights of given skewness and blunt tops.

    In turn tops are rounded by an opening with a paraboloid, heights are remapped in order to a
    Pearson III distribution, and the Fourier amplitudes restored: the amplitude-adjusted surrogate
    of Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635, whose summits would be sharp. The
    skewness of the whole surface, -1 to 1, is met to some 5 %. Heights are in float64.
    """
    from scipy import fft

    heights: Floats = surface.heights.astype(float)
    amplitude, deviation = np.abs(fft.rfft2(heights)), heights.std()
    neighbours = sum(np.roll(heights, step, axis) for step in (-1, 1) for axis in (0, 1))
    laplacian = np.sqrt(((neighbours - 4 * heights) ** 2).mean()) / surface.pixel_size**2
    radius = BLUNTNESS / (laplacian / 2)
    reach = min(np.sqrt(2 * radius * DEPTH * deviation), surface.size / 2)
    pixels = int(reach / surface.pixel_size)
    depth = (np.arange(pixels + 1.0) * surface.pixel_size) ** 2 / (2 * radius)
    aimed = skewness
    for _ in range(ROUNDS):
        remapped = _remapped(_opened(heights, depth), aimed, deviation)
        transform = fft.rfft2(remapped)
        size = np.abs(transform)
        transform *= np.divide(amplitude, size, out=np.zeros_like(size), where=size > 0)
        heights = fft.irfft2(transform, s=heights.shape)
        aimed += skewness - skewness_and_kurtosis(heights)[0]
    return replace(surface, heights=heights)


def _opened(heights: Floats, depth: Floats) -> Floats:
    """Return periodic heights lowered to the reach of a paraboloid that slides below them."""
    eroded = _eroded(_eroded(heights, depth, 1), depth, 0)
    return -_eroded(_eroded(-eroded, depth, 1), depth, 0)


#: Lines that are taken together where a parabola slides along them: their heights stay in cache.
LINES = 64


def _eroded(heights: Floats, depth: Floats, axis: int) -> Floats:
    """Return `scipy.ndimage.grey_erosion` by a parabola along an axis, in less time."""
    lines, reach = heights.swapaxes(axis, 1), len(depth) - 1
    lowest = np.empty_like(lines)
    for start in range(0, len(lines), LINES):
        wide = np.pad(lines[start : start + LINES], ((0, 0), (reach, reach)), "wrap")
        shifted = sliding_window_view(wide, lines.shape[1], axis=1)
        eroded = shifted[:, reach].copy()
        for step in range(1, reach + 1):
            nearest = np.minimum(shifted[:, reach - step], shifted[:, reach + step])
            nearest += depth[step]
            np.minimum(eroded, nearest, out=eroded)
        lowest[start : start + LINES] = eroded
    return lowest.swapaxes(axis, 1)


def _remapped(heights: Floats, skewness: float, deviation: float) -> Floats:
    """Return heights in the same order with a Pearson III distribution of mean zero.

    New heights are a continuous function of those before: ranks would break ties by rounding.
    """
    from scipy.special import gammaincinv

    probability = np.linspace(0, 1, INTERVALS + 1)[1:-1]
    rate = 2 / skewness if skewness else 1e5  # as good as normal
    tail = probability if rate > 0 else 1 - probability
    pearson3 = gammaincinv(rate**2, tail) / rate - rate**2 / rate
    counts, edges = np.histogram(heights, INTERVALS)
    share = np.append(0, counts.cumsum()) / heights.size
    quantiles = np.interp(share, probability, pearson3)
    return np.asarray(deviation * np.interp(heights, edges, quantiles))
