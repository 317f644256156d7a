"""Datasets of all surfaces, with their names, stacked from those of single scans and masters."""

from collections.abc import Iterable, Mapping
from typing import Any, TypedDict

import numpy as np
import xarray as xr

from hardcontact.base.dataset import read, stack
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES

#: Datasets by their labels: the surface first.
Parts = Mapping[tuple[Any, ...], xr.Dataset]


class NamedSurfaces(TypedDict):
    """Label of each surface, and whether it was measured or is a substitute."""

    labels: Mapping[str, str]
    basis: Mapping[str, str]


def add_names(dataset: xr.Dataset, named_surfaces: NamedSurfaces) -> xr.Dataset:
    """Return a dataset with the label and the basis of each of its surfaces."""
    surfaces = dataset["surface"].values.tolist()
    return dataset.assign(
        label=("surface", [named_surfaces["labels"][surface] for surface in surfaces]),
        basis=("surface", [named_surfaces["basis"][surface] for surface in surfaces]),
    )


def stack_sphere_scans(pairs: Mapping[int, xr.Dataset]) -> xr.Dataset:
    """Return forces of `pull_off_dataset` over (sphere_scan, ...), with contacts by number."""
    # Positions of contacts differ between pixel sizes.
    numbered = {
        (scan,): pair.assign_coords({axis: range(pair.sizes[axis]) for axis in CONTACT_AXES})
        for scan, pair in pairs.items()
    }
    return stack(numbered, ["sphere_scan"])


def stacked_pull_off_forces(scans: Parts, named_surfaces: NamedSurfaces) -> xr.Dataset:
    """Return the pull-off forces of all surfaces, pairs of scans, contact models and ranges.

    `scans` has the dataset of `stack_sphere_scans`, with `wider_window_change`, by (surface, scan).
    Returns the same variables over (surface, scan, ...); ``contact_pixel_count`` (contact_model) is
    the largest of all pairs.
    """
    dimensions = ["surface", "scan"]
    forces = stack(scans, dimensions)
    largest = forces["contact_pixel_count"].max([*dimensions, "sphere_scan"], keep_attrs=True)
    return add_names(forces.assign(contact_pixel_count=largest), named_surfaces)


def stacked_elastic_contacts(scans: Parts, named_surfaces: NamedSurfaces) -> xr.Dataset:
    """Return the elastic contacts of all surfaces and scans.

    `scans` has the dataset of `elastic_contacts_of_pair` by (surface, scan). Returns the same
    variables over (surface, scan, ...); ``pressure`` (surface, y, x) in Pa shows one contact on the
    first scan of each surface.
    """
    contacts = stack(
        {key: scan.drop_vars(["pressure", "y", "x"]) for key, scan in scans.items()},
        ["surface", "scan"],
    )
    pressures: dict[tuple[Any, ...], xr.Dataset] = {}
    for (surface, _), scan in scans.items():
        pressures.setdefault((surface,), scan[["pressure"]])
    pressure = stack(pressures, ["surface"]).pressure
    return add_names(contacts.assign(pressure=pressure), named_surfaces)


def stacked_forces(masters: Parts) -> xr.Dataset:
    """Return the forces on all filtered masters, and their ratios to the unfiltered forces.

    `masters` has the dataset of `forces_at_cutoffs` by (surface, realization, side). Returns the
    same variables over these dimensions, NaN at cutoffs of the other side, and
    ``filtered_force_ratio`` of means over contacts; ``unfiltered_wavelength`` is in nm.
    """
    forces = stack(masters, ["surface", "realization", "side"]).sortby("cutoff_wavelength")
    contact_axes = [axis for axis in CONTACT_AXES if axis in forces.dims]
    filtered = forces["pull_off_force"].mean(contact_axes)
    unfiltered = forces["unfiltered_pull_off_force"].mean(contact_axes)
    ratio = (filtered / unfiltered).assign_attrs(
        units="1",
        long_name="mean pull-off force with roughness beyond the cutoff removed, relative to the "
        "force with all roughness",
    )
    ends = forces["unfiltered_wavelength"].max("realization", keep_attrs=True)  # all are the same
    scales = forces.assign(filtered_force_ratio=ratio, unfiltered_wavelength=ends)
    scales["cutoff_wavelength"].attrs = NM | {"long_name": "cutoff wavelength"}
    return scales


def read_masters(
    surfaces: Iterable[str], paths: Iterable[str], realizations: int, load: str | None = None
) -> xr.Dataset:
    """Return the `stacked_forces` on masters of surfaces, from files of `filtered_pull_off`.

    Realizations after the given number are left out. `load` is the only load, at the single radius
    and range of the files; None for all.
    """
    masters: dict[tuple[Any, ...], xr.Dataset] = {}
    for surface, path in zip(surfaces, paths, strict=True):
        forces = read(path)
        if load is not None:
            forces = forces.sel(load=load, drop=True).squeeze(["radius", "rho"], drop=True)
            forces = forces.drop_vars("contact_area")
        for number in forces["realization"].values.tolist():
            if number <= realizations:
                for side in forces["side"].values.tolist():
                    master = forces.sel(realization=number, side=side, drop=True)
                    masters[surface, number, side] = master
    return stacked_forces(masters)


def add_spectrum_shifts(scales: xr.Dataset, sampled: xr.Dataset) -> xr.Dataset:
    """Return forces of masters with the changes that another spectrum makes.

    `scales` has masters with the most likely spectra; `sampled` those with sampled spectra and the
    same random numbers. The changes ``log_ratio_shift`` and ``log_unfiltered_force_shift`` of the
    logarithms of ratio and mean force are NaN if there is no sampled spectrum.
    """
    unfiltered = "unfiltered_pull_off_force"
    ratio = sampled["filtered_force_ratio"] / scales["filtered_force_ratio"]
    mean = sampled[unfiltered].mean(CONTACT_AXES) / scales[unfiltered].mean(CONTACT_AXES)
    shifts = xr.Dataset(
        {"log_ratio_shift": np.log(ratio), "log_unfiltered_force_shift": np.log(mean)}
    )
    for name in shifts.data_vars:
        shifts[name].attrs = DIMENSIONLESS
    return scales.merge(shifts, join="left", compat="no_conflicts")


def add_transitions(scales: xr.Dataset, transitions: Mapping[str, float]) -> xr.Dataset:
    """Return forces of masters with the ``transition`` (side) in nm to artificial roughness."""
    attributes = NM | {"long_name": "wavelength at which artificial roughness begins"}
    lengths = [transitions[str(side)] for side in scales["side"].values]
    return scales.assign(transition=("side", lengths, attributes))
