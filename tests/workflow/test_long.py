"""What takes long, or installs something: real scans, and a cluster of this machine."""

import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr
from own_studies import SHARED, made, quantities

pytestmark = pytest.mark.system


def test_slurm_recovers_a_cancelled_job_and_gives_the_same_values(finished):
    """`python tests/workflow/slurm.py` runs and compares the whole quick study."""
    stored = (finished / "results/store-quick/scales").rglob("uncd/**/*.nc")
    targets = [path.relative_to(finished).as_posix() for path in stored]
    script = Path(__file__).with_name("slurm.py")
    run = subprocess.run(
        [sys.executable, script, "--reference", finished / "results", *targets],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if run.stdout.startswith("skipped"):
        pytest.skip(run.stdout.strip())
    assert run.returncode == 0, run.stdout
    assert "recovered" in run.stdout and "none differs" in run.stdout


@pytest.mark.skipif(not SHARED.is_dir(), reason=f"no real scans in {SHARED}")
def test_real_scans(folder):
    files = [SHARED / name for name in ("uncd-demo-container.zip", "afm-10um-512.di")]
    results, _ = made(folder, "both", *files)
    surface = quantities(results)["both"]
    assert surface["scan_size"]["value"] == 10_000.0
    assert 14.2 < surface["scan_1_rms_height"]["value"] < 14.4
    assert set(xr.load_dataset(results / "spectra.nc")["kind"].values.ravel()) == {"map", "profile"}
    mean = surface["force_mean"]
    assert mean["low"] < mean["value"] < mean["high"]
    assert 20 < surface["short_edge"]["value"] < 100
    cautions = {row["status"] for name, row in surface.items() if name.startswith("caution")}
    assert "conditional" in cautions
    assert surface["force_continued_small"]["value"] < 0.7 * mean["value"]
