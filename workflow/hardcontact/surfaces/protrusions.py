"""Rare protrusions on a rough surface, such as unpolished grains or debris."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hardcontact.surfaces.height_map import HeightMap

#: What is assumed of protrusions where a surface has any: the logarithms of density (1/µm²) and
#: width (nm) and the height (rms heights of the coating) are uniform between these ends. Within
#: them the rms curvature of polished UNCD stays within its uncertainty in Table 1.
DENSITIES = (0.1, 3.0)
HEIGHTS = (3.0, 8.0)
WIDTHS = (30.0, 100.0)
#: Share of the surfaces that have no protrusions.
GAUSSIAN_SHARE = 0.25


class Protrusions(NamedTuple):
    """Protrusions of Gaussian shape, at random places.

    By Campbell's theorem the variance of a sum of equal shapes at independent places is their
    density times the integral of the squared shape.
    """

    density: float  #: Per µm².
    height: float  #: Over the rms height of the coating.
    width: float  #: Standard deviation of the shape in nm.

    @property
    def rms_slope(self) -> float:
        """The rms slope of protrusions alone, in rms heights of the coating per nm."""
        return float(self.height * np.sqrt(np.pi * self.density / 1e6))

    @property
    def rms_height(self) -> float:
        """The rms height of protrusions alone, in rms heights of the coating."""
        return self.rms_slope * self.width


class Roughness(NamedTuple):
    """What is published of the coating and of the sphere."""

    rms_height: float  #: Of the coating, in nm.
    rms_slope: float  #: Of the coating.
    max_rms_slope: float  #: Of the coating, with its uncertainty.
    max_sphere_rms_height: float  #: In nm.


def draw_protrusions(
    rng: np.random.Generator, roughness: Roughness, on_sphere: bool
) -> Protrusions:
    """Draw the protrusions of one surface; without any, density and height are 0.

    Those that the published roughness does not permit are drawn again.
    """
    while True:
        density = float(np.exp(rng.uniform(*np.log(DENSITIES))))
        width = float(np.exp(rng.uniform(*np.log(WIDTHS))))
        protrusions = Protrusions(density, float(rng.uniform(*HEIGHTS)), width)
        if is_permitted(protrusions, roughness, on_sphere):
            break
    if rng.uniform() < GAUSSIAN_SHARE:
        return Protrusions(0.0, 0.0, width)
    return protrusions


def is_permitted(protrusions: Protrusions, roughness: Roughness, on_sphere: bool) -> bool:
    """Return whether a surface with protrusions is as smooth as published.

    Protrusions alone may not exceed the rms height of the sphere. On the coating, whose heights are
    scaled to its rms height, slopes may not exceed its rms slope.
    """
    if on_sphere:
        return protrusions.rms_height * roughness.rms_height <= roughness.max_sphere_rms_height
    slope = np.hypot(roughness.rms_slope, protrusions.rms_slope * roughness.rms_height)
    return bool(slope / np.hypot(1, protrusions.rms_height) <= roughness.max_rms_slope)


def add_protrusions(
    rng: np.random.Generator, scan: HeightMap, protrusions: Protrusions, rms_height: float
) -> HeightMap:
    """Add protrusions at random places to a scan; the rms height of the coating is in nm.

    Their number is Poisson distributed. Protrusions whose centres lie outside of the scan are left
    out.
    """
    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    count = rng.poisson(protrusions.density * (scan.size / 1e3) ** 2)
    heights = scan.heights.astype(float)
    for y, x in rng.uniform(0, scan.size, (count, 2)):
        shape_y = np.exp(-((position - y) ** 2) / (2 * protrusions.width**2))
        shape_x = np.exp(-((position - x) ** 2) / (2 * protrusions.width**2))
        heights += protrusions.height * rms_height * shape_y[:, None] * shape_x
    return replace(scan, heights=heights)
