"""How many jobs of which rule a change or a named target asks for, and what they make."""

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from paper_numbers import SUBSTRATES
from random_scans import levelled_scan
from repository import OTHERWISE, ROOT, run_snakemake
from rule_graph import (
    AGGREGATED,
    BEYOND,
    BEYOND_AT_RANGES,
    KEPT,
    MASTERS,
    OF_SPECTRA,
    POOLED,
    following,
)
from scan_files import container, scan

#: Scans of robustness: of each surface, and of the substitutes made otherwise.
VARIED_PAIRS = 2 * (len(SUBSTRATES) + len(OTHERWISE))
#: Masters of the sets and of robustness on one side: on either sphere, of the substitutes made
#: otherwise, and of the realizations that robustness does without.
VARIED = 2 * len(SUBSTRATES) + len(OTHERWISE) + 3 * len(SUBSTRATES)


def planned(folder, *overlays, targets=()):
    """Return what a dry run would make: (rule, output files) of each job."""
    run = run_snakemake(folder, "-n", *targets, overlays=overlays)
    assert run.returncode == 0, run.stdout
    return re.findall(
        r"^(?:local)?rule (\w+):\n(?:    input: .*\n)?    output: (.*)$", run.stdout, re.M
    )


def counts(jobs):
    """Return the number of jobs of each rule."""
    return Counter(rule for rule, _ in jobs)


def outputs(jobs, rule):
    """Return the output files of each job of a rule."""
    return [output for name, output in jobs if name == rule]


def after(*rules):
    """Return one job each: of these rules, what follows from them and what shows every value."""
    return dict.fromkeys(following({*rules} | KEPT), 1)


# What a change brings about


def test_a_second_run_has_nothing_to_do(finished):
    run = run_snakemake(finished, "-n")
    assert run.returncode == 0
    assert "Nothing to be done" in run.stdout
    assert planned(finished) == []


def test_one_more_cutoff(finished):
    cutoffs = ["43 nm", "80 nm", "120 nm", "500 nm"]
    jobs = planned(finished, {"scales": {"small": {"cutoffs": cutoffs}}})
    assert counts(jobs) == {
        "compute_filtered_pull_off": 2 * len(SUBSTRATES),
        **after("aggregate_scales", "compare_closed_form"),
    }
    filtered = outputs(jobs, "compute_filtered_pull_off")
    assert all(output.endswith("small/cutoff-80nm.nc") for output in filtered)


def test_a_range_that_scans_are_computed_at(finished):
    """Forces of scans are computed at the range of the masters too: here this adds none."""
    assert counts(planned(finished, {"scales": {"range": "3 nm"}})) == {
        "measure_window_change": 2 * len(SUBSTRATES),
        "compute_filtered_pull_off": 16 * len(SUBSTRATES),
        "vary_scales": 2 * VARIED,
        "compute_law_forces": 2 * len(SUBSTRATES),
        "filter_windows": len(SUBSTRATES),
        **after(
            "aggregate_adhesion",
            "aggregate_scales",
            "aggregate_robustness",
            "judge_sets",
            *BEYOND_AT_RANGES,
            "scale_edges",
            "try_scan_sizes",
        ),
    }


def test_one_more_realization(finished):
    jobs = planned(finished, {"scales": {"realizations": 3}})
    assert counts(jobs) == {
        "synthesize_small_scale_master": len(SUBSTRATES),
        "synthesize_large_scale_master": len(SUBSTRATES),
        "compute_filtered_pull_off": 8 * len(SUBSTRATES),
        **after("aggregate_scales", "judge_sets"),
    }
    assert all("realization-3" in output for _, output in jobs if "store-quick" in output)


