"""Tests that take long: real scans, and a cluster on this machine."""

import os
import re
import sys
import tempfile
from pathlib import Path

import pytest
import slurm
import xarray as xr
from comparison import differences
from own_studies import REAL_SCANS, make_study, read_answer, read_quantities
from refusals import assert_says
from repository import copy_repository

pytestmark = pytest.mark.system


#: A fault of a job: options and variables of the command, a part of SLURM's message, and the key
#: that mends it.
FAULTS = [
    ("--default-resources slurm_partition=nowhere", {}, "Invalid partition", "slurm_partition"),
    ("--default-resources slurm_partition=members slurm_account=nobody", {}, "Invalid account",
     "slurm_account"),
    ("--set-resources compute_filtered_forces:runtime=1", {"STEP_DELAY": "100"},
     "DUE TO TIME LIMIT", "runtime"),
    ("--set-resources compute_filtered_forces:mem_mb=60", {}, "exceeded memory limit", "mem_mb"),
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
        words = [target.relative_to(finished_copy), *fault[0].split(), "--retries", "0"]
        # A run that ends removes empty folders of logs, in which others begin theirs.
        words += ["--slurm-logdir", tmp_path / f"logs-{number}"]
        runs.append(slurm.start_run(finished_copy, tmp_path / f"{number}", *words, **fault[1]))
    codes = [run.wait(slurm.RUN_SECONDS) for run in runs]
    assert codes == [1] * len(FAULTS)
    for number, (_, _, reason, key) in enumerate(FAULTS):
        text = (tmp_path / f"{number}").read_text()
        (line,) = [line for line in text.splitlines() if "compute_filtered_forces" in line]
        assert_says(line, "SLURM job cutoffs_compute_filtered_forces: ", reason, f"change {key}")
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


@pytest.mark.skipif(not REAL_SCANS.is_dir(), reason=f"no real scans in {REAL_SCANS}")
def test_real_scans_give_plausible_roughness_edges_and_forces(repository):
    files = [REAL_SCANS / name for name in ("uncd-demo-container.zip", "afm-10um-512.di")]
    results = make_study(repository, "both", *files)
    surface = read_quantities(results)["both"]
    assert surface["scan_size"]["value"] == 10_000.0
    assert 14.2 < surface["scan_1_rms_height"]["value"] < 14.4
    assert set(xr.load_dataset(results / "spectra.nc")["kind"].values.ravel()) == {
        "map",
        "line scan",
    }
    mean = surface["mean_force"]
    assert mean["low"] < mean["value"] < mean["high"]
    assert 20 < surface["short_edge"]["value"] < 100
    cautions = {note["code"] for note in read_answer(results)["notes"] if note["kind"] == "caution"}
    assert "conditional_intervals" in cautions
    assert surface["force_extrapolated_short"]["value"] < 0.7 * mean["value"]
