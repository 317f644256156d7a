"""Limits of keys that follow from the pixels of scans and masters, and from memory.

Few faults are reported of many, so that each line tells the user something new:

- A surface has several series of limits: for its scans, for its contact with the sphere, and for
  the masters of each side and section. Of a series only the first fault counts, because later
  limits may assume earlier ones.
- Then, for each surface, only the first fault of each key counts, because one value often exceeds
  several limits.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.formatting import format_quantity
from hardcontact.base.units import format_exact
from hardcontact.config.configuration import get_key, is_paper_study, master_keys, study_contact
from hardcontact.config.faults import key_fault, raise_faults
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import count_window_pixels
from hardcontact.contact.numerical_limits import (
    PENETRATION_OVER_RANGE,
    Extent,
    minimum_range,
    penetration_depth,
    periods_in_window,
)
from hardcontact.surfaces.synthesis import SIDES

#: Smallest and largest pixel (nm). The bins of measured spectra reach from 0.1 nm, two of the
#: smallest pixels, to 100 µm, ten of the largest pixels.
PIXEL_SIZES = (0.05, 1e4)
#: Largest number of pixels per row of a map: arrays of more than 2 GiB are not validated.
MAX_MAP_PIXELS = 16384
#: Largest share of the pixels around a contact that may touch: a choice, far above the shares of
#: hard, rough contacts.
MAX_CONTACT_SHARE = 1 / 4
#: Largest number of contact pixels of all contacts on a scan, with their images in the window. All
#: are in memory at once, some 24 bytes each, 1.6 GB together.
MAX_CONTACT_PIXELS = 2**26


def same_pixels(extent: Extent, reference: Extent) -> bool:
    """Return whether the scans of two extents have the same number and size of pixels."""
    same_size = math.isclose(reference.pixel_size, extent.pixel_size, rel_tol=1e-3)
    return extent.pixels == reference.pixels and same_size


class NamedContact(NamedTuple):
    """A contact, and the configuration keys of three fields, or their arguments in the API."""

    contact: Contact
    preload_key: str = "contact.preload"
    count_key: str = "contact.contacts_per_row"
    rho_key: str = "adhesion.ranges"


def strictest_contacts(study: dict[str, Any]) -> dict[str, NamedContact]:
    """Return the contact on scans, in indents, and on masters of band and sets.

    Of several radii, preloads or ranges it has the one that pixels and memory limit most. These are
    the smallest radius, the largest preload and the shortest range.
    """
    contact = study_contact(study)
    scan_contact = NamedContact(replace(contact, rho=study["adhesion"]["ranges"][0]))
    master_contact = NamedContact(contact, rho_key="adhesion.range")
    if not is_paper_study(study):
        return {"scans": scan_contact, "band": master_contact}
    indent = replace(scan_contact.contact, preload=study["indent"]["preloads"][-1])
    radius = min(contact.radius, study["exponents"]["radii"][0])
    contacts_per_row = study["sets"]["contacts_per_row"]
    set_contact = replace(contact, radius=radius, contacts_per_row=contacts_per_row)
    return {
        "scans": scan_contact,
        "indents": scan_contact._replace(contact=indent, preload_key="indent.preloads"),
        "band": master_contact,
        "sets": master_contact._replace(contact=set_contact, count_key="sets.contacts_per_row"),
    }


def refuse_unfit_values(study: dict[str, Any], extents: Mapping[str, Extent]) -> None:
    """Refuse values that the extents of scans, by surface, do not permit."""
    first_faults = dict[tuple[str, str], str]()
    sphere_surface = study["sphere"]["surface"]
    master_sections = ["band", "sets"] if is_paper_study(study) else ["band"]
    for surface, extent in extents.items():
        fault_series = [_scan_faults(study, surface, extent)]
        if surface != sphere_surface:
            # A smooth sphere has the extent of the substrate.
            sphere_extent = extents.get(sphere_surface, extent)
            fault_series.append(_body_faults(study, surface, extent, sphere_extent))
            fault_series += [
                _master_faults(study, section, side, surface, extent, sphere_extent)
                for section in master_sections
                for side in SIDES
            ]
        for fault in filter(None, (next(faults, "") for faults in fault_series)):
            first_faults.setdefault((surface, fault.partition(": expected")[0]), fault)
    raise_faults(first_faults.values())


def contact_faults(named_contact: NamedContact, surface: str, extent: Extent) -> Iterator[str]:
    """Yield the faults of a contact on a scan: load, number of contacts and range of adhesion."""
    contact, preload_key, count_key, rho_key = named_contact
    row_pixels = 2 * extent.pixels
    window_pixels = min(count_window_pixels(contact.window, extent.pixel_size), row_pixels) ** 2
    available_pixels = int(MAX_CONTACT_SHARE * window_pixels)
    reason = f"which {100 * MAX_CONTACT_SHARE:g} % of {window_pixels} pixels of {surface} can carry"
    yield from _load_faults(preload_key, contact, available_pixels, extent.pixel_size, reason)
    if contact.contacts_per_row > row_pixels:
        accepted = f"at most the {row_pixels} pixels along the mirrored scan of {surface}"
        yield f"{count_key}: expected {accepted}, found {contact.contacts_per_row}"
    min_rho, reason = minimum_range(contact.radius, contact.window, extent)
    if contact.rho < min_rho:
        accepted = f"at least {min_rho:g} nm on {surface}, where {reason}"
        yield f"{rho_key}: expected {accepted}, found {contact.rho:.4g} nm"


def _scan_faults(study: dict[str, Any], surface: str, extent: Extent) -> Iterator[str]:
    """Yield the faults of the sphere's size, and of contacts on scans or masters of a surface."""
    is_sphere = surface == study["sphere"]["surface"]
    radius = study["sphere"]["radius"]
    if is_sphere and radius < extent.size:
        accepted = f"at least the size of its scans ({extent.size:.6g} nm)"
        yield key_fault("sphere.radius", accepted, f"{radius:.6g} nm")
    # `Extent` has the width before mirroring, so a long-edge master counts with half its width. Its
    # pixel size stays that of the scan.
    master_extent = extent._replace(size=extent.size * study["band"]["long"]["tiles"])
    for stage, named_contact in strictest_contacts(study).items():
        uses_masters = stage in ("band", "sets") and not is_sphere
        faults = contact_faults(named_contact, surface, master_extent if uses_masters else extent)
        yield from (f"config key {fault}" for fault in faults)


