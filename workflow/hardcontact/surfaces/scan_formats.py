"""Opening files of scans: any format SurfaceTopography reads, contact.engineering containers.

Nothing is unpacked to disk, nothing in a file is executed, and sizes are checked before anything
is read. `scans` calls this in a process of its own.
"""

import zipfile
from pathlib import Path
from typing import Any, NamedTuple

from SurfaceTopography import open_topography
from SurfaceTopography.Exceptions import CannotDetectFileFormat, MetadataAlreadyFixedByFile
from SurfaceTopography.IO import XYZReader

from hardcontact.surfaces import containers
from hardcontact.surfaces.measurement import (
    FILE_LIMIT,
    Measurement,
    RefusedScan,
    check_points,
    unit_in_nm,
)
from hardcontact.surfaces.scan_values import map_values, profile_values, stated_tip_radius

__all__ = ["datasets_of", "measurement_of"]

#: Metadata that a container may state, by their names as arguments of a reader.
STATED = {"physical_sizes": "size", "unit": "unit", "height_scale_factor": "height_scale"}
#: Spacings, in the unit of a text file, below which its reader takes any line scan for uniform.
COARSE_SPACING = 1e-4


class _Source(NamedTuple):
    """A reader of a file, and what its container says of it, if it is in one."""

    reader: Any
    entry: dict[str, Any]


def datasets_of(path: Path) -> list[str]:
    """Return the data files in a container, in its order; one empty name of any other file.

    A file that is missing, too large or a container that cannot be used is a RefusedScan.
    """
    _check_file(path)
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            containers.check_archive(archive)
            if containers.is_container(archive):
                return [containers.data_file(entry) for entry in containers.members(archive)]
    return [""]


def measurement_of(path: Path, dataset: str, undefined_pixels: str) -> Measurement:
    """Return a map cropped to its central square, or a profile on uniform spacing.

    `dataset` names the member of a container and is empty for any other file; `undefined_pixels` is
    ``"refuse"`` or the name of an interpolation of SurfaceTopography. A scan that cannot be used is
    a RefusedScan.
    """
    try:
        source = _opened(path, dataset)
    except CannotDetectFileFormat:
        raise RefusedScan(
            "expected a whole file in a format that SurfaceTopography reads, "
            "found one that none of its readers takes"
        ) from None
    channel, chosen = _height_channel(source)
    topography, stated = _topography(channel, source.entry)
    factor = _unit_of(topography)
    is_map = topography.dim == 2
    values = (map_values if is_map else profile_values)(topography, factor, undefined_pixels)
    tip_radius, tip = stated_tip_radius(topography.info, source.entry)
    return Measurement(
        path=str(path),
        dataset=dataset,
        channel=channel.name,
        file_unit=topography.unit,
        kind="map" if is_map else "profile",
        heights=values.heights,
        pixel_size=values.pixel_size,
        tip_radius=tip_radius,
        notes=(*chosen, *stated, *values.notes, *tip),
        undefined=values.undefined,
    )


def _check_file(path: Path) -> None:
    """Refuse a folder, and a file that is missing, empty or too large."""
    if path.is_dir():
        raise RefusedScan("expected a scan, found a folder: name the files in it")
    if not path.is_file():
        raise RefusedScan("expected a scan, found no such file")
    size = path.stat().st_size
    if size == 0:
        raise RefusedScan("expected a scan, found an empty file")
    if size > FILE_LIMIT:
        raise RefusedScan(f"expected a file of at most {FILE_LIMIT} bytes, found {size}")


def _opened(path: Path, dataset: str) -> _Source:
    """Return the reader of a file, or of one member of a container."""
    _check_file(path)
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            containers.check_archive(archive)
            if containers.is_container(archive):
                stream, entry = containers.opened_member(archive, dataset)
                return _Source(open_topography(stream), entry)
    if dataset:
        raise RefusedScan(f"expected a whole container with a dataset {dataset!r}, found none")
    return _Source(open_topography(str(path)), {})


def _height_channel(source: _Source) -> tuple[Any, list[str]]:
    """Return the channel that the container names, or the reader's own, if it holds heights.

    Otherwise the first one that does, and a note that says so. Of Nanoscope files phases and
    voltages are channels of heights too, with a pair of units: of pixels and of values.
    """
    channels = source.reader.channels
    if not channels:
        raise RefusedScan("expected a file with heights, found no channel of them")
    number = source.entry.get("data_source")
    known = number in range(len(channels))
    wanted = channels[number] if known else source.reader.default_channel
    for channel in (wanted, *channels):
        if channel.is_height_channel and not isinstance(channel.unit, tuple):
            chosen = f"channel {channel.name} read: {wanted.name} holds no heights"
            return channel, [] if channel.index == wanted.index else [chosen]
    names = ", ".join(channel.name for channel in channels)
    raise RefusedScan(f"expected a channel of heights, found only {names}")


def _topography(channel: Any, entry: dict[str, Any]) -> tuple[Any, list[str]]:
    """Return the topography of a channel, and which of its metadata the container stated.

    Metadata of a container count only if its data file has none: its height scale would calibrate
    a calibrated file twice.
    """
    has_positions = channel.dim == 1 and channel.is_uniform is False
    size = None if has_positions else tuple(entry.get("size") or ()) or None
    check_points(channel.nb_grid_pts)
    if channel.physical_sizes is None and size is None and not has_positions:
        raise RefusedScan(
            "expected a file that states the physical size of the scan, found none: "
            "the file is damaged, or its format has none"
        )
    stated: dict[str, Any] = {}
    for argument, key in STATED.items():
        value = size if argument == "physical_sizes" else entry.get(key)
        if value is not None and _takes(channel, stated | {argument: value}):
            stated[argument] = value
    said = ", ".join(f"{STATED[argument]} {value}" for argument, value in stated.items())
    notes = [f"{said.replace('_', ' ')} as the container states"] if said else []
    return _with_positions(channel, channel.topography(**stated), stated), notes


def _takes(channel: Any, stated: dict[str, Any]) -> bool:
    """Return whether a channel lacks these metadata, so that they may be stated."""
    try:
        channel.topography(**stated)
    except MetadataAlreadyFixedByFile:
        return False
    return True


def _with_positions(channel: Any, topography: Any, stated: dict[str, Any]) -> Any:
    """Return a line scan with the positions of its file.

    The reader of text takes spacings that differ by less than 1e-6 of the unit for equal: 1 µm in
    a file in metres.
    """
    if not isinstance(channel.reader, XYZReader) or topography.dim != 1:
        return topography
    if abs(topography.physical_sizes[0]) > COARSE_SPACING * topography.nb_grid_pts[0]:
        return topography
    return channel.reader._read(tol=0, **stated)


def _unit_of(topography: Any) -> float:
    """Return the unit of a topography in nm; refuse one without size or unit of length."""
    if topography.physical_sizes is None or not isinstance(topography.unit, str):
        raise RefusedScan(
            "expected a physical size and a unit, "
            f"found size {topography.physical_sizes}, unit {topography.unit}"
        )
    return unit_in_nm(topography.unit)
