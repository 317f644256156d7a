"""Labels and bases of surfaces in datasets of several.

Datasets of all surfaces, stacked from those of single pairs, scans or masters.
"""

from collections.abc import Mapping
from typing import Any, TypedDict, TypeVar

import xarray as xr

from hardcontact.records.dataset import stack

__all__ = [
    "Described",
    "at_load",
    "stacked_asperities",
    "stacked_elastic_contacts",
    "stacked_filtered_forces",
    "stacked_pull_off_forces",
    "stacked_ratios",
    "with_names",
    "with_transitions",
]


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


def stacked_pull_off_forces(
    pairs: Mapping[Key, xr.Dataset], window_changes: Mapping[Key, xr.Dataset], described: Described
) -> xr.Dataset:
    """Return the pull-off forces of all surfaces, pairs of scans, contact models and ranges.

    Parameters
    ----------
    pairs : mapping of tuple to xarray.Dataset
        (surface, scan, sphere_scan) -> `pull_off_of_pair`.
    window_changes : mapping of tuple to xarray.Dataset
        (surface, scan) -> `window_change`.
    described : Described
        Labels and bases.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (surface, scan, sphere_scan, contact_model, rho, contact_y, contact_x),
        ``closest_approach`` and ``penetration``; ``contact_pixels`` (contact_model), the most of
        any pair; ``window_change`` (surface, scan).
    """
    dimensions = ["surface", "scan", "sphere_scan"]
    forces = stack(
        {key: _numbered(pair.drop_vars("contact_pixels")) for key, pair in pairs.items()},
        dimensions,
    )
    counts = stack({key: pair[["contact_pixels"]] for key, pair in pairs.items()}, dimensions)
    changes = stack(window_changes, dimensions[:2])
    forces = forces.assign(
        contact_pixels=counts.contact_pixels.max(dimensions, keep_attrs=True),
        window_change=changes.window_change,
    )
    return with_names(forces, described)


def stacked_filtered_forces(masters: Mapping[Key, xr.Dataset], described: Described) -> xr.Dataset:
    """Return the pull-off forces of every filtered master, and their ratio to the unfiltered one.

    Parameters
    ----------
    masters : mapping of tuple to xarray.Dataset
        (surface, realization, side, cutoff) -> `filtered_pull_off`; the cutoff as it stands in
        paths, e.g. ``"43nm"``, ``"none"`` of the unfiltered master.
    described : Described
        Labels and bases.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (surface, realization, side, cutoff_wavelength, contact_y, contact_x),
        ``unfiltered_pull_off_force``, ``unfiltered_wavelength`` (surface, side), ``ratio`` of the
        means over contacts.
    """
    dimensions = ["surface", "realization", "side"]
    unfiltered = stack(
        {
            (*key, side): _numbered(part).assign(unfiltered_wavelength=_end_of_spectrum(part, side))
            for (*key, side, cutoff), part in masters.items()
            if cutoff == "none"
        },
        dimensions,
    )
    filtered = stack(
        {
            (*key, float(cutoff.removesuffix("nm"))): _numbered(part[["pull_off_force"]])
            for (*key, cutoff), part in masters.items()
            if cutoff != "none"
        },
        [*dimensions, "cutoff_wavelength"],
    ).sortby("cutoff_wavelength")
    scales = filtered.assign(
        unfiltered_pull_off_force=unfiltered.pull_off_force,
        unfiltered_wavelength=unfiltered.unfiltered_wavelength.isel(realization=0, drop=True),
        ratio=filtered.pull_off_force.mean(CONTACT_AXES)
        / unfiltered.pull_off_force.mean(CONTACT_AXES),
    )
    end_of_spectrum = {"units": "nm", "long_name": "end of the unfiltered spectrum"}
    scales.ratio.attrs = {"units": "1", "long_name": "mean pull-off force over that unfiltered"}
    scales.unfiltered_wavelength.attrs = end_of_spectrum
    scales.cutoff_wavelength.attrs = {"units": "nm", "long_name": "cutoff wavelength"}
    return with_names(scales, described)


def with_transitions(scales: xr.Dataset, transitions: Mapping[str, float]) -> xr.Dataset:
    """Return forces of masters with the wavelength (nm) beyond which their roughness is artificial.

    Parameters
    ----------
    scales : xarray.Dataset
        Of `stacked_filtered_forces`.
    transitions : mapping of str to float
        By side, in nm.

    Returns
    -------
    xarray.Dataset
        With ``transition`` (side): below it on the small side, above it on the large one.
    """
    attributes = {"units": "nm", "long_name": "artificial roughness begins"}
    lengths = [transitions[str(side)] for side in scales["side"].values]
    return scales.assign(transition=("side", lengths, attributes))


def _end_of_spectrum(part: xr.Dataset, side: str) -> float:
    """Return the shortest or longest wavelength (nm) of an unfiltered master."""
    return float(part.attrs[{"small": "shortest", "large": "longest"}[side] + "_wavelength"])


def at_load(forces: Forces, load: str) -> Forces:
    """Return the forces at one load, by its name; one that is not there is a ValueError."""
    known = forces["load"].values.tolist()
    if load not in known:
        raise ValueError(f"expected forces at the load {load}, found those at {', '.join(known)}")
    return forces.sel(load=load, drop=True)


def stacked_ratios(masters: Mapping[Key, xr.Dataset], load: str) -> xr.Dataset:
    """Return the forces of filtered masters at one load over those of the unfiltered ones.

    Parameters
    ----------
    masters : mapping of tuple to xarray.Dataset
        (surface, realization, side) -> `mean_filtered_pull_off`.
    load : str
        Name of the load.

    Returns
    -------
    xarray.Dataset
        ``ratio`` (surface, realization, side, cutoff_wavelength), NaN at cutoffs of the other
        side, and ``unfiltered_wavelength`` (surface, side).
    """
    parts = {}
    for key, master in masters.items():
        chosen = at_load(master, load)
        ratio = chosen["pull_off_force"] / chosen["unfiltered_pull_off_force"]
        parts[key] = chosen[["unfiltered_wavelength"]].assign(ratio=ratio)
    curves = stack(parts, ["surface", "realization", "side"]).sortby("cutoff_wavelength")
    ends = curves["unfiltered_wavelength"].isel(realization=0, drop=True)
    return curves.assign(unfiltered_wavelength=ends)


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
