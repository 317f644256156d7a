"""The origins of a study's files: traced to their sources, and compared with the files there."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from hardcontact.base.origin import RECORDS, Record, digest, read_record


def traced_records(folder: str | Path) -> dict[str, Record]:
    """Return the records, by path, of the files in ``results/<study>`` and all that led to them.

    Raises ValueError, with one line, if a record is damaged.
    """
    records: dict[str, Record] = {}
    pending = [
        (path.parents[1] / path.stem).as_posix()
        for path in sorted(Path(folder).rglob(f"{RECORDS}/*.json"))
    ]
    paths = set(pending)
    while pending:
        path = pending.pop()
        record = read_record(path)
        if record is not None:
            records[path] = record
            new = record["input_digests"].keys() - paths
            paths |= new
            pending.extend(new)
    return records


def sources(records: Mapping[str, Record]) -> dict[str, str]:
    """Return the inputs in `traced_records` that are no outputs, as SHA-256 by sorted path."""
    inputs: dict[str, str] = {}
    for record in records.values():
        inputs |= record["input_digests"]
    return {path: inputs[path] for path in sorted(inputs.keys() - records.keys())}


def check(folder: str | Path, described: Mapping[str, str]) -> tuple[list[str], str]:
    """Compare every file that led to ``results/<study>`` with its record.

    described: SHA-256, by path, of the files that the RO-Crate describes. It counts for files
        without a record, as in an archive.
    Returns faults, counts: one line for each file that is missing or does not match; one line of
        counts.
    Raises ValueError if there is nothing to compare or a record is damaged, with one line.
    """
    records = traced_records(folder)
    if not records and not described:
        raise ValueError(f"{folder}: expected files of a study, found none")
    current = cache(digest)
    faults = list[str]()
    absent = set[str]()
    written = dict(described) | {path: record["sha256"] for path, record in records.items()}
    for path, expected in sorted(written.items()):
        if not Path(path).is_file():
            if Path(path).is_relative_to(folder):
                faults.append(f"{path}: expected a file of the study, found none")
        elif current(path) != expected:
            faults.append(f"{path}: is not the file that the study wrote")
    for path, record in sorted(records.items()):
        inputs = record["input_digests"]
        missing = {name for name in inputs if not Path(name).is_file()}
        present = sorted(inputs.keys() - missing)
        changed = [name for name in present if current(name) != inputs[name]]
        absent |= missing
        if changed and Path(path).is_file():
            faults.append(f"{path}: does not match its input {', '.join(changed)}")
    return faults, (
        f"{folder}: {len(written)} files checked, {len(faults)} faults, "
        f"{len(absent)} inputs not at hand"
    )
