"""The profile for SLURM, on a cluster of this machine alone."""

import os
import re
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import pytest
import slurm
from comparison import differences
from refusals import assert_says
from repository import copy_repository

pytestmark = pytest.mark.system


class Fault(NamedTuple):
    """A fault of a job."""

    options: str  #: Words of the command that make the fault.
    reason: str  #: A part of SLURM's message.
    key: str  #: The key that mends the fault.
    variables: dict = {}  #: Environment of the command.


FAULTS = [
    Fault("--default-resources slurm_partition=nowhere", "Invalid partition", "slurm_partition"),
    Fault("--default-resources slurm_partition=members slurm_account=nobody", "Invalid account",
          "slurm_account"),
    Fault("--set-resources compute_filtered_forces:runtime=1", "DUE TO TIME LIMIT", "runtime",
          {"STEP_DELAY": "100"}),
    Fault("--set-resources compute_filtered_forces:mem_mb=60", "exceeded memory limit", "mem_mb"),
]  # fmt: skip


@pytest.fixture
def cluster(monkeypatch):
    """Run a SLURM on this machine."""
    folders = [str(Path(sys.executable).parent), os.environ["PATH"], "/usr/sbin", "/sbin"]
    monkeypatch.setenv("PATH", os.pathsep.join(folders))
    monkeypatch.setenv("SLURM_CONF", "")
    if reason := slurm.obstacle():
        pytest.skip(reason)
    with tempfile.TemporaryDirectory(prefix="slurm-") as name:
        folder = Path(name)
        folder.chmod(0o755)  # munged wants others to reach its socket
        with slurm.slurm(folder):
            yield


def test_a_job_that_slurm_refuses_or_ends_has_one_line_with_the_remedy(
    cluster, finished_copy, tmp_path
):
    filtered = [*(finished_copy / "results/store-tiny/filtered/band").rglob("*.nc")]
    runs = []
    for number, (fault, target) in enumerate(zip(FAULTS, filtered, strict=False)):
        target.unlink()
        words = [target.relative_to(finished_copy), *fault.options.split(), "--retries", "0"]
        # A run that ends removes empty folders of logs, in which others begin theirs.
        words += ["--slurm-logdir", tmp_path / f"logs-{number}"]
        log = tmp_path / f"{number}"
        runs.append(slurm.start_run(finished_copy, log, *words, **fault.variables))
    codes = [run.wait(slurm.RUN_SECONDS) for run in runs]
    assert codes == [1] * len(FAULTS)
    for number, fault in enumerate(FAULTS):
        text = (tmp_path / f"{number}").read_text()
        (line,) = [line for line in text.splitlines() if "compute_filtered_forces" in line]
        assert_says(line, "SLURM job cutoffs_compute_filtered_forces: ", fault.reason)
        assert_says(line, f"change {fault.key}")
        assert not re.search("sacct|Error|Traceback", text), text


def test_slurm_recovers_a_cancelled_job_and_gives_the_same_values(cluster, finished, tmp_path):
    """Forces on masters of one surface are computed as without SLURM."""
    filtered = (finished / "results/store-tiny/filtered/band").rglob("uncd/**/*.nc")
    targets = [path.relative_to(finished).as_posix() for path in filtered]
    study, log = copy_repository(tmp_path / "study"), tmp_path / "log"
    cancelled = slurm.run_and_cancel(study, log, targets)
    slurm.check_recovery(cancelled, log.read_text())
    lines = differences(study / "results", finished / "results")
    assert all((study / target).is_file() for target in targets)
    assert [line for line in lines if not line.endswith(": missing")] == []
