"""A run stops at the lock of another."""

import pytest
from refusals import assert_says
from repository import run_snakemake

pytestmark = pytest.mark.study


def test_a_run_stops_at_the_lock_of_another_until_it_is_removed(probe):
    folder = probe.parents[1]
    lock = folder / ".snakemake/locks/0.output.lock"
    lock.parent.mkdir(exist_ok=True)
    lock.write_text(f"{probe.relative_to(folder) / 'answer.json'}\n")
    words = ["answer", "--configfile", "config/probe.yaml", "few.yaml", "--config", "effort=quick"]
    locked = run_snakemake(folder, *words)
    assert locked.returncode == 1
    assert_says(locked.stdout, "cannot be locked", "--unlock")
    words.insert(0, "--unlock")
    assert run_snakemake(folder, *words).returncode == 0
    assert not lock.exists()
