"""What determined each file of a study: read back, followed to its sources, checked."""

import json
from functools import cache
from pathlib import Path
from typing import NamedTuple

import netCDF4

from hardcontact.dataset import digest

__all__ = ["Check", "check", "records", "require", "sources", "traced"]


def _record(path):
    """The attributes of a netCDF file; None of another or none."""
    try:
        with netCDF4.Dataset(path) as file:
            return {name: file.getncattr(name) for name in file.ncattrs()}
    except OSError:
        return None


def _beside(path):
    """The record that was written beside files."""
    try:
        record = json.loads(Path(path).read_text())
        return record | {"output_digests": json.loads(record["output_digests"])}
    except (OSError, ValueError, TypeError, KeyError) as error:
        reason = str(error).splitlines()[0]
        raise ValueError(
            f"{path}: expected a whole record, found: {reason}; delete it and run again"
        ) from None


def require(path):
    """Raise ValueError, in one line, unless the files of a record are those that were written."""
    for name, expected in _beside(path)["output_digests"].items():
        if not Path(name).is_file() or digest([name]) != expected:
            raise ValueError(
                f"{name}: expected the file that the study wrote, found another or none; "
                "delete it and run again"
            )


def _made_here(record):
    return record is not None and "input_digests" in record


def records(folder):
    """Path -> record of every file of a study's folder that has one, in or beside it.

    A record has the texts of `dataset.provenance`; those beside files also `output_digests`, a
    dict. Raises ValueError naming a record that is damaged.
    """
    found = {path.as_posix(): _record(path) for path in sorted(Path(folder).glob("*.nc"))}
    for path in sorted(Path(folder, "provenance").glob("*.json")):
        record = _beside(path)
        found |= dict.fromkeys(record["output_digests"], record)
    return {path: record for path, record in found.items() if _made_here(record)}


def traced(folder):
    """`records` of a study's folder and of all intermediates at hand that led to it."""
    found = records(folder)
    pending = list(found)
    while pending:
        for path in json.loads(found[pending.pop()]["input_digests"]):
            if path.endswith(".nc") and path not in found and _made_here(record := _record(path)):
                found[path] = record
                pending.append(path)
    return found


def sources(found):
    """Path -> digest of what the files of `traced` were made from and the study did not make."""
    inputs = {}
    for record in found.values():
        inputs |= json.loads(record["input_digests"])
    return {path: inputs[path] for path in sorted(inputs.keys() - found.keys())}


class Check(NamedTuple):
    """Files that were compared, faults (a line each), and inputs that are not at hand."""

    files: set
    faults: list
    absent: set


def check(folder, described):
    """Compare every file that led to a study's folder with what it says it was made from.

    described: path -> digest of the folder's files in its RO-Crate. Returns a `Check`. Raises
    ValueError if there is nothing to compare.
    """
    found, now = traced(folder), cache(lambda path: digest([path]))
    if not found and not described:
        raise ValueError(f"{folder}: expected files of a study, found none")
    written = {
        path: record["output_digests"][path]
        for path, record in found.items()
        if "output_digests" in record
    } | described
    result = Check(found.keys() | written.keys(), [], set())
    for path, record in sorted(found.items()):
        digests = json.loads(record["input_digests"])
        missing = {name for name in digests if not Path(name).is_file()}
        other = [name for name in sorted(digests.keys() - missing) if now(name) != digests[name]]
        result.absent.update(missing)
        if other:
            result.faults.append(f"{path}: does not match its input {', '.join(other)}")
    for path, expected in sorted(written.items()):
        if not Path(path).is_file():
            result.faults.append(f"{path}: expected a file of the study, found none")
        elif now(path) != expected:
            result.faults.append(f"{path}: is not the file that the study wrote")
    return result
