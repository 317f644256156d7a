"""Sums of exp(-gap/rho) over the window of every contact of an array, smooth or rough sphere.

The exponential of the gap g = s - t - h factorizes: of a smooth sphere the sums of all contacts are
a product over both axes, of a rough one a correlation with a kernel that is computed once.
"""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import product

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from hardcontact.contact.bearing_area import LowestGaps
from hardcontact.contact.geometry import Bodies, ContactGeometry

__all__ = ["rough_sphere_sums", "smooth_sphere_sums"]

Floats = NDArray[np.float64]
Contacts = dict[tuple[int, int], LowestGaps]

ROWS = 64  # in a block: small enough for the cache, and the same for any number of threads


def smooth_sphere_sums(bodies: Bodies, rho: float, threads: int = 1) -> tuple[Floats, float]:
    """Return the sum of exp((h - h_max - s)/rho) for an array of contacts of a smooth sphere.

    The sum is G exp((h - h_max)/rho) G^T, a product over both axes, because exp(-s/rho) is such a
    product. Exact to rounding: all terms are positive.

    Parameters
    ----------
    bodies : Bodies
        The substrate and a smooth sphere.
    rho : float
        Range of adhesion in nm.
    threads : int
        The result does not depend on it.

    Returns
    -------
    sums : numpy.ndarray
        (contact, contact)
    h_max : float
        Highest point of the substrate in nm.
    """
    heights = bodies.substrate.heights
    h_max = float(heights.max())
    fold = _folded(bodies.substrate.pixels, bodies.geometry, rho)
    columns = np.ascontiguousarray(fold.T)

    def block(start: int) -> Floats:
        rows = slice(start, start + ROWS)
        return np.asarray(fold[:, rows] @ (_attraction(heights[rows], h_max, rho) @ columns))

    with threadpool_limits(1, "blas"), ThreadPoolExecutor(threads) as pool:
        return np.asarray(sum(pool.map(block, range(0, len(heights), ROWS)))), h_max


def _folded(pixels: int, geometry: ContactGeometry, rho: float) -> Floats:
    """Return exp(-s/rho) along one axis, summed over images in the window: (contact, n)."""
    offset = geometry.offsets()
    weight = np.exp(-geometry.paraboloid(offset) / rho)
    return np.array(
        [
            np.bincount((position + offset) % pixels, weight, pixels)
            for position in geometry.positions
        ]
    )


def _attraction(heights: NDArray[np.floating], highest: float, rho: float) -> Floats:
    """Return exp((heights - highest)/rho) in float64; heights in nm, of any precision."""
    attraction: Floats = np.subtract(heights, highest, dtype=float)
    attraction /= rho
    np.exp(attraction, out=attraction)
    return attraction


def rough_sphere_sums(bodies: Bodies, contacts: Contacts, rhos: Sequence[float] | Floats) -> Floats:
    """Return the sum of exp(-(g + d)/rho) over pixels outside plastic contact.

    d is the separation of closest approach. exp(h/rho) and the kernel exp((t - s)/rho), folded
    over the periodic images in the window, are computed once for each rho; the sums of all
    contacts are then products of matrices. All terms are positive: contact pixels are left out
    beforehand, because their subtraction would cost digits where rho is small.

    Parameters
    ----------
    bodies : Bodies
        The substrate and a rough sphere.
    contacts : dict
        Place (i, j) -> `LowestGaps` of each contact of the array.
    rhos : array_like
        (rho,) ranges of adhesion in nm.

    Returns
    -------
    numpy.ndarray
        (rho, contact, contact)
    """
    substrate, roughness = bodies.substrate, bodies.roughness
    if roughness is None:
        raise ValueError("expected a rough sphere, found a smooth one")
    h_max, t_max = float(substrate.heights.max()), float(roughness.heights.max())
    image_gaps = {
        place: _image_gaps(bodies, place, offsets) for place, (_, offsets) in contacts.items()
    }
    contact_pixels = _ContactPixels(bodies, contacts)
    shape = (len(bodies.geometry.positions),) * 2
    outside = np.empty((len(rhos), *shape))
    for k, rho in enumerate(rhos):
        of_sphere = _attraction(roughness.heights, t_max, rho)
        kernel = _kernel(substrate.pixels, of_sphere, bodies.geometry, rho)
        attraction = _attraction(substrate.heights, h_max, rho)
        removed = contact_pixels.remove_from(attraction)
        total = _correlation(attraction, kernel, bodies.geometry.positions)
        for place, (gaps, _) in contacts.items():
            of_others = contact_pixels.sum_over_others(removed, kernel, place)
            outside[k][place] = (
                np.exp((gaps[-1] + h_max + t_max) / rho) * (total[place] + of_others)
                + np.exp((gaps[-1] - image_gaps[place]) / rho).sum()
            )
    return outside


