"""The graph of jobs: what a change reruns; the texts of the rules, the schema, the README."""

import re
from collections import Counter
from pathlib import Path

import pandas as pd
import pytest
import yaml
from conftest import (
    OTHERWISE,
    PAPER,
    QUICK,
    ROOT,
    ROWS,
    SCHEMAS,
    container,
    heights,
    leaves,
    run_snakemake,
    scan,
)
from paper_numbers import SUBSTRATES


def planned(folder, *overlays, targets=()):
    """What a dry run would make: (rule, output files) of each job."""
    run = run_snakemake(folder, "-n", *targets, overlays=overlays)
    assert run.returncode == 0, run.stdout
    return re.findall(
        r"^(?:local)?rule (\w+):\n(?:    input: .*\n)?    output: (.*)$", run.stdout, re.M
    )


def counts(jobs):
    return Counter(rule for rule, _ in jobs)


def outputs(jobs, rule):
    return [output for name, output in jobs if name == rule]


SIZES = ("small", "large")


# What a change brings about


def test_a_second_run_has_nothing_to_do(finished):
    run = run_snakemake(finished, "-n")
    assert run.returncode == 0
    assert "Nothing to be done" in run.stdout
    assert planned(finished) == []


def once(*rules):
    return dict.fromkeys(rules, 1)


#: What follows from claims.csv, and from another value of any key: verdicts and parameters.
PAGES = once("describe_study", "keep_configuration", "describe_crate")
AFTER_INFERENCE = PAGES | once(
    "infer",
    "apply_classical_models",
    "evaluate_claims",
    "draw_fig3",
    "draw_fig4",
    "draw_fig6",
    "draw_fig_classical",
    "draw_fig_asperities",
    "draw_fig_robustness",
)
AFTER_SCALES = AFTER_INFERENCE | once("aggregate_scales")
AFTER_TOPOGRAPHY = once("aggregate_topography", "draw_fig1", "draw_table1")
AFTER_ELASTIC = PAGES | once("aggregate_elastic", "draw_fig_elastic", "evaluate_claims")
AFTER_INDENTS = PAGES | once("measure_indents", "draw_fig5", "evaluate_claims")
AFTER_ASPERITIES = PAGES | once("aggregate_asperities", "draw_fig_asperities", "evaluate_claims")
AFTER_VARIANTS = PAGES | once("aggregate_robustness", "draw_fig_robustness")

#: Pairs of robustness: of each surface, and of the substitutes made otherwise.
VARIED_PAIRS = 4 * (len(SUBSTRATES) + len(OTHERWISE))
#: Masters of robustness on one side: on either sphere, and of the substitutes made otherwise.
VARIED = 2 * len(SUBSTRATES) + len(OTHERWISE)


def test_one_more_cutoff(finished):
    cutoffs = ["43 nm", "80 nm", "120 nm", "500 nm"]
    jobs = planned(finished, {"scales": {"small": {"cutoffs": cutoffs}}})
    assert counts(jobs) == {
        "compute_filtered_pull_off": 2 * len(SUBSTRATES),
        **AFTER_SCALES,
    }
    filtered = outputs(jobs, "compute_filtered_pull_off")
    assert all(output.endswith("small/cutoff-80nm.nc") for output in filtered)


def test_one_more_realization(finished):
    jobs = planned(finished, {"scales": {"realizations": 3}})
    assert counts(jobs) == {
        "synthesize_small_scale_master": len(SUBSTRATES),
        "synthesize_large_scale_master": len(SUBSTRATES),
        "compute_filtered_pull_off": 8 * len(SUBSTRATES),
        **AFTER_SCALES,
    }
    assert all("realization-3" in output for _, output in jobs if "store-quick" in output)


def test_one_more_scan(finished):
    jobs = planned(finished, {"scans": [1, 2, 3]})
    assert counts(jobs) == {
        "synthesize_scan": 5 + len(OTHERWISE),
        "prepare_scan": 5 + len(OTHERWISE),
        "measure_topography": 5,
        "compute_pull_off": len(SUBSTRATES) * (9 - 4),
        "solve_elastic_contact": len(SUBSTRATES),
        "find_asperities": len(SUBSTRATES),
        "vary_adhesion": (9 - 4) * (len(SUBSTRATES) + len(OTHERWISE)),
        "aggregate_adhesion": 1,
        **AFTER_TOPOGRAPHY,
        **AFTER_ELASTIC,
        **AFTER_INDENTS,
        **AFTER_ASPERITIES,
        **AFTER_INFERENCE,
        **AFTER_VARIANTS,
    }
    rules = {
        "synthesize_scan", "prepare_scan", "solve_elastic_contact", "find_asperities",
        "compute_pull_off", "vary_adhesion",
    }  # fmt: skip
    assert all("scan-3" in output for rule in rules for output in outputs(jobs, rule))


