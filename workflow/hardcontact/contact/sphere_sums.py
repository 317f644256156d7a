"""Sums of exp(-gap/rho) over the window of every contact of an array, smooth or rough sphere.

The gap of a pixel is g = y - u - z in nm: sphere y, its roughness u (positive towards the
substrate) and substrate z. On a smooth sphere exp(-y/rho) is a product of one factor an axis, so
the sums of all contacts are one matrix product, G exp(z/rho) G^T, where G is exp(-y/rho) along an
axis for every contact. On a rough sphere they are the correlation of exp(z/rho) with the kernel
exp((u - y)/rho).

Contact pixels do not count. `_sums_by_subtraction` subtracts them from the sum over all pixels: it
is fast, but loses the digits of exp(penetration/rho). At short ranges and on rough spheres
`_sums_by_omission` therefore sets them to zero before it sums. Exponentials are relative to the
highest points of z and u, so that none overflows.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import ThreadpoolController

from hardcontact.contact.bearing_area import LowestGaps
from hardcontact.contact.geometry import Bodies, ContactGeometry, gaps_at

Floats = NDArray[np.float64]

#: Looked up once: it takes milliseconds.
LIBRARIES = ThreadpoolController()

#: Lowest gaps, those of the contact pixels, by the index (i, j) of the contact in the array.
GapsByContact = dict[tuple[int, int], LowestGaps]


class ContactPixels:
    """The substrate's pixels that are contact pixels of any contact of an array, each once.

    They are left out of the sum of every contact; those of the other contacts are then added again.
    `row` and `column` (pixels,) are their places on the substrate, by rows.
    """

    def __init__(self, bodies: Bodies, contacts: GapsByContact) -> None:
        pixels = bodies.substrate.pixels
        positions = bodies.geometry.positions
        touching = {
            index: np.ravel_multi_index(
                tuple(((positions[list(index)] + offsets) % pixels).T), (pixels, pixels)
            )
            for index, (_, offsets) in contacts.items()
        }
        flat = np.unique(np.concatenate(list(touching.values())))
        self.row, self.column = np.divmod(flat, pixels)
        self._own = {index: np.searchsorted(flat, pixel) for index, pixel in touching.items()}
        self._gaps = {index: gaps for index, (gaps, _) in contacts.items()}
        self._image_gaps = {
            index: _image_gaps(bodies, index, offsets) for index, (_, offsets) in contacts.items()
        }

    def leave_out(self, terms: NDArray[np.floating], first_row: int = 0) -> None:
        """Set these pixels to zero in the rows of the substrate (k, n) from the first one on."""
        block = slice(*np.searchsorted(self.row, [first_row, first_row + len(terms)]))
        terms[self.row[block] - first_row, self.column[block]] = 0.0

    def outside_sum(
        self, index: tuple[int, int], total: float, terms: Floats, highest: float, rho: float
    ) -> float:
        """Return the sum of exp(-(g + m)/rho) over pixels outside a contact (i, j).

        m is the height of the apex at closest approach. `total` sums all pixels but the contact
        pixels of all contacts, whose `terms` (pixels,) are overwritten. Both are at the approach at
        which the highest points of both bodies meet; `highest` is the sum of their heights.
        """
        terms[self._own[index]] = 0.0
        largest_gap = self._gaps[index][-1]
        image_sum = np.exp((largest_gap - self._image_gaps[index]) / rho).sum()
        return float(np.exp((largest_gap + highest) / rho) * (total + terms.sum()) + image_sum)


def _image_gaps(bodies: Bodies, index: tuple[int, int], offsets: NDArray[np.int_]) -> Floats:
    """Return the gaps (k,) in nm of images, in the window, of contact pixels at offsets."""
    pixels = bodies.substrate.pixels
    geometry = bodies.geometry
    if geometry.window <= pixels:
        return np.empty(0)
    reach = -(-geometry.window // (2 * pixels))
    flat, inverse = np.unique(offsets % pixels @ (pixels, 1), return_inverse=True)
    periods = pixels * np.arange(-reach, reach)
    row, column = np.divmod(flat, pixels)
    y = row[:, None] + periods
    x = column[:, None] + periods
    in_window = geometry.window_mask(y)[:, :, None] & geometry.window_mask(x)[:, None, :]
    own_y, own_x = (offsets // pixels + reach).T
    in_window[inverse, own_y, own_x] = False
    images = np.stack(np.broadcast_arrays(y[:, :, None], x[:, None, :]), axis=-1)
    return gaps_at(bodies, geometry.positions[list(index)], images[in_window])


#: Sums (contact, contact) over all pixels but those of contacts, and the factor of the sphere at
#: some pixels (their rows, their columns) of the substrate, seen from a contact (i, j).
SphereTerms = tuple[Floats, Callable[[tuple[int, int]], Floats]]

ROWS = 64  # in a block: small enough for the cache

#: Smallest sum, relative to the norms of its factors, that Fourier transforms give to 1e-9.
SMALLEST_TRANSFORMED = 1e-6

#: Largest penetration of a contact relative to the range at which contact pixels are subtracted, by
#: the precision of the heights: exp(2) of 7 digits are lost, or exp(6) of 16.
MAX_PENETRATION = {np.float32: 2.0, np.float64: 6.0}
#: Largest depth of a contact below the highest point of the surface, relative to the range: pixels
#: that round to zero are exp(-47) of those in contact.
MAX_DEPTH = {np.float32: 40.0, np.float64: 660.0}


def _products(
    blocks: Iterable[tuple[slice, Sequence[NDArray[np.floating]]]],
    folds: Sequence[NDArray[np.floating]],
) -> Floats:
    """Return G exp((z - highest)/rho) G^T, (rho, contact, contact), from blocks of rows.

    A block has its rows and the exponentials (rows, n) at each range; `folded` gives G.
    """
    columns = [np.ascontiguousarray(fold.T) for fold in folds]
    sums = np.zeros((len(folds), *[len(folds[0])] * 2))
    for rows, attractions in blocks:
        for index, attraction in enumerate(attractions):
            sums[index] += folds[index][:, rows] @ (attraction @ columns[index])
    return sums


def _blocks(
    heights: NDArray[np.floating],
    precision: type[np.floating],
    highest: float,
    rhos: Sequence[float],
) -> Iterator[tuple[slice, list[NDArray[np.floating]]]]:
    """Yield the rows of each block and its exponentials, in a precision."""
    for start in range(0, len(heights), ROWS):
        rows = slice(start, start + ROWS)
        yield rows, _attractions(heights[rows].astype(precision, copy=False), highest, rhos)


def _blocks_without_contacts(
    heights: NDArray[np.floating], contact_pixels: ContactPixels, rhos: Sequence[float]
) -> Iterator[tuple[slice, list[NDArray[np.floating]]]]:
    """Yield the rows of each block and its exponentials, zero at contact pixels."""
    for rows, attractions in _blocks(heights, np.float64, float(heights.max()), rhos):
        for attraction in attractions:
            contact_pixels.leave_out(attraction, rows.start)
        yield rows, attractions


def _attractions(
    heights: NDArray[np.floating], highest: float, rhos: Sequence[float]
) -> list[NDArray[np.floating]]:
    """Return `exponential` at every range: at half of another one it is the square of that."""
    attractions: dict[float, NDArray[np.floating]] = {}
    for rho in sorted(rhos, reverse=True):
        longer = attractions.get(2 * rho)
        attractions[rho] = exponential(heights, highest, rho) if longer is None else longer**2
    return [attractions[rho] for rho in rhos]


def _is_mirrored(heights: NDArray[np.floating]) -> bool:
    """Return whether heights equal both their mirror images; edges of most maps differ already."""
    return (
        np.array_equal(heights[0], heights[-1])
        and np.array_equal(heights, heights[::-1])
        and np.array_equal(heights, heights[:, ::-1])
    )


def _without_mirror_images(
    heights: NDArray[np.floating], folds: list[NDArray[np.floating]]
) -> tuple[NDArray[np.floating], list[NDArray[np.floating]]]:
    """Return a quarter of mirror-stitched heights (n, n) and the folds over its mirror images.

    Other heights and their folds are returned as they are.
    """
    if len(heights) % 2 or not _is_mirrored(heights):
        return heights, folds
    half = len(heights) // 2
    return heights[:half, :half], [fold[:, :half] + fold[:, : half - 1 : -1] for fold in folds]


def _sums_by_subtraction(bodies: Bodies, contacts: GapsByContact, rhos: Sequence[float]) -> Floats:
    """Return `outside_sums` on a smooth sphere: sums over all pixels less those in contact."""
    heights = bodies.substrate.heights
    precision = heights.dtype.type  # `join_bodies` permits these two.
    highest = float(heights.max())
    folds: list[NDArray[np.floating]] = [
        folded(len(heights), bodies.geometry, rho).astype(precision) for rho in rhos
    ]
    quarter, quarter_folds = _without_mirror_images(heights, folds)
    all_sums = _products(_blocks(quarter, precision, highest, rhos), quarter_folds)
    sums_outside = np.empty_like(all_sums)
    for index, (gaps, _) in contacts.items():
        for k, rho in enumerate(rhos):
            contact_sum = np.exp((gaps[-1] - gaps) / rho).sum()
            scale = np.exp((gaps[-1] + highest) / rho)
            sums_outside[k][index] = scale * all_sums[k][index] - contact_sum
    return sums_outside


def folded(pixels: int, geometry: ContactGeometry, rho: float) -> Floats:
    """Return G = exp(-y/rho) along one axis, summed over images in the window: (contact, n)."""
    offset = geometry.offsets()
    weight = np.exp(-geometry.paraboloid(offset) / rho)
    positions = geometry.positions
    return np.array(
        [np.bincount((position + offset) % pixels, weight, pixels) for position in positions]
    )


def exponential(heights: NDArray[np.floating], highest: float, rho: float) -> NDArray[np.floating]:
    """Return exp((heights - highest)/rho) in the precision of the heights (nm)."""
    attraction = heights - highest
    attraction /= rho
    np.exp(attraction, out=attraction)
    return attraction


def outside_sums(bodies: Bodies, contacts: GapsByContact, rhos: Sequence[float] | Floats) -> Floats:
    """Return the sum (rho, contact, contact) of exp(-(g + m)/rho) outside plastic contact.

    m is the height of the apex at closest approach. The contacts are `LowestGaps` by place (i, j)
    of the array.
    """
    ranges = np.asarray(rhos, float)
    sums_outside = np.empty((len(ranges), *[len(bodies.geometry.positions)] * 2))
    subtract = _are_shallow(bodies, contacts, ranges)
    with LIBRARIES.limit(limits=1, user_api="blas"):
        for is_chosen, method in ((subtract, _sums_by_subtraction), (~subtract, _sums_by_omission)):
            if is_chosen.any():
                sums_outside[is_chosen] = method(bodies, contacts, ranges[is_chosen].tolist())
    return sums_outside


def _are_shallow(bodies: Bodies, contacts: GapsByContact, rhos: Floats) -> NDArray[np.bool_]:
    """Return at which ranges (rho,) contact pixels can be subtracted from the sum over all.

    A rough sphere has a kernel for each range, and its maps are small: its sums stay exact.
    """
    if bodies.roughness is not None:
        return np.zeros(len(rhos), bool)
    lowest, largest = np.array([gaps[[0, -1]] for gaps, _ in contacts.values()]).T
    penetration = (largest - lowest).max()
    depth = (largest + bodies.substrate.heights.max()).max()
    precision = bodies.substrate.heights.dtype.type
    return np.asarray(
        (penetration <= MAX_PENETRATION[precision] * rhos) & (depth <= MAX_DEPTH[precision] * rhos)
    )


def _sums_by_omission(bodies: Bodies, contacts: GapsByContact, rhos: Sequence[float]) -> Floats:
    """Return `outside_sums` where no sum contains contact pixels, in double precision."""
    substrate = bodies.substrate
    roughness = bodies.roughness
    contact_pixels = ContactPixels(bodies, contacts)
    touching = substrate.heights[contact_pixels.row, contact_pixels.column].astype(float)
    highest_substrate = float(substrate.heights.max())
    highest_roughness = 0.0 if roughness is None else float(roughness.heights.max())
    highest = highest_substrate + highest_roughness
    sums_outside = np.empty((len(rhos), *[len(bodies.geometry.positions)] * 2))
    sphere_terms = _smooth_sphere_terms if roughness is None else _rough_sphere_terms
    sums = sphere_terms(bodies, contact_pixels, rhos)
    for k, (rho, (total, factor)) in enumerate(zip(rhos, sums, strict=True)):
        attraction = exponential(touching, highest_substrate, rho)
        for index in contacts:
            sums_outside[k][index] = contact_pixels.outside_sum(
                index, total[index], attraction * factor(index), highest, rho
            )
    return sums_outside


def _smooth_sphere_terms(
    bodies: Bodies, contact_pixels: ContactPixels, rhos: Sequence[float]
) -> Iterator[SphereTerms]:
    """Yield, for each range, the sums over all but contact pixels and the factor at these."""
    pixels = bodies.substrate.pixels
    row = contact_pixels.row
    column = contact_pixels.column
    folds = [folded(pixels, bodies.geometry, rho) for rho in rhos]
    blocks = _blocks_without_contacts(bodies.substrate.heights, contact_pixels, rhos)
    totals = _products(blocks, folds)
    for total, fold in zip(totals, folds, strict=True):

        def factor(index: tuple[int, int], fold: Floats = fold) -> Floats:
            return np.asarray(fold[index[0], row] * fold[index[1], column])

        yield total, factor


def _rough_sphere_terms(
    bodies: Bodies, contact_pixels: ContactPixels, rhos: Sequence[float]
) -> Iterator[SphereTerms]:
    """Yield the terms of `_smooth_sphere_terms` for a rough sphere, relative to its highest u."""
    assert bodies.roughness is not None
    pixels = bodies.substrate.pixels
    positions = bodies.geometry.positions
    heights = bodies.substrate.heights.astype(float)
    roughness = bodies.roughness.heights.astype(float)
    #: Rows, in units of whole rows, and columns of the contact pixels as seen from each position.
    rows = (contact_pixels.row - positions[:, None]) % pixels * pixels
    columns = (contact_pixels.column - positions[:, None]) % pixels
    for rho in rhos:
        attraction = exponential(roughness, float(roughness.max()), rho)
        kernel = _kernel(pixels, attraction, bodies.geometry, rho)
        terms = exponential(heights, float(heights.max()), rho)
        contact_pixels.leave_out(terms)

        def factor(index: tuple[int, int], kernel: Floats = kernel) -> Floats:
            return np.asarray(kernel.take(rows[index[0]] + columns[index[1]]))

        yield _correlation(terms, kernel, positions), factor


def _kernel(
    pixels: int, attraction: NDArray[np.floating], geometry: ContactGeometry, rho: float
) -> Floats:
    """Return exp((u - max(u) - y)/rho) on (n, n) offsets from the apex, summed over images."""
    period = len(attraction)
    weights = _folded_by_shift(pixels, period, geometry, rho)
    kernel = np.zeros((pixels, pixels))
    columns = np.arange(pixels)
    for start in range(0, pixels, ROWS):
        rows = columns[start : start + ROWS]
        for (shift_y, weight_y), (shift_x, weight_x) in product(weights.items(), repeat=2):
            shifted = attraction[np.ix_((rows + shift_y) % period, (columns + shift_x) % period)]
            kernel[rows] += weight_y[rows, None] * weight_x * shifted
    return kernel


def _folded_by_shift(
    pixels: int, period: int, geometry: ContactGeometry, rho: float
) -> dict[int, Floats]:
    """Return exp(-y/rho) along one axis, summed over images of the same shift of the roughness."""
    weights: dict[int, Floats] = {}
    reach = -(-geometry.window // (2 * pixels))
    for image in range(-reach, reach):
        offset = np.arange(pixels) + image * pixels
        decay = np.exp(-geometry.paraboloid(offset) / rho)
        weight = np.where(geometry.window_mask(offset), decay, 0.0)
        shift = image * pixels % period
        weights[shift] = weights.get(shift, np.zeros(pixels)) + weight
    return weights


def _correlation(
    attraction: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return the sum (contact, contact) of attraction * kernel, shifted to each contact.

    Fourier transforms take a third of the time of products, but their error is relative to the
    norms of both factors: they give the sums if all of these are large enough.
    """
    total = _correlation_by_transforms(attraction, kernel, positions)
    norm = np.linalg.norm(attraction) * np.linalg.norm(kernel)
    if total.min() > SMALLEST_TRANSFORMED * norm:
        return total
    return _correlation_by_products(attraction, kernel, positions)


def _correlation_by_transforms(
    attraction: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return `_correlation` with an error of some 1e-16 of the norms of both factors."""
    from scipy import fft

    product = fft.rfft2(attraction)
    product *= np.conj(fft.rfft2(kernel))
    rows = fft.ifft(product, axis=0, overwrite_x=True)[positions]
    return np.asarray(fft.irfft(rows, len(kernel), axis=1)[:, positions])


def _correlation_by_products(
    attraction: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return `_correlation` with an error relative to each sum."""
    # Each row of the kernel times one row of the attraction for every contact: matrices again.
    pixels = len(kernel)
    step = 4
    total = np.zeros((len(positions),) * 2)
    for start in range(0, pixels, step):
        rows = kernel[start : start + step]
        twice = np.concatenate([rows, rows], axis=1)
        shifted = np.lib.stride_tricks.sliding_window_view(twice, pixels, axis=1)
        shifted_rows = np.arange(start, start + len(rows))[:, None] + positions
        columns = shifted[:, pixels - positions]
        total += (attraction[shifted_rows % pixels] @ columns.transpose(0, 2, 1)).sum(axis=0)
    return total
