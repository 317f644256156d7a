"""Your scans: what their files state, and what is measured on them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import PurePath

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.commands.request import ScanFile
from hardcontact.contact.numerical_limits import Extent
from hardcontact.scans.defects import level_and_list_defects
from hardcontact.scans.measured_spectrum import isotropic_psd
from hardcontact.scans.reading import ReadingOptions, list_scans
from hardcontact.scans.reliable_wavelengths import ReliableWavelengths, reliable_wavelengths
from hardcontact.scans.scan_pairs import coarse_map, repeated_area_notes
from hardcontact.surfaces.height_map import HeightMap


@dataclass(frozen=True, eq=False)  # A scan equals only itself.
class UserScan:
    """A scan of the user; lengths are in nm."""

    scan_file: ScanFile
    dataset: str  #: Name of the scan in a container; empty for any other file.
    channel: str
    file_unit: str
    kind: str  #: ``"map"`` or ``"line scan"``.
    pixels: int  #: Pixels per row of a map, or points of a line scan.
    pixel_size: float
    rms_height: float  #: Of the levelled scan, without the shape of a sphere.
    peak_to_valley: float  #: Of the levelled scan, too.
    relief: float  #: Highest minus lowest height as read, or levelled if that is more.
    tip_radius: float | None
    is_tip_given: bool  #: Whether the tip radius is the user's, because the file states none.
    reliable_wavelengths: ReliableWavelengths
    density: Floats  #: C_iso (bins,) in nm⁴; NaN in empty bins.
    undefined_count: int  #: Number of undefined pixels, which were filled.
    notes: tuple[str, ...]  #: What was done in reading, and cautions: see `split_notes`.
    defects: Mapping[str, Mapping[str, float]]  #: Numbers by defect: see `scans.defects`.
    coarse_map: HeightMap  #: The levelled scan on few pixels, to find scans of the same area.

    @property
    def undefined_share(self) -> float:
        """Share of undefined pixels or points."""
        return self.undefined_count / (self.pixels**2 if self.kind == "map" else self.pixels)

    @property
    def size(self) -> float:
        """Width of a map, or length of a line scan, in nm."""
        return self.pixels * self.pixel_size

    @property
    def extent(self) -> Extent:
        """The extent of a map, as the checks of the study see it."""
        return Extent(self.pixels, self.pixel_size, self.size, self.relief)

    @property
    def has_reliable_wavelengths(self) -> bool:
        """Whether any wavelength is reliable."""
        return self.reliable_wavelengths.shortest <= self.reliable_wavelengths.longest

    @property
    def name(self) -> str:
        """The file without its folder, and for a container the data file in it."""
        file = PurePath(self.scan_file.path).name
        return f"{file}/{self.dataset}" if self.dataset else file


def read_inventory(
    scan_files: Sequence[ScanFile], options: ReadingOptions, channel: str = ""
) -> tuple[list[UserScan], list[str], list[str]]:
    """Return the scans of files, each area once, and lines on what is left out and on problems."""
    scans: list[UserScan] = []
    unreadable: list[str] = []
    problems: list[str] = []
    for scan_file in scan_files:
        file_scans, faults = _read_file(scan_file, options, channel)
        scans += file_scans
        # Faulty scans are left out beside sound ones of their container, or in a named folder.
        is_left_out = bool(file_scans) or scan_file.is_in_folder
        (unreadable if is_left_out else problems).extend(faults)
    if not scans and not problems:
        problems += unreadable
    problems += _copy_faults(scans)
    kept_scans, repeated = _leave_out_repeated_areas(scans)
    return kept_scans, unreadable + repeated, problems


def _read_file(
    scan_file: ScanFile, options: ReadingOptions, channel: str
) -> tuple[list[UserScan], list[str]]:
    """Return the usable scans of a file, and a line for each fault of the others."""
    try:
        datasets = list_scans(scan_file.path)
    except ValueError as error:
        return [], str(error).splitlines()
    user_scans = []
    faults = []
    for dataset in datasets:
        try:
            scan = options.read_scan(scan_file.path, dataset or channel)
            user_scans.append(_measure_scan(scan_file, scan, options))
        except ValueError as error:
            prefix = f"{scan_file.path}: "
            faults += [
                f"{prefix}{dataset}: {line.removeprefix(prefix)}" if dataset else line
                for line in str(error).splitlines()
            ]
    return user_scans, faults


def _copy_faults(scans: Sequence[UserScan]) -> Iterator[str]:
    """Yield a line for each copy of a scan of one surface: it would make intervals too narrow."""
    for scan, other in combinations(scans, 2):
        is_copy = (scan.kind, scan.pixels) == (other.kind, other.pixels) and np.allclose(
            (scan.size, scan.rms_height, scan.peak_to_valley),
            (other.size, other.rms_height, other.peak_to_valley),
            rtol=1e-4,  # File formats round differently.
            atol=0,
        )
        if is_copy and scan.scan_file.surface == other.scan_file.surface:
            yield f"{other.name}: expected each scan once, found that of {scan.name} again"


def _leave_out_repeated_areas(scans: Sequence[UserScan]) -> tuple[list[UserScan], list[str]]:
    """Return the scans whose area no earlier scan shows, and a line for each other scan."""
    kept_scans: list[UserScan] = []
    lines: list[str] = []
    for surface_scans in scans_by_surface(scans).values():
        maps = [scan.coarse_map for scan in surface_scans]
        notes = repeated_area_notes(maps, [scan.name for scan in surface_scans])
        kept_scans += [scan for index, scan in enumerate(surface_scans) if index not in notes]
        lines += notes.values()
    return kept_scans, lines


def scans_by_surface(scans: Sequence[UserScan]) -> dict[str, list[UserScan]]:
    """Return the scans of each surface, in their order."""
    surfaces: dict[str, list[UserScan]] = {}
    for scan in scans:
        surfaces.setdefault(scan.scan_file.surface, []).append(scan)
    return surfaces


def _measure_scan(scan_file: ScanFile, scan: HeightMap, options: ReadingOptions) -> UserScan:
    """Return a scan of the user, measured; raise ValueError if its height is constant."""
    relief = np.ptp(scan.heights)
    if relief == 0:
        raise ValueError(f"{scan_file.path}: expected a rough surface, found constant height")
    flat = level_and_list_defects(scan, scan_file.sphere_radius, options.levelling)
    peak_to_valley = float(np.ptp(flat.heights))
    density = isotropic_psd(flat)
    tip_radius = options.tip_radius if scan.tip_radius is None else scan.tip_radius
    return UserScan(
        scan_file=scan_file,
        dataset=scan.dataset,
        channel=scan.channel,
        file_unit=scan.file_unit,
        kind=scan.kind,
        pixels=scan.pixels,
        pixel_size=scan.pixel_size,
        rms_height=float(flat.heights.std()),
        peak_to_valley=peak_to_valley,
        relief=max(float(relief), peak_to_valley),
        tip_radius=tip_radius,
        is_tip_given=scan.tip_radius is None and options.tip_radius is not None,
        reliable_wavelengths=reliable_wavelengths(flat, tip_radius, density),
        density=density,
        undefined_count=scan.undefined_count,
        notes=flat.notes,
        defects=flat.defects,
        coarse_map=coarse_map(flat),
    )