def _body_faults(
    study: dict[str, Any], surface: str, extent: Extent, sphere_extent: Extent
) -> Iterator[str]:
    """Yield the faults of a substrate's scans and the sphere's, both on the finer of their pixels.

    They concern the window, the pixels per row, loads and the range of adhesion.
    """
    window = study["contact"]["window"]
    pixel_size = min(extent.pixel_size, sphere_extent.pixel_size)
    body_names = f"{surface} and the sphere"
    if count_window_pixels(window, pixel_size) > MAX_MAP_PIXELS:
        accepted = f"at most {MAX_MAP_PIXELS} pixels of {pixel_size:.4g} nm, on {body_names}"
        yield key_fault("contact.window", accepted, count_window_pixels(window, pixel_size))
    yield from _map_faults(body_names, pixel_size, extent, sphere_extent)
    contacts = strictest_contacts(study)
    periods = periods_in_window(window, extent.size)
    for named_contact in contacts.values():
        yield from _memory_faults(named_contact, surface, pixel_size, periods)
    if "indents" in contacts and surface == study["indent"]["surface"]:
        pixels = contacts["indents"].contact.pixel_count(pixel_size)
        if pixels < 2:
            accepted = f"at least 2 contact pixels of {pixel_size:.4g} nm at the largest"
            yield key_fault("indent.preloads", accepted, pixels)
    contact = contacts["band"].contact
    depth = penetration_depth(contact, extent.relief)
    min_rho = depth / PENETRATION_OVER_RANGE
    if contact.rho < min_rho:
        pressed = f"contact.preload presses the bodies some {depth:.3g} nm into each other"
        accepted = f"at least {min_rho:.3g} nm, as {pressed}"
        yield key_fault("adhesion.range", accepted, f"{contact.rho:.4g} nm")