def test_another_preload(finished):
    assert counts(planned(finished, {"contact": {"preload": "12 uN"}})) == {
        "compute_pull_off": 4 * len(SUBSTRATES),
        "compute_filtered_pull_off": 16 * len(SUBSTRATES),
        "solve_elastic_contact": 2 * len(SUBSTRATES),
        "find_asperities": 2 * len(SUBSTRATES),
        "vary_adhesion": VARIED_PAIRS,
        "vary_scales": 2 * VARIED,
        "aggregate_adhesion": 1,
        "trace_contact": 1,
        **AFTER_SCALES,
        **AFTER_ELASTIC,
        **AFTER_ASPERITIES,
        **AFTER_VARIANTS,
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
    shared = {"calibrate_spectrum", *(f"synthesize_{size}_scale_master" for size in SIZES)}
    assert not shared & counts(jobs).keys()
    assert all(token in output for output in outputs(jobs, "compute_filtered_pull_off"))
    pair = outputs(jobs, "compute_pull_off")[0]
    run = run_snakemake(finished_copy, pair, "results/second/contact.nc", overlays=[other])
    assert run.returncode == 0, run.stdout
    assert token in pair and Path(finished_copy, pair).is_file()
    assert planned(finished_copy) == []  # going back computes nothing


def test_another_dataset_of_a_container_reruns_its_scan(finished_copy):
    files = {
        f"{name}.nc": scan(finished_copy / f"{name}.nc", heights(128, 128), (2500.0, 2500.0))
        for name in "ab"
    }
    entries = [{"name": name[0], "datafile": {"original": name}} for name in files]
    container(finished_copy / "mcd.zip", entries, files)
    table = pd.read_csv(finished_copy / "config/surfaces.tsv", sep="\t", dtype=str, na_filter=False)
    rows = (table.surface == "mcd") & table.scan.isin(["1", "2"])
    table = table[rows | (table.surface != "mcd")]
    target = "results/store-quick/scans/mcd/scan-1-flat.nc"
    for datasets in (["a", "b"], ["b", "a"]):
        table.loc[rows, ["source", "path", "dataset"]] = [
            ["measured", "mcd.zip", name] for name in datasets
        ]
        table.to_csv(finished_copy / "config/surfaces.tsv", sep="\t", index=False)
        assert counts(planned(finished_copy, targets=[target])) == {"prepare_scan": 1}
        assert run_snakemake(finished_copy, target).returncode == 0
    assert planned(finished_copy, targets=[target]) == []


def test_another_study_shares_intermediates(finished):
    jobs = planned(finished, {"study": "second"})
    assert counts(jobs) == {
        "aggregate_adhesion": 1,
        "trace_contact": 1,
        **AFTER_TOPOGRAPHY,
        **AFTER_SCALES,
        **AFTER_ELASTIC,
        **AFTER_INDENTS,
        **AFTER_ASPERITIES,
        **AFTER_VARIANTS,
    }
    assert all("results/second/" in output for _, output in jobs)


def test_other_hardnesses_of_robustness(finished):
    jobs = planned(finished, {"robustness": {"hardnesses": ["16 GPa"]}})
    assert counts(jobs) == {
        "vary_adhesion": VARIED_PAIRS,
        "vary_scales": 2 * (VARIED - len(SUBSTRATES)),  # the rough sphere bears one load alone
        **AFTER_VARIANTS,
    }
    assert all("-smooth" in output for output in outputs(jobs, "vary_scales"))


def test_one_more_skewness_of_robustness(finished):
    jobs = planned(finished, {"robustness": {"skewness": [0, 0.3]}})
    assert counts(jobs) == {
        "calibrate_spectrum": len(SUBSTRATES),
        "synthesize_scan": 2 * len(SUBSTRATES),
        "prepare_scan": 2 * len(SUBSTRATES),
        "vary_adhesion": 4 * len(SUBSTRATES),
        "vary_scales": 2 * len(SUBSTRATES),
        **AFTER_VARIANTS,
    }
    stored = [output for _, output in jobs if "store-quick" in output]
    assert len(stored) == 11 * len(SUBSTRATES)
    assert all(".skewness-0.3" in output for output in stored)


def test_robustness_without_other_values_has_nothing_more_to_make(finished):
    jobs = planned(finished, {"robustness": {"preloads": [], "hardnesses": [], "skewness": []}})
    assert not [output for _, output in jobs if "skewness" in output]
    assert counts(jobs).keys() == {"vary_adhesion", "vary_scales", *AFTER_VARIANTS}


@pytest.mark.parametrize(
    ("target", "last", "not_needed"),
    [
        ("topography", "aggregate_topography", "compute_pull_off"),
        ("adhesion", "aggregate_adhesion", "compute_filtered_pull_off"),
        ("scales", "aggregate_scales", "compute_pull_off"),
        ("elastic", "aggregate_elastic", "compute_pull_off"),
        ("plasticity", "measure_indents", "compute_pull_off"),
        ("asperities", "aggregate_asperities", "solve_elastic_contact"),
        ("robustness", "aggregate_robustness", "compute_filtered_pull_off"),
        ("classical", "apply_classical_models", "vary_scales"),
        ("claims", "evaluate_claims", "draw_fig1"),
        ("figures", "draw_fig6", "evaluate_claims"),
        ("pages", "describe_study", "vary_scales"),
    ],
)
def test_named_target(finished, target, last, not_needed):
    elsewhere = {"study": "elsewhere", "store": "results/store-elsewhere"}
    jobs = counts(planned(finished, elsewhere, targets=[target]))
    assert jobs[last] == 1 and not jobs[not_needed]


# The text of the rules


def rules():
    """Text of each rule that makes files by a script, by name."""
    text = "\n".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
    blocks = re.findall(r"^rule (\w+):\n((?:(?:    .*)?\n)+)", text + "\n", re.M)
    return {name: block for name, block in blocks if "script:" in block and name != "verify"}


RULES = rules()
TARGETS = {
    "all", "topography", "adhesion", "elastic", "plasticity", "asperities", "scales", "classical",
    "robustness", "claims", "figures", "pages", "crate", "verify",
}  # fmt: skip


@pytest.mark.parametrize("name", RULES)
def test_rule_has_log_benchmark_code_parameters_and_its_script(name):
    block = RULES[name]
    for directive in ("input", "output", "params", "log", "benchmark", "script"):
        assert re.search(rf"^    {directive}:$", block, re.M), directive
    assert f'code=code("{name}.py")' in block
    assert f'"../scripts/{name}.py"' in block
    assert (ROOT / f"workflow/scripts/{name}.py").is_file()
    assert re.search(r"^        canonical=", block, re.M)


def test_every_script_belongs_to_a_rule():
    scripts = {path.stem for path in (ROOT / "workflow/scripts").glob("*.py")}
    assert scripts == set(RULES) | {"verify"}


def test_every_rule_is_a_script_or_a_named_target(finished):
    run = run_snakemake(finished, "--list-rules")
    listed = set(run.stdout.split()) - {"Using"}
    assert set(RULES) | TARGETS <= listed
    files = [ROOT / "Snakefile", *(ROOT / "workflow/rules").glob("*.smk")]
    named = {name for path in files for name in re.findall(r"^rule (\w+):", path.read_text(), re.M)}
    assert named == set(RULES) | TARGETS


def test_the_crate_describes_what_every_target_makes():
    block = RULES["describe_crate"].partition("    output:")[0]
    named = set(re.findall(r"rules\.(\w+)\.input", block))
    assert named == TARGETS - {"all", "crate", "verify"}


def test_every_rule_wrote_its_log_and_benchmark(finished):
    for kind, suffix in (("logs", ".log"), ("benchmarks", ".tsv")):
        found = {
            path.relative_to(folder).parts[0].removesuffix(suffix)
            for folder in (finished / "results").glob(f"*/{kind}")
            for path in folder.rglob(f"*{suffix}")
        }
        assert found - {"verify"} == set(RULES) - {"extrapolate_spectrum"}, kind


def test_library_knows_nothing_of_snakemake():
    for path in (ROOT / "workflow/hardcontact").rglob("*.py"):
        assert not re.search(r"^\s*(import|from) snakemake", path.read_text(), re.M), path


# Schema, configuration and documentation


SCHEMA = SCHEMAS["config"]


def resolved(schema):
    """A part of the schema, or the definition that it refers to."""
    return SCHEMA["$defs"][schema["$ref"].rsplit("/", 1)[1]] if "$ref" in schema else schema


def schema_tree(schema):
    schema = resolved(schema)
    if "properties" in schema:
        return {key: schema_tree(value) for key, value in schema["properties"].items()}
    return None


KEYS = sorted(leaves(schema_tree(SCHEMA)))


def objects(schema):
    """Every part of a schema that has properties."""
    schema = resolved(schema)
    if "properties" in schema:
        yield schema
        for part in schema["properties"].values():
            yield from objects(part)


def test_schema_and_configuration_have_the_same_keys():
    assert KEYS == sorted(leaves(PAPER))


def test_every_key_is_required_and_no_other_allowed():
    for part in objects(SCHEMA):
        assert sorted(part["required"]) == sorted(part["properties"])
        assert part["additionalProperties"] is False


def test_the_quick_study_changes_known_keys_only():
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    assert set(leaves(quick)) <= set(KEYS)


@pytest.mark.parametrize("key", KEYS)
def test_key_is_documented(key):
    assert f"`{key}`" in (ROOT / "config/README.md").read_text()


def test_columns_of_the_table_of_surfaces_are_documented():
    columns = ROWS.splitlines()[0].split("\t")
    assert columns == list(SCHEMAS["surfaces"]["properties"])
    text = (ROOT / "config/README.md").read_text()
    assert [column for column in columns if f"`{column}`" not in text] == []


def test_finished_study_is_the_repository_as_it_stands(finished):
    """What the fixture ran is what is tested here, not an older copy."""
    for path in ("Snakefile", "workflow/hardcontact/study.py", "config/config.yaml"):
        assert (finished / path).read_bytes() == (ROOT / path).read_bytes()