class _ContactPixels:
    """The substrate's pixels that are contact pixels of any contact of an array, each once.

    They are left out of the sum of every contact; those of the other contacts are then added again.
    """

    def __init__(self, bodies: Bodies, contacts: Contacts) -> None:
        pixels, positions = bodies.substrate.pixels, bodies.geometry.positions
        own = {
            place: np.ravel_multi_index(
                tuple(((positions[list(place)] + offsets) % pixels).T), (pixels, pixels)
            )
            for place, (_, offsets) in contacts.items()
        }
        self.pixels = np.unique(np.concatenate(list(own.values())))
        self.own = {place: np.searchsorted(self.pixels, pixel) for place, pixel in own.items()}
        row, column = np.divmod(self.pixels, pixels)
        #: Rows, in units of whole rows, and columns of the pixels as seen from each position.
        self.rows = (row - positions[:, None]) % pixels * pixels
        self.columns = (column - positions[:, None]) % pixels

    def remove_from(self, attraction: Floats) -> Floats:
        """Set the pixels of a map (n, n) to zero and return what they were: (pixels,)."""
        flat = attraction.reshape(-1)
        values: Floats = flat[self.pixels]
        flat[self.pixels] = 0.0
        return values

    def sum_over_others(self, values: Floats, kernel: Floats, place: tuple[int, int]) -> float:
        """Return the sum of values times kernel, without the contact pixels of one contact."""
        terms = values * kernel.take(self.rows[place[0]] + self.columns[place[1]])
        terms[self.own[place]] = 0.0
        return float(terms.sum())


def _kernel(pixels: int, attraction: Floats, geometry: ContactGeometry, rho: float) -> Floats:
    """Return exp((t - t_max - s)/rho) on (n, n) offsets from the apex, summed over its images.

    attraction: exp((t - t_max)/rho), (m, m).
    """
    period = len(attraction)
    folded = _folded_by_shift(pixels, period, geometry, rho)
    kernel, place = np.zeros((pixels, pixels)), np.arange(pixels)
    for start in range(0, pixels, ROWS):
        rows = place[start : start + ROWS]
        for (shift_y, weight_y), (shift_x, weight_x) in product(folded.items(), repeat=2):
            seen = attraction[np.ix_((rows + shift_y) % period, (place + shift_x) % period)]
            kernel[rows] += weight_y[rows, None] * weight_x * seen
    return kernel


def _folded_by_shift(
    pixels: int, period: int, geometry: ContactGeometry, rho: float
) -> dict[int, Floats]:
    """Return exp(-s/rho) along one axis, summed over images of the same shift of the roughness.

    Shift in pixels -> (n,); there is a single shift where both periods are the same.
    """
    folded: dict[int, Floats] = {}
    reach = -(-geometry.window // (2 * pixels))
    for image in range(-reach, reach):
        offset = np.arange(pixels) + image * pixels
        decay = np.exp(-geometry.paraboloid(offset) / rho)
        weight = np.where(geometry.inside(offset), decay, 0.0)
        shift = image * pixels % period
        folded[shift] = folded.get(shift, np.zeros(pixels)) + weight
    return folded


def _correlation(attraction: Floats, kernel: Floats, positions: NDArray[np.int_]) -> Floats:
    """Return the sum of attraction * kernel, the kernel shifted periodically to every contact.

    attraction, kernel: (n, n); positions: (contact,). Returns (contact, contact). Each row of the
    kernel is multiplied by one row of the attraction for every contact: a product of matrices.
    """
    pixels, step = len(kernel), 4
    total = np.zeros((len(positions),) * 2)
    with threadpool_limits(1, "blas"):
        for start in range(0, pixels, step):
            rows = kernel[start : start + step]
            twice = np.concatenate([rows, rows], axis=1)
            shifted = np.lib.stride_tricks.sliding_window_view(twice, pixels, axis=1)
            place = np.arange(start, start + len(rows))[:, None] + positions
            seen = shifted[:, pixels - positions]
            total += (attraction[place % pixels] @ seen.transpose(0, 2, 1)).sum(axis=0)
    return total


def _image_gaps(bodies: Bodies, place: tuple[int, int], offsets: NDArray[np.int_]) -> Floats:
    """Return the gaps (k,) in nm of the periodic images, inside the window, of contact pixels.

    Images that are contact pixels themselves are left out. offsets: (contact_pixels, 2) from the
    apex.
    """
    pixels, geometry = bodies.substrate.pixels, bodies.geometry
    assert bodies.roughness is not None
    reach = -(-geometry.window // pixels)
    steps = np.stack(np.meshgrid(*[np.arange(-reach, reach + 1) * pixels] * 2), -1).reshape(-1, 2)
    places = (offsets[:, None] + steps).reshape(-1, 2)
    places = places[geometry.inside(places).all(axis=1)]
    code = (4 * geometry.window, 1)  # one number a pixel, in the order of rows and columns
    codes, first = np.unique(places @ code, return_index=True)
    places = places[first[~np.isin(codes, offsets @ code)]]
    y, x = ((geometry.positions[list(place)] + places) % pixels).T
    u, v = (places % bodies.roughness.pixels).T
    return np.asarray(
        geometry.paraboloid(places).sum(axis=1)
        - bodies.roughness.heights[u, v]
        - bodies.substrate.heights[y, x]
    )
