"""Open the bytes of a scan: unpack a container, choose a reader, refuse files without heights.

The schema of containers is in `SurfaceTopography.Container.IO.Schema`.
"""

import gzip
import io
import json
import re
import zipfile
from collections.abc import Mapping
from importlib import import_module
from typing import Any

import yaml
from SurfaceTopography import open_topography
from SurfaceTopography.Exceptions import CannotDetectFileFormat
from SurfaceTopography.IO import MagicMatch, readers
from SurfaceTopography.Support.UnitConversion import is_length_unit

from hardcontact.scans.heights import RefusedFile
from hardcontact.scans.plain_text import NUMBERS, readable_text

#: Modules that readers import only while they read. They are imported here, because a process that
#: reads may open no files (`reading`).
IMPORTED_BY_READERS = (
    "SurfaceTopography.IO.description", "h5py", "tifffile", "zstandard", "encodings.ascii",
    "encodings.cp1252", "encodings.cp437", "encodings.latin_1", "encodings.utf_16",
    "encodings.utf_16_le", "encodings.utf_8_sig",
)  # fmt: skip
for module in IMPORTED_BY_READERS:
    import_module(module)
#: Files that list the scans of a container, new and old: the first that it has is read.
INDEX_FILES = ("index.json", "meta.yml")
#: Largest number of scans in a container: to read so many takes a minute.
MAX_SCANS = 1000
#: Keys of the data file of a scan in a container: the measured file, or else the processed one.
DATA_FILE_KEYS = ("original", "squeezed-netcdf")
#: Metadata of the measured file alone: the processed file has one channel, already scaled.
ORIGINAL_ONLY_KEYS = ("data_source", "height_scale")
#: SurfaceTopography's message on an unreadable file: a reader and its reason, in turn.
READER_MESSAGE = re.compile(r"tried (\w+): \n (.*?)\n\n(?=tried |\Z)", re.S)
#: The unit of values that a header of a text states.
VALUE_UNIT = re.compile(r"(?:value units|z-unit|unit data)\s*[:=]\s*(\S+)", re.I)
#: The remedy for a file whose heights no reader takes.
SAVE_AS_TEXT = "save the heights as netCDF or as a text of numbers, for example with Gwyddion"
PICTURE = f"a picture, whose grey values are not heights: {SAVE_AS_TEXT}"
#: First bytes of files without heights on a grid, by words for their type and the remedy. No reader
#: is tried on them.
TYPES_WITHOUT_HEIGHTS = {
    PICTURE: (b"P2\n", b"P5\n", b"\x89PNG", b"\xff\xd8\xff", b"GIF8"),
    "a model of triangles or points: save its points as a text of x, y, height": (
        b"#VRML", b"ply\n",
    ),
    f"a document: {SAVE_AS_TEXT}": (b"%PDF",),
}  # fmt: skip
#: First bytes of files that some reader may take, by their type and the remedy if none does.
TYPES_OFTEN_REFUSED = {
    "a compressed file of MountainsMap: save it without compression": (b"DSCOMPRESSED",),
    "an archive: unpack it, and give the scans in it": (
        b"PK\3\4", b"BZh", b"\xfd7zXZ", b"7z\xbc\xaf", b"Rar!",
    ),
    PICTURE: (b"BM", b"II*\0", b"MM\0*"),
}  # fmt: skip
#: SurfaceTopography's messages on values that are no lengths.
UNKNOWN_UNIT = re.compile("Unknown unit '(.*)'|.* while unit '(.*)' is of kind")


def list_datasets(content: bytes) -> dict[str, Any]:
    """Return the names of the data files of a container, or one empty name for any other file.

    They are in a dictionary, because `read_in_child` passes dictionaries.
    """
    entries = _container_entries(_decompress(content))
    return {"datasets": [""] if entries is None else [entry["file"] for entry in entries]}


def open_scan(content: bytes, dataset: str) -> tuple[Any, dict[str, Any], list[str]]:
    """Return a reader with channels, the metadata from a container ({} if in none), and notes."""
    content = _decompress(content)
    entries = _container_entries(content)
    entry: dict[str, Any] = {}
    if entries is not None:
        entry = _find_entry(entries, dataset)
        with zipfile.ZipFile(io.BytesIO(content)) as container:
            content = container.read(entry["file"])
    content, notes = readable_text(content)
    return _open_reader(content), entry, notes


def _decompress(content: bytes) -> bytes:
    """Return the content of a file of gzip; any other content stays as it is."""
    return gzip.decompress(content) if content.startswith(b"\x1f\x8b") else content


def _container_entries(content: bytes) -> list[dict[str, Any]] | None:
    """Return the metadata and data file of each scan, None if the file is no container."""
    if not zipfile.is_zipfile(io.BytesIO(content)):
        return None
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        index_file = next((name for name in INDEX_FILES if name in archive.namelist()), None)
        if index_file is None:
            return None
        text = archive.read(index_file)
    try:
        is_json = index_file.endswith(".json")
        surfaces = (json.loads(text) if is_json else yaml.load(text, yaml.CFullLoader))["surfaces"]
        entries = [
            _container_entry(scan) for surface in surfaces for scan in surface["topographies"]
        ]
    except Exception as error:  # A malformed list may raise any error.
        raise RefusedFile(
            f"expected {index_file} that lists surfaces, their topographies and the data file of "
            f"each, found: {type(error).__name__}: {str(error)[:200]}"
        ) from None
    if len(entries) > MAX_SCANS:
        raise RefusedFile(
            f"expected at most {MAX_SCANS} scans in a container, found {len(entries)}"
        )
    return entries


