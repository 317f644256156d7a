"""Substitute scans, cut out of random surfaces: of a flat surface or a sphere."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hardcontact.base.random import generator
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import SpectrumFunction
from hardcontact.surfaces.synthesis import (
    Transform,
    random_corner,
    random_surface,
    white_noise,
)


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


def whole_surface(
    seed: int,
    surface: str,
    realization: int,
    density: SpectrumFunction,
    pixels: int,
    pixel_size: float,
) -> HeightMap:
    """Return a periodic substitute surface (pixels, pixels), as large as a large-scale master."""
    return random_surface(
        generator(seed, surface, realization, "whole surface"), pixels, pixel_size, density
    )


def sample_scan(
    rng: np.random.Generator, density: SpectrumFunction, grid: ScanGrid, factor: float = 1.0
) -> HeightMap:
    """Sample a scan with C_iso `density` in nm⁴, its heights times a factor."""
    return scan_of_noise(white_noise(rng, grid.realization_pixels), density, grid, factor)


def scan_of_noise(
    noise: Transform, density: SpectrumFunction, grid: ScanGrid, factor: float = 1.0
) -> HeightMap:
    """Return the scan of the transform of white noise: the corner of a random surface."""
    surface = random_corner(noise, grid.pixels, grid.pixel_size, density)
    return cut_scan(surface, grid.pixels, factor)


def add_sphere(rng: np.random.Generator, roughness: HeightMap, radius: float) -> HeightMap:
    """Return a scan of a rough sphere (radius in nm), its apex within the middle half."""
    apex = rng.uniform(-0.25, 0.25, 2) * roughness.size
    position = (np.arange(roughness.pixels) + 0.5) * roughness.pixel_size - roughness.size / 2
    y, x = position - apex[0], position - apex[1]
    heights = roughness.heights - (y[:, None] ** 2 + x**2) / (2 * radius)
    return replace(roughness, heights=heights)
