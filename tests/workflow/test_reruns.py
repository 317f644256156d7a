"""After a change, a dry run plans exactly the files that depend on it.

A change is a key, a file or a module. The inputs of each job are compared with the modules that its
script loads.
"""

import ast
import csv
import importlib
import os
import pkgutil
import re
import sys
from pathlib import Path

import pytest
import yaml
from forked_runs import run_forked, use_library_of
from refusals import assert_says
from repository import (
    ROOT,
    STUDY_FILES,
    TINY,
    copy_repository,
    linked_copy,
    run_snakemake,
    run_tiny_study,
    snakemake_outputs,
)

import hardcontact
from hardcontact.config.configuration import set_keys

pytestmark = pytest.mark.study


def imports(path):
    """Yield the lines of a file that import from the library, also those inside of functions."""
    for node in ast.walk(ast.parse(Path(path).read_text("utf-8"))):
        if isinstance(node, ast.Import | ast.ImportFrom) and "hardcontact" in ast.unparse(node):
            yield ast.unparse(node)


def loaded_modules(script, *names):
    """Return the paths of the library's modules that a script and further modules load."""
    use_library_of(ROOT)
    for name in names:
        importlib.import_module(name)
    pending, done, modules = {f"workflow/scripts/{script}"}, set(), set()
    while pending:
        for line in (line for path in pending for line in imports(path)):
            exec(line, {})
        done |= pending
        library = (module for name, module in sys.modules.items() if name.startswith("hardcontact"))
        modules = {os.path.relpath(module.__file__) for module in library}
        pending = modules - done
    return modules


def run_dry(folder):
    """Return the rules of a dry run in a folder that make files, each with its files."""
    (text,) = snakemake_outputs(folder, [["-n", "--configfile", TINY, "overlay.yaml"]])
    planned_jobs = re.findall(
        r"^(?:local)?rule (\S+):\n(?:    input: .*\n)?(?:    output: (.*)\n)?", text, re.M
    )
    return [(rule, output) for rule, output in planned_jobs if output]


@pytest.mark.parametrize("option", ["--tou", "-Ft"])
def test_touch_is_refused(tmp_path, option):
    study = copy_repository(tmp_path / "study")
    run = run_snakemake(study, "describe_study", option, "--configfile", TINY)
    assert run.returncode == 1
    assert_says(run.stdout, "inputs, not file times", "snakemake -n")


#: Beginnings of names of rules made in loops, one per batch of scans.
LOOPED = {"make_scans"}


class Graph:
    """The jobs of a finished study, from Snakemake's own summary: inputs and rule by output."""

    def __init__(self, finished):
        lines = run_tiny_study(finished, "--detailed-summary").stdout.splitlines()
        header = next(n for n, line in enumerate(lines) if line.startswith("output_file\t"))
        self.inputs, self.rules = {}, {}
        for row in csv.DictReader(lines[header:], delimiter="\t"):
            self.inputs[row["output_file"]] = set(row["input-file(s)"].split(","))
            self.rules[row["output_file"]] = row["rule"]

    def readers(self, path):
        """Return the files that have a file among their inputs."""
        return {output for output, inputs in self.inputs.items() if path in inputs}

    def files_of_rules(self, rules):
        """Return the files of some rules; rules made in a loop have longer names."""
        return {
            path
            for path, rule in self.rules.items()
            if rule in rules or any(rule.startswith(f"{name}_") for name in LOOPED & rules)
        }

    def following_rules(self, changed_files):
        """Return the rules of some files and of all files that depend on them."""
        changed_files = set(changed_files)
        while (
            added_files := {path for path, inputs in self.inputs.items() if inputs & changed_files}
            - changed_files
        ):
            changed_files |= added_files
        return {self.rules[path] for path in changed_files}


@pytest.fixture(scope="module")
def graph(finished):
    return Graph(finished)


@pytest.fixture(scope="module")
def dry(finished, tmp_path_factory):
    """Return a function that runs the finished study dry after a change, in a copy of its files."""
    top = tmp_path_factory.mktemp("dry")

    def planned(overlay=None, change=lambda folder: None):
        folder = linked_copy(finished, top / str(len(list(top.iterdir()))))
        change(folder)
        (folder / "overlay.yaml").write_text(yaml.safe_dump(overlay or {}))
        return run_dry(folder)

    return planned


