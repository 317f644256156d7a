"""Containers of contact.engineering: archives of scans with a list of their metadata.

`SurfaceTopography.Container.IO.Schema` describes them.
"""

import io
import json
import zipfile
from typing import Any

import yaml

from hardcontact.scans.refused_file import RefusedFile

#: The lists of scans in containers, new and old, in the order in which they are looked for.
INDEX_FILES = ("index.json", "meta.yml")
#: Largest number of scans in a container. Each is read in its own process, which takes
#: 0.05 s for 512 x 512 pixels: so many take a minute.
MAX_SCANS = 1000
#: Keys of the data file of a scan: the measured file, or else the processed file, whose channel is
#: already selected and whose heights are already scaled.
DATA_FILE_KEYS = ("original", "squeezed-netcdf")
#: Metadata that hold for the measured file only: they are ignored for the processed file.
ORIGINAL_ONLY_KEYS = ("data_source", "height_scale")


def container_entries(content: bytes) -> list[dict[str, Any]] | None:
    """Return the metadata and data file of each scan, None if the file is no container."""
    if not zipfile.is_zipfile(io.BytesIO(content)):
        return None
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        name = next((name for name in INDEX_FILES if name in archive.namelist()), None)
        if name is None:
            return None
        text = archive.read(name)
    try:
        contents = json.loads(text) if name == INDEX_FILES[0] else yaml.load(text, yaml.CFullLoader)
        surfaces = contents["surfaces"]
        entries = [_entry(scan) for surface in surfaces for scan in surface["topographies"]]
    except Exception as error:  # A malformed list may raise any error.
        raise RefusedFile(
            f"expected {name} that lists surfaces, their topographies and the data file of "
            f"each, found: {type(error).__name__}: {str(error)[:200]}"
        ) from None
    if len(entries) > MAX_SCANS:
        raise RefusedFile(
            f"expected at most {MAX_SCANS} scans in a container, found {len(entries)}"
        )
    return entries


def _entry(scan: dict[str, Any]) -> dict[str, Any]:
    """Return the metadata of a scan in a container with its data file, and a name."""
    key = next(key for key in DATA_FILE_KEYS if scan["datafile"].get(key))
    file = scan["datafile"][key]
    if not isinstance(file, str):
        raise TypeError("the name of a data file is no text")
    ignored = () if key == "original" else ORIGINAL_ONLY_KEYS
    kept_metadata = {key: value for key, value in scan.items() if key not in ignored}
    return kept_metadata | {"name": scan.get("name") or file, "file": file}


def find_entry(entries: list[dict[str, Any]], dataset: str) -> dict[str, Any]:
    """Return the metadata of the only scan with this name or data file."""
    named_entries = [entry for entry in entries if dataset in (entry["file"], entry["name"])]
    if len(named_entries) != 1:
        scans = ", ".join(f"{entry['name']} ({entry['file']})" for entry in entries)
        raise RefusedFile(
            "expected a dataset that names one scan, "
            f"found {len(named_entries)} of {dataset!r} among {scans}"
        )
    return named_entries[0]
