"""Forces on masters, unfiltered and without the waves beyond each cutoff: computed, read, compared.

In a master random waves replace those of a scan beyond a transition (`surfaces.synthesis`).
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.dataset import concatenate, read_by_key, stack
from hardcontact.base.progress import progress
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import FORCE_ATTRS, WORK_OF_ADHESION, forces_at_loadings
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap


class Filters(NamedTuple):
    """The filters of one side."""

    side: str  #: short: wavelengths below the cutoff are removed; long: wavelengths above it.
    pixels: int  #: Pixels per row of the substrates in contact.
    cutoffs: Sequence[float]  #: In nm.


def filtered_pull_off(
    master: HeightMap,
    filters: Filters,
    contacts_by_loading: Sequence[Contact],
    sphere: HeightMap | None = None,
    radii: Sequence[float] | None = None,
    ranges: Sequence[float] | None = None,
) -> xr.Dataset:
    """Return forces on a master, unfiltered and at each cutoff, by radius, loading and range.

    The contacts differ in their loading alone. Radius and range are those of the first
    contact, unless `radii` and `ranges` are given.
    """
    side, pixels, cutoffs = filters
    first_contact = contacts_by_loading[0]
    radii = radii or [first_contact.radius]
    ranges = ranges or [first_contact.rho]
    contacts_by_radius = [replace(first_contact, radius=radius) for radius in radii]

    def compute_forces(substrate: HeightMap) -> np.ndarray:
        all_bodies = (join_bodies(substrate, sphere, contact) for contact in contacts_by_radius)
        forces = [forces_at_loadings(bodies, contacts_by_loading, ranges) for bodies in all_bodies]
        return np.array(forces)

    out = np.empty((pixels, pixels), np.float32)  # A new array for each substrate takes longer.
    substrates = filtered_series(master, side, [None, *cutoffs], pixels, out)
    all_forces = (compute_forces(substrate) for substrate in substrates)
    unfiltered, *filtered = progress(all_forces, 1 + len(cutoffs), "cutoffs")
    axes = ("radius", "loading", "rho", *CONTACT_AXES)
    pixel_size = master.size / pixels  # of the substrates in contact
    spectrum_end = 2 * pixel_size if side == "short" else master.size
    touching_areas = [
        contact.pixel_count(pixel_size) * pixel_size**2 for contact in contacts_by_loading
    ]
    contact_areas = [contact.area for contact in contacts_by_loading]
    return xr.Dataset(
        {
            "unfiltered_pull_off_force": (axes, unfiltered, FORCE_ATTRS),
            "pull_off_force": (("cutoff_wavelength", *axes), np.array(filtered), FORCE_ATTRS),
            "spectrum_end": ((), spectrum_end, NM),
            "touching_area": ("loading", touching_areas, {"units": "nm2"}),  # of whole pixels
        },
        {
            "cutoff_wavelength": ("cutoff_wavelength", np.asarray(cutoffs, float), NM),
            "radius": ("radius", radii, NM),
            "loading": [contact.loading_name for contact in contacts_by_loading],
            "rho": ("rho", np.asarray(ranges, float), NM),
            **{axis: np.arange(first_contact.contacts_per_row) for axis in CONTACT_AXES},
            "contact_area": ("loading", contact_areas, {"units": "nm2"}),
        },
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def read_master_forces(
    surfaces: Iterable[str], paths: Iterable[str], loading: str | None = None
) -> xr.Dataset:
    """Read the datasets of `filtered_pull_off` (surface, realization, side, ...); add force ratios.

    `surfaces` has the surface of each path. With a `loading`, the result has no dimensions of
    loading, radius and range.
    """
    chunks = read_by_key([(surface, index) for index, surface in enumerate(surfaces)], paths)
    forces = stack(concatenate(chunks, "realization"), ["surface"])
    if loading is not None:
        forces = forces.sel(loading=loading, drop=True).squeeze(["radius", "rho"], drop=True)
        forces = forces.drop_vars("touching_area")
    return add_force_ratios(forces)


def add_force_ratios(forces: xr.Dataset) -> xr.Dataset:
    """Return forces on masters, by growing cutoff, with the ratios of filtered to unfiltered means.

    Means are over the contacts of a master. ``spectrum_end`` loses the dimension `realization`.
    """
    forces = forces.sortby("cutoff_wavelength")
    filtered = forces["pull_off_force"].mean(CONTACT_AXES)
    unfiltered = forces["unfiltered_pull_off_force"].mean(CONTACT_AXES)
    # Coordinates keep their units.
    ratio = (filtered / unfiltered).drop_attrs(deep=False).assign_attrs(DIMENSIONLESS)
    # All realizations, if any, have the same end, NaN where a surface has no such realization.
    realization_axes = [axis for axis in forces["spectrum_end"].dims if axis == "realization"]
    spectrum_end = forces["spectrum_end"].max(realization_axes, keep_attrs=True)
    return forces.assign(filtered_force_ratio=ratio, spectrum_end=spectrum_end)


def add_spectrum_shifts(forces: xr.Dataset, sampled_forces: xr.Dataset) -> xr.Dataset:
    """Return forces on masters, with the changes of ln(ratio) and ln(force) by sampled spectra.

    `forces` are on masters of the most likely spectra, `sampled_forces` on masters of sampled
    spectra, with the same random numbers.
    """
    force = forces["unfiltered_pull_off_force"].mean(CONTACT_AXES)
    sampled_force = sampled_forces["unfiltered_pull_off_force"].mean(CONTACT_AXES)
    factors = {
        "log_ratio_shift": sampled_forces["filtered_force_ratio"] / forces["filtered_force_ratio"],
        "log_unfiltered_force_shift": sampled_force / force,
    }
    shifts = {
        name: xr.ufuncs.log(factor).assign_attrs(DIMENSIONLESS) for name, factor in factors.items()
    }
    return forces.merge(xr.Dataset(shifts), join="left", compat="no_conflicts")
