"""Pull-off of one substrate scan on all sphere scans, and how window and pixels change it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, Contact
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.pull_off import (
    force_on_finer_pixels,
    mean_pull_off_dataset,
    pull_off_dataset,
    wider_window_change,
)


def pull_off_on_spheres(
    all_bodies: Mapping[int, Bodies], contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return `pull_off_dataset` of all bodies over (sphere_scan, ...), with contacts by number."""
    forces = {}
    for sphere_scan, bodies in all_bodies.items():
        forces_on_sphere = pull_off_dataset(bodies, contact, ranges)
        # Positions of contacts differ between pixel sizes.
        contact_numbers = {axis: range(forces_on_sphere.sizes[axis]) for axis in CONTACT_AXES}
        forces[(sphere_scan,)] = forces_on_sphere.assign_coords(contact_numbers)
    return stack(forces, ["sphere_scan"])


def pull_off_with_checks(
    all_bodies: Mapping[int, Bodies], contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return `pull_off_on_spheres` of one substrate, with three numbers to judge it by.

    ``wider_window_change`` is at the range of the contact, ``finer_pixel_ratio`` of the first scan
    of the sphere at the shortest range; ``smooth_sphere_force`` (contact_model, rho) is the mean
    over contacts.
    """
    forces = pull_off_on_spheres(all_bodies, contact, ranges)
    plastic_force = forces["pull_off_force"].sel(contact_model=PLASTIC)
    first_bodies = next(iter(all_bodies.values()))
    shortest = replace(contact, rho=min(ranges))
    first_forces = plastic_force.isel(sphere_scan=0).sel(rho=shortest.rho)
    smooth = mean_pull_off_dataset(replace(first_bodies, sphere_roughness=None), contact, ranges)
    return forces.assign(
        {
            **wider_window_change(all_bodies.values(), contact, plastic_force.sel(rho=contact.rho)),
            **force_on_finer_pixels(first_bodies, shortest, first_forces),
            "smooth_sphere_force": smooth["pull_off_force"],
        }
    )
