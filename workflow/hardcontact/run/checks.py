"""Checks that the values of a study agree with each other, with its tables and its scans."""

from collections.abc import Iterator
from glob import escape, glob
from typing import Any

import numpy as np
import pandas as pd

from hardcontact.base import published
from hardcontact.config.configuration import get_key, is_paper_study, reading_arguments
from hardcontact.config.descriptions import refuse_description, refuse_in_own_study
from hardcontact.config.faults import collect_faults, key_fault, raise_faults
from hardcontact.config.force_table import read_forces
from hardcontact.config.keys import NONE, SMOOTH_SPHERE
from hardcontact.config.limits import PIXEL_SIZES, refuse_unfit_values, same_pixels
from hardcontact.config.selected_surfaces import CONTACT_USE
from hardcontact.contact.numerical_limits import Extent
from hardcontact.files.paths import MEASUREMENT
from hardcontact.records.origin import is_current
from hardcontact.scans.reading import read_scan
from hardcontact.surfaces.height_map import HeightMap, load_height_map, refuse_line_scan
from hardcontact.surfaces.substitute_spectra import (
    described_rms_height,
    needs_calibration,
    read_segments,
)

#: Bound on the relief, highest minus lowest point, of a substitute for a surface of the paper, in
#: nm: about five times the largest rms height (MCD).
SUBSTITUTE_RELIEF = 500.0
#: Bound on the relief of other substitutes, relative to the rms height of all waves up to the width
#: of a long-edge master: a fifth more than 3.7, the largest ratio on 24 random surfaces of 10 to
#: 40 µm, from descriptions of 18 to 850 nm rms.
RELIEF_OVER_RMS = 4.5


