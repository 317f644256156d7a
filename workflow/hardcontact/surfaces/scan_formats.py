"""Opening files of scans: any format SurfaceTopography reads, contact.engineering containers.

Nothing is unpacked to disk, nothing in a file is executed, no other file is read, and sizes are
checked before anything is read. `scans` calls this in a process of its own. A container is a zip
archive with a list of its scans, `index.json` or, of older ones, `meta.yml`; the format is
described by `SurfaceTopography.Container.IO.Schema`.
"""

import io
import json
import math
import zipfile
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import yaml
from SurfaceTopography import open_topography
from SurfaceTopography.Exceptions import CannotDetectFileFormat, MetadataAlreadyFixedByFile
from SurfaceTopography.IO import AscReader, XYZReader

from hardcontact.surfaces.measurement import (
    FILE_LIMIT,
    INFLATION,
    OBLONG,
    RefusedScan,
    check_points,
    map_values,
    profile_values,
    stated_tip_radius,
    unit_in_nm,
)

#: The lists of scans, in the order in which they are looked for, and the largest one in bytes.
LISTS: dict[str, Callable[[bytes], Any]] = {
    "index.json": json.loads,
    "meta.yml": lambda text: yaml.load(text, Loader=_ListLoader),
}
LIST_LIMIT = 2**20
#: The most files in an archive, scans in a container, and groups and datasets in an HDF5 file, and
#: levels of these: readers take longer than in proportion.
FILES, SCANS, OBJECTS, LEVELS = 5000, 1000, 1000, 20
#: What a list that is none may raise.
LIST_ERRORS = (
    yaml.YAMLError, AttributeError, LookupError, RecursionError, TypeError, ValueError,
)  # fmt: skip
#: Keys of the data file of a scan: as it was measured, else as it was kept after processing, with
#: its channel chosen and its heights scaled.
DATA_FILES = ("original", "squeezed-netcdf")
OF_ORIGINAL = {"data_source", "height_scale"}
#: What else is used of a scan, by kind. Anything but these is refused unread: written out, the
#: aliases of a short list make texts without end.
KINDS: dict[str, type | tuple[type, ...]] = {
    "size": list,
    "unit": str,
    "height_scale": (int, float),
    "data_source": int,
    "description": str,
    "instrument": dict,
}
#: Stands for no unit, for files that state none.
NO_UNIT = "none"
#: Metadata that a container may state, by their names as arguments of a reader.
STATED = {"physical_sizes": "size", "unit": "unit", "height_scale_factor": "height_scale"}
#: Spacings, in the unit of a text file, below which its reader takes any line scan for uniform.
COARSE_SPACING = 1e-4


def datasets_of(path: Path) -> dict[str, Any]:
    """Return as `datasets` the data files in a container, in its order; one empty name of others.

    A file that is missing, too large or a container that cannot be used is a RefusedScan.
    """
    members = _members(path)
    if members is not None and len(members) > SCANS:
        raise RefusedScan(f"expected at most {SCANS} scans in a container, found {len(members)}")
    return {"datasets": [""] if members is None else [_data_file(entry) for entry in members]}


