"""The rerun matrix: what a dry run would make after each possible change, and nothing else."""

import ast
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
from multiprocessing.pool import ThreadPool
from pathlib import Path

import pandas as pd
import pytest
import yaml
from conftest import PAPER, PARTS, QUICK, ROOT, ROWS, heights, leaves, scan
from snakemake.cli import main as snakemake

# The rules of one stage

SCANS = {"synthesize_scan", "prepare_scan", "measure_topography", "aggregate_topography"}
MASTERS = {"synthesize_small_scale_master", "synthesize_large_scale_master"}
PAIRS = {"compute_pull_off", "solve_elastic_contact", "find_asperities", "vary_adhesion"}
CONTACTS = PAIRS | {"trace_contact", "measure_indents"}
FILTERED = {"compute_filtered_pull_off", "vary_scales"}
FORCES = CONTACTS | FILTERED
FROM_SCANS = SCANS | MASTERS | FORCES
AGGREGATED = {
    "aggregate_topography", "aggregate_adhesion", "aggregate_elastic", "aggregate_asperities",
    "aggregate_scales", "aggregate_robustness",
}  # fmt: skip

#: What reads the file that a rule makes; intermediates are named in full by the tables below.
FOLLOWS = {
    "compute_pull_off": {"aggregate_adhesion"},
    "solve_elastic_contact": {"aggregate_elastic"},
    "find_asperities": {"aggregate_asperities"},
    "compute_filtered_pull_off": {"aggregate_scales"},
    "vary_adhesion": {"aggregate_robustness"},
    "vary_scales": {"aggregate_robustness"},
    "measure_topography": {"aggregate_topography"},
    "aggregate_topography": {"draw_fig1", "draw_table1", "evaluate_claims"},
    "aggregate_adhesion": {"infer", "evaluate_claims", "draw_fig3"},
    "trace_contact": {"draw_fig4"},
    "aggregate_elastic": {"draw_fig_elastic", "evaluate_claims"},
    "measure_indents": {"draw_fig5", "evaluate_claims"},
    "aggregate_asperities": {"draw_fig_asperities", "evaluate_claims"},
    "aggregate_scales": {"infer", "evaluate_claims", "draw_fig6"},
    "aggregate_robustness": {"draw_fig_robustness"},
    "infer": {
        "draw_fig3", "draw_fig4", "draw_fig6", "draw_fig_asperities", "draw_fig_robustness",
        "apply_classical_models", "evaluate_claims",
    },
    "apply_classical_models": {"draw_fig_classical", "evaluate_claims"},
    "evaluate_claims": {"describe_study"},
}  # fmt: skip

#: What reads the intermediates, where all files of a rule are made again.
INTERMEDIATE = {
    "calibrate_spectrum": {"synthesize_scan", *MASTERS, "vary_scales", "aggregate_topography"},
    "extrapolate_spectrum": {*MASTERS, "vary_scales", "aggregate_topography"},
    "synthesize_scan": {"prepare_scan", "aggregate_topography"},
    "prepare_scan": {
        "measure_topography",
        "aggregate_topography",
        *MASTERS,
        *CONTACTS,
        "vary_scales",
    },
    "synthesize_small_scale_master": {"compute_filtered_pull_off"},
    "synthesize_large_scale_master": {"compute_filtered_pull_off"},
}


def following(rules, graph=FOLLOWS):
    """The rules, what follows from them by the graph, and the description of the whole."""
    found, pending = set(rules), list(rules)
    while pending:
        more = graph.get(pending.pop(), set()) - found
        found |= more
        pending += more
    return found | ({"describe_crate"} if found else set())


def all_following(rules):
    return following(rules, FOLLOWS | INTERMEDIATE)


