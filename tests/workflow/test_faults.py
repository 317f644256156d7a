"""Damaged files and jobs that fail: one line that says what is wrong, and nothing lost."""

import os

import pytest
from comparison import differences
from faults import ALTERED, OF_ALTERED, alter, errors, others
from refusals import assert_says
from repository import run_snakemake
from scan_files import cut

pytestmark = pytest.mark.system

LOG = f"results/quick/logs/{ALTERED}.log"


# Damaged files


def test_deleted_results_are_made_again(finished_copy):
    deleted = {
        "figures/fig1.png": "draw_fig1",
        "indent.nc": "measure_indents",
        "claims.csv": "evaluate_claims",
        "answer.html": "answer_paper",
        "configuration.yaml": "keep_configuration",
    }
    for path in deleted:
        (finished_copy / "results/quick" / path).unlink()
    run = run_snakemake(finished_copy, "-n")
    for rule in deleted.values():
        assert f"\nrule {rule}:" in run.stdout, rule


@pytest.mark.parametrize(
    ("path", "targets"),
    [
        ("store-quick/scans/uncd/study/scan-1-flat.nc", ["topography"]),
        ("store-quick/masters/uncd/study/realization-1/small.nc", ["scales"]),
        ("quick/claims.csv", []),
        ("quick/figures/fig5.csv", []),
        ("quick/answer.html", []),
        ("quick/answer.json", []),
    ],
)
def test_a_truncated_file_is_deleted_and_made_again(finished_copy, finished, path, targets):
    truncated = cut(finished_copy / "results" / path, 0.7)
    run = run_snakemake(finished_copy, *targets)
    assert run.returncode != 0
    # Every job that reads the file says the same and names its own log.
    said = {error.partition(" (see ")[0] for error in errors(run.stdout)}
    assert len(said) == 1, run.stdout
    assert_says(said.pop(), f"results/{path}: expected the file that the study wrote, found")
    truncated.unlink()
    run = run_snakemake(finished_copy, *targets)
    assert run.returncode == 0, run.stdout
    # An intermediate from which nothing has to be made is not made again.
    lines = differences(finished_copy / "results", finished / "results")
    assert [line for line in lines if not line.endswith(".nc: missing")] == []


def test_a_flipped_bit_of_any_age_stops_the_job_that_reads_it(finished_copy):
    results = finished_copy / "results"
    paths = ["quick/adhesion.nc", "store-quick/masters/ncd/study/realization-1/large.nc"]
    for path in paths:
        before, content = (results / path).stat(), bytearray((results / path).read_bytes())
        content[len(content) * 2 // 3] ^= 1
        (results / path).write_bytes(content)
        os.utime(results / path, ns=(before.st_atime_ns, before.st_mtime_ns))
    (results / "quick/inference.nc").unlink()
    run = run_snakemake(finished_copy, "results/quick/inference.nc")
    (said,) = errors(run.stdout)
    assert_says(said, "results/quick/adhesion.nc: expected", "delete it and run again")
    verified = run_snakemake(finished_copy, "verify")
    for path in paths:
        assert f"results/{path}: is not the file that the study wrote" in verified.stdout


# Jobs that fail


FAILS_ONCE = """
from pathlib import Path
tried = Path("tried").exists()
Path("tried").touch()
if not tried:
    raise RuntimeError("fails once")
"""


def test_a_job_that_fails_once_is_tried_again(finished_copy, finished):
    alter(finished_copy, FAILS_ONCE)
    run = run_snakemake(finished_copy)
    assert run.returncode == 0, run.stdout
    assert errors(run.stdout) == [f"error: fails once (see {LOG})"]
    lines = differences(finished_copy / "results", finished / "results")
    assert others(lines, *OF_ALTERED) == []


def test_a_job_that_always_fails_lets_the_others_finish(finished_copy, finished):
    alter(finished_copy, 'raise RuntimeError("fails always")')
    other = "results/quick/figures/fig5.png"
    (finished_copy / other).unlink()
    run = run_snakemake(finished_copy, "--cores", "1")
    assert run.returncode == 1
    assert errors(run.stdout) == [f"error: fails always (see {LOG})"]
    assert_says(run.stdout, f"Error in rule {ALTERED}:")
    assert_says((finished_copy / LOG).read_text(), "Traceback", "RuntimeError: fails always")
    assert (finished_copy / other).read_bytes() == (finished / other).read_bytes()
