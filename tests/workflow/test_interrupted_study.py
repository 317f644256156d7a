"""A small study ends bit-equal after two kills, once the lock of the first is removed."""

import multiprocessing
import os
import shutil
import signal
import time

import pytest
from comparison import damaged_datasets, differences, result_paths
from forked_runs import call_main, fork_jobs, load_job_packages, use_library_of
from refusals import assert_says
from repository import environment, run_snakemake, run_snakemake_with_forks

from hardcontact.base.atomic_file import INCOMPLETE_PREFIX

pytestmark = pytest.mark.study

#: Files that a run may write before a kill: in all, most files of the study.
FILES = 10
#: Seconds that a test waits at most for the next file.
PATIENCE = 300
STUDY_WORDS = ["--configfile", "config/probe.yaml", "few.yaml", "--config", "effort=quick"]


def differences_from(probe, results):
    """Return the differences of results from the probe's, whose study was not killed."""
    return [
        line
        for folder in (probe, probe.with_name(f"store-{probe.name}"))
        for line in differences(results / folder.name, folder)
    ]


def kill_after_files(study, *options):
    """Resume the study in a process group of its own; kill the group after FILES more."""

    def run_as_group():
        os.setsid()
        use_library_of(study)
        fork_jobs()
        words = ["--cores", "1", *options, *STUDY_WORDS]  # A second job would be repeated, too.
        with open(study / "output", "w") as output:
            call_main("snakemake.cli", words, environment(study), output.fileno())

    load_job_packages()
    file_count = len(result_paths(study / "results")) + FILES
    run = multiprocessing.get_context("fork").Process(target=run_as_group)
    run.start()
    end = time.monotonic() + PATIENCE
    while (
        run.is_alive()
        and len(result_paths(study / "results")) < file_count
        and time.monotonic() < end
    ):
        time.sleep(0.05)  # looking costs a processor as well
    assert run.is_alive(), (study / "output").read_text()
    os.killpg(run.pid, signal.SIGKILL)
    run.join()
    assert "Traceback" not in (study / "output").read_text()


def test_a_study_that_is_killed_twice_ends_as_one_that_is_not(probe, tmp_path):
    ignored = shutil.ignore_patterns("results", ".snakemake")
    empty = shutil.copytree(probe.parents[1], tmp_path / "empty", ignore=ignored)
    (empty / "results").mkdir()
    for options in ([], ["--nolock"]):  # The first kill leaves Snakemake's lock.
        kill_after_files(empty, *options)
        assert damaged_datasets(empty / "results") == []
    locked = run_snakemake(empty, *STUDY_WORDS)
    assert locked.returncode == 1
    assert_says(locked.stdout, "cannot be locked", "--unlock")
    assert run_snakemake(empty, "--unlock", *STUDY_WORDS).returncode == 0
    run = run_snakemake_with_forks(empty, *STUDY_WORDS)
    assert run.returncode == 0, run.stdout
    assert differences_from(probe, empty / "results") == []
    assert not list((empty / "results").rglob(f"{INCOMPLETE_PREFIX}*"))
