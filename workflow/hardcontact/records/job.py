"""One job of a rule: its log, its parameters, and whole files with their origin."""

import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from hardcontact.records import dataset as labelled
from hardcontact.records import log
from hardcontact.records.dataset import FileFormat
from hardcontact.records.origin import Origin, canonical, digests
from hardcontact.records.whole_file import whole_file


class Job(NamedTuple):
    """Inputs and parameters of a script, and the ways in which it writes its outputs.

    Attributes
    ----------
    input, output : named lists of paths
        As the rule names them.
    parameters : dict
        The rule's `params.canonical`, decoded.
    threads : int
        Number of threads that the job may use.
    origin : Origin
        What determines the files of the job.
    """

    input: Any
    output: Any
    parameters: dict[str, Any]
    threads: int
    origin: Origin

    def attributes(self, title: str) -> dict[str, str]:
        """Return the global attributes of a file that the job writes."""
        return {
            "title": title,
            "Conventions": "CF-1.11",
            "history": f"made by the hardcontact study: {title}",
            **self.origin.attributes(),
        }

    def write(
        self,
        dataset: xr.Dataset,
        title: str,
        output: int | str = 0,
        file_format: FileFormat = "NETCDF4",
    ) -> None:
        """Write a labelled dataset, with its origin, to an output by its place or name."""
        complete = dataset.assign_attrs(self.attributes(title))
        labelled.write(complete, self._path(output), file_format)

    def write_text(self, text: str, output: int | str = 0) -> None:
        """Write a text whole to an output by its place or name."""
        with whole_file(self._path(output)) as path:
            Path(path).write_text(text, "utf-8")

    def copy(self, source: str | Path, output: int | str = 0) -> None:
        """Copy a file, byte by byte, to an output by its place or name."""
        with whole_file(self._path(output)) as path:
            shutil.copyfile(source, path)

    def record(self, *outputs: int | str) -> None:
        """Write to the output `record` what determined outputs that have no attributes."""
        made = {"output_digests": digests(self._path(output) for output in outputs)}
        self.write_text(canonical(self.origin.attributes() | made), "record")

    def _path(self, output: int | str) -> str:
        return str(self.output[output])


@contextmanager
def job(snakemake: Any) -> Iterator[Job]:
    """Keep the log of a script and give it its `Job`.

    An error goes to the log in full and to stderr in one line, and ends the process.

    Parameters
    ----------
    snakemake : object
        The object of that name that Snakemake gives to every script.

    Yields
    ------
    Job
        Inputs, outputs and parameters.
    """
    with log.job_log(snakemake.log[0]):
        inputs, canonical_parameters = snakemake.input, snakemake.params.canonical
        code = getattr(inputs, "code", [])  # a rule that writes nothing names no code
        yield Job(
            inputs,
            snakemake.output,
            json.loads(canonical_parameters),
            snakemake.threads,
            Origin(canonical_parameters, list(inputs), list(code)),
        )
