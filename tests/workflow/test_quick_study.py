"""The quick study finds what the full study finds, within its own, wider intervals."""

import pytest
from full_study import read_full_study, study_numbers
from repository import copy_repository, run_snakemake

pytestmark = pytest.mark.system


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """Run the quick study of README; return its numbers."""
    study = copy_repository(tmp_path_factory.mktemp("quick") / "study")
    run = run_snakemake(study, "--configfile", "config/quick.yaml")
    assert run.returncode == 0, run.stdout[-3000:]
    return study_numbers(study / "results/quick")


def test_its_intervals_contain_the_numbers_of_the_full_study(quick):
    full = read_full_study().loc[quick.index]
    # An open end has no number.
    is_missed = (full["value"] < quick["low"]) | (quick["high"] < full["value"])
    assert not is_missed.any(), quick.join(full.add_suffix("_full"))[is_missed].to_string()


def test_no_verdict_contradicts_that_of_the_full_study(quick):
    verdicts = quick.join(read_full_study().add_suffix("_full"))[["verdict", "verdict_full"]]
    judged_verdicts = verdicts[verdicts.isin(["reproduced", "not reproduced"]).all(axis=1)]
    assert (judged_verdicts["verdict"] == judged_verdicts["verdict_full"]).all(), (
        judged_verdicts.to_string()
    )
