"""Compare every file of a finished or archived study with its record, without a workflow."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from hardcontact.records.code import PIN_FILES, installed_version
from hardcontact.records.origin import RECORDS, Record, file_digest, read_record, record_path

#: Folders of a study whose files describe runs: no record describes them.
RUN_FOLDERS = ("logs", "benchmarks")


def traced_records(folder: str | Path) -> dict[str, Record]:
    """Return the records, by path, of ``results/<study>`` and of all files that led to it."""
    records: dict[str, Record] = {}
    # The record of F/fit.nc is F/.origin/fit.nc.json.
    pending = [
        (path.parents[1] / path.stem).as_posix()
        for path in sorted(Path(folder).rglob(f"{RECORDS}/*.json"))
    ]
    while pending:
        path = pending.pop()
        record = None if path in records else read_record(path)
        if record is not None:
            records[path] = record
            pending.extend(record.input_digests)
    return records


def verify_study(folder: str | Path) -> tuple[list[str], list[str]]:
    """Return a line for each file of ``results/<study>`` that does not match, and a summary.

    Files that led to the study are compared, too, unless they are missing.
    """
    records = traced_records(folder)
    if not records:
        raise ValueError(f"{folder}: expected files of a study, found none: was it run?")
    inputs = {path for record in records.values() for path in record.input_digests}
    digests_now = {
        path: file_digest(path) for path in inputs | records.keys() if Path(path).is_file()
    }
    page = Path(folder, "answer.html")
    faults = [
        *_output_faults(folder, records, digests_now),
        *_input_faults(records, digests_now),
        *_unrecorded_faults(folder, digests_now),
    ]
    return faults, [
        *_other_versions(records),
        *([] if page.is_file() else [f"{page}: is missing, so the study is not finished"]),
        f"{folder}: {len(records)} files checked, {len(faults)} faults, "
        f"{len(inputs - digests_now.keys())} inputs not at hand",
    ]


def _output_faults(
    folder: str | Path, records: Mapping[str, Record], digests_now: Mapping[str, str]
) -> Iterator[str]:
    """Yield a line for each file that differs from its record, or is missing in the folder."""
    for path, record in sorted(records.items()):
        if path in digests_now and digests_now[path] != record.sha256:
            yield f"{path}: is not the file that the study wrote"
        elif path not in digests_now and Path(path).is_relative_to(folder):
            yield f"{path}: expected a file of the study, found none"


def _input_faults(records: Mapping[str, Record], digests_now: Mapping[str, str]) -> Iterator[str]:
    """Yield a line for each file whose inputs are no longer those that it was made from."""
    for path, record in sorted(records.items()):
        changed_input_paths = [
            input_path
            for input_path, recorded_digest in sorted(record.input_digests.items())
            if digests_now.get(input_path, recorded_digest) != recorded_digest
        ]
        if changed_input_paths and path in digests_now:
            yield f"{path}: does not match its input {', '.join(changed_input_paths)}"


def _unrecorded_faults(folder: str | Path, traced_paths: Iterable[str]) -> Iterator[str]:
    """Yield a line for each file without a record, in the study or beside recorded files."""
    study_files = (
        path
        for path in Path(folder).rglob("*")
        if RECORDS not in path.parts and path.relative_to(folder).parts[0] not in RUN_FOLDERS
    )
    output_folders = {
        Path(path).parent
        for path in traced_paths
        # A job made it, even if all records in its folder are lost.
        if (path.startswith("results/") and path not in PIN_FILES)
        or record_path(path).parent.is_dir()
    }
    files_beside = (path for output_folder in output_folders for path in output_folder.iterdir())
    for path in sorted({*study_files, *files_beside}):
        if path.is_file() and not record_path(path).is_file():
            yield f"{path.as_posix()}: expected a record of its origin, found none"


def _other_versions(records: Mapping[str, Record]) -> Iterator[str]:
    """Yield a line for each version of a package that is not the installed one."""
    paths_by_version = defaultdict[str, list[str]](list)
    for path, record in sorted(records.items()):
        for name, recorded in record.versions.items():
            if recorded != installed_version(name):
                versions = f"{name} {recorded}, here {installed_version(name) or 'none'}"
                paths_by_version[versions].append(path)
    for versions, paths in paths_by_version.items():
        yield f"{len(paths)} files, such as {paths[0]}, were made with {versions}"
