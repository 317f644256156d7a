"""The probe: its paraboloid, the array of contact positions, the analysis window.

Pixel indices run along one axis. A contact at index c sees the substrate at the unfolded indices
c + u, u from -window/2 to window/2 - 1; the substrate continues itself periodically.
"""

from typing import NamedTuple

import numpy as np

from hardcontact.dataset import pixel_size
from hardcontact.fourier import interpolate

__all__ = [
    "Pair",
    "common_pixels",
    "contact_positions",
    "pair",
    "paraboloid",
    "rough_sphere",
    "sampled_contacts",
    "window_pixels",
]


def paraboloid(offsets, pixel_size, radius):
    """Height (nm) above its apex of a sphere of `radius` (nm) along one axis: (u p)²/2R.

    The height at (u, v) is the sum of both axes; this makes the force sum separable.
    """
    return (np.asarray(offsets) * pixel_size) ** 2 / (2 * radius)


def window_pixels(window, pixel_size):
    """Even number of pixels along the edge of the analysis window (nm)."""
    return 2 * int(round(window / pixel_size / 2))


def contact_positions(pixels, count):
    """Indices (count,) of contacts along one axis, evenly over one period of the substrate.

    The first lies a quarter of a step in, so that no two contacts are mirror images of each other
    on a mirror-stitched surface (which is symmetric about the ends of its period).
    """
    return np.floor((np.arange(count) + 0.25) * pixels / count).astype(int)


def sampled_contacts(rng, count, contacts):
    """Places (contacts, 2) drawn from an array of count x count contacts, each at most once.

    From one generator more contacts keep the fewer. Raises ValueError if there are not so many.
    """
    if contacts > count**2:
        raise ValueError(f"expected at most {count**2} contacts, found {contacts}")
    return np.stack(np.divmod(rng.permutation(count**2)[:contacts], count), axis=1)


def common_pixels(substrate, substrate_pixel, roughness, roughness_pixel):
    """Substrate and sphere roughness, both mirror-stitched, on the smaller of the two pixel sizes.

    The coarser is Fourier interpolated to the whole number of pixels nearest to its period; what
    that changes of its period is returned as `stretch` (relative, at most half a pixel a period).
    The apex of the sphere is put into the middle of its scan: at the origin of the stitched map
    lies a corner, about which it would be symmetric.
    Returns substrate, roughness, the pixel size (nm) and the stretch.
    """
    fine = min(substrate_pixel, roughness_pixel)
    maps, stretch = [], 0.0
    for heights, pixel in ((substrate, substrate_pixel), (roughness, roughness_pixel)):
        pixels = max(round(heights.shape[0] * pixel / fine), heights.shape[0])
        stretch = max(stretch, abs(pixels * fine / (heights.shape[0] * pixel) - 1))
        same = pixels == heights.shape[0]
        maps.append(heights if same else interpolate(heights, pixels))
    middle = maps[1].shape[0] // 4
    return maps[0], np.roll(maps[1], (-middle, -middle), axis=(0, 1)), fine, stretch


class Pair(NamedTuple):
    """A substrate and a sphere ready for contact, on common pixels.

    substrate: h (n, n), roughness: t (m, m), in nm, periodic; positions: (contact,) pixels along
    either axis; pixel_size: nm; window: pixels; stretch: see `common_pixels`.
    """

    substrate: np.ndarray
    roughness: np.ndarray
    positions: np.ndarray
    pixel_size: float
    window: int
    stretch: float


def rough_sphere(pair, radius, centre, reach):
    """Height (nm) above its apex of the sphere with its roughness, within `reach` pixels of one.

    pair: `Pair`; radius: nm; centre: (y, x) pixels from the apex. Returns (2 reach + 1, same).
    """
    offset = np.arange(-reach, reach + 1)
    rows, columns = centre[0] + offset, centre[1] + offset
    period = pair.roughness.shape[0]
    return (
        paraboloid(rows, pair.pixel_size, radius)[:, None]
        + paraboloid(columns, pair.pixel_size, radius)
        - pair.roughness[np.ix_(rows % period, columns % period)]
    )


def pair(substrate, sphere, window, count):
    """The `Pair` of two mirror-stitched scans: datasets of `dataset.height_map`.

    window: edge of the analysis window in nm; count: contacts along an edge of the array.
    """
    maps = (
        part for scan in (substrate, sphere) for part in (scan.heights.values, pixel_size(scan))
    )
    heights, roughness, pixel, stretch = common_pixels(*maps)
    positions = contact_positions(heights.shape[0], count)
    return Pair(heights, roughness, positions, pixel, window_pixels(window, pixel), stretch)
