"""Zip archives that hold scans: checked before they are read, unpacked in memory alone.

A contact.engineering container has a list of its scans, `index.json` or, of older ones,
`meta.yml`; the format is described by `SurfaceTopography.Container.IO.Schema`.
"""

import io
import json
import zipfile
from collections.abc import Callable
from typing import Any

import yaml

from hardcontact.surfaces.measurement import FILE_LIMIT, RefusedScan

__all__ = ["check_archive", "data_file", "is_container", "members", "opened_member"]

#: The lists of scans, in the order in which they are looked for, and the largest one in bytes.
LISTS: dict[str, Callable[[bytes], Any]] = {
    "index.json": json.loads,
    "meta.yml": lambda text: yaml.load(text, Loader=_ListLoader),
}
LIST_LIMIT = 2**20
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


class _ListLoader(yaml.SafeLoader):
    """Plain data only; the containers' tuples are read as lists, nothing is executed."""


_ListLoader.add_constructor(
    "tag:yaml.org,2002:python/tuple",
    yaml.SafeLoader.construct_yaml_seq,  # type: ignore[type-var]
)


def check_archive(archive: zipfile.ZipFile) -> None:
    """Refuse an archive that unpacks to too much, or not to one file a name, before reading it."""
    files = archive.infolist()
    size = sum(file.file_size for file in files)
    if size > FILE_LIMIT:
        raise RefusedScan(f"expected at most {FILE_LIMIT} bytes once unpacked, found {size}")
    if len({file.filename for file in files}) < len(files):
        raise RefusedScan("expected an archive with each file once, found one repeated")
    if any(file.flag_bits & 1 for file in files):
        raise RefusedScan("expected an archive without a password, found an encrypted file")


def is_container(archive: zipfile.ZipFile) -> bool:
    """Return whether an archive lists the scans it holds."""
    return any(name in archive.namelist() for name in LISTS)


def members(container: zipfile.ZipFile) -> list[dict[str, Any]]:
    """Return what a checked container says of each of its scans.

    The keys are those of ``TopographyMeta`` of SurfaceTopography; each scan has a data file. A list
    that is too large or lists no scans is a RefusedScan.
    """
    name = next(name for name in LISTS if name in container.namelist())
    size = container.getinfo(name).file_size
    if size > LIST_LIMIT:
        raise RefusedScan(f"expected {name} of at most {LIST_LIMIT} bytes, found {size}")
    text = container.read(name)
    try:
        surfaces = LISTS[name](text)["surfaces"]
        return [_member(entry) for surface in surfaces for entry in surface["topographies"]]
    except LIST_ERRORS as error:
        raise RefusedScan(
            f"expected {name} that lists surfaces, their topographies and the data file of "
            f"each, found: {type(error).__name__}: {error}"
        ) from None


def _member(entry: dict[str, Any]) -> dict[str, Any]:
    """Return what is said of a scan, with its name, or that of its data file if it has none."""
    file, name = data_file(entry), entry.get("name")
    for key, kind in KINDS.items():
        if entry.get(key) is not None and not isinstance(entry[key], kind):
            raise TypeError(f"the {key} of {file} is of another kind")
    if not all(isinstance(length, int | float) for length in entry.get("size") or ()):
        raise TypeError(f"the size of {file} is no list of numbers")
    processed = set() if file == entry["datafile"].get("original") else OF_ORIGINAL
    named = {key: value for key, value in entry.items() if key not in processed}
    return named | {"name": name if name and isinstance(name, str) else file}


def data_file(entry: dict[str, Any]) -> str:
    """Return the name of the data file of a scan."""
    files = entry["datafile"]
    file = [files[key] for key in DATA_FILES if files.get(key)][0]
    if not isinstance(file, str):  # never turned into text: aliases make lists of any length
        raise TypeError("the name of a data file is no text")
    return file


def opened_member(container: zipfile.ZipFile, dataset: str) -> tuple[io.BytesIO, dict[str, Any]]:
    """Return the data file of the one member of this name or data file, and what is said of it."""
    entries = members(container)
    chosen = [entry for entry in entries if dataset in (data_file(entry), entry["name"])]
    if not chosen:
        known = ", ".join(sorted({entry["name"] for entry in entries}))
        raise RefusedScan(f"expected the column dataset to name one of {known}; found {dataset!r}")
    if len(chosen) > 1:
        files = ", ".join(data_file(entry) for entry in chosen)
        raise RefusedScan(
            f"expected one scan {dataset!r}, found {files}; name one of these instead"
        )
    file = data_file(chosen[0])
    if file not in container.namelist():
        raise RefusedScan(f"expected the data file {file} in the container, found none")
    return io.BytesIO(container.read(file)), chosen[0]
