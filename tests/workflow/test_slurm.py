"""Cutoffs through SLURM give what they give without it, also if a job is cancelled.

`python tests/workflow/slurm.py` runs and compares the whole quick study.
"""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("slurm.py")


@pytest.mark.system
def test_slurm_recovers_a_cancelled_job_and_gives_the_same_values(finished):
    made = (finished / "results/store-quick/scales").rglob("uncd/**/*.nc")
    targets = [path.relative_to(finished).as_posix() for path in made]
    run = subprocess.run(
        [sys.executable, SCRIPT, "--reference", finished / "results", *targets],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if run.stdout.startswith("skipped"):
        pytest.skip(run.stdout.strip())
    assert run.returncode == 0, run.stdout
    assert "recovered" in run.stdout and "none differs" in run.stdout