#: Another value of every key, and the rules that it concerns. Every value also stands in the
#: configuration kept with the results and on the page of parameters.
KEYS = {
    "study": ("second", AGGREGATED | {"trace_contact", "measure_indents", "infer"}),
    "store": ("results/other", FROM_SCANS | {"calibrate_spectrum"}),
    "surfaces": ("config/same.tsv", set()),
    "scans": ([1, 2, 3], SCANS | CONTACTS - {"trace_contact"}),
    "reference_surface": ("ncd", {"aggregate_topography", "aggregate_robustness", "infer"}),
    "seed": (1, FROM_SCANS | {"calibrate_spectrum", "infer", "apply_classical_models"}),
    "sphere.surface": ("mcd", FROM_SCANS),
    "sphere.radius": ("300 um", SCANS | FORCES),
    "scan.pixels": (112, FROM_SCANS),
    "scan.size": ("2400 nm", FROM_SCANS),
    "scan.realization_pixels": (256, FROM_SCANS),
    "scan.undefined_pixels": ("harmonic", set()),  # substitutes have none
    "topography.slope": ("profile", FROM_SCANS | {"calibrate_spectrum"}),
    "topography.curvature": ("laplacian", FROM_SCANS | {"calibrate_spectrum"}),
    "contact.hardness": ("30 GPa", FORCES),
    "contact.preload": ("12 uN", FORCES - {"measure_indents"}),
    "contact.window": ("12000 nm", FORCES),
    "contact.count": (5, FORCES - {"vary_adhesion", "vary_scales"}),
    "adhesion.ranges": (["1 nm", "3 nm", "5.6 nm"], {"compute_pull_off", "vary_adhesion"}),
    "adhesion.traced_contact.surface": ("ncd", {"trace_contact"}),
    "adhesion.traced_contact.scan": (2, {"trace_contact"}),
    "adhesion.traced_contact.sphere_scan": (2, {"trace_contact"}),
    "adhesion.traced_contact.contact": ([2, 3], {"trace_contact"}),
    "inference.error_threshold": (0.2, {"infer", "aggregate_robustness"}),
    "inference.force_floor": ("20 nN", {"infer"}),
    "inference.bootstrap_samples": (
        120,
        {"infer", "aggregate_robustness", "apply_classical_models"},
    ),
    "inference.confidence": (
        0.9,
        {"aggregate_topography", "infer", "aggregate_robustness", "apply_classical_models"},
    ),
    "scales.range": ("5 nm", {"compute_pull_off", *FILTERED}),
    "scales.tolerance": (0.2, {"infer", "aggregate_robustness"}),
    "scales.realizations": (3, {*MASTERS, "compute_filtered_pull_off"}),
    "scales.sphere_roughness": (True, FILTERED),
    "scales.small.pixels": (2048, {MASTER_SMALL := "synthesize_small_scale_master", *FILTERED}
                            - {"vary_scales"}),
    "scales.small.transition": ("90 nm", {MASTER_SMALL, *FILTERED}),
    "scales.small.cutoffs": (["43 nm", "80 nm", "120 nm", "500 nm"], {"compute_filtered_pull_off"}),
    "scales.large.pixels": (2048, {"compute_filtered_pull_off"}),
    "scales.large.tiles": (3, {MASTER_LARGE := "synthesize_large_scale_master", *FILTERED}),
    "scales.large.transition": ("900 nm", {MASTER_LARGE, *FILTERED}),
    "scales.large.cutoffs": (["500 nm", "1800 nm", "4000 nm", "5000 nm"],
                             {"compute_filtered_pull_off"}),
    "elastic.sphere.modulus": ("360 GPa", {"solve_elastic_contact"}),
    "elastic.sphere.poisson_ratio": (0.3, {"solve_elastic_contact"}),
    "elastic.substrate.modulus": ("1000 GPa", {"solve_elastic_contact"}),
    "elastic.substrate.poisson_ratio": (0.2, {"solve_elastic_contact"}),
    "elastic.contacts": (2, {"solve_elastic_contact"}),
    "elastic.window": ("2400 nm", {"solve_elastic_contact"}),
    "indent.surface": ("mcd", {"measure_indents"}),
    "indent.preloads": (["20 uN"], {"measure_indents"}),
    "asperities.contacts": (3, {"find_asperities"}),
    "asperities.share": (0.8, {"find_asperities"}),
    "asperities.ranges": (["1 nm", "2 nm"], {"find_asperities"}),
    "robustness.preloads": (["6 uN"], {"vary_adhesion", "vary_scales"}),
    "robustness.hardnesses": (["16 GPa"], {"vary_adhesion", "vary_scales"}),
    "robustness.skewness": (
        [0.1],
        {"calibrate_spectrum", "synthesize_scan", "prepare_scan", "vary_adhesion", "vary_scales"},
    ),
    "robustness.realizations": (2, {"vary_scales"}),
    "robustness.count": (5, {"vary_adhesion", "vary_scales"}),
    "robustness.small.pixels": (2048, {"vary_scales"}),
    "robustness.small.cutoffs": (["43 nm", "120 nm"], {"vary_scales"}),
    "robustness.large.pixels": (2048, {"vary_scales"}),
    "robustness.large.cutoffs": (["500 nm", "1800 nm"], {"vary_scales"}),
}  # fmt: skip
KEPT = {"keep_configuration", "describe_study"}

