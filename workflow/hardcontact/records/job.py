"""One job of a rule: its log, its parameters, and complete files with their origin."""

import gc
import json
import logging
import os
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from hardcontact.base.atomic_file import remove_incomplete_files, write_text_file
from hardcontact.base.dataset import describe_variables, read_meanings, write_dataset
from hardcontact.records.origin import (
    Origin,
    canonical_json,
    changed_paths,
    file_digests,
    keep_records,
    record_path,
    refuse_edited_files,
)

_logger = logging.getLogger("hardcontact")


class Job(NamedTuple):
    """Inputs and parameters of a script, and methods that write its outputs."""

    input: Any  #: Paths, by position or by name in the rule.
    output: Any  #: Paths, likewise.
    parameters: dict[str, Any]  #: The rule's `params.parameters` as JSON: tuples are lists.
    origin: Origin

    def write(self, results: xr.Dataset, title: str, output: int | str = 0) -> None:
        """Write results with their origin and the meanings of their variables."""
        path = self.output[output]
        meanings = read_meanings(Path(path).stem)
        complete = describe_variables(results, meanings).assign_attrs(
            title=title,
            Conventions="CF-1.11",
            history=f"made by the hardcontact study: {title}",
            **self.origin.attributes(),
        )
        write_dataset(complete, path)

    def write_text(self, text: str, output: int | str = 0) -> None:
        """Write a text."""
        write_text_file(self.output[output], text)


@contextmanager
def run_job(snakemake: Any) -> Iterator[Job]:
    """Run the block of a script as a job: log it, yield its `Job`, keep records of its outputs.

    An input is refused if somebody changed it after a job had written it. The job also fails if an
    input changes while the block runs.
    """
    # Jobs make hardly any reference cycles; looking for them takes a twentieth of their time.
    gc.disable()
    try:
        with job_log(snakemake.log[0]):
            inputs = snakemake.input
            parameters_json = canonical_json(snakemake.params.parameters)
            input_digests = file_digests(inputs)
            refuse_edited_files(input_digests)
            for path in snakemake.output:  # Snakemake's lock keeps other runs from these files.
                remove_incomplete_files(path)
                remove_incomplete_files(record_path(path))
                record_path(path).unlink(missing_ok=True)  # It would describe the old file.
            code = getattr(inputs, "code", [])  # only rules with outputs have it
            origin = Origin(parameters_json, input_digests, list(code))
            yield Job(inputs, snakemake.output, json.loads(parameters_json), origin)
            if changed := changed_paths(input_digests):
                raise ValueError(
                    f"inputs changed while the job ran: {', '.join(changed)}; run again"
                )
            keep_records((path for path in snakemake.output if Path(path).is_file()), origin)
    finally:
        gc.enable()


@contextmanager
def job_log(path: str | Path) -> Iterator[None]:
    """Log a job. An error ends the job: the log has its traceback, stderr one line."""
    # If the log cannot be written, only the line on stderr is left.
    logging.raiseExceptions = False
    logging.lastResort = None
    try:
        handler = logging.FileHandler(path, mode="w", encoding="utf-8")
        handler.setFormatter(logging.Formatter("%(asctime)s %(message)s", "%H:%M:%S"))
        _logger.addHandler(handler)
        _logger.setLevel(logging.INFO)
        yield
    except Exception as error:
        _logger.error("failed\n%s", traceback.format_exc())
        message = " ".join(str(error).split()) or type(error).__name__
        has_log = Path(path).is_file() and Path(path).stat().st_size > 0
        line = f"error: {message} (see {path})" if has_log else f"error: {message}"
        print(line, file=sys.stderr, flush=True)
        os._exit(1)  # netCDF that could not write crashes when Python cleans up
    except KeyboardInterrupt:
        sys.exit(130)  # The run prints that it was stopped.
    else:
        _logger.removeHandler(handler)
        with suppress(OSError):  # the disk may be full
            handler.close()
