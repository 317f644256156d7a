"""Sums of exp(-gap/rho) at contacts of a sphere that keeps the indents of those before."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.geometry import Bodies
from hardcontact.contact.repeated_contact import Indentation, over_window, repeated_contacts

__all__ = ["repeated_totals"]

Floats = NDArray[np.float64]


class _Attraction:
    """Sums of exp(-g/rho) at the contacts of a sphere whose roughness changes.

    The factor of the substrate is computed once, that of the sphere is changed where it is indented
    alone; a contact is a product of both. Indented pixels touch, so that their gap of zero counts
    as any other and no pixel is left out.
    """

    def __init__(self, bodies: Bodies, rho: float) -> None:
        whole = over_window(bodies)
        assert whole.roughness is not None
        self.geometry, self.rho, self.pixels = bodies.geometry, rho, bodies.substrate.pixels
        offset = bodies.geometry.offsets()
        shape = bodies.geometry.paraboloid(offset)
        self.heights = np.fft.fftshift(whole.roughness.heights) - shape[:, None] - shape
        h_max, self.t_max = float(bodies.substrate.heights.max()), float(self.heights.max())
        self.highest = h_max + self.t_max
        of_substrate = np.exp((bodies.substrate.heights.astype(float) - h_max) / rho)
        self.of_substrate = np.tile(of_substrate, (2, 2))
        #: Pixel of the substrate below each offset, for the apex at the origin.
        self.folded = offset % self.pixels
        self.of_sphere = np.zeros((self.pixels,) * 2)
        np.add.at(
            self.of_sphere,
            np.ix_(self.folded, self.folded),
            np.exp((self.heights - self.t_max) / rho),
        )

    def total(self, position: NDArray[np.int_], indentation: Indentation) -> float:
        """Return the sum at the closest approach of a contact that has indented the sphere."""
        offsets = indentation.contact.offsets
        self._indent(offsets, indentation.depth)
        (y, x), pixels = position % self.pixels, self.pixels
        seen = self.of_substrate[y : y + pixels, x : x + pixels]
        approach = indentation.contact.gaps[-1]
        product = np.einsum("ij,ij", seen, self.of_sphere)
        return float(np.exp((approach + self.highest) / self.rho) * product)

    def _indent(self, offsets: NDArray[np.int_], depth: Floats) -> None:
        """Compute the factor of the sphere anew where it is indented, from all periodic images."""
        window, pixels = self.geometry.window, self.pixels
        places = np.unique((offsets % pixels), axis=0)
        first = (places + window // 2) % pixels
        reach = np.arange(-(-window // pixels)) * pixels
        rows, columns = (first[:, axis, None] + reach for axis in (0, 1))
        inside = (rows < window)[:, :, None] & (columns < window)[:, None, :]
        at = np.minimum(rows, window - 1)[:, :, None], np.minimum(columns, window - 1)[:, None, :]
        terms = np.exp((self.heights[at] - depth[at] - self.t_max) / self.rho)
        self.of_sphere[tuple(places.T)] = np.where(inside, terms, 0.0).sum(axis=(1, 2))


def repeated_totals(
    bodies: Bodies, positions: NDArray[np.int_], contact_pixels: int, rho: float
) -> Iterator[tuple[float, Indentation]]:
    """Press one place of a sphere onto places of a substrate, and sum exp(-gap/rho) at each.

    Parameters
    ----------
    bodies : Bodies
        Substrate and sphere before the first contact.
    positions : numpy.ndarray
        (contacts, 2) pixels of the substrate under the apex: row, column.
    contact_pixels : int
        At each contact.
    rho : float
        Range of adhesion in nm.

    Yields
    ------
    total : float
        At plastic closest approach, with the sphere as all contacts so far have left it.
    indentation : Indentation
        Of the contact.
    """
    attraction = _Attraction(bodies, rho)
    contacts = repeated_contacts(bodies, positions, contact_pixels)
    for position, indentation in zip(positions, contacts, strict=True):
        yield attraction.total(position, indentation), indentation
