"""A job writes complete files with a record of their origin, and keeps its log."""

import json
import logging
import os
import subprocess
import sys
from types import SimpleNamespace

import pytest
import xarray as xr
from refusals import assert_says
from repository import ROOT, environment

from hardcontact.base.dataset import read_dataset
from hardcontact.records.job import run_job
from hardcontact.records.origin import file_digest, read_record

PARAMETERS = {"surface": "uncd", "range": 5.6}


class Named(list):
    """A list with names for some of its entries, as Snakemake gives it."""

    def __init__(self, **entries):
        super().__init__()
        for name, entry in entries.items():
            setattr(self, name, entry)
            self.extend(entry if isinstance(entry, list) else [entry])

    def __getitem__(self, key):
        return getattr(self, key) if isinstance(key, str) else super().__getitem__(key)


@pytest.fixture
def snakemake(tmp_path, monkeypatch):
    """Return the object that Snakemake passes to a script: a scan, code and two outputs."""
    monkeypatch.chdir(tmp_path)
    for name in ("scan.txt", "script.py"):
        (tmp_path / name).write_text(name)
    return SimpleNamespace(
        input=Named(scan="scan.txt", code=["script.py"]),
        output=Named(data="made/data.nc", text="made/text.txt"),
        params=SimpleNamespace(parameters=PARAMETERS),
        log=["a.log"],
    )


def test_every_file_has_a_record_and_a_dataset_its_origin(snakemake, tmp_path):
    with run_job(snakemake) as job:
        job.write(xr.Dataset({"a": ("x", [1.0])}, attrs={"source": "measured"}), "a title", "data")
        job.write_text("µ\n", "text")
    written = read_dataset("made/data.nc")
    assert written.a.values.tolist() == [1.0] and written.attrs["source"] == "measured"
    assert written.attrs["title"] == "a title" and written.attrs["Conventions"].startswith("CF-")
    assert json.loads(written.attrs["parameters"]) == PARAMETERS
    assert json.loads(written.attrs["input_digests"]).keys() == {"scan.txt", "script.py"}
    assert len(written.attrs["code_digest"]) == 64
    assert (tmp_path / "made/text.txt").read_bytes() == "µ\n".encode()
    for path in snakemake.output:
        record = read_record(path)
        assert record.sha256 == file_digest(path)
        assert record.input_digests.keys() == {"scan.txt", "script.py"}
        assert record.parameters == PARAMETERS


@pytest.fixture
def errors(monkeypatch, capsys):
    """Return a function that returns what failed jobs printed; jobs do not end the process."""
    monkeypatch.setattr(os, "_exit", sys.exit)
    logger = logging.getLogger("hardcontact")
    monkeypatch.setattr(logger, "handlers", [])
    yield lambda: capsys.readouterr().err
    for handler in logger.handlers:
        handler.close()


def test_a_changed_input_stops_the_job(snakemake, tmp_path, errors):
    with run_job(snakemake) as job:
        job.write_text("made", "text")
    snakemake.input, snakemake.output = Named(text="made/text.txt"), Named(data="made/data.nc")
    (tmp_path / "made/text.txt").write_text("edited")
    with pytest.raises(SystemExit), run_job(snakemake):
        pytest.fail("computed with a changed input")
    assert_says(errors(), "error: made/text.txt: expected", "delete it")


@pytest.mark.parametrize("path", ["scan.txt", "script.py"])
def test_an_input_that_changes_while_the_job_runs_fails_it(snakemake, tmp_path, errors, path):
    with pytest.raises(SystemExit), run_job(snakemake) as job:
        job.write_text("made", "text")
        (tmp_path / path).write_text("another")
    assert_says(errors(), "error: inputs changed while the job ran", path)
    assert read_record("made/text.txt") is None


def test_a_record_is_removed_before_its_file_is_replaced(snakemake):
    """So a job that is killed leaves no record of the earlier file."""
    for text in ("first", "second"):
        with run_job(snakemake) as job:
            assert read_record("made/text.txt") is None
            job.write_text(text, "text")


@pytest.mark.parametrize(
    ("block", "path", "code", "message"),
    [
        ("raise ValueError('a\\n b')", "a.log", 1, "error: a b (see a.log)\n"),
        ("raise KeyboardInterrupt", "a.log", 130, ""),
        ("pass", "none/a.log", 1, "error: [Errno 2] No such file or directory: 'none/a.log'\n"),
    ],
)
def test_an_error_is_one_line_that_names_the_log(tmp_path, block, path, code, message):
    program = f"from hardcontact.records.job import job_log\nwith job_log({path!r}):\n    {block}\n"
    run = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path, env=environment(ROOT), capture_output=True, text=True,
    )  # fmt: skip
    assert (run.returncode, run.stdout) == (code, "")
    assert run.stderr.replace(str(tmp_path) + "/", "") == message
    if "ValueError" in block:
        text = (tmp_path / "a.log").read_text()
        assert "Traceback" in text and "ValueError: a\n b" in text
