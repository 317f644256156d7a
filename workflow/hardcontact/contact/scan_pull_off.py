"""Pull-off of all substrate scans on all sphere scans, and how window and pixels change it."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.base.dataset import DatasetsByLabels, stack
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, Contact
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.pull_off import forces_at_loadings, pull_off_dataset
from hardcontact.surfaces.filters import interpolate


def pull_off_on_spheres(
    all_bodies: Mapping[int, Bodies], contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return `pull_off_dataset` (sphere_scan, ...) of bodies by the number of the sphere's scan."""
    forces = {}
    for sphere_scan, bodies in all_bodies.items():
        forces_on_sphere = pull_off_dataset(bodies, contact, ranges)
        # Numbers replace positions, which differ between pixel sizes.
        contact_numbers = {axis: range(forces_on_sphere.sizes[axis]) for axis in CONTACT_AXES}
        forces[(sphere_scan,)] = forces_on_sphere.assign_coords(contact_numbers)
    return stack(forces, ["sphere_scan"])


def finer_pixel_ratio(bodies: Bodies, contact: Contact, forces: xr.DataArray) -> float:
    """Return the mean plastic force on interpolated pixels of half the size, relative to `forces`.

    The forces (...) on the bodies' own pixels are in N at 1 J/m², at the range of the contact.
    """
    geometry = bodies.geometry
    substrate = bodies.substrate
    sphere = bodies.sphere_roughness
    fine_bodies = Bodies(
        interpolate(substrate, 2 * substrate.pixels),
        sphere and interpolate(sphere, 2 * sphere.pixels),
        replace(
            geometry,
            pixel_size=geometry.pixel_size / 2,
            window_pixels=2 * geometry.window_pixels,
            positions=2 * geometry.positions,
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
    """Return `pull_off_on_spheres`, with the effects of window and pixels and of a smooth sphere.

    ``wider_window_change`` is at the range of the contact, ``finer_pixel_ratio`` at the shortest
    range on the first sphere scan.
    """
    forces = pull_off_on_spheres(all_bodies, contact, ranges)
    plastic_forces = forces["pull_off_force"].sel(contact_model=PLASTIC)
    window_change = wider_window_change(
        all_bodies.values(), contact, plastic_forces.sel(rho=contact.rho)
    )
    bodies = next(iter(all_bodies.values()))
    shortest_range_contact = replace(contact, rho=min(ranges))
    pixel_ratio = finer_pixel_ratio(
        bodies, shortest_range_contact, plastic_forces.isel(sphere_scan=0).sel(rho=min(ranges))
    )
    smooth_forces = pull_off_dataset(replace(bodies, sphere_roughness=None), contact, ranges)
    return forces.assign(
        wider_window_change=((), window_change, DIMENSIONLESS),
        finer_pixel_ratio=((), pixel_ratio, DIMENSIONLESS | {"rho": min(ranges)}),
        smooth_sphere_force=smooth_forces["pull_off_force"].mean(CONTACT_AXES, keep_attrs=True),
    )


def stack_pull_off_forces(scans: DatasetsByLabels) -> xr.Dataset:
    """Stack `pull_off_with_checks` by (surface, scan), with the largest contact pixel count."""
    dimensions = ["surface", "scan"]
    forces = stack(scans, dimensions)
    pixel_count = forces["contact_pixel_count"].max([*dimensions, "sphere_scan"], keep_attrs=True)
    return forces.assign(contact_pixel_count=pixel_count)
