"""Pull-off of two bodies: rigid and plastic, at every range, at several loadings.

A pixel at the gap g attracts with the pressure (W/rho) exp(-g/rho), Eq. 2 of the paper. Totals are
sums of exp(-g/rho) at closest approach; `pull_off_force` turns them into forces, Eq. 3.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.base.arrays import Floats
from hardcontact.base.units import DIMENSIONLESS, NANOMETRE, NEWTON, NM, PASCAL
from hardcontact.contact.bearing_area import ContactPixels, all_contact_pixels
from hardcontact.contact.contact import CONTACT_AXES, CONTACT_MODELS, Contact
from hardcontact.contact.force_sum.outside_sums import outside_sums
from hardcontact.contact.geometry import Bodies, gap_map, join_bodies, largest_contact_gap
from hardcontact.surfaces.height_map import HeightMap

#: Dimension, values and attributes of a coordinate.
Axis = tuple[tuple[str], Any, dict[str, str]]
#: Forces on one surface, of any shape.
ForcesOnSurface = Callable[[HeightMap], Floats]

#: Work of adhesion (J/m²) of all stored forces, which are proportional to it.
WORK_OF_ADHESION = 1.0
#: Attributes of a stored force.
FORCE_ATTRS = NEWTON | {"long_name": "pull-off force at W = 1 J/m2"}


def loading_axis(loaded_contacts: Sequence[Contact]) -> dict[str, Axis]:
    """Return the coordinate of the loadings of contacts, by name."""
    names = [contact.loading_name for contact in loaded_contacts]
    return {"loading": (("loading",), names, {})}


def range_axis(ranges: Sequence[float]) -> dict[str, Axis]:
    """Return the coordinate of ranges of adhesion."""
    return {"rho": (("rho",), np.asarray(ranges, float), NM)}


def pull_off_force(
    total: ArrayLike, rho: ArrayLike, pixel_size: float, work_of_adhesion: float
) -> Floats:
    """Return the pull-off force (N, positive) from sums of exp(-gap/rho): Eq. 3.

    Sums and ranges of adhesion broadcast. Ranges and pixel size are in nm, the work of adhesion in
    J/m². Raises ValueError if a sum exceeds the range of floats, because the highest point outside
    the window lies many hundred rho above the contact.
    """
    if not np.isfinite(total).all():
        raise ValueError(
            f"rho = {np.min(rho):g} nm: expected a longer range of adhesion, because the surface "
            "rises over 700 ranges above a contact, more than exp() can hold"
        )
    pixel_force = work_of_adhesion / np.asarray(rho) * pixel_size**2 * NANOMETRE
    return np.asarray(pixel_force * np.asarray(total))


def attraction_totals(
    bodies: Bodies,
    contact_pixels: ContactPixels,
    pixel_counts: Sequence[int],
    ranges: Sequence[float],
) -> Floats:
    """Return sums (pixel count, rho, contact_y, contact_x) of exp(-gap/rho) at closest approach.

    A pixel count is the number of pixels that touch; `contact_pixels` has at least as many.
    """
    gaps = contact_pixels.gaps
    sums_by_range = list(zip(outside_sums(bodies, contact_pixels, ranges), ranges, strict=True))
    totals = [
        [_total_of_lowest(outside_sum, gaps, count, rho) for outside_sum, rho in sums_by_range]
        for count in pixel_counts
    ]
    return np.array(totals)


def _total_of_lowest(
    outside_sum: Floats, gaps: Floats, contact_pixel_count: int, rho: float
) -> Floats:
    """Return the sum (...) of exp(-gap/rho) if only the lowest of the gaps (..., k) touch.

    Gaps in nm ascend. If all k pixels touch, the other pixels add `outside_sum`. If fewer touch,
    all gaps are larger by the same length.
    """
    largest_gap = gaps[..., contact_pixel_count - 1]
    opened = np.exp((largest_gap[..., None] - gaps[..., contact_pixel_count:]) / rho).sum(axis=-1)
    return np.asarray(
        contact_pixel_count + opened + outside_sum * np.exp((largest_gap - gaps[..., -1]) / rho)
    )


def forces_at_loadings(
    bodies: Bodies, loaded_contacts: Sequence[Contact], ranges: Sequence[float]
) -> Floats:
    """Return the forces (loading, rho, contact_y, contact_x) of two bodies in N at 1 J/m².

    The contacts differ in their loading alone; ranges of adhesion are in nm.
    """
    return _pixels_and_forces(bodies, loaded_contacts, ranges)[2]


def make_force_function(contact: Contact, sphere: HeightMap | None = None) -> ForcesOnSurface:
    """Return a function of a surface: its forces (contact_y, contact_x) in N at 1 J/m²."""

    def compute_forces(surface: HeightMap) -> Floats:
        bodies = join_bodies(surface, sphere, contact)
        return np.asarray(forces_at_loadings(bodies, [contact], [contact.rho])[0, 0])

    return compute_forces


def _pixels_and_forces(
    bodies: Bodies, loaded_contacts: Sequence[Contact], ranges: Sequence[float]
) -> tuple[list[int], ContactPixels, Floats]:
    """Return the counts (loading,) of contact pixels, the pixels of the largest, and the forces."""
    pixel_size = bodies.geometry.pixel_size
    pixel_counts = [contact.pixel_count(pixel_size) for contact in loaded_contacts]
    contact_pixels = all_contact_pixels(bodies, max(pixel_counts))
    totals = attraction_totals(bodies, contact_pixels, pixel_counts, ranges)
    rho = np.asarray(ranges, float)[:, None, None]
    forces = pull_off_force(totals, rho, pixel_size, WORK_OF_ADHESION)
    return pixel_counts, contact_pixels, forces


def pull_off_dataset(bodies: Bodies, contact: Contact, ranges: Sequence[float]) -> xr.Dataset:
    """Return the rigid and plastic pull-off force of two bodies at every contact and range.

    Returns ``pull_off_force`` (contact_model, rho, contact_y, contact_x) in N at 1 J/m²,
    ``apex_height`` in nm, ``contact_pixel_count`` and `touched_patches`. Raises ValueError if a
    range (nm) is too short for the relief of the surface.
    """
    pixel_size = bodies.geometry.pixel_size
    loaded_contacts = [replace(contact, plastic=False), contact]
    counts, contact_pixels, forces = _pixels_and_forces(bodies, loaded_contacts, ranges)
    gaps = contact_pixels.gaps
    # At closest approach the largest gap of the touching pixels has become zero.
    apex_heights = -np.stack([gaps[..., 0], gaps[..., -1]])
    positions = bodies.geometry.positions * pixel_size
    model_axes = ("contact_model", *CONTACT_AXES)
    return xr.Dataset(
        {
            "pull_off_force": (("contact_model", "rho", *CONTACT_AXES), forces, FORCE_ATTRS),
            "apex_height": (model_axes, apex_heights, NM),
            "contact_pixel_count": ("contact_model", counts, DIMENSIONLESS),
            "touched_patches": ((), touched_patches(bodies, contact_pixels), DIMENSIONLESS),
        },
        {"contact_model": CONTACT_MODELS}
        | range_axis(ranges)
        | {axis: (axis, positions, NM) for axis in CONTACT_AXES},
        {"work_of_adhesion": WORK_OF_ADHESION, "pixel_size": pixel_size},
    )


def touched_patches(bodies: Bodies, contact_pixels: ContactPixels) -> int:
    """Return the number of patches of a mirrored scan that hold the deepest pixel of some contact.

    A patch is a group of contact pixels that share edges or corners. If one particle on a flat
    scan carried every contact, forces would scatter little, however wrong they were.
    """
    from scipy.ndimage import label

    pixels = bodies.substrate.pixels
    points = (bodies.geometry.apexes()[:, :, None] + contact_pixels.offsets) % pixels
    # Fold the mirror images back onto the scan, a quarter of the map.
    rows, columns = np.moveaxis(np.minimum(points, pixels - 1 - points), -1, 0)
    is_touched = np.zeros((-(-pixels // 2),) * 2, bool)
    is_touched[rows, columns] = True
    patches, _ = label(is_touched, np.ones((3, 3)))
    # The first pixel of a contact has its lowest gap.
    return len(np.unique(patches[rows[..., 0], columns[..., 0]]))


def mean_pull_off_dataset(bodies: Bodies, contact: Contact, ranges: Sequence[float]) -> xr.Dataset:
    """Return the pull-off forces of two bodies, averaged over the contacts.

    The ranges of adhesion are in nm. Returns ``pull_off_force`` (contact_model, rho) in N at
    1 J/m².
    """
    loaded_contacts = [replace(contact, plastic=False), contact]
    forces = forces_at_loadings(bodies, loaded_contacts, ranges).mean(axis=(-2, -1))
    return xr.Dataset(
        {"pull_off_force": (("contact_model", "rho"), forces, FORCE_ATTRS)},
        {"contact_model": CONTACT_MODELS} | range_axis(ranges),
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def trace_contact(bodies: Bodies, index: tuple[int, int], contact: Contact) -> xr.Dataset:
    """Trace the gap, adhesive pressure and force of one plastic contact of the array.

    The index is row and column in the array. Returns ``gap`` (y, x) in nm before flattening,
    ``adhesive_pressure`` (y, x) in Pa and ``force`` (separation) in N.
    """
    geometry = bodies.geometry
    rho = contact.rho
    work = contact.work
    gap = gap_map(bodies, index)
    gap -= largest_contact_gap(gap, contact.pixel_count(geometry.pixel_size))
    attraction = np.exp(-np.maximum(gap, 0) / rho)
    pressure = work / (rho * NANOMETRE) * attraction
    pull_off = float(pull_off_force(attraction.sum(), rho, geometry.pixel_size, work))
    # The bodies keep their deformed shape: all gaps grow by the same length.
    separation = np.linspace(0, 10 * rho, 201)
    position = geometry.offsets() * geometry.pixel_size
    return xr.Dataset(
        {
            "gap": (("y", "x"), gap.astype(np.float32), NM),
            "adhesive_pressure": (("y", "x"), pressure.astype(np.float32), PASCAL),
            "force": ("separation", -pull_off * np.exp(-separation / rho), NEWTON),
        },
        {
            "y": ("y", position, NM),
            "x": ("x", position, NM),
            "separation": ("separation", separation, NM),
        },
        {"rho": rho, "work_of_adhesion": work, "pull_off_force": pull_off},
    )
