"""A whole small study ends bit-equal after twenty kills."""

import multiprocessing
import os
import shutil
import signal
import time

import pytest
from comparison import damaged, differences, paths
from forked_runs import call_main, run_program
from repository import environment

from hardcontact.base.whole_file import PART

KILLS = 20
#: Seconds that a test waits at most for the next file.
PATIENCE = 300
WORDS = ["--configfile", "config/probe.yaml", "few.yaml", "--config", "effort=quick"]
RESUME = ["--nolock", *WORDS]  # A killed run leaves Snakemake's lock.


@pytest.fixture
def empty(probe, tmp_path):
    """Copy the small study without its results."""
    ignored = shutil.ignore_patterns("results", ".snakemake")
    return shutil.copytree(probe.parents[1], tmp_path / "empty", ignore=ignored)


def kill_after_a_file(study):
    """Resume the study in a process group of its own; kill the group after one more file."""

    def run_as_group():
        os.setsid()
        words = ["--cores", "1", *RESUME]  # A second job would be repeated as well.
        with open(study / "output", "w") as output:
            call_main(study, "snakemake.cli", words, environment(study), output.fileno())

    count = len(paths(study / "results")) + 1
    run = multiprocessing.get_context("fork").Process(target=run_as_group)
    run.start()
    end = time.monotonic() + PATIENCE
    while run.is_alive() and len(paths(study / "results")) < count and time.monotonic() < end:
        time.sleep(0.05)  # looking costs a processor as well
    assert run.is_alive(), (study / "output").read_text()
    os.killpg(run.pid, signal.SIGKILL)
    run.join()
    assert "Traceback" not in (study / "output").read_text()


@pytest.mark.study
def test_a_study_that_is_killed_twenty_times_ends_as_one_that_is_not(empty, probe):
    (empty / "results").mkdir()
    for _ in range(KILLS):
        kill_after_a_file(empty)
        assert damaged(empty / "results") == []
    run = run_program(empty, "snakemake.cli", RESUME, environment(empty))
    assert run.returncode == 0, run.stdout
    assert differences(empty / "results", probe.parent) == []
    assert not list((empty / "results").rglob(f"{PART}*"))
