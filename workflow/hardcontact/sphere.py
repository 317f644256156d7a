"""The probe: its paraboloid, the array of contact positions, the analysis window.

Pixel indices run along one axis. A contact at index c sees the substrate at the unfolded indices
c + u, u from -window/2 to window/2 - 1; the substrate continues itself periodically.
"""

import numpy as np

from hardcontact.fourier import interpolate

__all__ = ["common_pixels", "contact_positions", "paraboloid", "window_pixels"]


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
