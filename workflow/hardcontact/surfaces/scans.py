"""Reading scans of any microscope."""

import zipfile
from pathlib import Path

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.limited_process import read_in_child


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    unit: str = "none",
    map_size: float | str = "none",
) -> HeightMap:
    """Read the central square of a map, or a line scan, in nm, not levelled.

    `dataset` names a member of a container, or a channel. `unit` (two: of positions, heights) and
    `map_size`, the longer side in nm, serve files that state none. Raises ValueError, in one line,
    if the scan cannot be used, or has undefined pixels and their interpolation is ``"refuse"``.
    """
    from hardcontact.surfaces.scan_formats import read_fields

    fields = read_in_child(read_fields, Path(path), dataset, undefined_pixels, unit, map_size)
    fields["notes"] = tuple(fields["notes"])
    return HeightMap(path=str(path), **fields)


def list_scans(path: str | Path) -> list[str]:
    """Return the names of a container's data files, or one empty name for any other file.

    Raises ValueError, with one line, if the container cannot be used.
    """
    # A file that is no archive needs no child, which `read_scan` starts for it.
    if not (Path(path).is_file() and zipfile.is_zipfile(path)):
        return [""]
    from hardcontact.surfaces.scan_formats import list_datasets

    return list(read_in_child(list_datasets, Path(path))["datasets"])
