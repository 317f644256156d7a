"""The origin of a file: its parameters, inputs, code and the versions of packages.

Each file that a job makes has a record of its origin and of its own SHA-256, in the hidden folder
RECORDS beside it. Records decide what a run makes again.
"""

import hashlib
import json
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from hardcontact.base.atomic_file import write_text_file

#: Packages whose versions each record names.
PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "SurfaceTopography", "snakemake")
#: Name of the folder with the records of files, beside these files.
RECORDS = ".origin"


class Record(NamedTuple):
    """The record of a file: its `Origin`, versions of packages, its own SHA-256 and its lineage."""

    parameters: dict[str, Any]
    versions: dict[str, str]
    input_digests: dict[str, str]  #: SHA-256 by path.
    sha256: str
    lineage: str  #: From `lineage_digest`; empty in records of former versions.


def canonical_json(parameters: object) -> str:
    """Return parameters as one sorted JSON text: equal text means equal parameters."""
    return json.dumps(parameters, sort_keys=True, ensure_ascii=False, separators=(",", ":"))


def value_digest(value: object) -> str:
    """Return the SHA-256 of the canonical JSON text of a value."""
    return hashlib.sha256(canonical_json(value).encode()).hexdigest()


def short_value_digest(value: object) -> str:
    """Return the first eight digits of the digest of a value, for paths."""
    return value_digest(value)[:8]


def file_digest(path: str | Path) -> str:
    """Return the SHA-256 of the content of a file."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@cache
def versions() -> dict[str, str]:
    """Return the installed versions of PACKAGES."""
    return {name: version(name) for name in PACKAGES}


def lineage_digest(parameters_json: str, input_lineages: Mapping[str, str]) -> str:
    """Return a digest of a file's parameters, of package versions and of the lineage of each input.

    The lineage of a file that no job made is its SHA-256.
    """
    return value_digest([parameters_json, versions(), input_lineages])


def file_digests(paths: Iterable[str | Path]) -> dict[str, str]:
    """Return the SHA-256 of files, by path."""
    return {Path(path).as_posix(): file_digest(path) for path in set(paths)}


class Origin(NamedTuple):
    """The parameters, inputs and code from which a file was made."""

    parameters_json: str  #: From `canonical_json`.
    input_digests: dict[str, str]  #: SHA-256 by path.
    code: list[str]  #: Those inputs that are code.

    def attributes(self) -> dict[str, str]:
        """Return the origin, with versions of packages, as texts by name."""
        return {
            "parameters": self.parameters_json,
            "versions": canonical_json(versions()),
            "code_digest": value_digest({path: self.input_digests[path] for path in self.code}),
            "input_digests": canonical_json(self.input_digests),
        }


def record_path(path: str | Path) -> Path:
    """Return the path of the record of a file."""
    # The name does not end in .nc, so that a search for *.nc finds no records.
    return Path(path).parent / RECORDS / f"{Path(path).name}.json"


def keep_records(paths: Iterable[str | Path], origin: Origin) -> None:
    """Keep the origin, the lineage and the SHA-256 of files that a job has made."""
    input_lineages = {}
    for path, digest in origin.input_digests.items():
        record = read_record(path)
        input_lineages[path] = record.lineage if record and record.lineage else digest
    shared_record = origin.attributes() | {
        "input_digests": origin.input_digests,
        "lineage": lineage_digest(origin.parameters_json, input_lineages),
    }
    for path, sha256 in file_digests(paths).items():
        write_text_file(record_path(path), canonical_json(shared_record | {"sha256": sha256}))


def read_record(path: str | Path) -> Record | None:
    """Return the record of a file, None if it has none; refuse a damaged record."""
    path_of_record = record_path(path)
    if not path_of_record.is_file():
        return None
    try:
        content = json.loads(path_of_record.read_text("utf-8"))
        return Record(
            dict(json.loads(content["parameters"])),
            dict(json.loads(content["versions"])),
            dict(content["input_digests"]),
            str(content["sha256"]),
            str(content.get("lineage", "")),
        )
    except (ValueError, TypeError, KeyError) as error:
        raise ValueError(
            f"{path}: expected a complete record of its origin in {path_of_record}, found: "
            f"{' '.join(str(error).split())}; delete {path} and run again"
        ) from None


def is_current(path: str | Path, parameters: Mapping[str, Any], input_path: str) -> bool:
    """Return whether a job would make the same file from this input with these parameters now."""
    record = read_record(path)
    if record is None or record.versions != versions():
        return False
    has_parameters = canonical_json(record.parameters) == canonical_json(parameters)
    has_input = Path(input_path).as_posix() in record.input_digests
    recorded_digests = record.input_digests | {str(path): record.sha256}
    return has_parameters and has_input and not changed_paths(recorded_digests)


def changed_paths(former_digests: Mapping[str, str]) -> list[str]:
    """Return the files that are missing or have another SHA-256 than before."""
    return [
        path
        for path, former_digest in sorted(former_digests.items())
        if not Path(path).is_file() or file_digest(path) != former_digest
    ]


def refuse_edited_files(digests_now: Mapping[str, str]) -> None:
    """Refuse files that have a record with another SHA-256."""
    lines = [
        f"{path}: expected the file that the study wrote, found another"
        for path, digest in sorted(digests_now.items())
        if (record := read_record(path)) and record.sha256 != digest
    ]
    if lines:
        raise ValueError("; ".join(lines) + "; delete it: a run that needs it makes it again")
