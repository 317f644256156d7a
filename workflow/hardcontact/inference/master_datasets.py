"""Forces on the filtered masters of all surfaces, stacked, with the shifts of sampled spectra."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.dataset import DatasetsByLabels, read, stack
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES


def stack_masters(master_datasets: DatasetsByLabels) -> xr.Dataset:
    """Stack the forces on all filtered masters, and add their ratios to the unfiltered forces.

    `master_datasets` has the dataset of `forces_at_cutoffs` by (surface, realization, side).
    Returns the same variables over these dimensions, NaN at cutoffs of the other side, and
    ``filtered_force_ratio`` of means over contacts; ``unfiltered_wavelength`` is in nm.
    """
    forces = add_force_ratios(stack(master_datasets, ["surface", "realization", "side"]))
    spectrum_ends = forces["unfiltered_wavelength"].max("realization", keep_attrs=True)  # all equal
    return forces.assign(unfiltered_wavelength=spectrum_ends)


def add_force_ratios(forces: xr.Dataset) -> xr.Dataset:
    """Return stacked forces by growing cutoff, with their ratios to the unfiltered forces."""
    forces = forces.sortby("cutoff_wavelength")
    contact_axes = [axis for axis in CONTACT_AXES if axis in forces.dims]
    filtered = forces["pull_off_force"].mean(contact_axes)
    unfiltered = forces["unfiltered_pull_off_force"].mean(contact_axes)
    return forces.assign(filtered_force_ratio=(filtered / unfiltered).assign_attrs(DIMENSIONLESS))


def read_master_forces(
    surfaces: Iterable[str], paths: Iterable[str], realizations: int, loading: str | None = None
) -> xr.Dataset:
    """Read files of `filtered_pull_off` and stack the forces, as `stack_masters` does.

    Realizations after the given number are left out. `loading` is the only one, at the single
    radius and range of the files; None for all.
    """
    master_datasets: dict[tuple[Any, ...], xr.Dataset] = {}
    for surface, path in zip(surfaces, paths, strict=True):
        forces = read(path)
        if loading is not None:
            forces = forces.sel(loading=loading, drop=True).squeeze(["radius", "rho"], drop=True)
            forces = forces.drop_vars("touching_area")
        for realization in forces["realization"].values.tolist():
            if realization <= realizations:
                for side in forces["side"].values.tolist():
                    master = forces.sel(realization=realization, side=side, drop=True)
                    master_datasets[surface, realization, side] = master
    return stack_masters(master_datasets)


def add_spectrum_shifts(scales: xr.Dataset, sampled: xr.Dataset) -> xr.Dataset:
    """Return forces on masters, and how they change with another spectrum that the scans permit.

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
    lengths = [transitions[str(side)] for side in scales["side"].values]
    return scales.assign(transition=("side", lengths, NM))