def _container_entry(scan: dict[str, Any]) -> dict[str, Any]:
    """Return the metadata of a scan in a container, with its data file and a name."""
    file_key = next(key for key in DATA_FILE_KEYS if scan["datafile"].get(key))
    file = scan["datafile"][file_key]
    if not isinstance(file, str):
        raise TypeError("the name of a data file is no text")
    ignored_keys = () if file_key == "original" else ORIGINAL_ONLY_KEYS
    kept_metadata = {key: value for key, value in scan.items() if key not in ignored_keys}
    return kept_metadata | {"name": scan.get("name") or file, "file": file}


def _find_entry(entries: list[dict[str, Any]], dataset: str) -> dict[str, Any]:
    """Return the metadata of the only scan with this name or data file, or refuse the name."""
    matching = [entry for entry in entries if dataset in (entry["file"], entry["name"])]
    if len(matching) != 1:
        scans = ", ".join(f"{entry['name']} ({entry['file']})" for entry in entries)
        raise RefusedFile(
            "expected a dataset that names one scan, "
            f"found {len(matching)} of {dataset!r} among {scans}"
        )
    return matching[0]


def _open_reader(content: bytes) -> Any:
    """Return a reader whose channels can be listed; refuse other files with the remedy."""
    file_type = _file_type_in_words(content, TYPES_WITHOUT_HEIGHTS)
    if file_type:
        raise RefusedFile(f"expected a scan of heights, found {file_type}")
    try:
        reader = open_topography(io.BytesIO(content))
        has_channels = bool(reader.channels)
    except CannotDetectFileFormat as error:
        raise RefusedFile(
            "expected a file in a format that SurfaceTopography reads, "
            f"found {_describe_unread(content, str(error))}"
        ) from None
    except ValueError as error:
        unit_match = UNKNOWN_UNIT.match(str(error))
        if unit_match is None:
            raise
        raise RefusedFile(
            f"expected heights, found values in {unit_match[1] or unit_match[2]!r}, which is no "
            "unit of length: save the heights in place of them"
        ) from None
    if not has_channels:
        raise RefusedFile(f"expected a file with heights, found {_describe_unread(content, '')}")
    return reader


def _file_type_in_words(content: bytes, types: Mapping[str, tuple[bytes, ...]]) -> str:
    """Return the words for the type whose first bytes the content has; an empty text for none."""
    return next((words for words, starts in types.items() if content.startswith(starts)), "")


def _describe_unread(content: bytes, reader_messages: str) -> str:
    """Describe a file that no reader takes, and why the readers of its type do not take it."""
    file_type, reader_names = _file_type_and_readers(content)
    reasons = {
        name: f"{name}: {' '.join(reason.split())[:200]}"
        for name, reason in READER_MESSAGE.findall(reader_messages)
    }
    reader_reasons = [reasons[name] for name in reader_names if name in reasons]
    if file_type:
        return "; ".join([file_type, *reader_reasons])
    return f"{'; '.join(reader_reasons) or 'one that none of its readers takes'}; {SAVE_AS_TEXT}"


def _file_type_and_readers(content: bytes) -> tuple[str, list[str]]:
    """Return the type of a file with the remedy, "" if unknown, and names of its readers."""
    describe = _describe_zip if zipfile.is_zipfile(io.BytesIO(content)) else _describe_text
    file_type, reader_names = describe(content)
    if file_type:
        return file_type, reader_names
    matches = {reader.__name__: reader.can_read(content[:512]) for reader in readers}
    reader_names = [name for name, match in matches.items() if match == MagicMatch.YES]
    return _file_type_in_words(content, TYPES_OFTEN_REFUSED), reader_names


def _describe_zip(content: bytes) -> tuple[str, list[str]]:
    """Return the type of a zip file with the remedy, "" if unknown, and names of its readers."""
    members = zipfile.ZipFile(io.BytesIO(content)).namelist()
    if "[Content_Types].xml" in members:
        return f"a document of an office program: {SAVE_AS_TEXT}", []
    if any(member.endswith("/main.xml") for member in members):
        return "an X3P with files in a folder: zip them without the folder", ["X3PReader"]
    return "", []


def _describe_text(content: bytes) -> tuple[str, list[str]]:
    """Return the fault of a text of numbers, "" for other content, and names of its readers."""
    lines = content[: 2**16].decode("utf-8", "replace").splitlines()
    if sum(NUMBERS.fullmatch(line) is not None for line in lines) <= len(lines) / 2:
        return "", []
    unit = VALUE_UNIT.search("\n".join(lines))
    if unit and not is_length_unit(unit[1]):
        return (
            f"a text of values in {unit[1]}, which is no unit of length: multiply them by "
            "the sensitivity of the instrument, and state the unit of the heights"
        ), []
    return "a text that is neither a matrix of equal rows nor columns of points", ["AscReader"]