def check_study(study: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse a study that would fail in a job.

    `study` is the configuration as numbers, `table` the table of surfaces with a row a scan. Names,
    tables and descriptions are checked first. Then the scans with contacts are read, because their
    pixels, size and relief limit keys.
    """
    find_faults = _paper_faults if is_paper_study(study) else _own_surface_faults
    faults = _substitute_faults(study, table) + find_faults(study, table)
    raise_faults(faults)
    extents: dict[str, Extent] = {}
    for name, rows in table[table.use == CONTACT_USE].groupby("surface", sort=False):
        with collect_faults(faults):
            extents[str(name)] = surface_extent(study, str(name), rows)
    raise_faults(faults)
    with collect_faults(faults):
        refuse_unfit_values(study, extents)
    raise_faults(faults)


def _substitute_faults(study: dict[str, Any], table: pd.DataFrame) -> list[str]:
    """Return the faults of descriptions of substitutes."""
    table1 = published.read_table1(published.PUBLISHED_TABLES["published_table1"])
    table1_quantities = {str(name): set(rows.quantity) for name, rows in table1.groupby("surface")}
    substitutes = table[table.source == "substitute"].drop_duplicates("surface")
    faults: list[str] = []
    for surface, path in zip(substitutes.surface, substitutes.path, strict=True):
        with collect_faults(faults):
            refuse_description(path, table1_quantities.get(surface, set()))
            if not is_paper_study(study):
                refuse_in_own_study(path, surface, table1_quantities)
    return faults


def _name_faults(study: dict[str, Any], key: str, surfaces: list[str]) -> list[str]:
    """Return a line if the value of a key is not one of the surfaces."""
    if get_key(study, key) in surfaces:
        return []
    accepted = f"a surface of the table ({', '.join(surfaces)})"
    return [key_fault(key, accepted, get_key(study, key))]


def _paper_faults(study: dict[str, Any], table: pd.DataFrame) -> list[str]:
    """Return the faults of a study that is compared with the paper."""
    contacts = table[table.use == CONTACT_USE]
    surfaces = list(contacts.surface.unique())
    substrates = [surface for surface in surfaces if surface != study["sphere"]["surface"]]
    faults = _name_faults(study, "sphere.surface", surfaces)
    for key in ("reference_surface", "indent.surface"):
        faults += _name_faults(study, key, substrates)
    if study["substitutes"]["featured_surface"] != NONE:
        faults += _name_faults(study, "substitutes.featured_surface", substrates)
    faults += [
        *_substrate_faults(substrates),
        *_pool_size_faults(study, contacts[contacts.surface.isin(substrates)]),
    ]
    # Imported here, as the claims would cost studies of your surfaces almost a second.
    from hardcontact.paper.claims.statements import check_claims

    with collect_faults(faults):
        check_claims(published.CLAIMS)
    return faults


def _substrate_faults(substrates: list[str]) -> Iterator[str]:
    """Yield the faults of substrates without a published force, and of a single substrate."""
    pull_off_table = published.PUBLISHED_TABLES["published_pull_off"]
    published_surfaces = published.read_published_forces(pull_off_table).index
    unpublished = [surface for surface in substrates if surface not in published_surfaces]
    if unpublished:
        accepted = (
            f"substrates with a published pull-off force ({', '.join(published_surfaces)}); with "
            "`published: none` any are accepted"
        )
        yield key_fault("surfaces", accepted, ", ".join(unpublished))
    if len(substrates) == 1:
        accepted = "two substrates or more, because range and work are fitted to their forces"
        yield key_fault("surfaces", accepted, *substrates)


def _pool_size_faults(study: dict[str, Any], contacts: pd.DataFrame) -> Iterator[str]:
    """Yield the fault if a pool holds fewer scans than a set takes: as many as the study has."""
    pool_size = study["sets"]["pool_size"]
    scan_counts = contacts.surface[contacts.source == "substitute"].value_counts(sort=False)
    if len(scan_counts) and scan_counts.max() > pool_size:
        accepted = f"at least the {scan_counts.max()} scans of {scan_counts.idxmax()}"
        yield key_fault("sets.pool_size", accepted, pool_size)


def _own_surface_faults(study: dict[str, Any], table: pd.DataFrame) -> list[str]:
    """Return the faults of a study of your surfaces, but not those of scans with contacts.

    They are faults of the sphere's name, of scans that only enter the spectrum, and of measured
    forces. `check_study` reads the scans with contacts itself.
    """
    sphere = study["sphere"]["surface"]
    makes_contact = table.use == CONTACT_USE
    faults: list[str] = []
    if sphere != SMOOTH_SPHERE:
        surfaces = list(table.surface[makes_contact].unique())
        faults += _name_faults(study, "sphere.surface", surfaces)
    for row in table[~makes_contact].itertuples():
        with collect_faults(faults):
            load_or_read_scan(study, row)
    if study["forces"] != NONE:
        substrates = list(table.surface[table.surface != sphere].unique())
        with collect_faults(faults):
            read_forces(study["forces"], substrates, study["sphere"]["radius"])
    return faults


def load_or_read_scan(study: dict[str, Any], row: Any) -> HeightMap:
    """Return a measured scan of a row of the table, stored by the rule read_scan or read again."""
    pattern = MEASUREMENT.format(surface=row.surface, scan=row.scan, digest="*")
    arguments = reading_arguments(study) | {"dataset": row.dataset}
    for stored_path in glob(f"{escape(study['store'])}/measurements/*/{pattern}"):
        if is_current(stored_path, arguments, row.path):
            return load_height_map(stored_path)
    return read_scan(row.path, **arguments)


def surface_extent(study: dict[str, Any], surface: str, rows: pd.DataFrame) -> Extent:
    """Return the extent of the scans of a surface.

    Its relief is measured; for substitutes it is an upper bound, which holds on masters, too.
    """
    path = rows.path.iloc[0]
    if rows.source.iloc[0] == "substitute":
        pixels = study["substitutes"]["pixels"]
        size = study["substitutes"]["size"]
        # A description that needs a calibration has no rms height before a job calibrates it.
        relief = SUBSTITUTE_RELIEF
        if not needs_calibration(read_segments(path)):
            widest_domain = 2 * size * study["band"]["long"]["tiles"]
            relief = RELIEF_OVER_RMS * described_rms_height(path, widest_domain)
        extent = Extent(pixels, size / pixels, size, relief)
        location = "config key substitutes.size"
    else:
        extent = _measured_extent(study, surface, rows)
        location = path
    low, high = PIXEL_SIZES
    if not low <= extent.pixel_size <= high:
        raise ValueError(
            f"{location}: expected pixels of {low:g} to {high:g} nm, where spectra are known, "
            f"found {extent.pixel_size:.6g} nm"
        )
    return extent


def _measured_extent(study: dict[str, Any], surface: str, rows: pd.DataFrame) -> Extent:
    """Return the extent of a measured surface's scans, with the largest relief of all."""
    extents: list[Extent] = []
    for row in rows.itertuples():
        scan = load_or_read_scan(study, row)
        refuse_line_scan(scan)
        relief = float(np.ptp(scan.heights))
        if relief == 0:
            raise ValueError(f"{row.path}: expected a rough surface, found constant height")
        extents.append(Extent(scan.pixels, scan.pixel_size, scan.size, relief))
        if not same_pixels(extents[0], extents[-1]):
            raise ValueError(
                f"{row.path}: expected, as in the first scan of {surface}, "
                f"{extents[0].pixels} pixels of {extents[0].pixel_size:.4g} nm; "
                f"found {scan.pixels} of {scan.pixel_size:.4g} nm"
            )
    return extents[0]._replace(relief=max(extent.relief for extent in extents))
