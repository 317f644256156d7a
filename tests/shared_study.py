"""All processes that share the tests share one study, which is computed once."""

import fcntl
import tempfile
from pathlib import Path

import pytest


def shared_study(shared, compute):
    """Return the folder of the study in `shared`; the first process that asks computes it.

    `compute` takes an empty folder, different in every run, and returns the folder of the study in
    it. Where it fails, whoever asks later fails with the same message, and nothing runs again.
    """
    study, failure = shared / "study", shared / "failure.txt"
    with open(shared / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if failure.exists():
            pytest.fail(failure.read_text("utf-8"), pytrace=False)
        if not study.exists():
            try:
                compute(Path(tempfile.mkdtemp(prefix="running-", dir=shared))).rename(study)
            except Exception as error:
                failure.write_text(f"{type(error).__name__}: {error}", "utf-8")
                raise
    return study
