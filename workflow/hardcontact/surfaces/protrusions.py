"""Rare protrusions on a rough surface, such as unpolished grains or debris."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hardcontact.surfaces.height_map import HeightMap

#: Bounds of the protrusions of a surface: the logarithms of density (1/µm²) and width (nm), and the
#: height (in rms heights of the coating), are uniform between them. Within these bounds the rms
#: curvature of polished UNCD stays within its uncertainty in Table 1.
DENSITY_BOUNDS = (0.1, 3.0)
HEIGHT_BOUNDS = (3.0, 8.0)
WIDTH_BOUNDS = (30.0, 100.0)
#: Share of the surfaces that have no protrusions.
SHARE_WITHOUT_PROTRUSIONS = 0.25


class Protrusions(NamedTuple):
    """Protrusions of Gaussian shape, at random places.

    Equal shapes at independent places add up to a variance of their density times the integral of
    the squared shape (Campbell's theorem).
    """

    density: float  #: Per µm².
    height: float  #: In rms heights of the coating.
    width: float  #: Standard deviation of the shape in nm.

    @property
    def rms_slope(self) -> float:
        """The rms slope of protrusions alone, in rms heights of the coating per nm."""
        return float(self.height * np.sqrt(np.pi * self.density / 1e6))

    @property
    def rms_height(self) -> float:
        """The rms height of protrusions alone, in rms heights of the coating."""
        return self.rms_slope * self.width


class PublishedRoughness(NamedTuple):
    """The published roughness of the coating and of the sphere."""

    rms_height: float  #: Rms height of the coating in nm.
    rms_slope: float  #: Rms slope of the coating.
    max_rms_slope: float  #: Rms slope of the coating plus its uncertainty.
    max_sphere_rms_height: float  #: Largest rms height of the sphere in nm.


def sample_protrusions(
    rng: np.random.Generator, roughness: PublishedRoughness, on_sphere: bool
) -> Protrusions:
    """Sample the protrusions of a surface; density and height are 0 for a surface without any.

    Protrusions are sampled again until the published roughness permits them.
    """
    while True:
        density = float(np.exp(rng.uniform(*np.log(DENSITY_BOUNDS))))
        width = float(np.exp(rng.uniform(*np.log(WIDTH_BOUNDS))))
        protrusions = Protrusions(density, float(rng.uniform(*HEIGHT_BOUNDS)), width)
        if is_permitted(protrusions, roughness, on_sphere):
            break
    if rng.uniform() < SHARE_WITHOUT_PROTRUSIONS:
        return Protrusions(0.0, 0.0, width)
    return protrusions


def is_permitted(protrusions: Protrusions, roughness: PublishedRoughness, on_sphere: bool) -> bool:
    """Return whether the published roughness permits protrusions.

    On the sphere, its largest published rms height limits that of protrusions. A coating with
    protrusions is scaled back to its rms height; its slope may then not exceed the published one
    plus its uncertainty.
    """
    if on_sphere:
        return protrusions.rms_height * roughness.rms_height <= roughness.max_sphere_rms_height
    slope = np.hypot(roughness.rms_slope, protrusions.rms_slope * roughness.rms_height)
    return bool(slope / np.hypot(1, protrusions.rms_height) <= roughness.max_rms_slope)


def add_protrusions(
    rng: np.random.Generator, scan: HeightMap, protrusions: Protrusions, rms_height: float
) -> HeightMap:
    """Add protrusions at random places to a scan; the rms height of the coating is in nm.

    Their number follows a Poisson distribution. All centres lie within the scan.
    """
    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    count = rng.poisson(protrusions.density * (scan.size / 1e3) ** 2)
    heights = scan.heights.astype(float)
    for y, x in rng.uniform(0, scan.size, (count, 2)):
        shape_y = np.exp(-((position - y) ** 2) / (2 * protrusions.width**2))
        shape_x = np.exp(-((position - x) ** 2) / (2 * protrusions.width**2))
        heights += protrusions.height * rms_height * shape_y[:, None] * shape_x
    return replace(scan, heights=heights)