#: What is made of one substitute surface, and with it; traced is uncd, indents are made on ncd.
SUBSTITUTE = {"calibrate_spectrum", *FROM_SCANS}
OF_MCD = SUBSTITUTE - {"trace_contact", "measure_indents"}

#: Another text of a column of the rows of mcd (of its second scan), and the rules it concerns.
COLUMNS = {
    "surface": ("xcd", OF_MCD),
    "label": ("fine diamond", AGGREGATED - {"aggregate_robustness"}),
    "scan": ("6", SCANS | MASTERS | PAIRS | {"compute_filtered_pull_off"}),
    "source": (
        "measured",
        OF_MCD - {"calibrate_spectrum", "synthesize_scan"} | {"extrapolate_spectrum"},
    ),
    "path": ("resources/spectra/ncd-table1.csv", OF_MCD),
}


def loaded(script):
    """Modules of the library, as paths, that the imports of a script really load."""
    tree = ast.parse((ROOT / "workflow/scripts" / script).read_text())
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    program = ast.unparse(ast.Module(imports, [])) + (
        "\nimport sys\nfor name, module in sys.modules.items():"
        "\n    if name.split('.')[0] == 'hardcontact': print(module.__file__)"
    )
    run = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONPATH": str(ROOT / "workflow")},
        capture_output=True,
        text=True,
        check=True,
    )
    return {os.path.relpath(path, ROOT) for path in run.stdout.split()}


SCRIPTS = sorted(path.name for path in (ROOT / "workflow/scripts").glob("*.py"))
MODULES = sorted(
    path.relative_to(ROOT).as_posix() for path in (ROOT / "workflow/hardcontact").rglob("*.py")
)
#: Rules that the quick study has no job for.
IDLE = {"extrapolate_spectrum", "verify"}
ALL = {Path(script).stem for script in SCRIPTS} - IDLE

#: Files beside the code, and what is to be made after a change of their text.
FILES = {
    "environment.txt": ALL,
    "README.md": following({"describe_study"}),
    "CITATION.cff": {"describe_crate"},
    "config/surfaces.tsv": following({"keep_configuration"}),
    "resources/paper/table1.csv": all_following(
        {"calibrate_spectrum", "draw_table1", "apply_classical_models"}
    ),
    "resources/paper/pull_off.csv": following(
        {"infer", "apply_classical_models", "aggregate_robustness"}
    ),
    "resources/paper/parameters.csv": all_following(
        {"calibrate_spectrum", "infer", "apply_classical_models", "aggregate_robustness"}
    ),
    "resources/paper/claims.csv": following({"evaluate_claims"}),
    "resources/spectra/polished_uncd.csv": following(OF_MCD),
    "resources/spectra/uncd.csv": following(SUBSTITUTE - {"measure_indents"}),
    "resources/spectra/uncd-tem.csv": following(SUBSTITUTE),  # of uncd and ncd
    "resources/spectra/ncd.csv": following(SUBSTITUTE - {"trace_contact"}),
    "resources/spectra/mcd.csv": following(OF_MCD),
    "resources/spectra/ruby.csv": following(SUBSTITUTE - MASTERS - {"compute_filtered_pull_off"}),
    "resources/spectra/height_distribution.csv": set(),  # its values are parameters of the rules
}


def run_dry(folder):
    os.chdir(folder)
    sys.stdout = sys.stderr = open("output", "w", buffering=1)
    snakemake(["-n", "--configfile", QUICK, "overlay.yaml"])


def dry_run(folder):
    """The rules of a dry run in a folder that shares the finished one's results; or its error.

    In a process that is forked where Snakemake is imported: this saves half of the time.
    """
    process = multiprocessing.get_context("fork").Process(target=run_dry, args=(folder,))
    process.start()
    process.join()
    text = (folder / "output").read_text()
    if process.exitcode:
        return text
    return set(re.findall(r"^(?:local)?rule (\w+):\n", text, re.M)) - {"all"}


def nested(key, value):
    for part in reversed(key.split(".")):
        value = {part: value}
    return value


def with_line(path):
    """Another text that says the same: a comment, or a line that readers skip."""

    def change(folder):
        with open(folder / path, "a") as file:
            file.write("\n" if path.endswith((".csv", ".tsv")) else "\n# another line\n")

    return change


