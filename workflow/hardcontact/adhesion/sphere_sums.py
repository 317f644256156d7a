"""Sums of exp(-gap/rho) over the window of every contact of an array, smooth or rough sphere.

The exponential of the gap g = s - t - h factorizes: of a smooth sphere the sums of all contacts are
a product over both axes, of a rough one a correlation with a kernel. Contact pixels are left out
beforehand: subtracting them afterwards would cost as many digits as exp(penetration/rho) has.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from hardcontact.contact.bearing_area import LowestGaps
from hardcontact.contact.geometry import Bodies, ContactGeometry, gaps_at

Floats = NDArray[np.float64]

#: Contact pixels of each contact, by its place (i, j) in the array.
Contacts = dict[tuple[int, int], LowestGaps]


class ContactPixels:
    """The substrate's pixels that are contact pixels of any contact of an array, each once.

    They are left out of the sum of every contact; those of the other contacts are then added again.
    `row` and `column` (pixels,) are their places on the substrate, by rows.
    """

    def __init__(self, bodies: Bodies, contacts: Contacts) -> None:
        pixels, positions = bodies.substrate.pixels, bodies.geometry.positions
        own = {
            place: np.ravel_multi_index(
                tuple(((positions[list(place)] + offsets) % pixels).T), (pixels, pixels)
            )
            for place, (_, offsets) in contacts.items()
        }
        flat = np.unique(np.concatenate(list(own.values())))
        self.row, self.column = np.divmod(flat, pixels)
        self._own = {place: np.searchsorted(flat, pixel) for place, pixel in own.items()}
        self._gaps = {place: gaps for place, (gaps, _) in contacts.items()}
        self._image_gaps = {
            place: _image_gaps(bodies, place, offsets) for place, (_, offsets) in contacts.items()
        }

    def leave_out(self, terms: Floats, first_row: int = 0) -> None:
        """Set these pixels to zero in the rows of the substrate (k, n) from the first one on."""
        part = slice(*np.searchsorted(self.row, [first_row, first_row + len(terms)]))
        terms[self.row[part] - first_row, self.column[part]] = 0.0

    def outside(
        self, place: tuple[int, int], total: float, others: Floats, highest: float, rho: float
    ) -> float:
        """Return the sum of exp(-(g + d)/rho) over pixels outside the contact at a place (i, j).

        d is the separation of closest approach. `total` is the sum over all pixels but these, and
        `others` (pixels,) are the terms of these, overwritten, both at the approach where the
        highest points would meet, whose sum is `highest`.
        """
        others[self._own[place]] = 0.0
        approach = self._gaps[place][-1]
        of_images = np.exp((approach - self._image_gaps[place]) / rho).sum()
        return float(np.exp((approach + highest) / rho) * (total + others.sum()) + of_images)


def _image_gaps(bodies: Bodies, place: tuple[int, int], offsets: NDArray[np.int_]) -> Floats:
    """Return the gaps (k,) in nm of images, in the window, of contact pixels at offsets."""
    pixels, geometry = bodies.substrate.pixels, bodies.geometry
    reach = -(-geometry.window // (2 * pixels))
    within, which = np.unique(offsets % pixels @ (pixels, 1), return_inverse=True)
    periods = pixels * np.arange(-reach, reach)
    y, x = (one[:, None] + periods for one in np.divmod(within, pixels))
    wanted = geometry.inside(y)[:, :, None] & geometry.inside(x)[:, None, :]
    own_y, own_x = (offsets // pixels + reach).T
    wanted[which, own_y, own_x] = False
    images = np.stack(np.broadcast_arrays(y[:, :, None], x[:, None, :]), axis=-1)
    return gaps_at(bodies, geometry.positions[list(place)], images[wanted])


#: Sums (contact, contact) over all pixels but those of contacts, and the factor of the sphere at
#: some pixels (their rows, their columns) of the substrate, seen from a contact (i, j).
OfSphere = tuple[Floats, Callable[[tuple[int, int]], Floats]]

ROWS = 64  # in a block: small enough for the cache


def _products(
    heights: NDArray[np.floating],
    contact_pixels: ContactPixels,
    highest: float,
    folds: Sequence[Floats],
    rhos: Sequence[float],
) -> Floats:
    """Return G exp((h - highest)/rho) G^T, (rho, contact, contact), without the contact pixels."""
    columns = [np.ascontiguousarray(fold.T) for fold in folds]

    def block(start: int) -> Floats:
        rows = slice(start, start + ROWS)
        attractions = _attractions(heights[rows], highest, rhos)
        parts = []
        for rho, fold, of_columns in zip(rhos, folds, columns, strict=True):
            contact_pixels.leave_out(attractions[rho], start)
            parts.append(fold[:, rows] @ (attractions[rho] @ of_columns))
        return np.array(parts)

    return np.asarray(sum(block(start) for start in range(0, len(heights), ROWS)))


def _attractions(
    heights: NDArray[np.floating], highest: float, rhos: Sequence[float]
) -> dict[float, Floats]:
    """Return `exponential` at every range: at half of another one it is the square of that."""
    found: dict[float, Floats] = {}
    for rho in sorted(rhos, reverse=True):
        longer = found.get(2 * rho)
        found[rho] = exponential(heights, highest, rho) if longer is None else longer**2
    return found


def folded(pixels: int, geometry: ContactGeometry, rho: float) -> Floats:
    """Return exp(-s/rho) along one axis, summed over images in the window: (contact, n)."""
    offset = geometry.offsets()
    weight = np.exp(-geometry.paraboloid(offset) / rho)
    positions = geometry.positions
    return np.array([np.bincount((at + offset) % pixels, weight, pixels) for at in positions])


def exponential(heights: NDArray[np.floating], highest: float, rho: float) -> Floats:
    """Return exp((heights - highest)/rho) in float64; heights in nm, of any precision."""
    attraction: Floats = np.subtract(heights, highest, dtype=float)
    attraction /= rho
    np.exp(attraction, out=attraction)
    return attraction


def outside_sums(bodies: Bodies, contacts: Contacts, rhos: Sequence[float] | Floats) -> Floats:
    """Return the sum (rho, contact, contact) of exp(-(g + d)/rho) outside plastic contact.

    d is the separation of closest approach. The contacts are `LowestGaps` by place (i, j) of the
    array.
    """
    substrate, roughness = bodies.substrate, bodies.roughness
    contact_pixels = ContactPixels(bodies, contacts)
    touching = substrate.heights[contact_pixels.row, contact_pixels.column]
    h_max = float(substrate.heights.max())
    t_max = 0.0 if roughness is None else float(roughness.heights.max())
    ranges = [float(rho) for rho in rhos]
    outside = np.empty((len(ranges), *[len(bodies.geometry.positions)] * 2))
    with threadpool_limits(1, "blas"):
        sphere_terms = _of_smooth_sphere if roughness is None else _of_rough_sphere
        sums = sphere_terms(bodies, contact_pixels, h_max, ranges)
        for k, (rho, (total, factor)) in enumerate(zip(ranges, sums, strict=True)):
            attraction = exponential(touching, h_max, rho)
            for place in contacts:
                outside[k][place] = contact_pixels.outside(
                    place, total[place], attraction * factor(place), h_max + t_max, rho
                )
    return outside


def _of_smooth_sphere(
    bodies: Bodies, contact_pixels: ContactPixels, h_max: float, rhos: Sequence[float]
) -> Iterator[OfSphere]:
    """Yield, for each range, the sums over all but contact pixels and the factor at these."""
    pixels, row, column = bodies.substrate.pixels, contact_pixels.row, contact_pixels.column
    # G exp((h - h_max)/rho) G^T is a product over both axes, because exp(-s/rho) is one.
    folds = [folded(pixels, bodies.geometry, rho) for rho in rhos]
    totals = _products(bodies.substrate.heights, contact_pixels, h_max, folds, rhos)
    for total, fold in zip(totals, folds, strict=True):

        def factor(place: tuple[int, int], fold: Floats = fold) -> Floats:
            return np.asarray(fold[place[0], row] * fold[place[1], column])

        yield total, factor


def _of_rough_sphere(
    bodies: Bodies, contact_pixels: ContactPixels, h_max: float, rhos: Sequence[float]
) -> Iterator[OfSphere]:
    """Yield the same of a rough sphere, relative to the highest point t_max of its roughness."""
    assert bodies.roughness is not None
    pixels, positions = bodies.substrate.pixels, bodies.geometry.positions
    roughness = bodies.roughness.heights
    #: Rows, in units of whole rows, and columns of the contact pixels as seen from each position.
    rows = (contact_pixels.row - positions[:, None]) % pixels * pixels
    columns = (contact_pixels.column - positions[:, None]) % pixels
    for rho in rhos:
        attraction = exponential(roughness, float(roughness.max()), rho)
        kernel = _kernel(pixels, attraction, bodies.geometry, rho)
        outside = exponential(bodies.substrate.heights, h_max, rho)
        contact_pixels.leave_out(outside)

        def factor(place: tuple[int, int], kernel: Floats = kernel) -> Floats:
            return np.asarray(kernel.take(rows[place[0]] + columns[place[1]]))

        yield _correlation(outside, kernel, positions), factor


def _kernel(pixels: int, attraction: Floats, geometry: ContactGeometry, rho: float) -> Floats:
    """Return exp((t - t_max - s)/rho) on (n, n) offsets from the apex, summed over its images."""
    period = len(attraction)
    weights = _folded_by_shift(pixels, period, geometry, rho)
    kernel, place = np.zeros((pixels, pixels)), np.arange(pixels)
    for start in range(0, pixels, ROWS):
        rows = place[start : start + ROWS]
        for (shift_y, weight_y), (shift_x, weight_x) in product(weights.items(), repeat=2):
            seen = attraction[np.ix_((rows + shift_y) % period, (place + shift_x) % period)]
            kernel[rows] += weight_y[rows, None] * weight_x * seen
    return kernel


def _folded_by_shift(
    pixels: int, period: int, geometry: ContactGeometry, rho: float
) -> dict[int, Floats]:
    """Return exp(-s/rho) along one axis, summed over images of the same shift of the roughness."""
    weights: dict[int, Floats] = {}
    reach = -(-geometry.window // (2 * pixels))
    for image in range(-reach, reach):
        offset = np.arange(pixels) + image * pixels
        decay = np.exp(-geometry.paraboloid(offset) / rho)
        weight = np.where(geometry.inside(offset), decay, 0.0)
        shift = image * pixels % period
        weights[shift] = weights.get(shift, np.zeros(pixels)) + weight
    return weights


def _correlation(attraction: Floats, kernel: Floats, positions: NDArray[np.int_]) -> Floats:
    """Return the sum (contact, contact) of attraction * kernel, shifted to each contact."""
    # Each row of the kernel times one row of the attraction for every contact: matrices again.
    pixels, step = len(kernel), 4
    total = np.zeros((len(positions),) * 2)
    for start in range(0, pixels, step):
        rows = kernel[start : start + step]
        twice = np.concatenate([rows, rows], axis=1)
        shifted = np.lib.stride_tricks.sliding_window_view(twice, pixels, axis=1)
        place = np.arange(start, start + len(rows))[:, None] + positions
        seen = shifted[:, pixels - positions]
        total += (attraction[place % pixels] @ seen.transpose(0, 2, 1)).sum(axis=0)
    return total
