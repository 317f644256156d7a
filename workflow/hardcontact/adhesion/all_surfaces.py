"""Datasets of all surfaces, with their names, stacked from those of single pairs or scans."""

from collections.abc import Mapping
from typing import Any, TypedDict, TypeVar

import xarray as xr

from hardcontact.records.dataset import stack


class Described(TypedDict):
    """Label of each surface, and whether it was measured or is a substitute."""

    labels: Mapping[str, str]
    basis: Mapping[str, str]


def with_names(dataset: xr.Dataset, described: Described) -> xr.Dataset:
    """Return a dataset with the label and the basis of every surface of it."""
    surfaces = dataset["surface"].values.tolist()
    return dataset.assign(
        label=("surface", [described["labels"][surface] for surface in surfaces]),
        basis=("surface", [described["basis"][surface] for surface in surfaces]),
    )


Forces = TypeVar("Forces", xr.DataArray, xr.Dataset)
Key = tuple[Any, ...]
CONTACT_AXES = ["contact_y", "contact_x"]


def over_sphere_scans(pairs: Mapping[int, xr.Dataset]) -> xr.Dataset:
    """Return `pull_off_of_pair` of one scan on all scans of the sphere, with contacts by number."""
    # Positions of contacts differ between pixel sizes.
    numbered = {
        (scan,): pair.assign_coords({axis: range(pair.sizes[axis]) for axis in CONTACT_AXES})
        for scan, pair in pairs.items()
    }
    return stack(numbered, ["sphere_scan"])


def stacked_pull_off_forces(scans: Mapping[Key, xr.Dataset], described: Described) -> xr.Dataset:
    """Return the pull-off forces of all surfaces, pairs of scans, contact models and ranges.

    The scans are of `over_sphere_scans` with `window_change`, by (surface, scan).
    ``pull_off_force`` (surface, scan, sphere_scan, contact_model, rho, contact_y, contact_x) stands
    beside ``closest_approach`` and ``penetration``; ``contact_pixels`` (contact_model) are the most
    of any pair; ``window_change`` is over (surface, scan).
    """
    dimensions = ["surface", "scan"]
    forces = stack(scans, dimensions)
    most = forces["contact_pixels"].max([*dimensions, "sphere_scan"], keep_attrs=True)
    return with_names(forces.assign(contact_pixels=most), described)


def at_load(forces: Forces, load: str) -> Forces:
    """Return the forces at one load, by its name; one that is not there is a ValueError."""
    known = forces["load"].values.tolist()
    if load not in known:
        raise ValueError(f"expected forces at the load {load}, found those at {', '.join(known)}")
    return forces.sel(load=load, drop=True)


def stacked_elastic_contacts(scans: Mapping[Key, xr.Dataset], described: Described) -> xr.Dataset:
    """Return the `elastic_contacts_of_pair` of all surfaces and scans, by (surface, scan).

    The variables (surface, scan, contact) stand beside ``pressure`` (surface, y, x) of one contact
    on the first scan of each surface.
    """
    contacts = stack(
        {key: scan.drop_vars(["pressure", "y", "x"]) for key, scan in scans.items()},
        ["surface", "scan"],
    ).drop_encoding()  # whole numbers are missing where a scan is
    first: dict[Key, xr.Dataset] = {}
    for (surface, _), scan in scans.items():
        first.setdefault((surface,), scan[["pressure"]])
    pressure = stack(first, ["surface"]).pressure
    return with_names(contacts.assign(pressure=pressure), described)


def stacked_asperities(scans: Mapping[Key, xr.Dataset], described: Described) -> xr.Dataset:
    """Return `asperities_of_pair` of all surfaces and scans: (surface, scan, contact, rho)."""
    return with_names(stack(scans, ["surface", "scan"]), described)
