"""All processes that share the tests share each study, which is computed once."""

import fcntl
import os
import shutil
import tempfile
from pathlib import Path

import pytest


def shared_study(tmp_path_factory, compute):
    """Return a copy of a study for this process; the first process that asks computes the study.

    `compute` takes an empty folder, different in every run, and returns the folder of the study in
    it. Where it fails, whoever asks later fails with the same message, and nothing runs again.
    """
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent
    name = compute.__name__
    study, failure = shared / f"{name}-study", shared / f"{name}-failure.txt"
    with open(shared / f"{name}-lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if failure.exists():
            pytest.fail(failure.read_text("utf-8"), pytrace=False)
        if not study.exists():
            try:
                compute(Path(tempfile.mkdtemp(prefix=f"{name}-", dir=shared))).rename(study)
            except Exception as error:
                failure.write_text(f"{type(error).__name__}: {error}", "utf-8")
                raise
    return shutil.copytree(study, tmp_path_factory.mktemp(name) / "study")
