"""Rare protrusions on a rough surface, such as grains that polishing left or debris."""

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
#: Of surfaces so many have none.
GAUSSIAN_SHARE = 0.25


class Protrusions(NamedTuple):
    """Protrusions of Gaussian shape, at random places."""

    density: float  #: Per µm².
    height: float  #: Over the rms height of the surface.
    width: float  #: Standard deviation of the shape in nm.


def draw_protrusions(rng: np.random.Generator) -> Protrusions:
    """Draw the protrusions of one surface; a surface without any has the density and height 0."""
    density, width = (float(np.exp(rng.uniform(*np.log(ends)))) for ends in (DENSITIES, WIDTHS))
    height = float(rng.uniform(*HEIGHTS))
    if rng.uniform() < GAUSSIAN_SHARE:
        return Protrusions(0.0, 0.0, width)
    return Protrusions(density, height, width)


def with_protrusions(
    rng: np.random.Generator, scan: HeightMap, protrusions: Protrusions
) -> HeightMap:
    """Return a scan with protrusions at random places, levelled, at the rms height that it had.

    Their number is that of a Poisson process; those whose centres lie outside of the scan are left
    out.
    """
    rms_height = scan.heights.std()
    position = (np.arange(scan.pixels) + 0.5) * scan.pixel_size
    count = rng.poisson(protrusions.density * (scan.size / 1e3) ** 2)
    heights = scan.heights.astype(float)
    for y, x in rng.uniform(0, scan.size, (count, 2)):
        along_y, along_x = (
            np.exp(-((position - centre) ** 2) / (2 * protrusions.width**2)) for centre in (y, x)
        )
        heights += protrusions.height * rms_height * along_y[:, None] * along_x
    protruded = level(replace(scan, heights=heights))
    factor = rms_height / protruded.heights.std()
    return replace(protruded, heights=factor * protruded.heights)
