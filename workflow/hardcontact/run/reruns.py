"""The files that a run makes again: their records differ from their present origin.

Times and Snakemake's metadata do not count, because a copy or a power loss makes them wrong.
"""

import os
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

from snakemake.jobs import Job
from snakemake.persistence import ParamsChange, PersistenceBase
from snakemake.settings.types import RerunTrigger

from hardcontact.records.origin import (
    Record,
    canonical_json,
    file_digest,
    lineage_digest,
    read_record,
    refuse_edited_files,
    versions,
)
from hardcontact.run.ending import end_run_at_fault, refuse

#: Size in bytes up to which files of earlier jobs are read to see whether they changed. Larger
#: files are taken to be as recorded; the job that uses such a file compares it with its record.
MAX_READ_SIZE = 1_000_000

#: The oldest Snakemake that has all attributes that `plan_by_records` replaces.
MIN_SNAKEMAKE = "9.27"


class Changes(NamedTuple):
    """The differences between the record of a file and the file that would be made now."""

    #: Parameters and versions found only in the record; without a record, a text that says so.
    recorded: set[str]
    current: set[str]  #: Parameters and versions found only now.
    inputs: set[str]  #: Inputs that are new, gone, or have a different content.


class Reruns:
    """Finds what changed since the files of a run were made; jobs are Snakemake's.

    A file is made again if a parameter, a version or the content of an input is not as recorded. If
    an input is missing, because somebody deleted the store, no content can be compared. Therefore
    lineages are compared. The lineage of a file is one digest of its parameters, of versions, and
    of the lineages of its inputs. The lineage of a file that no job makes is its SHA-256. So the
    present lineage of each file can be found without files that jobs make. If it is as recorded,
    the missing input would be made as before, and the file is not made again.
    """

    def __init__(self, dependencies: Mapping[Any, Mapping[Any, Iterable[str]]]) -> None:
        """Take the files, by job, that each job needs from other jobs."""
        self._dependencies = dependencies
        self._digests: dict[str, str | None] = {}  # By path.
        self._input_digests: dict[Any, dict[str, str | None]] = {}  # By job.
        self._lineages: dict[Any, str] = {}  # By job.

    def changes(self, job: Any, path: str) -> Changes:
        """Return the changes since a job made a file."""
        record = _complete_record(path)
        if record is None:
            return Changes({f"no complete record of {path}"}, set(), set())
        recorded = _key_value_texts(record.parameters | record.versions)
        current = _key_value_texts(job.params.parameters | versions())
        return Changes(
            recorded - current, current - recorded, self._changed_input_paths(job, record)
        )

    def _changed_input_paths(self, job: Any, record: Record) -> set[str]:
        """Return inputs that changed; missing inputs only if the lineage of the outputs changed."""
        if job not in self._input_digests:
            self._input_digests[job] = {path: self._digest(path) for path in _input_paths(job)}
        inputs = self._input_digests[job]
        changed_paths = {path for path, _ in inputs.items() ^ record.input_digests.items()}
        missing_paths = {path for path, value in inputs.items() if value is None}
        if missing_paths and self._lineage(job) == record.lineage:
            return changed_paths - missing_paths
        return changed_paths

    def _digest(self, path: str) -> str | None:
        """Return the SHA-256 of a file, as recorded if it is large; None if it is missing."""
        if path not in self._digests:
            self._digests[path] = None
            if Path(path).is_file():
                is_large = Path(path).stat().st_size > MAX_READ_SIZE
                record = _complete_record(path) if is_large else None
                self._digests[path] = record.sha256 if record else file_digest(path)
        return self._digests[path]

    def made_file_digests(self, paths: Iterable[str]) -> dict[str, str]:
        """Return the SHA-256, as `_digest` does, of those files that exist and that a job made."""
        made_paths = filter(_complete_record, paths)
        return {path: digest for path in made_paths if (digest := self._digest(path))}

    def _lineage(self, job: Any) -> str:
        """Return the lineage that the files of a job would have now."""
        if job not in self._lineages:
            makers = {
                Path(path).as_posix(): maker
                for maker, paths in self._dependencies[job].items()
                for path in paths
            }
            lineages = {
                path: self._lineage(makers[path]) if path in makers else _file_lineage(path)
                for path in _input_paths(job)
            }
            self._lineages[job] = lineage_digest(canonical_json(job.params.parameters), lineages)
        return self._lineages[job]


