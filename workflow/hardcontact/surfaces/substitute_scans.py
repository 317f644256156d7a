"""Substitute scans, cut out of random surfaces: of a flat surface or a sphere, of any skewness."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.lib.stride_tricks import sliding_window_view

from hardcontact.surfaces.height_map import HeightMap, level, skewness_and_kurtosis
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import Floats, SpectrumFunction
from hardcontact.surfaces.synthesis import random_surface


class ScanGrid(NamedTuple):
    """The pixels and size of substitute scans."""

    pixels: int  #: Pixels along a side of a scan.
    size: float  #: Side of a scan in nm.
    realization_pixels: int  #: Pixels along a side of the random surfaces.

    @property
    def pixel_size(self) -> float:
        """Side of a pixel in nm."""
        return self.size / self.pixels


def cut_scan(surface: HeightMap, pixels: int, factor: float = 1.0) -> HeightMap:
    """Return the corner (pixels, pixels) of a periodic surface, with heights times a factor."""
    heights = factor * surface.heights[:pixels, :pixels].astype(float)
    return replace(surface, heights=heights, periodic=False)


def sample_scan(rng: np.random.Generator, density: SpectrumFunction, grid: ScanGrid) -> HeightMap:
    """Sample a scan: the corner of a random surface with C_iso `density` in nm⁴."""
    surface = random_surface(rng, grid.realization_pixels, grid.pixel_size, density)
    return cut_scan(surface, grid.pixels)


def add_sphere(rng: np.random.Generator, roughness: HeightMap, radius: float) -> HeightMap:
    """Return a scan of a rough sphere (radius in nm), its apex within the middle half."""
    apex = rng.uniform(-0.25, 0.25, 2) * roughness.size
    position = (np.arange(roughness.pixels) + 0.5) * roughness.pixel_size - roughness.size / 2
    y, x = position - apex[0], position - apex[1]
    heights = roughness.heights - (y[:, None] ** 2 + x**2) / (2 * radius)
    return replace(roughness, heights=heights)


def synthesize_scan(
    rng: np.random.Generator,
    density: SpectrumFunction,
    grid: ScanGrid,
    factor: float = 1.0,
    *,
    sphere_radius: float | None = None,
    skewness: float = 0.0,
) -> xr.Dataset:
    """Return a substitute scan in the format that SurfaceTopography reads from a file.

    density: c_iso in nm⁴ of wavevectors in rad/nm.
    grid: pixels and size of the scan.
    sphere_radius: radius in nm of the sphere that the scan shows; None for a flat surface.
    skewness: skewness of the heights; a skewed scan has the rms height of the Gaussian scan.
    Returns `heights` (x, y) in nm, in float64, for a file in netCDF's classic format.
    """
    surface = random_surface(rng, grid.realization_pixels, grid.pixel_size, density)
    scan = cut_scan(surface, grid.pixels, factor)
    if skewness:
        surface = skew_surface(surface, skewness)
        skewed = cut_scan(surface, grid.pixels, factor)
        factor *= float(level(scan).heights.std() / level(skewed).heights.std())
        scan = cut_scan(surface, grid.pixels, factor)
    if sphere_radius is not None:
        scan = add_sphere(rng, scan, sphere_radius)
    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    axis = {"length": scan.size, "unit": "nm", "units": "nm", "periodic": np.int32(scan.periodic)}
    return xr.Dataset(
        {"heights": (("x", "y"), scan.heights.T, {"unit": "nm", "units": "nm"})},
        {"x": ("x", position, axis), "y": ("y", position, axis)},
        {"basis": "substitute: synthesised, not measured"},
    )


def convert_to_measurement(synthesized: xr.Dataset, path: str) -> Measurement:
    """Return a synthesized scan as a measurement, equal to reading its file but faster.

    synthesized: from `synthesize_scan`.
    Returns a height map.
    """
    heights = synthesized["heights"].values.T
    pixel_size = float(synthesized["x"].attrs["length"] / len(heights))
    return Measurement(path, "", "Default", "nm", "map", heights, pixel_size, None, (), 0)


#: Radius of the paraboloid that rounds tops, times the rms half-Laplacian. It was fitted to an AFM
#: scan of UNCD (10 µm, 19.5 nm pixels), whose forces and summits it reproduces.
BLUNTNESS = 0.9
#: Number of times that tops are rounded, heights remapped and amplitudes restored, from this fit.
ROUND_COUNT = 10
#: Depth of the paraboloid in rms heights; a deeper paraboloid changes forces by some 2 %.
RELATIVE_DEPTH = 2.0
#: Bins in which heights are counted, and intervals of probability.
INTERVAL_COUNT = 4096


def skew_surface(surface: HeightMap, skewness: float) -> HeightMap:
    """Return a surface with the same spectrum, skewed heights and blunt tops.

    Each round has three steps. An opening with a paraboloid rounds the tops. Heights are remapped
    in order to a Pearson III distribution. The Fourier amplitudes are restored. Without the first
    step this is the amplitude-adjusted surrogate of Schreiber and Schmitz, Phys. Rev. Lett. 77
    (1996) 635, whose summits are sharp.

    surface: periodic and square.
    skewness: from -1 to 1; the surface meets it to some 5 %.
    Returns heights in float64.
    """
    from scipy import fft

    heights: Floats = surface.heights.astype(float)
    amplitude = np.abs(fft.rfft2(heights))
    deviation = heights.std()
    neighbours = sum(np.roll(heights, step, axis) for step in (-1, 1) for axis in (0, 1))
    laplacian = np.sqrt(((neighbours - 4 * heights) ** 2).mean()) / surface.pixel_size**2
    radius = BLUNTNESS / (laplacian / 2)
    reach = min(np.sqrt(2 * radius * RELATIVE_DEPTH * deviation), surface.size / 2)
    pixels = int(reach / surface.pixel_size)
    depth = (np.arange(pixels + 1.0) * surface.pixel_size) ** 2 / (2 * radius)
    target_skewness = skewness
    for _ in range(ROUND_COUNT):
        remapped = _remap_heights(_open_with_paraboloid(heights, depth), target_skewness, deviation)
        transform = fft.rfft2(remapped)
        size = np.abs(transform)
        transform *= np.divide(amplitude, size, out=np.zeros_like(size), where=size > 0)
        heights = fft.irfft2(transform, s=heights.shape)
        target_skewness += skewness - skewness_and_kurtosis(heights)[0]
    return replace(surface, heights=heights)


def _open_with_paraboloid(heights: Floats, depth: Floats) -> Floats:
    """Return periodic heights lowered to the reach of a paraboloid that slides below them."""
    eroded = _erode_along_axis(_erode_along_axis(heights, depth, 1), depth, 0)
    return -_erode_along_axis(_erode_along_axis(-eroded, depth, 1), depth, 0)


#: Lines eroded at a time, so that their heights stay in the cache.
BLOCK_LINES = 64


def _erode_along_axis(heights: Floats, depth: Floats, axis: int) -> Floats:
    """Return heights eroded by a parabola along an axis, faster than SciPy's `grey_erosion`."""
    lines = heights.swapaxes(axis, 1)
    reach = len(depth) - 1
    lowest = np.empty_like(lines)
    for start in range(0, len(lines), BLOCK_LINES):
        wide = np.pad(lines[start : start + BLOCK_LINES], ((0, 0), (reach, reach)), "wrap")
        shifted = sliding_window_view(wide, lines.shape[1], axis=1)
        eroded = shifted[:, reach].copy()
        for step in range(1, reach + 1):
            nearest = np.minimum(shifted[:, reach - step], shifted[:, reach + step])
            nearest += depth[step]
            np.minimum(eroded, nearest, out=eroded)
        lowest[start : start + BLOCK_LINES] = eroded
    return lowest.swapaxes(axis, 1)


def _remap_heights(heights: Floats, skewness: float, deviation: float) -> Floats:
    """Return heights remapped in order to a Pearson III distribution of mean zero.

    Each new height is a continuous function of the old height. Ranks would break ties by rounding.
    """
    from scipy.special import gammaincinv

    probability = np.linspace(0, 1, INTERVAL_COUNT + 1)[1:-1]
    rate = 2 / skewness if skewness else 1e5  # practically normal
    tail = probability if rate > 0 else 1 - probability
    pearson3 = gammaincinv(rate**2, tail) / rate - rate**2 / rate
    counts, edges = np.histogram(heights, INTERVAL_COUNT)
    share = np.append(0, counts.cumsum()) / heights.size
    quantiles = np.interp(share, probability, pearson3)
    return np.asarray(deviation * np.interp(heights, edges, quantiles))