def measurement_of(path: Path, dataset: str, undefined_pixels: str, unit: str) -> dict[str, Any]:
    """Return the fields of the `Measurement` of a map or a profile, as of `scans.read_measurement`.

    A scan that cannot be used is a RefusedScan.
    """
    try:
        reader, entry = _opened(path, dataset)
    except CannotDetectFileFormat:
        raise RefusedScan(
            "expected a whole file in a format that SurfaceTopography reads, "
            "found one that none of its readers takes"
        ) from None
    channel, chosen = _height_channel(reader, entry, "" if entry else dataset)
    given = {} if unit == NO_UNIT else {"unit": unit}
    topography, stated = _topography(channel, entry or given)
    if topography.unit is None:
        raise RefusedScan(
            "expected a unit of length, found none in the file: --unit, or the key scan.unit, "
            "gives one to all files without"
        )
    if topography.physical_sizes is None or not isinstance(topography.unit, str):
        raise RefusedScan(
            "expected a physical size and one unit, "
            f"found size {topography.physical_sizes}, unit {topography.unit}"
        )
    origin = "the container states" if entry else "given"
    stated = [f"{', '.join(stated)} as {origin}".replace("_", " ")] if stated else []
    factor = unit_in_nm(topography.unit)
    is_map = topography.dim == 2
    if is_map and isinstance(reader, AscReader):
        _check_lines(topography)
    values = (map_values if is_map else profile_values)(topography, factor, undefined_pixels)
    tip_radius, tip = stated_tip_radius(topography.info, entry)
    return {
        "path": str(path),
        "dataset": dataset if entry or len(reader.channels) > 1 else "",
        "channel": channel.name,
        "file_unit": topography.unit,
        "kind": "map" if is_map else "profile",
        "tip_radius": tip_radius,
        **values,
        "notes": [*chosen, *stated, *values["notes"], *tip],
    }


def _check_file(path: Path) -> None:
    """Refuse a folder, and a file that is missing, empty or too large."""
    if path.is_dir():
        raise RefusedScan("expected a scan, found a folder: name the files in it")
    if not path.is_file():
        found = "no regular file" if path.exists() else "no such file"
        raise RefusedScan(f"expected a scan, found {found}")
    size = path.stat().st_size
    if size == 0:
        raise RefusedScan("expected a scan, found an empty file")
    if size > FILE_LIMIT:
        raise RefusedScan(f"expected a file of at most {FILE_LIMIT} bytes, found {size}")


def _opened(path: Path, dataset: str) -> tuple[Any, dict[str, Any]]:
    """Return the reader of a file, or of one member of a container and what that says of it."""
    members = _members(path)
    if members is not None:
        entry = _member_named(members, dataset)
        file = _data_file(entry)
        with zipfile.ZipFile(path) as container:
            if file not in container.namelist():
                raise RefusedScan(f"expected the data file {file} in the container, found none")
            content = io.BytesIO(_unpacked(container, file))
        _check_inside(content)
        content.seek(0)
        return open_topography(content), entry
    _check_inside(path)
    return open_topography(str(path)), {}


def _height_channel(reader: Any, entry: dict[str, Any], name: str) -> tuple[Any, list[str]]:
    """Return the channel of a name or that the container names, or the reader's own, if of heights.

    A name counts where there are several. Without a name it is otherwise the first that holds some,
    and a note says so. Of Nanoscope files phases and voltages are channels of heights too, with a
    pair of units: of pixels and of values.
    """
    channels = reader.channels
    if not channels:
        raise RefusedScan("expected a file with heights, found no channel of them")
    number = entry.get("data_source")
    if number is not None and number not in range(len(channels)):
        raise RefusedScan(
            f"expected a data_source from 0 to {len(channels) - 1} in the container, found {number}"
        )
    wanted = reader.default_channel if number is None else channels[number]
    names = ", ".join(channel.name for channel in channels)
    if name and len(channels) > 1:  # Else there is nothing to choose.
        places = enumerate(channels, 1)
        channels = [channel for place, channel in places if name in (channel.name, str(place))]
        if not channels:
            raise RefusedScan(
                f"expected one of the channels {names}, or its number from 1; found {name!r}"
            )
        wanted = channels[0]
    for channel in (wanted, *channels):
        if channel.is_height_channel and not isinstance(channel.unit, tuple):
            chosen = f"channel {channel.name} read: {wanted.name} holds no heights"
            return channel, [] if channel.index == wanted.index else [chosen]
    raise RefusedScan(f"expected a channel of heights, found only {names}")


