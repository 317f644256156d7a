"""Forces on a master, unfiltered and filtered below or above every cutoff wavelength.

A master is a scan with artificial roughness beyond its own wavelengths, on one side. A filter of
the side ``"short"`` removes wavelengths below the cutoff, of ``"long"`` wavelengths above it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.units import NM
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import (
    FORCE_ATTRS,
    WORK_OF_ADHESION,
    ForcesOnSurface,
    forces_at_loadings,
)
from hardcontact.records.job import progress
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.synthesis import synthesize_master

#: Dimension, values and attributes of a coordinate.
Axis = tuple[tuple[str], Any, dict[str, str]]


class Filters(NamedTuple):
    """The cutoffs of one side; each cutoff filters the unfiltered master."""

    side: str  #: short: wavelengths below the cutoff are removed; long: wavelengths above it.
    pixels: int  #: Pixels per row of the filtered surfaces.
    cutoffs: Sequence[float]  #: In nm.


def forces_at_cutoffs(
    master: HeightMap, filters: Filters, compute_forces: ForcesOnSurface, axes: Mapping[str, Axis]
) -> xr.Dataset:
    """Return the forces on a periodic master, unfiltered and filtered at every cutoff of a side.

    `compute_forces` returns the forces (...) in N on a surface; `axes` are their dimensions and
    coordinates. Returns ``pull_off_force`` (cutoff_wavelength, ...), ``unfiltered_pull_off_force``
    (...) and ``unfiltered_wavelength``, the end of the unfiltered spectrum in nm.
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
    """Return the pull-off forces on a master, unfiltered and filtered, for all contacts of a sweep.

    The contacts differ only in their loading, the hardness and the preload (or that they are
    rigid). Radii and ranges (nm) are by default those of the first contact. The variables of
    `forces_at_cutoffs` are over (radius, loading, rho, contact_y, contact_x). ``touching_area``
    (loading) is the area of the touching pixels, the coordinate ``contact_area`` (loading) the
    preload over the hardness, both in nm².
    """
    contact = loaded_contacts[0]
    pixel_size = master.size / filters.pixels
    radii = radii or [contact.radius]
    ranges = ranges or [contact.rho]

    def compute_forces(surface: HeightMap) -> np.ndarray:
        bodies = [join_bodies(surface, sphere, replace(contact, radius=radius)) for radius in radii]
        return np.array([forces_at_loadings(both, loaded_contacts, ranges) for both in bodies])

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


def master_from_spectrum(
    side: str,
    rng: np.random.Generator,
    scan: HeightMap,
    settings: Mapping[str, Any],
    spectrum_data: xr.Dataset,
) -> HeightMap:
    """Return the master of a side, made from a scan and the dataset of a spectrum.

    A sampled spectrum has the attribute ``height_factor``, by which the heights of its scan are
    multiplied. `settings` are those of `synthesize_master`.
    """
    scaled = replace(scan, heights=scan.heights * spectrum_data.attrs.get("height_factor", 1.0))
    return synthesize_master(side, rng, scaled, settings, spectrum_of_dataset(spectrum_data))
