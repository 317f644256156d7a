"""Pull-off forces of two bodies and of all scans, and how window and pixels change them.

A pixel attracts with the pressure (W/rho) exp(-gap/rho), Eq. 2 of the paper. The force is

    F = (W/rho) a sum over all pixels of exp(-gap/rho),

with the area a of a pixel and the gaps at closest approach, Eq. 3. Forces are computed at a work of
adhesion W of 1 J/m², because they are proportional to it.

From the sums to adhesion.nc, each function gives more than the one before:

    attraction_sums         the sums, for several numbers of contact pixels
    forces_at_loadings      the forces that they give: on masters and, by `make_force_function`,
                            on surfaces with changed octaves
    pull_off_dataset        rigid and plastic forces of one scan of each body
    pull_off_on_spheres     the same on all scans of the sphere
    pull_off_with_checks    also the effects of window and pixels
    stack_pull_off_forces   all this of all scans of all surfaces: adhesion.nc
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import DatasetsByLabels, stack
from hardcontact.base.units import DIMENSIONLESS, NANOMETRE, NEWTON, NM
from hardcontact.contact.bearing_area import ContactPixels, all_contact_pixels
from hardcontact.contact.contact import (
    CONTACT_AXES,
    CONTACT_DIMENSIONS,
    CONTACT_MODELS,
    PLASTIC,
    Contact,
)
from hardcontact.contact.force_sum.outside_sums import outside_sums
from hardcontact.contact.geometry import Bodies, join_bodies
from hardcontact.contact.numerical_limits import EXP_LIMITS
from hardcontact.contact.patches import count_touched_patches
from hardcontact.surfaces.filters import interpolate
from hardcontact.surfaces.height_map import HeightMap

#: A function that returns the forces on a height map, in an array of any shape.
ForceFunction = Callable[[HeightMap], Floats]
#: Work of adhesion (J/m²) of all forces of this module.
WORK_OF_ADHESION = 1.0
#: Attributes of forces at this work of adhesion.
FORCE_ATTRS = NEWTON | {"long_name": "pull-off force at W = 1 J/m2"}


def attraction_sums(
    bodies: Bodies, contact_pixels: ContactPixels, counts: Sequence[int], ranges: Sequence[float]
) -> Floats:
    """Return sums (pixel count, rho, contact_y, contact_x) of exp(-gap/rho) at closest approach.

    If n pixels touch, they are those with the n smallest reference gaps g_1 <= g_2 <= ..., and the
    apex is at -g_n. Contact pixels have no gap, so each adds one, also if it penetrates. All other
    pixels add exp(-(g - g_n)/rho). With N pixels in `contact_pixels`,

        sum = n + sum over i = n+1 ... N of exp(-(g_i - g_n)/rho)
                + exp((g_n - g_N)/rho) x `outside_sums`, which hold with the apex at -g_N.
    """
    gaps = contact_pixels.reference_gaps
    sums_outside = outside_sums(bodies, contact_pixels, ranges)
    rho_column = np.asarray(ranges, float)[:, None, None]
    sums = []
    for count in counts:
        largest_gap = gaps[..., count - 1]
        open_gaps = gaps[..., count:] - largest_gap[..., None]
        open_sums = np.array([np.exp(-open_gaps / rho).sum(axis=-1) for rho in ranges])
        # With fewer contact pixels the bodies stay further apart.
        decay = np.exp((largest_gap - gaps[..., -1]) / rho_column)
        sums.append(count + open_sums + sums_outside * decay)
    return np.array(sums)


def forces_at_loadings(
    bodies: Bodies, contacts_by_loading: Sequence[Contact], ranges: Sequence[float]
) -> Floats:
    """Return the forces (loading, rho, contact_y, contact_x) of two bodies in N at 1 J/m²."""
    counts = count_contact_pixels(bodies, contacts_by_loading)
    return _forces_of_pixels(bodies, all_contact_pixels(bodies, max(counts)), counts, ranges)


def count_contact_pixels(bodies: Bodies, contacts_by_loading: Sequence[Contact]) -> list[int]:
    """Return the number of contact pixels at each loading."""
    return [contact.pixel_count(bodies.geometry.pixel_size) for contact in contacts_by_loading]


def make_force_function(contact: Contact, sphere: HeightMap | None = None) -> ForceFunction:
    """Return a function of a surface: its forces (contact_y, contact_x) in N at 1 J/m²."""

    def compute_forces(substrate: HeightMap) -> Floats:
        bodies = join_bodies(substrate, sphere, contact)
        return np.asarray(forces_at_loadings(bodies, [contact], [contact.rho])[0, 0])

    return compute_forces


def _forces_of_pixels(
    bodies: Bodies, contact_pixels: ContactPixels, counts: Sequence[int], ranges: Sequence[float]
) -> Floats:
    """Return the forces (pixel count, rho, contact_y, contact_x) in N at 1 J/m², by Eq. 3."""
    sums = attraction_sums(bodies, contact_pixels, counts, ranges)
    if not np.isfinite(sums).all():
        raise ValueError(
            f"rho = {min(ranges):g} nm: expected a longer range of adhesion, because the surface "
            f"rises over {EXP_LIMITS[np.float64]:g} ranges above a contact, more than exp() holds"
        )
    rho_column = np.asarray(ranges, float)[:, None, None]
    pixel_area = bodies.geometry.pixel_size**2
    return np.asarray(WORK_OF_ADHESION / rho_column * pixel_area * NANOMETRE * sums)


def pull_off_dataset(bodies: Bodies, contact: Contact, ranges: Sequence[float]) -> xr.Dataset:
    """Return the rigid and plastic pull-off force of two bodies at every contact and range.

    Raises ValueError if a range is too short for the relief of the substrate.
    """
    pixel_size = bodies.geometry.pixel_size
    counts = count_contact_pixels(bodies, [replace(contact, plastic=False), contact])
    contact_pixels = all_contact_pixels(bodies, max(counts))
    forces = _forces_of_pixels(bodies, contact_pixels, counts, ranges)
    reference_gaps = contact_pixels.reference_gaps
    # Rigid contact: one pixel touches, that of the smallest gap. Plastic contact: all touch.
    apex_heights = -np.stack([reference_gaps[..., 0], reference_gaps[..., -1]])
    positions = bodies.geometry.contact_positions * pixel_size
    model_axes = ("contact_model", *CONTACT_AXES)
    return xr.Dataset(
        {
            "pull_off_force": (("contact_model", "rho", *CONTACT_AXES), forces, FORCE_ATTRS),
            "apex_height": (model_axes, apex_heights, NM),
            "contact_pixel_count": ("contact_model", counts, DIMENSIONLESS),
            "touched_patches": ((), count_touched_patches(bodies, contact_pixels), DIMENSIONLESS),
        },
        {"contact_model": CONTACT_MODELS, "rho": ("rho", np.asarray(ranges, float), NM)}
        | {axis: (axis, positions, NM) for axis in CONTACT_AXES},
        {"work_of_adhesion": WORK_OF_ADHESION, "pixel_size": pixel_size},
    )


def pull_off_on_spheres(
    all_bodies: Mapping[int, Bodies], contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return `pull_off_dataset` (sphere_scan, ...) of bodies by the number in `sphere_scan`.

    It numbers the scans of the sphere, or the positions at which one scan of it touches.
    """
    forces = {}
    for sphere_scan, bodies in all_bodies.items():
        forces_on_sphere = pull_off_dataset(bodies, contact, ranges)
        # Numbers replace positions, which differ between pixel sizes.
        contact_numbers = {axis: range(forces_on_sphere.sizes[axis]) for axis in CONTACT_AXES}
        forces[(sphere_scan,)] = forces_on_sphere.assign_coords(contact_numbers)
    return stack(forces, ["sphere_scan"])