def _topography(channel: Any, entry: dict[str, Any]) -> tuple[Any, list[str]]:
    """Return the topography of a channel, and what of its metadata its file does not state.

    Other metadata, of a container or given, count only then: a height scale would calibrate a
    calibrated file twice.
    """
    has_positions = channel.dim == 1 and channel.is_uniform is False
    size = None if has_positions else tuple(entry.get("size") or ()) or None
    check_points(channel.nb_grid_pts)
    _check_stated(size, entry.get("height_scale"), channel.dim)
    if channel.physical_sizes is None and size is None and not has_positions:
        raise RefusedScan(
            "expected a file that states the physical size of the scan, found none: "
            "the file is damaged, or its format has none"
        )
    stated: dict[str, Any] = {}
    for argument, key in STATED.items():
        value = size if argument == "physical_sizes" else entry.get(key)
        if value is not None:
            with suppress(MetadataAlreadyFixedByFile):
                channel.topography(**stated | {argument: value})
                stated[argument] = value
    said = [f"{STATED[argument]} {value}" for argument, value in stated.items()]
    return _with_positions(channel, channel.topography(**stated), stated), said


def _check_lines(matrix: Any) -> None:
    """Refuse a text whose pixels are not square: it has no count of lines, and may be cut short."""
    along_x, along_y = np.divide(matrix.physical_sizes, matrix.nb_grid_pts)
    if abs(along_x / along_y - 1) > OBLONG:
        raise RefusedScan(
            f"expected square pixels of a text, which has lost lines else, found {along_x:.6g} "
            f"{matrix.unit} x {along_y:.6g} {matrix.unit}"
        )


def _check_stated(size: tuple[float, ...] | None, scale: float | None, dimensions: int) -> None:
    """Refuse a size or a height scale in a container that no scan of these dimensions has."""
    if size is not None and not (len(size) == dimensions and all(0 < x < math.inf for x in size)):
        raise RefusedScan(
            f"expected a size of {dimensions} positive numbers in the container, found {size}"
        )
    if scale is not None and not 0 < scale < math.inf:
        raise RefusedScan(f"expected a positive height scale in the container, found {scale}")


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


class _ListLoader(yaml.CSafeLoader):
    """Plain data only; the containers' tuples are read as lists, nothing is executed."""


_ListLoader.add_constructor(
    "tag:yaml.org,2002:python/tuple",
    yaml.CSafeLoader.construct_yaml_seq,  # type: ignore[type-var]
)


def _check_inside(file: Path | io.BytesIO) -> None:
    """Refuse an archive as `_check_archive` does, and HDF5 with data in other files or too deep.

    A link to another file is followed by readers, wherever it leads.
    """
    if zipfile.is_zipfile(file):
        with zipfile.ZipFile(file) as archive:
            _check_archive(archive)
    try:
        content = h5py.File(file, "r")
    except OSError:  # no HDF5
        return
    names = list[str]()

    def fault(name: str, link: Any) -> str | None:
        names.append(name)
        if len(names) > OBJECTS or name.count("/") > LEVELS:
            return f"expected at most {OBJECTS} groups and datasets on {LEVELS} levels, found more"
        outside = isinstance(link, h5py.ExternalLink)
        if isinstance(link, h5py.HardLink) and isinstance(found := content[name], h5py.Dataset):
            outside = bool(found.external) or found.is_virtual
        return f"expected heights in this file, found {name!r} in another one" if outside else None

    with content:
        if said := content.visititems_links(fault):
            raise RefusedScan(said)