def _master_faults(
    study: dict[str, Any],
    section: str,
    side: str,
    surface: str,
    extent: Extent,
    sphere_extent: Extent,
) -> Iterator[str]:
    """Yield the faults of pixels, wavelengths and loads on the masters of a substrate and side."""
    keys = master_keys(study, section, side)
    pixels = get_key(study, keys["pixels"])
    tiles = get_key(study, keys["tiles"]) if "tiles" in keys else 1
    size = 2 * extent.size * tiles
    pixel_size = size / pixels  # of the surfaces in contact
    min_pixels = 2 * extent.pixels * tiles
    if pixels < min_pixels:
        accepted = f"at least the {min_pixels} of {tiles} x {tiles} mirrored scans of {surface}"
        yield key_fault(keys["pixels"], accepted, pixels)
    # The transition divides the waves of the scan, on its pixels. Cutoffs divide the waves of the
    # master: a short-edge master has pixels of its own, a long-edge master those of the scan.
    filtered_pixel_size = pixel_size if side == "short" else extent.pixel_size
    for name, finest in (("transition", extent.pixel_size), ("cutoffs", filtered_pixel_size)):
        accepted = (
            f"wavelengths of more than two pixels ({2 * finest:.4g} nm) and at most the "
            f"{size:.6g} nm of a master of {section}.{side} on {surface}"
        )
        for wavelength in np.atleast_1d(get_key(study, keys[name])):
            # The margin refuses exactly two pixels in spite of rounding, as `filters.lowpass` does.
            if not 2 * finest * (1 + 1e-9) < wavelength <= size:
                yield key_fault(keys[name], accepted, f"{wavelength:.4g} nm")
    if study["band"]["sphere_roughness"]:
        pixel_size = min(pixel_size, sphere_extent.pixel_size)
        body_names = f"the {side}-edge masters of {surface} and the sphere"
        yield from _map_faults(
            body_names, pixel_size, extent._replace(size=size / 2), sphere_extent
        )
    yield from _memory_faults(strictest_contacts(study)[section], surface, pixel_size, 1)


def _map_faults(body_names: str, pixel_size: float, *extents: Extent) -> Iterator[str]:
    """Yield the fault of mirrored maps that are too large on common pixels (nm)."""
    pixels = round(max(2 * extent.size for extent in extents) / pixel_size)
    if pixels > MAX_MAP_PIXELS:
        common_pixels = f"{body_names} on common pixels of {pixel_size:.4g} nm"
        accepted = f"at most {MAX_MAP_PIXELS} pixels per row of {common_pixels}"
        yield f"config keys surfaces and scan: expected {accepted}, found {pixels}"


def _memory_faults(
    named_contact: NamedContact, surface: str, pixel_size: float, periods: float
) -> Iterator[str]:
    """Yield the fault of a load whose contact pixels exceed the memory.

    All contacts on a map are in memory at once. Each contact pixel counts once for each of the
    `periods` of the map in the window.
    """
    contact, preload_key, count_key, _ = named_contact
    reason = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{count_key} = {contact.contacts_per_row} and contact.window = {contact.window:.6g} nm"
    )
    available_pixels = int(MAX_CONTACT_PIXELS / contact.contacts_per_row**2 / periods)
    key = f"config key {preload_key}"
    yield from _load_faults(key, contact, available_pixels, pixel_size, reason)


def _load_faults(
    name: str, contact: Contact, available_pixels: int, pixel_size: float, reason: str
) -> Iterator[str]:
    """Yield the fault of a load with more contact pixels than are available."""
    if contact.pixel_count(pixel_size) > available_pixels:
        max_load = available_pixels * (pixel_size * 1e-9) ** 2 * contact.hardness
        yield (
            f"{name}: expected at most {format_quantity(max_load, 'N')} of load at a hardness of "
            f"{format_exact(contact.hardness, 'Pa')}, {reason}, found "
            f"{format_quantity(contact.preload, 'N')}: scans that are wider or have larger pixels "
            "permit more"
        )