def finer_pixel_ratio(bodies: Bodies, contact: Contact, forces: xr.DataArray) -> float:
    """Return the mean plastic force on interpolated pixels of half the size, relative to `forces`.

    Below 1, finer pixels lower the force. Interpolation adds no shorter waves, so the ratio tests
    only how well the pixels resolve the map. (`own.wide_pixels` allows for waves that pixels hide.)
    The forces (...) on the bodies' own pixels are in N at 1 J/m², at the range of the contact.
    """
    geometry = bodies.geometry
    substrate = bodies.substrate
    roughness = bodies.sphere_roughness
    fine_bodies = Bodies(
        interpolate(substrate, 2 * substrate.pixels),
        roughness and interpolate(roughness, 2 * roughness.pixels),
        replace(
            geometry,
            pixel_size=geometry.pixel_size / 2,
            window_pixels=2 * geometry.window_pixels,
            contact_positions=2 * geometry.contact_positions,
        ),
    )
    fine_forces = forces_at_loadings(fine_bodies, [contact], [contact.rho])
    return float(fine_forces.mean() / forces.values.mean())


def wider_window_change(
    all_bodies: Iterable[Bodies], contact: Contact, forces: xr.DataArray
) -> float:
    """Return the largest relative change of plastic forces in a window wider by a period per side.

    The forces (sphere_scan, contact_y, contact_x) in N at 1 J/m² are at the range of the contact.
    """
    changes = []
    for bodies, narrow_window_forces in zip(all_bodies, forces.values, strict=True):
        pixels = bodies.geometry.window_pixels + 2 * bodies.substrate.pixels
        wide_bodies = replace(bodies, geometry=replace(bodies.geometry, window_pixels=pixels))
        wide_window_forces = forces_at_loadings(wide_bodies, [contact], [contact.rho])[0, 0]
        changes.append(float(np.abs(wide_window_forces / narrow_window_forces - 1).max()))
    return max(changes)


