"""Pull-off of all substrate scans on all sphere scans, and how window and pixels change it."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.base.dataset import DatasetsByLabels, NamedSurfaces, add_surface_names, stack
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, Contact
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.pull_off import forces_at_loadings, pull_off_dataset
from hardcontact.surfaces.filters import interpolate


def pull_off_on_spheres(
    all_bodies: Mapping[int, Bodies], contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return pull-off forces and apex heights of all bodies (sphere_scan, ...).

    The bodies share the substrate. The variables are those of `pull_off_dataset`; contacts are
    numbered, because their positions differ between pixel sizes.
    """
    forces = {}
    for sphere_scan, bodies in all_bodies.items():
        forces_on_sphere = pull_off_dataset(bodies, contact, ranges)
        contact_numbers = {axis: range(forces_on_sphere.sizes[axis]) for axis in CONTACT_AXES}
        forces[(sphere_scan,)] = forces_on_sphere.assign_coords(contact_numbers)
    return stack(forces, ["sphere_scan"])


def finer_pixel_ratio(bodies: Bodies, contact: Contact, forces: xr.DataArray) -> float:
    """Return the mean plastic force on pixels of half the size, relative to the bodies' own pixels.

    Both maps are Fourier interpolated, so that the surfaces stay the same. The forces (...) of the
    bodies in N at 1 J/m² are at the range of the contact.
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
    """Return the largest relative change of a plastic force in a window that is wider.

    The window is wider by a period of the substrate on each side. The forces (sphere_scan,
    contact_y, contact_x) in N at 1 J/m² are at the range of the contact. All bodies share the
    substrate.
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
    """Return the pull-off forces on one substrate scan, with three numbers to judge them by.

    ``wider_window_change`` is at the range of the contact, ``finer_pixel_ratio`` of the first
    sphere scan at the shortest range. ``smooth_sphere_force`` (contact_model, rho) is the mean over
    contacts. `pull_off_on_spheres` gives the other variables.
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


def stack_pull_off_forces(scans: DatasetsByLabels, named_surfaces: NamedSurfaces) -> xr.Dataset:
    """Stack the pull-off forces of all surfaces, scans, contact models and ranges.

    `scans` has the dataset of `pull_off_with_checks` by (surface, scan).
    Returns the same variables over (surface, scan, ...); ``contact_pixel_count`` (contact_model) is
    the largest of all scans.
    """
    dimensions = ["surface", "scan"]
    forces = stack(scans, dimensions)
    pixel_count = forces["contact_pixel_count"].max([*dimensions, "sphere_scan"], keep_attrs=True)
    return add_surface_names(forces.assign(contact_pixel_count=pixel_count), named_surfaces)
