"""The spectrum C_iso of your surface, from a table or from scans at reliable wavelengths."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.arrays import generator
from hardcontact.own.spectrum_table import is_spectrum_table, read_spectrum_table
from hardcontact.scans.both_bodies import combine_maps, combine_spectra
from hardcontact.scans.defects import defect_sentence, level_and_list_defects
from hardcontact.scans.heights import LENGTH_BOUNDS, TAKE_CARE, split_notes
from hardcontact.scans.joined_spectrum import ScanSpectrum, joined_spectrum, reliable_spectrum
from hardcontact.scans.reading import DEFAULT_OPTIONS, ReadingOptions, list_scans
from hardcontact.scans.reliable_wavelengths import ReliableWavelengths
from hardcontact.scans.scan_pairs import (
    describe_contradictions,
    find_contradictions,
    repeated_area_notes,
)
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.metrics import metrics
from hardcontact.surfaces.spectrum import Spectrum


class OwnSpectrum(NamedTuple):
    """C_iso from your files, with notes on what reading changed or left out."""

    spectrum: Spectrum  #: A `ScanSpectrum` if it comes from scans.
    notes: tuple[str, ...]
    scans: tuple[HeightMap, ...] = ()  #: Levelled; empty for a table.
    #: The levelled maps of a substrate and of a rough sphere, whose sum is the only scan.
    body_maps: tuple[HeightMap, ...] = ()


def read_own_spectrum(
    files: Sequence[str | Path],
    options: ReadingOptions = DEFAULT_OPTIONS,
    *,
    dataset: str = "",
    sphere_radius: float | None = None,
) -> OwnSpectrum:
    """Return the spectrum of a table, or of scans of one surface at their reliable wavelengths.

    `dataset` names the only scan to read, "" stands for all; `sphere_radius` (nm) is for scans of a
    sphere.
    """
    if not files:
        raise ValueError("files: expected a table of a spectrum or scans, found none")
    tables = [path for path in files if is_spectrum_table(path)]
    if tables and len(files) > 1:
        raise ValueError(f"{tables[0]}: expected one table, or scans alone, found other files, too")
    if tables:
        spectrum = read_spectrum_table(tables[0])
        zeros = np.count_nonzero(spectrum.density == 0)
        note = f"no roughness in {zeros} rows of the table, with a density of 0"
        return OwnSpectrum(spectrum, (note,) if zeros else ())
    scans = [
        level_and_list_defects(options.read_scan(path, name), sphere_radius, options.levelling)
        for path in files
        for name in ([dataset] if dataset else list_scans(path))
    ]
    for scan in scans:
        if np.ptp(scan.heights) < LENGTH_BOUNDS[0]:
            raise ValueError(f"{scan.path}: expected a rough surface, found constant height")
    return _spectrum_of_scans(scans, options.tip_radius)


def spectrum_of_map(scan: HeightMap) -> OwnSpectrum:
    """Return the spectrum of a map, which is levelled first, at its reliable wavelengths."""
    return _spectrum_of_scans([level_and_list_defects(scan)])


def add_sphere_roughness(substrate: OwnSpectrum, sphere: OwnSpectrum, seed: int) -> OwnSpectrum:
    """Return the sum of both spectra, and of both maps if each body has a single one.

    The seed decides which positions of the maps meet. Raises ValueError for a table.
    """
    substrate_spectrum, sphere_spectrum = substrate.spectrum, sphere.spectrum
    if not isinstance(substrate_spectrum, ScanSpectrum) or not isinstance(
        sphere_spectrum, ScanSpectrum
    ):
        raise ValueError("--sphere: expected scans of both bodies, found a table of a spectrum")
    spectra = combine_spectra(substrate_spectrum.joined_dataset, sphere_spectrum.joined_dataset)
    notes = substrate.notes + sphere.notes
    scans = substrate.scans + sphere.scans
    if len(scans) > 2 or any(scan.kind != "map" for scan in scans):
        skewness = max(substrate_spectrum.skewness, sphere_spectrum.skewness, key=abs)
        return OwnSpectrum(reliable_spectrum(spectra, skewness), notes, scans)
    combined_map = _sum_of_maps(*scans, seed=seed)
    spectrum = reliable_spectrum(spectra, metrics(combined_map)["skewness"])
    return OwnSpectrum(spectrum, notes, (combined_map,), scans)


def _sum_of_maps(substrate: HeightMap, sphere: HeightMap, *, seed: int) -> HeightMap:
    """Return the sum of the levelled maps of both bodies, on the substrate's pixels."""
    rng = generator(seed, "both bodies")
    mirrored = combine_maps(rng, mirror_in_float32(substrate), mirror_in_float32(sphere))
    heights = mirrored.heights[: substrate.pixels, : substrate.pixels]
    return replace(substrate, heights=heights, defects={**sphere.defects, **substrate.defects})


def _spectrum_of_scans(scans: Sequence[HeightMap], tip_radius: float | None = None) -> OwnSpectrum:
    """Return the joined spectrum of scans, with cautions and other notes.

    Of scans of the same area only the first counts. Scans that state no tip radius get `tip_radius`
    (nm).
    """
    repeated = repeated_area_notes(scans, [scan.name for scan in scans])
    scans = [scan for index, scan in enumerate(scans) if index not in repeated]
    defects = [
        (scan.name, defect_sentence(code, numbers))
        for scan in scans
        for code, numbers in scan.defects.items()
    ]
    tip_radii = [tip_radius if scan.tip_radius is None else None for scan in scans]
    try:
        spectra = joined_spectrum(scans, tip_radii)
    except ValueError as error:  # Defects may be the cause: spikes look like a noise floor.
        lines = [f"{name}: expected a sound scan, found: {line}" for name, line in defects]
        raise ValueError("\n".join([str(error), *lines])) from None
    notes = [f"{TAKE_CARE}{line}" for line in repeated.values()]
    notes += _reading_notes(scans, spectra)
    columns = (spectra[name].values for name in ("psd", "reliable", "kind", "size"))
    if contradictions := find_contradictions(*columns):
        names = [scan.name for scan in scans]
        notes.append(f"{TAKE_CARE}{describe_contradictions(contradictions, names)}")
    notes += [f"{TAKE_CARE}{name}: {line}" for name, line in defects]
    skewnesses = [metrics(scan)["skewness"] for scan in scans if scan.kind == "map"]
    spectrum = reliable_spectrum(spectra, max(skewnesses, key=abs, default=0.0))
    return OwnSpectrum(spectrum, tuple(notes), tuple(scans))


def _reading_notes(scans: Sequence[HeightMap], spectra: xr.Dataset) -> Iterator[str]:
    """Yield for each scan its reliable wavelengths with what reading changed, and its cautions."""
    ends = (spectra[key].values for key in ("shortest_reliable", "longest_reliable", "limited_by"))
    for scan, *scan_ends in zip(scans, *ends, strict=True):
        changes, cautions = split_notes(scan.notes)
        yield "; ".join([f"{scan.name}: reliable {ReliableWavelengths(*scan_ends)}", *changes])
        yield from (f"{TAKE_CARE}{scan.name}: {line}" for line in cautions)