def rules_of(jobs):
    return {rule for rule, _ in jobs} - {"all"}


# Inputs of jobs


def test_the_modules_that_a_script_loads_are_inputs_of_its_jobs(graph):
    """A changed module then repeats the jobs that load it, as is tested below."""
    for module in pkgutil.walk_packages(hardcontact.__path__, "hardcontact."):
        importlib.import_module(module.name)  # Other packages are then loaded once.
    runs = {}
    for path, rule in graph.rules.items():
        (script,) = (Path(file).name for file in graph.inputs[path] if "workflow/scripts/" in file)
        figure = [f"hardcontact.report.figures.{rule[5:]}"] if script == "draw_figure.py" else []
        library = {file for file in graph.inputs[path] if file.startswith("workflow/hardcontact/")}
        runs.setdefault((script, *figure), set()).add(frozenset(library))
    for program, programs_run in runs.items():
        assert programs_run == {frozenset(run_forked(loaded_modules, *program))}, program


# Nothing changed


def rewrite_files(folder):
    """Write all files again, as a checkout does: other comments, another order of keys."""
    for name in STUDY_FILES:
        for path in [folder / name, *(folder / name).rglob("*")]:
            if path.is_file():
                content = path.read_bytes()
                path.unlink()
                path.write_bytes(content)
    for name in ("config/config.yaml", TINY):
        content = yaml.safe_load((folder / name).read_text())
        reordered = yaml.safe_dump(dict(reversed(content.items())), sort_keys=False)
        (folder / name).write_text(f"# the same\n{reordered}")
    for path in ("environment.txt", "workflow/lock.txt"):
        append_line(path)(folder)


def test_rewritten_files_of_the_same_meaning_make_nothing(dry):
    assert dry(change=rewrite_files) == []


# A key: the rules that it concerns, and all that is made from theirs

#: Every value is in the configuration kept with the results and on pages.
KEEPS_EVERY_KEY = {"describe_study", "answer_paper"}


def lose_metadata(folder):
    """Remove what Snakemake remembers of a run, as a copy of the results alone does."""
    (folder / ".snakemake").unlink()


def empty_metadata(folder):
    """Leave Snakemake's memory of a run empty, as a power loss or a full disk does."""
    metadata = (folder / ".snakemake/metadata").resolve()
    lose_metadata(folder)
    for path in metadata.iterdir():
        copy = folder / ".snakemake/metadata" / path.name
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.touch()


@pytest.mark.parametrize(
    ("key", "value", "concerned", "change_metadata"),
    [
        ("sets.pool_size", 12, {"compute_pool", "sample_sets"}, lambda folder: None),
        ("band.short.transition", "90 nm",
         {"synthesize_masters", "compute_filtered_forces", "aggregate_filtered_forces"},
         lose_metadata),
        ("band.tolerance", 0.2,
         {"find_edges_of_independent_masters", "sample_sets", "fit_exponents",
          "compute_edge_shifts"},
         empty_metadata),
    ],
)  # fmt: skip
def test_a_changed_key_repeats_exactly_its_dependents(
    dry, graph, key, value, concerned, change_metadata
):
    """The study's records decide, whatever Snakemake remembers of the run."""
    planned_jobs = dry(set_keys({}, {key: value}), change_metadata)
    assert rules_of(planned_jobs) == graph.following_rules(
        graph.files_of_rules(concerned | KEEPS_EVERY_KEY)
    )


# A file or a module


def append_line(path):
    """Return a change that adds a line without meaning: a comment, or an empty row."""

    def change(folder):
        with open(folder / path, "a") as file:
            file.write("\n" if path.endswith((".csv", ".tsv")) else "\n# another line\n")

    return change


@pytest.mark.parametrize(
    "path", ["resources/spectra/mcd.csv", "workflow/hardcontact/contact/force_sum/outside_sums.py"]
)
def test_a_changed_file_repeats_exactly_its_dependents(dry, graph, path):
    readers = graph.readers(path)
    assert readers
    assert rules_of(dry(change=append_line(path))) == graph.following_rules(readers)