def _check_archive(archive: zipfile.ZipFile) -> None:
    """Refuse an archive that unpacks to too much, or not to one file a name, before reading it."""
    files = archive.infolist()
    size = sum(file.file_size for file in files)
    most = min(FILE_LIMIT, INFLATION * archive.fp.seek(0, io.SEEK_END)) if archive.fp else 0
    if size > most:
        raise RefusedScan(
            f"expected at most {most} bytes once unpacked, {INFLATION} times those of the archive, "
            f"found {size}"
        )
    if len(files) > FILES:
        raise RefusedScan(f"expected at most {FILES} files in an archive, found {len(files)}")
    if len({file.filename for file in files}) < len(files):
        raise RefusedScan("expected an archive with each file once, found one repeated")
    if any(file.flag_bits & 1 for file in files):
        raise RefusedScan("expected an archive without a password, found an encrypted file")
    if {file.compress_type for file in files} - {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}:
        raise RefusedScan("expected files stored or deflated, found another compression")


def _unpacked(archive: zipfile.ZipFile, name: str) -> bytes:
    """Return a file of an archive: no more than its declared size, even of one that is longer."""
    with archive.open(name) as file:
        return file.read(archive.getinfo(name).file_size)


def _members(path: Path) -> list[dict[str, Any]] | None:
    """Return what a container says of each of its scans, None of a file that is none.

    The keys are those of ``TopographyMeta`` of SurfaceTopography; each scan has a data file. A file
    that `_check_file` or `_check_archive` refuses, a list that is too large or lists no scans is a
    RefusedScan.
    """
    _check_file(path)
    if not zipfile.is_zipfile(path):
        return None
    with zipfile.ZipFile(path) as archive:
        _check_archive(archive)
        name = next((name for name in LISTS if name in archive.namelist()), None)
        if name is None:
            return None
        size = archive.getinfo(name).file_size
        if size > LIST_LIMIT:
            raise RefusedScan(f"expected {name} of at most {LIST_LIMIT} bytes, found {size}")
        text = _unpacked(archive, name)
    try:
        surfaces = LISTS[name](text)["surfaces"]
        found = [_member(entry) for surface in surfaces for entry in surface["topographies"]]
    except LIST_ERRORS as error:
        raise RefusedScan(
            f"expected {name} that lists surfaces, their topographies and the data file of "
            f"each, found: {type(error).__name__}: {error}"
        ) from None
    (file, count), *_ = Counter(map(_data_file, found)).most_common(1) or [("", 0)]
    if count > 1:
        raise RefusedScan(
            f"expected {name} that lists each data file once, found {file} {count} times"
        )
    return found


def _member(entry: dict[str, Any]) -> dict[str, Any]:
    """Return what is said of a scan, with its name, or that of its data file if it has none."""
    file, name = _data_file(entry), entry.get("name")
    for key, kind in KINDS.items():
        if entry.get(key) is not None and not isinstance(entry[key], kind):
            raise TypeError(f"the {key} of {file} is of another kind")
    if not all(isinstance(length, int | float) for length in entry.get("size") or ()):
        raise TypeError(f"the size of {file} is no list of numbers")
    processed = set() if file == entry["datafile"].get("original") else OF_ORIGINAL
    named = {key: value for key, value in entry.items() if key not in processed}
    return named | {"name": name if name and isinstance(name, str) else file}


def _data_file(entry: dict[str, Any]) -> str:
    """Return the name of the data file of a scan."""
    files = entry["datafile"]
    file = [files[key] for key in DATA_FILES if files.get(key)][0]
    # Never turned into text: aliases make lists of any length.
    if not isinstance(file, str) or not file.isprintable():
        raise TypeError("the name of a data file is no printable text")
    return file


def _member_named(entries: list[dict[str, Any]], dataset: str) -> dict[str, Any]:
    """Return what is said of the one scan of this name or data file."""
    chosen = [entry for entry in entries if dataset in (_data_file(entry), entry["name"])]
    if not chosen:
        known = ", ".join(sorted({entry["name"] for entry in entries}))
        raise RefusedScan(f"expected the column dataset to name one of {known}; found {dataset!r}")
    if len(chosen) > 1:
        files = ", ".join(_data_file(entry) for entry in chosen)
        raise RefusedScan(
            f"expected one scan {dataset!r}, found {files}; name one of these instead"
        )
    return chosen[0]
