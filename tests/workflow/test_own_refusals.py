"""Studies of own surfaces that are refused or left out, with a reason; nothing is written."""

import pytest
import yaml
from own_studies import LEFT_OUT, changed, new, quick, rough, spm
from refusals import assert_says
from scan_files import cut

from hardcontact.base.random import generator
from hardcontact.config.configuration import NONE, omitted_targets

pytestmark = pytest.mark.study


def errors(run):
    """Return the lines of the refusal of a run."""
    assert run.returncode != 0 and "Traceback" not in run.stdout, run.stdout
    return [line for line in run.stdout.splitlines() if line.startswith("error:")]


def files_of(folder):
    """Return the files of a study, without what Snakemake keeps for itself."""
    return {path for path in folder.rglob("*") if ".snakemake" not in path.parts}


def test_targets_left_out_say_why(folder, probe):
    targets = sorted(LEFT_OUT | {"fit"})
    run = quick(folder, "probe", *targets, "-n")
    assert run.returncode == 0
    reasons = omitted_targets({"published": NONE, "forces": NONE})
    for target in targets:
        assert f"{target} is left out: {reasons[target]}" in run.stdout


def test_a_study_is_not_overwritten(folder, probe):
    files_before = (folder / "config/probe.yaml").read_bytes()
    done = new(folder, "probe", "scans/probe.001")
    assert done.returncode == 1 and "--overwrite" in done.stderr
    assert (folder / "config/probe.yaml").read_bytes() == files_before


def test_several_faults_are_told_at_once_and_nothing_is_written(folder, probe):
    (folder / "scans/broken.001").write_text("no scan")
    cut(spm(folder / "scans/short.001", rough(generator(7)), 2500.0), 0.6)
    (folder / "unitless.csv").write_text("surface,value,unit\nmine,1,\n")
    files_before = files_of(folder)
    done = new(
        folder, "mine", "scans/broken.001", "scans/short.001", "none.001", "scans/probe.001",
        "--preload", "10", "--radius", "3 N", "--forces", "unitless.csv",
    )  # fmt: skip
    assert done.returncode == 1 and not done.stdout
    lines = done.stderr.splitlines()
    messages = ["--preload", "--radius", "broken.001", "short.001", "none.001", "unitless.csv"]
    assert all(line.startswith("error: ") and ": expected " in line for line in lines)
    assert all(any(message in line for line in lines) for message in messages)
    assert files_of(folder) == files_before


@pytest.mark.parametrize(
    ("change", "message_parts"),
    [
        (
            {"contact": {"preload": 10}, "quick": {"scales": {"rang": "1 nm"}}},
            ["config key contact.preload", "a force with a unit", "found 10"],
        ),
        ({"contact": {"preload": "1 N"}}, ["contact.preload", "at most 1.37 mN", "found 1 N"]),
        ({"forces": "unitless.csv"}, ["unitless.csv: line 2: expected a force with a unit"]),
    ],
)
def test_a_bad_overlay_is_refused_in_the_users_units(folder, probe, change, message_parts):
    (folder / "unitless.csv").write_text("surface,value,unit\nprobe,1,\n")
    (folder / "bad.yaml").write_text(yaml.safe_dump(change))
    files_before = files_of(folder)
    assert_says(" ".join(errors(quick(folder, "probe", overlays=["bad.yaml"]))), *message_parts)
    assert files_of(folder) == files_before


def test_a_scan_that_is_gone_is_named(folder, probe):
    table = folder / "config/probe.tsv"
    with changed(table, table.read_text().replace("probe.001", "gone.001")):
        (line,) = errors(quick(folder, "probe"))
    assert_says(line, "config/probe.tsv: line 2", "scans/gone.001", "no such file")
