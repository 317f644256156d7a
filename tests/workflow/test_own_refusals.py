"""Studies of own surfaces that are refused, with a reason; nothing is written."""

import pytest
import yaml
from own_studies import quick
from refusals import assert_says
from repository import snakemake

pytestmark = pytest.mark.study


def errors(run):
    """Return the lines of the refusal of a run."""
    assert run.returncode != 0 and "Traceback" not in run.stdout, run.stdout
    return [line for line in run.stdout.splitlines() if line.startswith("error:")]


def files_of(folder):
    """Return the files of a study, without what Snakemake keeps for itself."""
    return {path for path in folder.rglob("*") if ".snakemake" not in path.parts}


def test_a_faulty_overlay_is_refused_in_one_line_and_nothing_is_written(probe):
    folder = probe.parents[1]
    overlay = {"contact": {"preload": 10}, "quick": {"scales": {"rang": "1 nm"}}}
    (folder / "bad.yaml").write_text(yaml.safe_dump(overlay))
    files_before = files_of(folder)
    lines = errors(quick(folder, "probe", overlays=["bad.yaml"]))
    assert_says(lines[0], "config key contact.preload", "a force with a unit", "found 10")
    assert files_of(folder) == files_before


def test_a_run_stops_at_the_lock_of_another_until_it_is_removed(probe):
    folder = probe.parents[1]
    lock = folder / ".snakemake/locks/0.output.lock"
    lock.parent.mkdir(exist_ok=True)
    lock.write_text(f"{probe.relative_to(folder) / 'answer.json'}\n")
    words = ["answer", "--configfile", "config/probe.yaml", "few.yaml", "--config", "effort=quick"]
    locked = snakemake(folder, *words)
    assert locked.returncode == 1
    assert_says(locked.stdout, "cannot be locked", "--unlock")
    words.insert(0, "--unlock")
    assert snakemake(folder, *words).returncode == 0
    assert not lock.exists()
