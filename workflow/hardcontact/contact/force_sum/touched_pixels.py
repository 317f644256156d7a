"""Pixels of the substrate that touch in any contact of an array, and their part in the sums.

`outside_sums` has the formula; `geometry` defines the heights z, u and y.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.bearing_area import ContactPixels
from hardcontact.contact.geometry import Bodies, reference_gaps


class SphereTerms(NamedTuple):
    """What one range needs of the sphere; z and u are relative to their highest points."""

    #: (contact_y, contact_x), sums of exp((z + u - y)/rho) over pixels that are not touched.
    untouched_sums: Floats
    #: Returns exp((u - y)/rho) (touched,) of a contact (i, j) at the touched pixels, each summed
    #: over the pixel's images in the window.
    sphere_factor_at: Callable[[tuple[int, int]], Floats]


def exponential(heights: NDArray[np.floating], highest: float, rho: float) -> NDArray[np.floating]:
    """Return exp((heights - highest)/rho) in the precision of the heights (nm)."""
    exponents = heights - highest
    exponents /= rho
    return np.asarray(np.exp(exponents, out=exponents))


class TouchedPixels:
    """The pixels of the substrate that touch in any contact: their `row` and `column` (touched,).

    It also knows which of them touch in each contact, and the gaps of the images of these.
    """

    def __init__(self, bodies: Bodies, contact_pixels: ContactPixels) -> None:
        pixels = bodies.substrate.pixels
        apexes = bodies.geometry.apexes()
        touching = _flat_indices(apexes[:, :, None] + contact_pixels.offsets, pixels)
        touched = np.unique(touching)
        self.row, self.column = np.divmod(touched, pixels)
        self._indices_of_contact = np.searchsorted(touched, touching)
        self._largest_gaps = contact_pixels.reference_gaps[..., -1]
        self._image_gaps = {
            index: _image_gaps(bodies, apexes[index], contact_pixels.offsets[index])
            for index in np.ndindex(self._largest_gaps.shape)
        }

    def leave_out(self, block: NDArray[np.floating], first_row: int = 0) -> None:
        """Set the touched pixels to zero in a block (k, n) of rows that begin at `first_row`."""
        start, end = np.searchsorted(self.row, [first_row, first_row + len(block)])
        block[self.row[start:end] - first_row, self.column[start:end]] = 0.0

    def sum_outside(
        self,
        index: tuple[int, int],
        untouched_sum: float,
        touched_terms: Floats,
        highest: float,
        rho: float,
    ) -> float:
        """Return the sum of exp(-gap/rho) outside a contact (i, j), whose pixels all touch.

        `untouched_sum` and `touched_terms` (touched,) are for the apex at height 0, relative to
        exp(highest/rho). The terms are overwritten.
        """
        touched_terms[self._indices_of_contact[index]] = 0.0
        largest_gap = self._largest_gaps[index]
        scale = np.exp((largest_gap + highest) / rho)  # brings the apex to minus the largest gap
        image_sum = np.exp((largest_gap - self._image_gaps[index]) / rho).sum()
        return float(scale * (untouched_sum + touched_terms.sum()) + image_sum)


def _flat_indices(positions: NDArray[np.int_], pixels: int) -> NDArray[np.int_]:
    """Return the flat indices (...) of positions (..., 2) on a periodic map of n x n pixels."""
    row, column = np.moveaxis(positions % pixels, -1, 0)
    return np.asarray(row * pixels + column)


def _image_gaps(bodies: Bodies, apex: NDArray[np.int_], offsets: NDArray[np.int_]) -> Floats:
    """Return the reference gaps (k,) of the images of contact pixels that lie in the window.

    Images of contact pixels that touch themselves are left out. Without a window wider than a
    period there are no images.
    """
    pixels = bodies.substrate.pixels
    geometry = bodies.geometry
    if geometry.window_pixels <= pixels:
        return np.empty(0)
    reach = -(-geometry.window_pixels // (2 * pixels))
    flat, inverse = np.unique(_flat_indices(offsets, pixels), return_inverse=True)
    periods = pixels * np.arange(-reach, reach)
    row, column = np.divmod(flat, pixels)
    y = row[:, None] + periods
    x = column[:, None] + periods
    is_image = geometry.window_mask(y)[:, :, None] & geometry.window_mask(x)[:, None, :]
    period_y, period_x = (offsets // pixels + reach).T
    is_image[inverse, period_y, period_x] = False
    images = np.stack(np.broadcast_arrays(y[:, :, None], x[:, None, :]), axis=-1)
    return reference_gaps(bodies, apex, images[is_image])