def test_one_more_scan(finished):
    """The scans of a surface are conditioned together: all of them are made again.

    So is the fourth, which begins another group and on which the sets' last realization builds.
    """
    jobs = planned(finished, {"scans": [1, 2, 3]})
    surfaces = 5 + len(OTHERWISE)
    assert counts(jobs) == {
        "condition_scans": 5 + 2 * len(SUBSTRATES),  # those of the other curvature as well
        "synthesize_scan": 3 * surfaces + len(SUBSTRATES),
        "prepare_scan": 3 * surfaces + len(SUBSTRATES),
        **dict.fromkeys(POOLED, len(SUBSTRATES)),
        "measure_topography": 3 * 5,
        "compute_pull_off": 9 * len(SUBSTRATES),
        "measure_window_change": 3 * len(SUBSTRATES),
        "solve_elastic_contact": 3 * len(SUBSTRATES),
        "find_asperities": 3 * len(SUBSTRATES),
        "vary_adhesion": 3 * (len(SUBSTRATES) + len(OTHERWISE)),
        **dict.fromkeys(MASTERS, 2 * len(SUBSTRATES)),
        "compute_filtered_pull_off": 16 * len(SUBSTRATES),
        "vary_scales": 2 * VARIED,
        "compute_law_forces": 2 * len(SUBSTRATES),
        "repeat_contact": 2 * (len(SUBSTRATES) + 1),
        "estimate_elastic_limit": 3 * len(SUBSTRATES),
        "compute_scaled_pull_off": 4 * len(SUBSTRATES),  # of two scans, on either side
        **after(*AGGREGATED, "trace_contact", "measure_indents", *BEYOND - OF_SPECTRA),
    }


def test_another_preload(finished):
    assert counts(planned(finished, {"contact": {"preload": "12 uN"}})) == {
        "compute_pull_off": 4 * len(SUBSTRATES),
        "measure_window_change": 2 * len(SUBSTRATES),
        "compute_filtered_pull_off": 16 * len(SUBSTRATES),
        "solve_elastic_contact": 2 * len(SUBSTRATES),
        "find_asperities": 2 * len(SUBSTRATES),
        "vary_adhesion": VARIED_PAIRS,
        "vary_scales": 2 * VARIED,
        **dict.fromkeys(POOLED, len(SUBSTRATES)),
        "compute_law_forces": 2 * len(SUBSTRATES),
        "repeat_contact": 2 * len(SUBSTRATES),  # NCD at the preload of the image stays
        "estimate_elastic_limit": 2 * len(SUBSTRATES),
        "filter_windows": len(SUBSTRATES),
        **after(*AGGREGATED - {"aggregate_topography"}, "trace_contact", *BEYOND - {"map_forces"}),
    }


@pytest.mark.parametrize(
    ("values", "token"),
    [
        ({"contact": {"preload": "12 uN"}}, "F12uN"),
        ({"contact": {"hardness": "30 GPa"}}, "H30GPa"),
        ({"sphere": {"radius": "300 um"}}, "R300um"),
    ],
)
def test_two_studies_lie_side_by_side_and_share_masters(finished_copy, values, token):
    other = {"study": "second", **values}
    jobs = planned(finished_copy, other)
    assert not {"calibrate_spectrum", *MASTERS} & counts(jobs).keys()
    assert all(token in output for output in outputs(jobs, "compute_filtered_pull_off"))
    pair = outputs(jobs, "compute_pull_off")[0]
    run = run_snakemake(finished_copy, pair, "results/second/contact.nc", overlays=[other])
    assert run.returncode == 0, run.stdout
    assert token in pair and Path(finished_copy, pair).is_file()
    assert planned(finished_copy) == []  # going back computes nothing


#: Other texts in the rows of two measured scans, one after the other, and what reads them: their
#: heights, or the spectrum that all scans of a surface are joined into.
MEASURED = [
    ({"source": ["measured"] * 2, "path": ["mcd.zip"] * 2, "dataset": ["a", "b"]},
     {"prepare_scan", "measure_spectrum"}),
    ({"dataset": ["b", "a"]}, {"prepare_scan", "measure_spectrum"}),
    ({"tip_radius": ["50 nm", ""]}, {"measure_spectrum"}),
    ({"use": ["contact", "spectrum"]}, set()),
]  # fmt: skip


def test_what_the_table_says_of_measured_scans_reruns_what_reads_it(finished_copy):
    rng = np.random.default_rng(1)
    files = {
        f"{name}.nc": scan(
            finished_copy / f"{name}.nc",
            levelled_scan(rng, 128, 2500 / 128).heights,
            (2500.0, 2500.0),
        )
        for name in "ab"
    }
    entries = [{"name": name[0], "datafile": {"original": name}} for name in files]
    container(finished_copy / "mcd.zip", entries, files)
    path = finished_copy / "config/surfaces.tsv"
    table = pd.read_csv(path, sep="\t", dtype=str, na_filter=False)
    table = table[(table.surface != "mcd") | table.scan.isin(["1", "2"])]
    names = ("scans/mcd/study/scan-1-flat.nc", "spectra/mcd/study/measured-flat.nc")
    targets = [f"results/store-quick/{name}" for name in names]
    for texts, rules in MEASURED:
        for column, values in texts.items():
            table.loc[table.surface == "mcd", column] = values
        table.to_csv(path, sep="\t", index=False)
        assert counts(planned(finished_copy, targets=targets)) == dict.fromkeys(rules, 1)
        run = run_snakemake(finished_copy, *targets)
        assert run.returncode == 0, run.stdout
    assert planned(finished_copy, targets=targets) == []


