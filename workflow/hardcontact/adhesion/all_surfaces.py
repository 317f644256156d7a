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


def _numbered(part: xr.Dataset) -> xr.Dataset:
    """Label contacts by number, because their positions differ between pixel sizes."""
    return part.assign_coords({axis: range(part.sizes[axis]) for axis in CONTACT_AXES})


def over_sphere_scans(pairs: Mapping[int, xr.Dataset]) -> xr.Dataset:
    """Return the forces of one scan on all scans of the sphere.

    Parameters
    ----------
    pairs : mapping of int to xarray.Dataset
        Number of the scan of the sphere -> `pull_off_of_pair`.

    Returns
    -------
    xarray.Dataset
        Their variables (sphere_scan, ...), with contacts by number.
    """
    return stack({(number,): _numbered(pair) for number, pair in pairs.items()}, ["sphere_scan"])


def stacked_pull_off_forces(scans: Mapping[Key, xr.Dataset], described: Described) -> xr.Dataset:
    """Return the pull-off forces of all surfaces, pairs of scans, contact models and ranges.

    Parameters
    ----------
    scans : mapping of tuple to xarray.Dataset
        (surface, scan) -> `over_sphere_scans` with `window_change`.
    described : Described
        Labels and bases.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (surface, scan, sphere_scan, contact_model, rho, contact_y, contact_x),
        ``closest_approach`` and ``penetration``; ``contact_pixels`` (contact_model), the most of
        any pair; ``window_change`` (surface, scan).
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
    """Return the elastic contacts of all surfaces and scans.

    Parameters
    ----------
    scans : mapping of tuple to xarray.Dataset
        (surface, scan) -> `elastic_contacts_of_pair`.
    described : Described
        Labels and bases.

    Returns
    -------
    xarray.Dataset
        Their variables (surface, scan, contact), and ``pressure`` (surface, y, x) of one contact
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
