"""The pixels that touch in an array of contacts, left out of sums over the whole surface.

Forces of plastic contact sum over the pixels outside it. To subtract the contact pixels from a sum
over all pixels would cost as many digits as exp(penetration/rho) has.
"""

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.bearing_area import LowestGaps
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.pixel_gaps import gaps_at

__all__ = ["ContactPixels", "Contacts"]

Floats = NDArray[np.float64]

#: Contact pixels of each contact, by its place (i, j) in the array.
Contacts = dict[tuple[int, int], LowestGaps]


class ContactPixels:
    """The substrate's pixels that are contact pixels of any contact of an array, each once.

    They are left out of the sum of every contact; those of the other contacts are then added again.

    Parameters
    ----------
    bodies : Bodies
        The substrate and a smooth or a rough sphere.
    contacts : dict
        Place (i, j) -> `LowestGaps` of each contact of the array.

    Attributes
    ----------
    row, column : numpy.ndarray
        (pixels,) of each on the substrate.
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

    def left_out(self, heights: NDArray[np.floating]) -> NDArray[np.floating]:
        """Return a copy of heights (n, n) in which these pixels are infinitely deep."""
        rest = heights.copy()
        rest[self.row, self.column] = -np.inf
        return rest

    def outside(
        self,
        place: tuple[int, int],
        total: float,
        others: Floats,
        highest: float,
        rho: float,
    ) -> float:
        """Return the sum of exp(-(g + d)/rho) over pixels outside the contact at a place.

        d is the separation of closest approach.

        Parameters
        ----------
        place : tuple of int
            (i, j) of the contact.
        total : float
            Sum over all pixels but these, at the approach where the highest points would meet.
        others : numpy.ndarray
            (pixels,) terms of these pixels at that approach; overwritten where they are contact
            pixels of this contact.
        highest : float
            Sum of the highest points of both bodies in nm.
        rho : float
            Range of adhesion in nm.
        """
        others[self._own[place]] = 0.0
        approach = self._gaps[place][-1]
        of_images = np.exp((approach - self._image_gaps[place]) / rho).sum()
        return float(np.exp((approach + highest) / rho) * (total + others.sum()) + of_images)


def _image_gaps(bodies: Bodies, place: tuple[int, int], offsets: NDArray[np.int_]) -> Floats:
    """Return the gaps (k,) in nm of the periodic images, inside the window, of contact pixels.

    Images that are contact pixels themselves are left out. offsets: (contact_pixels, 2) from the
    apex.
    """
    pixels, geometry = bodies.substrate.pixels, bodies.geometry
    reach = -(-geometry.window // pixels)
    steps = np.stack(np.meshgrid(*[np.arange(-reach, reach + 1) * pixels] * 2), -1).reshape(-1, 2)
    places = (offsets[:, None] + steps).reshape(-1, 2)
    places = places[geometry.inside(places).all(axis=1)]
    code = (4 * geometry.window, 1)  # one number a pixel, in the order of rows and columns
    codes, first = np.unique(places @ code, return_index=True)
    places = places[first[~np.isin(codes, offsets @ code)]]
    return gaps_at(bodies, geometry.positions[list(place)], places)