def test_another_study_shares_intermediates(finished):
    jobs = planned(finished, {"study": "second"})
    assert counts(jobs) == after(*AGGREGATED, "trace_contact", "measure_indents", *BEYOND)
    assert all("results/second/" in output for _, output in jobs)


def test_other_hardnesses_of_robustness(finished):
    jobs = planned(finished, {"robustness": {"hardnesses": ["16 GPa"]}})
    assert counts(jobs) == {
        "vary_adhesion": VARIED_PAIRS,
        "vary_scales": 2 * (VARIED - len(SUBSTRATES)),  # the rough sphere bears one load alone
        **after("aggregate_robustness", "judge_sets"),  # sets draw masters that bear all loads
    }
    assert all("-smooth" in output for output in outputs(jobs, "vary_scales"))


def test_one_more_skewness_of_robustness(finished):
    """It concerns one surface, which keeps its spectrum and conditioning."""
    jobs = planned(finished, {"robustness": {"heights": {"skewness": [0.5, 0.3]}}})
    assert counts(jobs) == {
        "synthesize_scan": 2,
        "prepare_scan": 2,
        "vary_adhesion": 2,
        "vary_scales": 2,
        **after("aggregate_robustness"),
    }
    stored = [output for _, output in jobs if "store-quick" in output]
    assert len(stored) == 8
    assert all("/polished_uncd/skewness+0.3/" in output for output in stored)


def test_robustness_without_other_values_has_nothing_more_to_make(finished):
    none = {"heights": {"skewness": []}, "tip": {"radii": []}}
    jobs = planned(finished, {"robustness": {"preloads": [], "hardnesses": [], **none}})
    assert not [output for _, output in jobs if "skewness" in output or "tip-" in output]
    expected = {"vary_adhesion", "vary_scales", *after("aggregate_robustness")}
    assert counts(jobs).keys() >= expected


# Named targets

#: Another study, of which nothing is made.
ELSEWHERE = {"study": "elsewhere", "store": "results/store-elsewhere"}


@pytest.fixture(scope="module")
def of_the_crate(finished):
    """Return what a run makes before it describes the whole study for an archive."""
    return set(planned(finished, ELSEWHERE, targets=["crate"]))


@pytest.mark.parametrize(
    ("target", "last", "not_needed"),
    [
        ("topography", "aggregate_topography", "compute_pull_off"),
        ("adhesion", "aggregate_adhesion", "compute_filtered_pull_off"),
        ("scales", "aggregate_scales", "compute_pull_off"),
        ("elastic", "aggregate_elastic", "compute_pull_off"),
        ("plasticity", "measure_indents", "compute_pull_off"),
        ("asperities", "aggregate_asperities", "solve_elastic_contact"),
        ("sets", "judge_sets", "compute_filtered_pull_off"),
        ("robustness", "aggregate_robustness", "compute_filtered_pull_off"),
        ("classical", "apply_classical_models", "vary_scales"),
        ("claims", "evaluate_claims", "draw_fig1"),
        ("figures", "draw_fig6", "evaluate_claims"),
        ("pages", "describe_study", "vary_adhesion"),
        ("answer", "answer_paper", "describe_study"),
        ("insight", "answer_insight", "compute_pull_off"),
    ],
)
def test_named_target(finished, of_the_crate, target, last, not_needed):
    jobs = planned(finished, ELSEWHERE, targets=[target])
    assert counts(jobs)[last] == 1 and not counts(jobs)[not_needed]
    assert set(jobs) - {(target, "")} <= of_the_crate


# The study that all of this is planned on


def test_finished_study_is_the_repository_as_it_stands(finished):
    """What the fixture ran is what is tested here, not an older copy."""
    for path in ("Snakefile", "workflow/hardcontact/records/job.py", "config/config.yaml"):
        assert (finished / path).read_bytes() == (ROOT / path).read_bytes()
