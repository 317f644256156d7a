"""A small study ends bit-equal after four kills, and stops at the lock of another run."""

import multiprocessing
import os
import shutil
import signal
import time

import pytest
from comparison import damaged_datasets, differences, result_paths
from forked_runs import call_main, use_library_of
from refusals import assert_says
from repository import environment, run_snakemake

from hardcontact.base.dataset import PART

pytestmark = pytest.mark.study

#: Kills of one study.
KILLS = 4
#: Files that a run may write before a kill: in all, most files of the study.
FILES = 5
#: Seconds that a test waits at most for the next file.
PATIENCE = 300
STUDY_WORDS = ["--configfile", "config/probe.yaml", "few.yaml", "--config", "effort=quick"]
RESUME = ["--nolock", *STUDY_WORDS]  # A killed run leaves Snakemake's lock.


@pytest.fixture
def empty(probe, tmp_path):
    """Copy the small study without its results."""
    ignored = shutil.ignore_patterns("results", ".snakemake")
    return shutil.copytree(probe.parents[1], tmp_path / "empty", ignore=ignored)


def differences_from(probe, results):
    """Return the differences from the study that was left alone."""
    return [
        line
        for folder in (probe, probe.with_name(f"store-{probe.name}"))
        for line in differences(results / folder.name, folder)
    ]


def kill_after_files(study):
    """Resume the study in a process group of its own; kill the group after FILES more."""

    def run_as_group():
        os.setsid()
        use_library_of(study)
        words = ["--cores", "1", *RESUME]  # A second job would be repeated as well.
        with open(study / "output", "w") as output:
            call_main("snakemake.cli", words, environment(study), output.fileno())

    count = len(result_paths(study / "results")) + FILES
    run = multiprocessing.get_context("fork").Process(target=run_as_group)
    run.start()
    end = time.monotonic() + PATIENCE
    while (
        run.is_alive() and len(result_paths(study / "results")) < count and time.monotonic() < end
    ):
        time.sleep(0.05)  # looking costs a processor as well
    assert run.is_alive(), (study / "output").read_text()
    os.killpg(run.pid, signal.SIGKILL)
    run.join()
    assert "Traceback" not in (study / "output").read_text()


def test_a_study_that_is_killed_four_times_ends_as_one_that_is_not(empty, probe):
    (empty / "results").mkdir()
    for _ in range(KILLS):
        kill_after_files(empty)
        assert damaged_datasets(empty / "results") == []
    run = run_snakemake(empty, *RESUME)
    assert run.returncode == 0, run.stdout
    assert differences_from(probe, empty / "results") == []
    assert not list((empty / "results").rglob(f"{PART}*"))


def test_a_run_stops_at_the_lock_of_another_until_it_is_removed(probe):
    folder = probe.parents[1]
    lock = folder / ".snakemake/locks/0.output.lock"
    lock.parent.mkdir(exist_ok=True)
    lock.write_text(f"{probe.relative_to(folder) / 'answer.json'}\n")
    locked = run_snakemake(folder, "answer", *STUDY_WORDS)
    assert locked.returncode == 1
    assert_says(locked.stdout, "cannot be locked", "--unlock")
    assert run_snakemake(folder, "--unlock", "answer", *STUDY_WORDS).returncode == 0
    assert not lock.exists()