def with_column(column, text):
    """The rows of mcd with another text in one column, and what that asks for."""

    def change(folder):
        path = folder / "config/surfaces.tsv"
        table = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
        rows = table.surface == "mcd"
        if column == "scan":
            rows &= table.scan == "2"
        table.loc[rows, column] = text
        if column == "surface":  # of which Table 1 has no row to calibrate it to
            table.loc[rows, "path"] = "resources/spectra/ruby.csv"
        if column == "source":
            table.loc[rows, "path"] = [f"{number}.nc" for number in table.scan[rows]]
            for name in table.path[rows]:
                scan(folder / name, heights(128, 128), (2500.0, 2500.0))
        table.to_csv(path, sep="\t", index=False)

    return change


def same_table(folder):
    shutil.copy2(folder / "config/surfaces.tsv", folder / "config/same.tsv")


def text_says_the_same(folder):
    """The configuration with its keys in another order, without its comments, with new ones."""
    for name in ("config/config.yaml", QUICK):
        content = yaml.safe_load((folder / name).read_text())
        reordered = yaml.safe_dump(dict(reversed(content.items())), sort_keys=False)
        (folder / name).write_text(f"# the same\n{reordered}")


def checked_out(folder):
    """All files written again with the same content, as a checkout does, and touched."""
    for part in PARTS:
        for path in [folder / part, *(folder / part).rglob("*")]:
            if path.is_file():
                content = path.read_bytes()
                path.unlink()
                path.write_bytes(content)


#: Name -> configuration laid over the quick study, what is done to its files, what is to be made.
CHANGES = (
    {
        key: (nested(key, value), same_table, following(rules | KEPT))
        for key, (value, rules) in KEYS.items()
    }
    | {
        f"column {name}": (
            {"scans": [1, 2, 6]} if name == "scan" else {},
            with_column(name, text),
            following(rules | KEPT),
        )
        for name, (text, rules) in COLUMNS.items()
    }
    | {path: ({}, with_line(path), rules) for path, rules in FILES.items()}
    | {
        f"workflow/scripts/{name}": (
            {}, with_line(f"workflow/scripts/{name}"), all_following({Path(name).stem} - IDLE)
        )
        for name in SCRIPTS
    }
    | {"nothing": ({}, lambda folder: None, set())}
    | {"touch and checkout": ({}, checked_out, set())}
    | {"comments and order of keys": ({}, text_says_the_same, set())}
)  # fmt: skip


@pytest.fixture(scope="module")
def uses():
    """Module -> rules whose script loads it."""
    with ThreadPool(2) as pool:
        modules = dict(zip(SCRIPTS, pool.map(loaded, SCRIPTS), strict=True))
    return {
        path: {Path(name).stem for name in SCRIPTS if path in modules[name]} for path in MODULES
    }


@pytest.fixture(scope="module")
def reruns(finished, tmp_path_factory):
    """Name of a change -> the rules of a dry run after it."""
    top = tmp_path_factory.mktemp("reruns")
    requests = {}
    changes = CHANGES | {path: ({}, with_line(path), None) for path in MODULES}
    for number, (name, (overlay, change, _)) in enumerate(changes.items()):
        folder = top / str(number)
        folder.mkdir()
        for part in PARTS:
            copy = shutil.copytree if (finished / part).is_dir() else shutil.copy2
            copy(finished / part, folder / part)
        for part in ("results", ".snakemake"):
            (folder / part).symlink_to(finished / part)
        change(folder)
        (folder / "overlay.yaml").write_text(yaml.safe_dump(overlay))
        requests[name] = folder
    with ThreadPool(2) as pool:
        found = pool.map(dry_run, requests.values(), chunksize=1)
    shutil.rmtree(top)
    return dict(zip(requests, found, strict=True))


def test_every_key_is_in_the_matrix():
    assert sorted(KEYS) == sorted(leaves(PAPER))


def test_every_column_is_in_the_matrix():
    columns = ROWS.splitlines()[0].split("\t")
    assert [*COLUMNS, "dataset"] == columns


def test_every_resource_is_in_the_matrix():
    used = {
        path.relative_to(ROOT).as_posix()
        for folder in ("paper", "spectra")
        for path in (ROOT / "resources" / folder).glob("*.csv")
    }
    other = {"resources/spectra/ncd-table1.csv"}  # an alternative that no surface names
    assert used - other <= set(FILES)


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_reruns_what_depends_on_it(reruns, name):
    assert reruns[name] == CHANGES[name][2]


@pytest.mark.parametrize("path", MODULES)
def test_a_module_reruns_the_rules_whose_scripts_load_it(reruns, uses, path):
    assert reruns[path] == all_following(uses[path] - IDLE)


def test_no_script_reads_the_configuration():
    for name in SCRIPTS:
        text = (ROOT / "workflow/scripts" / name).read_text()
        assert not re.search(r"snakemake\.config|config\[|\.yaml['\"]", text), name