def pull_off_with_checks(
    all_bodies: Mapping[int, Bodies], contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return `pull_off_on_spheres` with the effects of window and pixels, and smooth_sphere_force.

    ``wider_window_change`` is at the range of the contact, ``finer_pixel_ratio`` at the shortest
    range on the first sphere scan.
    """
    forces = pull_off_on_spheres(all_bodies, contact, ranges)
    plastic_forces = forces["pull_off_force"].sel(contact_model=PLASTIC)
    window_change = wider_window_change(
        all_bodies.values(), contact, plastic_forces.sel(rho=contact.rho)
    )
    first_bodies = next(iter(all_bodies.values()))
    shortest_range_contact = replace(contact, rho=min(ranges))
    shortest_range_forces = plastic_forces.isel(sphere_scan=0).sel(rho=min(ranges))
    pixel_ratio = finer_pixel_ratio(first_bodies, shortest_range_contact, shortest_range_forces)
    smooth_forces = pull_off_dataset(replace(first_bodies, sphere_roughness=None), contact, ranges)
    return forces.assign(
        wider_window_change=((), window_change, DIMENSIONLESS),
        finer_pixel_ratio=((), pixel_ratio, DIMENSIONLESS | {"rho": min(ranges)}),
        smooth_sphere_force=smooth_forces["pull_off_force"].mean(CONTACT_AXES, keep_attrs=True),
    )


def stack_pull_off_forces(scans: DatasetsByLabels) -> xr.Dataset:
    """Stack `pull_off_with_checks` of (surface, scan), with the largest contact pixel count."""
    dimensions = ["surface", "scan"]
    forces = stack(scans, dimensions)
    pixel_count = forces["contact_pixel_count"].max([*dimensions, "sphere_scan"], keep_attrs=True)
    return forces.assign(contact_pixel_count=pixel_count)


def mean_over_contacts(values: xr.DataArray) -> xr.DataArray:
    """Return the mean over the contacts of one scan and over the scans of the sphere."""
    return values.mean([dim for dim in CONTACT_DIMENSIONS if dim in values.dims])