def _input_paths(job: Any) -> set[str]:
    """Return the inputs of a job, as records name them."""
    return {Path(path).as_posix() for path in job.input}


def _complete_record(path: str) -> Record | None:
    """Return the record of a file, None if it is missing or damaged."""
    try:
        return read_record(path)
    except ValueError:
        return None


def _file_lineage(path: str) -> str:
    """Return the lineage of a file that no job of the run makes: as recorded, else its SHA-256."""
    record = _complete_record(path)
    return record.lineage if record else file_digest(path)


def _key_value_texts(values: Mapping[str, Any]) -> set[str]:
    """Return a text key=value for each key."""
    return {f"{key}={canonical_json(value)}" for key, value in values.items()}


def plan_by_records(workflow: Any) -> None:
    """Make records decide which files are made again, since times and metadata can be lost.

    Parts of Snakemake are replaced: a missing one ends the run, and
    `tests/workflow/test_reruns.py` fails if one has another meaning.
    """
    from snakemake.dag import DAG  # It imports itself in a circle unless Snakemake runs.

    replacements: list[tuple[type, str, Any]] = [
        # Snakemake asks only whether parameters changed; `_recorded_change` reports all changes.
        (type(workflow), "rerun_triggers", frozenset({RerunTrigger.PARAMS})),
        # Snakemake would advise users to trust file times, which are lost or misleading.
        (type(workflow), "log_provenance_info", lambda workflow: None),
        # Without a time of outputs, Snakemake finds no input that is newer.
        (Job, "output_mintime", property(_no_time)),
        # Snakemake would skip files without metadata, although they have a record.
        (PersistenceBase, "has_metadata", lambda persistence, job: True),
        # Snakemake would skip files whose metadata are from an older version of it.
        (PersistenceBase, "has_outdated_metadata", lambda persistence, job: False),
        # Snakemake would compare parameters with its metadata, not with records.
        (PersistenceBase, "params_changed", _recorded_change),
        # Snakemake calls it before it touches files. Its `--touch` would renew times alone.
        (DAG, "check_touch_compatible", _refuse_touch),
    ]
    for owner, name, replacement in replacements:
        if not hasattr(owner, name):
            refuse(f"expected Snakemake with {owner.__name__}.{name}, found none")
        setattr(owner, name, replacement)


def refuse_edited_inputs(workflow: Any) -> None:
    """End the run, before a job removes its outputs, if somebody changed what a job wrote."""
    dag = workflow.persistence.dag
    changed_paths = {path for job in dag.jobs for path in dag.reason(job).updated_input}
    with end_run_at_fault():
        refuse_edited_files(_reruns(dag).made_file_digests(changed_paths))


def _refuse_touch(dag: Any) -> NoReturn:
    """End the run, because file times do not decide what runs again."""
    refuse(
        "snakemake: --touch has no effect, because records of inputs, not file times, "
        "decide what runs again; `snakemake -n` lists the jobs"
    )


async def _no_time(job: Any) -> None:
    """Return None, so that Snakemake never compares file times."""


def _recorded_change(persistence: Any, job: Any, file: str | None = None) -> ParamsChange:
    """Return the changed parameters and versions of a job, or of one of its files.

    This takes the place of `PersistenceBase.params_changed`, whose result has no field for inputs.
    So changed inputs are added to the reasons of the job, which `snakemake -n` lists.
    """
    paths = [path for path in ([file] if file else job.output) if os.path.isfile(path)]
    reruns = _reruns(persistence.dag)
    changes_of_files = [reruns.changes(job, path) for path in paths]
    updated_input = persistence.dag.reason(job).updated_input
    updated_input.update(path for changes in changes_of_files for path in changes.inputs)
    return ParamsChange(
        only_old={value for changes in changes_of_files for value in changes.recorded},
        only_new={value for changes in changes_of_files for value in changes.current},
        files=set(paths),
    )


@cache
def _reruns(dag: Any) -> Reruns:
    """Return the `Reruns` of a run, one for all its jobs, because it keeps what it has found."""
    return Reruns(dag.dependencies)
