"""Forces on a master, unfiltered and filtered below or above every cutoff wavelength.

In a master random waves replace those of a scan beyond a transition (`surfaces.synthesis`).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.dataset import concatenate, read, read_all, stack
from hardcontact.base.progress import progress
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import (
    FORCE_ATTRS,
    WORK_OF_ADHESION,
    ForcesOnSurface,
    forces_at_loadings,
)
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap, load_height_map
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.synthesis import synthesize_master

#: Dimension, values and attributes of a coordinate.
Axis = tuple[tuple[str], Any, dict[str, str]]


class Filters(NamedTuple):
    """The filters of one side, each of which is applied to the unfiltered master."""

    side: str  #: short: wavelengths below the cutoff are removed; long: wavelengths above it.
    pixels: int  #: Pixels per row of the filtered surfaces.
    cutoffs: Sequence[float]  #: In nm.


def forces_at_cutoffs(
    master: HeightMap, filters: Filters, compute_forces: ForcesOnSurface, axes: Mapping[str, Axis]
) -> xr.Dataset:
    """Return the forces on a periodic master, unfiltered and filtered at every cutoff of a side.

    `axes` are the dimensions and coordinates of computed forces (...). Returns ``pull_off_force``
    (cutoff_wavelength, ...), ``unfiltered_pull_off_force`` (...) and ``unfiltered_wavelength``, the
    end of the unfiltered spectrum in nm.
    """
    side, pixels, cutoffs = filters
    out = np.empty((pixels, pixels), np.float32)  # A new array for each surface takes longer.
    surfaces = filtered_series(master, side, [None, *cutoffs], pixels, out)
    surface_forces = (compute_forces(surface) for surface in surfaces)
    unfiltered, *filtered = progress(surface_forces, 1 + len(cutoffs), "cutoffs")
    spectrum_end = 2 * master.size / pixels if side == "short" else master.size
    cutoff_axis = (("cutoff_wavelength",), np.asarray(cutoffs, float), NM)
    filtered_forces = np.reshape(filtered, (len(cutoffs), *np.shape(unfiltered)))
    return xr.Dataset(
        {
            "unfiltered_pull_off_force": (tuple(axes), unfiltered, FORCE_ATTRS),
            "pull_off_force": (("cutoff_wavelength", *axes), filtered_forces, FORCE_ATTRS),
            "unfiltered_wavelength": ((), spectrum_end, NM),
        },
        {"cutoff_wavelength": cutoff_axis, **axes},
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def filtered_pull_off(
    master: HeightMap,
    filters: Filters,
    loaded_contacts: Sequence[Contact],
    sphere: HeightMap | None = None,
    radii: Sequence[float] | None = None,
    ranges: Sequence[float] | None = None,
) -> xr.Dataset:
    """Return `forces_at_cutoffs` on a master, over (radius, loading, rho, contact_y, contact_x).

    The contacts differ in their loading alone; radii and ranges are by default those of the first.
    ``touching_area`` (loading) in nm² is the area of the touching pixels, the coordinate
    ``contact_area`` the preload over the hardness.
    """
    contact = loaded_contacts[0]
    pixel_size = master.size / filters.pixels
    radii = radii or [contact.radius]
    ranges = ranges or [contact.rho]

    contacts = [replace(contact, radius=radius) for radius in radii]

    def compute_forces(surface: HeightMap) -> np.ndarray:
        all_bodies = (join_bodies(surface, sphere, contact) for contact in contacts)
        forces = [forces_at_loadings(bodies, loaded_contacts, ranges) for bodies in all_bodies]
        return np.array(forces)

    axes: dict[str, Axis] = {
        "radius": (("radius",), radii, NM),
        "loading": (("loading",), [loaded.loading_name for loaded in loaded_contacts], {}),
        "rho": (("rho",), np.asarray(ranges, float), NM),
        **{axis: ((axis,), np.arange(contact.contacts_per_row), {}) for axis in CONTACT_AXES},
    }
    contact_area = ("loading", [loaded.area for loaded in loaded_contacts], {"units": "nm2"})
    touching = [loaded.pixel_count(pixel_size) * pixel_size**2 for loaded in loaded_contacts]
    touching_area = ("loading", touching, {"units": "nm2"})
    filtered = forces_at_cutoffs(master, filters, compute_forces, axes)
    return filtered.assign(touching_area=touching_area).assign_coords(contact_area=contact_area)


def make_master(
    side: str,
    rng: np.random.Generator,
    scan_path: str,
    spectrum_path: str,
    settings: Mapping[str, Any],
) -> HeightMap:
    """Return a master made from the files of a mirrored scan and its spectrum."""
    scan = load_height_map(scan_path)
    spectrum_data = read(spectrum_path)
    # A sampled spectrum has a factor on the heights of its scan.
    heights = scan.heights * spectrum_data.attrs.get("height_factor", 1.0)
    spectrum = spectrum_of_dataset(spectrum_data)
    return synthesize_master(side, rng, replace(scan, heights=heights), settings, spectrum)


def read_master_forces(
    surfaces: Iterable[str], paths: Iterable[str], realizations: int, loading: str | None = None
) -> xr.Dataset:
    """Read `add_force_ratios` (surface, realization, side, ...) up to a number of realizations.

    With a `loading`, the result has no dimensions of loading, radius and range, which are single.
    """
    files = read_all([(name, number) for number, name in enumerate(surfaces)], paths)
    forces = stack(concatenate(files, "realization", 1), ["surface"])
    forces = forces.sel(realization=forces["realization"] <= realizations)
    if loading is not None:
        forces = forces.sel(loading=loading, drop=True).squeeze(["radius", "rho"], drop=True)
        forces = forces.drop_vars("touching_area")
    return add_force_ratios(forces)


def add_force_ratios(forces: xr.Dataset) -> xr.Dataset:
    """Return forces on masters, by growing cutoff, with the ratios of mean to unfiltered forces.

    ``filtered_force_ratio`` (..., cutoff_wavelength) is NaN at cutoffs of the other side.
    """
    forces = forces.sortby("cutoff_wavelength")
    contact_axes = [axis for axis in CONTACT_AXES if axis in forces.dims]
    filtered = forces["pull_off_force"].mean(contact_axes)
    unfiltered = forces["unfiltered_pull_off_force"].mean(contact_axes)
    spectrum_end = forces["unfiltered_wavelength"]
    realizations = [axis for axis in ("realization",) if axis in forces.dims]
    ratio = (filtered / unfiltered).drop_attrs(deep=False)  # Coordinates keep their units.
    return forces.assign(
        filtered_force_ratio=ratio.assign_attrs(DIMENSIONLESS),
        unfiltered_wavelength=spectrum_end.max(realizations, keep_attrs=True),
    )


def add_spectrum_shifts(scales: xr.Dataset, sampled: xr.Dataset) -> xr.Dataset:
    """Return forces on masters, with the changes if the scans have another spectrum.

    `scales` has the most likely spectra, `sampled` sampled ones, with the same random numbers.
    ``log_ratio_shift`` and ``log_unfiltered_force_shift`` are the changes of the logarithms of
    ``filtered_force_ratio`` and of the mean unfiltered force; NaN without a sampled spectrum.
    """
    unfiltered = "unfiltered_pull_off_force"
    ratio = sampled["filtered_force_ratio"] / scales["filtered_force_ratio"]
    mean = sampled[unfiltered].mean(CONTACT_AXES) / scales[unfiltered].mean(CONTACT_AXES)
    shifts = xr.Dataset(
        {"log_ratio_shift": np.log(ratio), "log_unfiltered_force_shift": np.log(mean)}
    )
    for shift in shifts.values():
        shift.attrs = DIMENSIONLESS
    return scales.merge(shifts, join="left", compat="no_conflicts")
