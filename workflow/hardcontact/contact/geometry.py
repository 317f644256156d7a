"""The sphere over a substrate: its paraboloid, the array of contacts, their gaps in a window.

The reference gap of a pixel is g = y - u - z in nm: the height y of the sphere, less its roughness
u (positive towards the substrate) and the height z of the substrate. If the apex is at the height
m, the gap is g + m. At closest approach m is minus the largest reference gap of the contact pixels.

Along one axis, a window of n pixels about a contact at the pixel c holds the pixels c - n/2 to
c + n/2 - 1, counted on over periods of the substrate.
"""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.filters import interpolate
from hardcontact.surfaces.height_map import HeightMap, load_height_map


@dataclass(frozen=True, eq=False)
class ContactGeometry:
    """The smooth sphere, its window and the array of contacts."""

    radius: float  #: Of the sphere, in nm.
    pixel_size: float  #: Width of a pixel in nm.
    window_pixels: int  #: Pixels per row of the window, even.
    #: (contacts_per_row,) pixels along either axis; each pair of them is a contact.
    contact_positions: NDArray[np.int_]

    def paraboloid(self, offsets: ArrayLike) -> Floats:
        """Return the heights (nm) of the smooth sphere at offsets (pixels) along one axis."""
        return (np.asarray(offsets) * self.pixel_size) ** 2 / (2 * self.radius)

    def window_mask(self, offsets: NDArray[np.int_]) -> NDArray[np.bool_]:
        """Return whether offsets from the apex (pixels) lie in the window, along one axis."""
        return (offsets >= -(self.window_pixels // 2)) & (offsets < self.window_pixels // 2)

    def apexes(self) -> NDArray[np.int_]:
        """Return the pixel (contact_y, contact_x, 2) of the apex at every contact: row, column."""
        return np.stack(
            np.meshgrid(self.contact_positions, self.contact_positions, indexing="ij"), axis=-1
        )

    def offsets(self) -> NDArray[np.int_]:
        """Return all offsets (window_pixels,) from the apex along one axis, in pixels."""
        return np.arange(self.window_pixels) - self.window_pixels // 2


@dataclass(frozen=True, eq=False)
class Bodies:
    """A substrate and a sphere on common pixels, ready for contact."""

    substrate: HeightMap  #: Heights z (n, n), periodic.
    #: Roughness u of the sphere, periodic, with the apex at the origin; None for a smooth sphere.
    sphere_roughness: HeightMap | None
    geometry: ContactGeometry

    def sphere_heights(self, rows: NDArray[np.int_], columns: NDArray[np.int_]) -> Floats:
        """Return the heights y - u (k, l) in nm at rows (k,) and columns (l,) from the apex."""
        heights = self.geometry.paraboloid(rows)[:, None] + self.geometry.paraboloid(columns)
        if self.sphere_roughness is not None:
            period = self.sphere_roughness.pixels
            heights -= self.sphere_roughness.heights[np.ix_(rows % period, columns % period)]
        return heights


def count_window_pixels(window: float, pixel_size: float) -> int:
    """Return the pixels per row of a window (nm), an even number."""
    return 2 * int(round(window / pixel_size / 2))


def contact_positions(pixels: int, contacts_per_row: int) -> NDArray[np.int_]:
    """Return the pixels (contacts_per_row,) of contacts, evenly over a period of the substrate."""
    # A quarter of a step from the border, no two contacts are mirror images.
    steps = np.arange(contacts_per_row) + 0.25
    return np.floor(steps * pixels / contacts_per_row).astype(int)


def sample_contacts(
    rng: np.random.Generator, contacts_per_row: int, count: int
) -> NDArray[np.int_]:
    """Sample indices (count or all, 2) of contacts of the array, each contact at most once."""
    numbers = rng.permutation(contacts_per_row**2)[:count]
    return np.stack(np.divmod(numbers, contacts_per_row), axis=1)


def join_bodies(substrate: HeightMap, sphere: HeightMap | None, contact: Contact) -> Bodies:
    """Bring a substrate and a sphere together, on the smaller of their two pixel sizes.

    `sphere` is the mirrored scan of its roughness, or None for a smooth sphere.
    """
    substrate = _convert_precision(substrate)
    sphere_roughness = None
    if sphere is not None:
        sphere = _convert_precision(sphere)
        pixel_size = min(substrate.pixel_size, sphere.pixel_size)
        substrate = _refine(substrate, pixel_size)
        sphere = _refine(sphere, pixel_size)
        # The origin of a mirrored map is a corner of the scan; the apex is in its middle.
        middle = sphere.pixels // 4
        heights = np.roll(sphere.heights, (-middle, -middle), axis=(0, 1))
        sphere_roughness = replace(sphere, heights=heights)
    geometry = ContactGeometry(
        contact.radius,
        substrate.pixel_size,
        count_window_pixels(contact.window, substrate.pixel_size),
        contact_positions(substrate.pixels, contact.contacts_per_row),
    )
    return Bodies(substrate, sphere_roughness, geometry)


def spheres_at_positions(sphere: HeightMap, positions_per_row: int) -> list[HeightMap]:
    """Return copies of a sphere's mirrored scan, each moved to touch at a point of a grid."""
    scan_pixels = sphere.pixels // 2
    positions = (2 * np.arange(positions_per_row) + 1) * scan_pixels // (2 * positions_per_row)
    shifts = (scan_pixels // 2 - positions).tolist()
    return [
        replace(sphere, heights=np.roll(sphere.heights, shift, axis=(0, 1)))
        for shift in product(shifts, repeat=2)
    ]


def read_bodies(substrate_path: str, sphere_path: str | None, contact: Contact) -> Bodies:
    """Read two height maps of the study and join them by `join_bodies`."""
    sphere = load_height_map(sphere_path) if sphere_path else None
    return join_bodies(load_height_map(substrate_path), sphere, contact)


def _convert_precision(height_map: HeightMap) -> HeightMap:
    """Return a map with heights in float64, unless they are in float32."""
    precision = np.float32 if height_map.heights.dtype == np.float32 else np.float64
    return replace(height_map, heights=height_map.heights.astype(precision, copy=False))


def _refine(height_map: HeightMap, pixel_size: float) -> HeightMap:
    """Return a periodic map on pixels of a size (nm); its period is rounded to whole pixels."""
    pixels = max(round(height_map.size / pixel_size), height_map.pixels)
    if pixels != height_map.pixels:
        height_map = interpolate(height_map, pixels)
    return replace(height_map, pixel_size=pixel_size)


def reference_gaps(bodies: Bodies, apex: NDArray[np.int_], offsets: NDArray[np.int_]) -> Floats:
    """Return the reference gaps (...) at offsets (..., 2) in pixels from an apex (2,)."""
    y, x = np.moveaxis((apex + offsets) % bodies.substrate.pixels, -1, 0)
    gaps = bodies.geometry.paraboloid(offsets).sum(axis=-1) - bodies.substrate.heights[y, x]
    if bodies.sphere_roughness is not None:
        sphere_y, sphere_x = np.moveaxis(offsets % bodies.sphere_roughness.pixels, -1, 0)
        gaps -= bodies.sphere_roughness.heights[sphere_y, sphere_x]
    return np.asarray(gaps)


def reference_gap_map(
    bodies: Bodies, index: tuple[int, int] | NDArray[np.int_], sphere_heights: Floats | None = None
) -> Floats:
    """Return the reference gaps (n, n) in the window of one contact; the apex is at (n/2, n/2).

    `sphere_heights` (n, n) are the same for all contacts; None computes them.
    """
    geometry = bodies.geometry
    offset = geometry.offsets()
    if sphere_heights is None:
        sphere_heights = bodies.sphere_heights(offset, offset)
    apex = geometry.contact_positions[list(index)]
    rows, columns = (apex[:, None] + offset) % bodies.substrate.pixels
    return np.asarray(sphere_heights - bodies.substrate.heights[rows].take(columns, axis=1))


def largest_contact_gap(gap: Floats, contact_pixel_count: int) -> float:
    """Return the largest gap (nm) of the contact pixels, which have the smallest gaps."""
    if gap.ndim == 2 and contact_pixel_count <= len(gap):
        # In N rows the smallest gap is at most this bound, so the N contact pixels are, too.
        bound = np.partition(gap.min(axis=1), contact_pixel_count - 1)[contact_pixel_count - 1]
        gap = gap[gap <= bound]
    return float(np.partition(gap.ravel(), contact_pixel_count - 1)[contact_pixel_count - 1])


def square_around_lowest(gap: Floats, pixels: int) -> Floats:
    """Return the square (pixels, pixels) of a gap map about its lowest point, within the map."""
    lowest = np.unravel_index(gap.argmin(), gap.shape)
    row, column = np.clip(np.array(lowest) - pixels // 2, 0, gap.shape[0] - pixels)
    return gap[row : row + pixels, column : column + pixels]
