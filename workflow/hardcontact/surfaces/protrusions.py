"""Rare protrusions on a rough surface, such as unpolished grains or debris."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hardcontact.surfaces.height_map import HeightMap, level

#: What is assumed of protrusions where a surface has any: the logarithms of density (1/µm²) and
#: width (nm) and the height (rms heights of the surface) are uniform between these ends. Within
#: them slope and curvature of polished UNCD stay within their uncertainties in Table 1.
DENSITIES = (0.1, 3.0)
HEIGHTS = (3.0, 8.0)
WIDTHS = (30.0, 100.0)
#: Share of the surfaces that have no protrusions.
GAUSSIAN_SHARE = 0.25


class Protrusions(NamedTuple):
    """Protrusions of Gaussian shape, at random places."""

    density: float  #: Per µm².
    height: float  #: Over the rms height of the surface.
    width: float  #: Standard deviation of the shape in nm.


def draw_protrusions(rng: np.random.Generator) -> Protrusions:
    """Draw the protrusions of one surface; without any, density and height are 0."""
    density = float(np.exp(rng.uniform(*np.log(DENSITIES))))
    width = float(np.exp(rng.uniform(*np.log(WIDTHS))))
    height = float(rng.uniform(*HEIGHTS))
    if rng.uniform() < GAUSSIAN_SHARE:
        return Protrusions(0.0, 0.0, width)
    return Protrusions(density, height, width)


def with_protrusions(
    rng: np.random.Generator, scan: HeightMap, protrusions: Protrusions
) -> HeightMap:
    """Add protrusions at random places to a scan, level it and restore its rms height.

    Their number is Poisson distributed. Protrusions whose centres lie outside of the scan are left
    out.
    """
    rms_height = scan.heights.std()
    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    count = rng.poisson(protrusions.density * (scan.size / 1e3) ** 2)
    heights = scan.heights.astype(float)
    for y, x in rng.uniform(0, scan.size, (count, 2)):
        shape_y = np.exp(-((position - y) ** 2) / (2 * protrusions.width**2))
        shape_x = np.exp(-((position - x) ** 2) / (2 * protrusions.width**2))
        heights += protrusions.height * rms_height * shape_y[:, None] * shape_x
    protruded = level(replace(scan, heights=heights))
    factor = rms_height / protruded.heights.std()
    return replace(protruded, heights=factor * protruded.heights)
