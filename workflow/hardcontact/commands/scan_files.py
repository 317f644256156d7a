"""The files of scans that the arguments of `hardcontact new` name, and the labels of surfaces."""

import os
import re
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from hardcontact.config.selected_surfaces import LABEL, RESERVED_IDS
from hardcontact.records.code import ROOT

#: Id and label of the sphere's surface.
SPHERE = "sphere"


class ScanFile(NamedTuple):
    """A file of a surface: the surface's id and label, where to read it, its path in the table."""

    surface: str
    label: str
    file: str
    path: str
    sphere_radius: float | None = None  #: In nm, of scans of the sphere.
    is_in_folder: bool = False  #: Whether the user named its folder, which may hold other files.


def label_faults(option: str, label: str) -> Iterator[str]:
    """Yield a line if a label is not valid in figures."""
    try:
        LABEL.check(label)
    except ValueError as error:
        yield f"{option}: label: {error}"


def list_scan_files(arguments: Namespace, radius: float) -> tuple[list[ScanFile], list[str]]:
    """Return the files of all surfaces, the sphere's last, and a line for each fault."""
    surfaces = [(arguments.name, arguments.files)] if arguments.files else []
    surfaces += [(label, files) for label, *files in arguments.surface]
    faults = [] if surfaces else ["FILE: expected files of scans, found none"]
    for label, *files in arguments.surface:
        faults += label_faults("--surface", label)
        if not files:
            faults.append(f"--surface {label}: expected files of scans, found none")
    surfaces += [(SPHERE, arguments.sphere)] if arguments.sphere else []
    scan_files: list[ScanFile] = []
    labels: dict[str, str] = {}
    for label, files in surfaces:
        surface = surface_id(label)
        if surface in labels:
            faults.append(
                f"--surface {labels[surface]}: expected labels that differ in their first 40 "
                f"letters and digits, found also {label}"
            )
        labels.setdefault(surface, label)
        sphere_radius = radius if files is arguments.sphere else None
        for file in files:
            file_paths = _files_in(file)
            if not file_paths:
                faults.append(f"{file}: expected a folder with files of scans, found none")
            scan_files += [
                ScanFile(surface, label, path, path_from_root(path), sphere_radius, path != file)
                for path in file_paths
            ]
    counts = Counter(scan_file.path for scan_file in scan_files)
    faults += [
        f"{path}: expected each file once, found it {count} times"
        for path, count in counts.items()
        if count > 1
    ]
    return scan_files, faults


def _files_in(file: str) -> list[str]:
    """Return the files in a folder, without hidden ones; any other path alone."""
    if not Path(file).is_dir():
        return [file]
    return sorted(str(path) for path in Path(file).glob("[!.]*") if path.is_file())


def surface_id(label: str) -> str:
    """Return the id of a surface: its label in lower case, other characters as underscores."""
    name = re.sub(r"[^a-z0-9]+", "_", label.lower()).strip("_")
    if name in RESERVED_IDS or not re.match("[a-z]", name):
        name = f"surface_{name}".rstrip("_")
    return name[:40].rstrip("_")


def path_from_root(file: str) -> str:
    """Return a path relative to the top folder; an absolute path to elsewhere stays absolute."""
    absolute = os.path.abspath(file)
    if os.path.isabs(file) and not Path(absolute).is_relative_to(ROOT):
        return absolute
    return os.path.relpath(absolute, ROOT)
