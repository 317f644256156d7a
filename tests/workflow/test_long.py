"""Tests that take long or install something: real scans, and a cluster on this machine."""

import os
import sys
import tempfile
from pathlib import Path

import pytest
import slurm
import xarray as xr
from comparison import differences
from own_studies import SHARED, make_study, numbers, quantities
from repository import copy_repository

pytestmark = pytest.mark.system


def test_slurm_recovers_a_cancelled_job_and_gives_the_same_values(finished, tmp_path, monkeypatch):
    """Forces on masters of one surface are computed as without SLURM."""
    folders = [str(Path(sys.executable).parent), os.environ["PATH"], "/usr/sbin", "/sbin"]
    monkeypatch.setenv("PATH", os.pathsep.join(folders))
    monkeypatch.setenv("SLURM_CONF", "")
    if reason := slurm.obstacle():
        pytest.skip(reason)
    filtered = (finished / "results/store-tiny/filtered/scales").rglob("uncd/**/*.nc")
    targets = [path.relative_to(finished).as_posix() for path in filtered]
    study, log = copy_repository(tmp_path / "study"), tmp_path / "log"
    with tempfile.TemporaryDirectory(prefix="slurm-") as folder:
        cluster = Path(folder)
        cluster.chmod(0o755)  # munged wants others to reach its socket
        with slurm.slurm(cluster):
            cancelled = slurm.run_and_cancel(study, log, targets)
            slurm.check_recovery(cancelled, log.read_text())
    lines = differences(study / "results", finished / "results")
    assert all((study / target).is_file() for target in targets)
    assert [line for line in lines if not line.endswith(": missing")] == []


@pytest.mark.skipif(not SHARED.is_dir(), reason=f"no real scans in {SHARED}")
def test_real_scans_give_plausible_roughness_edges_and_forces(folder):
    files = [SHARED / name for name in ("uncd-demo-container.zip", "afm-10um-512.di")]
    results = make_study(folder, "both", *files)
    surface = quantities(results)["both"]
    assert surface["scan_size"]["value"] == 10_000.0
    assert 14.2 < surface["scan_1_rms_height"]["value"] < 14.4
    assert set(xr.load_dataset(results / "spectra.nc")["kind"].values.ravel()) == {
        "map",
        "line scan",
    }
    mean = surface["force_mean"]
    assert mean["low"] < mean["value"] < mean["high"]
    assert 20 < surface["short_edge"]["value"] < 100
    cautions = {note["code"] for note in numbers(results)["notes"] if note["kind"] == "caution"}
    assert "conditional_intervals" in cautions
    assert surface["force_extrapolated_small"]["value"] < 0.7 * mean["value"]
