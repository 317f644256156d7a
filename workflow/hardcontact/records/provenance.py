"""The origins of a study's files: read back, followed to their sources, checked."""

import json
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import netCDF4

from hardcontact.records.origin import digest, kept_digest

#: The texts of `Origin.attributes`; of files without attributes also `output_digests`, a dict.
Record = dict[str, Any]

#: The folder of the records of files that have no attributes, below the results of a study.
FOLDER = "provenance"


def _attributes(path: str | Path) -> Record | None:
    """Return the attributes of a netCDF file that a study wrote; None of any other file."""
    try:
        with netCDF4.Dataset(path) as file:
            attributes: Record = dict(file.__dict__)
    except OSError:
        return None
    return attributes if "input_digests" in attributes else None


def _record(path: str | Path) -> Record:
    """Read the record of files that have no attributes."""
    try:
        record: Record = json.loads(Path(path).read_text("utf-8"))
        outputs = dict(json.loads(record["output_digests"]))
        json.loads(record["input_digests"])
        return record | {"output_digests": outputs}
    except (OSError, ValueError, TypeError, KeyError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(
            f"{path}: expected a whole record, found: {reason}; delete it and run again"
        ) from None


def require(paths: Iterable[str | Path]) -> None:
    """Refuse files that are not those that the study wrote.

    Paths in the folder FOLDER are records; the files that they name are compared. A ValueError of
    one line names the first file that is another or none, or a damaged record.
    """
    for path in paths:
        outputs = _record(path)["output_digests"] if Path(path).parent.name == FOLDER else {}
        for name, expected in outputs.items():
            if not Path(name).is_file() or digest(name) != expected:
                raise ValueError(
                    f"{name}: expected the file that the study wrote, found another or none; "
                    "delete it and run again"
                )


def folder_records(folder: str | Path) -> dict[str, Record]:
    """Return the records of the files in ``results/<study>`` by path.

    They are in the attributes of a file or in the folder FOLDER; a damaged one is a ValueError.
    """
    datasets = {path.as_posix(): _attributes(path) for path in sorted(Path(folder).glob("*.nc"))}
    result = {path: record for path, record in datasets.items() if record is not None}
    for path in sorted(Path(folder, FOLDER).glob("*.json")):
        record = _record(path)
        result |= dict.fromkeys(record["output_digests"], record)
    return result


def traced_records(folder: str | Path) -> dict[str, Record]:
    """Return `folder_records` and those of all intermediate files at hand that led to them."""
    result = folder_records(folder)
    pending = list(result)
    while pending:
        for path in json.loads(result[pending.pop()]["input_digests"]):
            if not path.endswith(".nc") or path in result:
                continue
            if (record := _attributes(path)) is not None:
                result[path] = record
                pending.append(path)
    return result


def sources(records: Mapping[str, Record]) -> dict[str, str]:
    """Return path and SHA-256, sorted, of what is an input in `traced_records` but no output."""
    inputs: dict[str, str] = {}
    for record in records.values():
        inputs |= json.loads(record["input_digests"])
    return {path: inputs[path] for path in sorted(inputs.keys() - records.keys())}


def check(folder: str | Path, described: Mapping[str, str]) -> tuple[list[str], str]:
    """Compare every file that led to ``results/<study>`` with the record of what it was made from.

    `described` has the SHA-256 of the folder's files in its RO-Crate, by path. Returned are the
    faults, one line a file that is missing or another than what is recorded, and a line of counts.
    A ValueError of one line says that there is nothing to compare, or that a record is damaged.
    """
    known = traced_records(folder)
    if not known and not described:
        raise ValueError(f"{folder}: expected files of a study, found none")
    written = dict(described)
    for path, record in known.items():
        if "output_digests" in record:
            written.setdefault(path, record["output_digests"][path])
    # A damaged file may have no attributes that tell what it was made from.
    beside = (file.as_posix() for file in Path(folder).rglob("*") if file.is_file())
    when_made = {path: kept_digest(path) for path in {*known, *beside}}
    written |= {path: value for path, value in when_made.items() if value is not None}
    now = cache(digest)
    faults, absent = list[str](), set[str]()
    for path, record in sorted(known.items()):
        digests = json.loads(record["input_digests"])
        missing = {name for name in digests if not Path(name).is_file()}
        changed = [name for name in sorted(digests.keys() - missing) if now(name) != digests[name]]
        absent |= missing
        if changed:
            faults.append(f"{path}: does not match its input {', '.join(changed)}")
    for path, expected in sorted(written.items()):
        if not Path(path).is_file():
            faults.append(f"{path}: expected a file of the study, found none")
        elif now(path) != expected:
            faults.append(f"{path}: is not the file that the study wrote")
    return faults, (
        f"{folder}: {len(known.keys() | written.keys())} files checked, {len(faults)} faults, "
        f"{len(absent)} inputs not at hand"
    )
