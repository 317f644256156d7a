"""The rules as they are written: what each has to have, and what belongs to none of them."""

import re

import pytest
import yaml
from repository import PAPER, ROOT, snakemake

from hardcontact.config.configuration import made
from hardcontact.figures.listing import FIGURES

FILES = [ROOT / "Snakefile", ROOT / "workflow/redraw.smk", *(ROOT / "workflow/rules").glob("*.smk")]
DRAWN = {f"draw_{name}" for name in FIGURES}
#: Rules that a study of own surfaces has and the paper's has not.
OF_OWN_SURFACES = {
    "aggregate_spectra", "draw_spectra", "vary_spectrum", "find_band_edges", "predict_force",
    "fit_forces", "answer_surfaces",
}  # fmt: skip
BLOCKS = dict(
    re.findall(
        r"^rule (\w+):\n((?:(?: {4}.*)?\n)+)",
        "\n".join(path.read_text() for path in FILES) + "\n",
        re.M,
    )
)
#: Rules of a loop, whose outputs are as many as scans or surfaces: their names go on.
LOOPED = ("make_scans", "vary_scales")
for text in (path.read_text() for path in FILES):
    for block in re.findall(r"^    rule:\n((?: {8}.*\n|\n)+)", text, re.M):
        for name in LOOPED:
            if f'f"{name}_' in block:
                BLOCKS[name] = re.sub("^    ", "", block, flags=re.M)
#: Rules that make files by a script of their name.
RULES = {name: block for name, block in BLOCKS.items() if "script:" in block and name != "verify"}
#: Those of the paper's study.
OF_PAPER = RULES.keys() - OF_OWN_SURFACES
#: Targets of the paper's study.
TARGETS = {
    "all", "topography", "adhesion", "elastic", "plasticity", "asperities", "scales", "classical",
    "sets", "robustness", "claims", "figures", "pages", "answer",
    "insight", "crate", "verify",
}  # fmt: skip


@pytest.mark.parametrize("name", RULES)
def test_rule_has_log_benchmark_code_parameters_and_its_script(name):
    block = RULES[name]
    for directive in ("input", "output", "params", "log", "benchmark", "script"):
        assert re.search(rf"^    {directive}:$", block, re.M), directive
    (script,) = re.findall(r'"\.\./scripts/(\w+\.py)"', block)
    assert (ROOT / "workflow/scripts" / script).is_file()
    assert f'code=code_inputs("{script}")' in block
    assert f'PATTERNS.log("{name}"' in block and f'PATTERNS.benchmark("{name}"' in block
    assert re.search(r"^        canonical=", block, re.M)


def test_every_script_belongs_to_a_rule():
    scripts = {path.stem for path in (ROOT / "workflow/scripts").glob("*.py")}
    named = {
        script for path in FILES for script in re.findall(r"scripts/(\w+)\.py", path.read_text())
    }
    assert scripts == named


def test_rule_files_hold_nothing_but_rules():
    for path in FILES:
        assert not re.search(r"^\s*(def|class) |lambda \w+(, \w+)+:", path.read_text(), re.M), path


@pytest.mark.parametrize("name", BLOCKS)
def test_every_rule_says_what_it_is_for(name):
    assert re.match(r' {4}"""[A-Z][^"]*\."""$', BLOCKS[name], re.M)


def test_the_study_of_the_paper_has_the_rules_that_concern_it(repository):
    listed = re.findall(r"^([\w+-]+) \((.+)\)$", snakemake(repository, "--list-rules").stdout, re.M)
    names = {re.sub(rf"^({'|'.join(LOOPED)})_.*", r"\1", name) for name, _ in listed}
    assert names == OF_PAPER | TARGETS | DRAWN | set(FIGURES)


def test_lint_misses_nothing_but_environments(repository):
    said = re.findall(r"^    \* (.*):$", snakemake(repository, "--lint").stdout, re.M)
    assert set(said) == {"Specify a conda environment or container for each rule."}


def test_the_crate_describes_what_every_target_makes():
    block = RULES["describe_crate"].partition("    output:")[0]
    assert "[getattr(rules, target).input for target in made(STUDY)]" in block
    assert set(made(PAPER)) == TARGETS - {"all", "crate", "verify"}


def test_every_rule_wrote_its_log_and_benchmark(finished):
    for kind, suffix in (("logs", ".log"), ("benchmarks", ".tsv")):
        found = {
            path.relative_to(folder).parts[0].removesuffix(suffix)
            for folder in (finished / "results").glob(f"*/{kind}")
            for path in folder.rglob(f"*{suffix}")
        }
        of_own = {"measure_spectrum", "prepare_scan", "read_scan"}
        assert found - {"verify"} == (OF_PAPER | DRAWN) - of_own, kind


def test_the_cluster_profile_names_rules_there_are_and_the_resources_of_all_others():
    profile = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())
    named = profile["groups"].keys() | profile["set-resources"].keys()
    assert named <= RULES.keys() | DRAWN
    assert profile["default-resources"].keys() == {"mem_mb", "runtime"}
    assert set(profile["groups"].values()) == profile["group-components"].keys()


def test_library_knows_nothing_of_snakemake():
    library = ROOT / "workflow/hardcontact"
    for path in set(library.rglob("*.py")) - {library / "config/start.py"}:
        assert not re.search(r"^\s*(import|from) snakemake", path.read_text(), re.M), path
