"""Substitute scans: cut out of random surfaces, flat or of the sphere.

`scipy` and `xarray` are imported where they are used.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.skewed_surface import skewed_surface
from hardcontact.surfaces.spectrum import Density
from hardcontact.surfaces.synthesis import random_surface, refined
from hardcontact.surfaces.tip import FINENESS, imaged_scan
from hardcontact.surfaces.topography import level

if TYPE_CHECKING:
    import xarray as xr

__all__ = [
    "HeightChoices",
    "ScanGrid",
    "drawn_scan",
    "sphere_scan",
    "substitute_scan",
    "synthesized_scan",
]


class ScanGrid(NamedTuple):
    """Pixels of substitute scans and of the random surfaces that they are cut out of.

    Attributes
    ----------
    pixels, realization_pixels : int
        Along an edge of the scan, and of the surface.
    size : float
        Edge of the scan in nm.
    """

    pixels: int
    size: float
    realization_pixels: int

    @property
    def pixel_size(self) -> float:
        """Edge of a pixel in nm."""
        return self.size / self.pixels


class HeightChoices(NamedTuple):
    """What else than a Gaussian surface, its heights taken at the pixels, a scan may show.

    Attributes
    ----------
    skewness : float
        Of the heights; the rms height is that of the Gaussian scan.
    tip_radius : float or None
        In nm, of the tip that images the surface; None: heights at the pixels.
    """

    skewness: float = 0.0
    tip_radius: float | None = None


#: The study's own choices.
GAUSSIAN = HeightChoices()


def substitute_scan(surface: HeightMap, pixels: int, factor: float = 1.0) -> HeightMap:
    """Return a scan: the corner of a larger random surface, its heights times a factor.

    Parameters
    ----------
    surface : HeightMap
        Periodic.
    pixels : int
        Along an edge of the scan.
    factor : float
        Of the heights.

    Returns
    -------
    HeightMap
        Not periodic; heights (pixels, pixels) in float64.
    """
    heights = factor * surface.heights[:pixels, :pixels].astype(float)
    return replace(surface, heights=heights, periodic=False)


def drawn_scan(rng: np.random.Generator, density: Density, grid: ScanGrid) -> HeightMap:
    """Return a scan as it is drawn: the corner of a random surface of C_iso `density` in nm⁴."""
    surface = random_surface(rng, grid.realization_pixels, grid.pixel_size, density)
    return substitute_scan(surface, grid.pixels)


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
    density: Density,
    grid: ScanGrid,
    factor: float = 1.0,
    sphere_radius: float | None = None,
    choices: HeightChoices = GAUSSIAN,
) -> "xr.Dataset":
    """Return a substitute scan as SurfaceTopography reads it from a file.

    Parameters
    ----------
    rng : numpy.random.Generator
        Of everything that is random in the scan.
    density : callable
        C_iso in nm⁴, of `spectral_gain.conditioned_density`.
    grid : ScanGrid
        Of the scan.
    factor : float
        Of the heights, from the same conditioning.
    sphere_radius : float or None
        In nm, of a scan of the sphere; None of a flat surface.
    choices : HeightChoices
        Of the heights.

    Returns
    -------
    xarray.Dataset
        `heights` (x, y) in nm, in float64, for a file in netCDF's classic format.
    """
    surface = random_surface(rng, grid.realization_pixels, grid.pixel_size, density)
    scan = substitute_scan(surface, grid.pixels, factor)
    if choices.skewness:
        surface = skewed_surface(surface, choices.skewness)
        factor *= _rms_height(scan) / _rms_height(substitute_scan(surface, grid.pixels, factor))
        scan = substitute_scan(surface, grid.pixels, factor)
    if choices.tip_radius is not None:
        fine = refined(rng, surface, FINENESS, density)
        fine = replace(fine, heights=factor * fine.heights)
        scan = imaged_scan(fine, grid.pixels, choices.tip_radius)
    if sphere_radius is not None:
        scan = sphere_scan(rng, scan, sphere_radius)
    return _classic_dataset(scan)


def _rms_height(scan: HeightMap) -> float:
    """Return the rms height of a scan in nm, levelled."""
    return float(level(scan).heights.std())


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
