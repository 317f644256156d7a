"""The rerun matrix: what a dry run would make after each possible change, and nothing else."""

import csv
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
from multiprocessing.pool import ThreadPool

import pytest
import yaml
from changes import ALL, CHANGES, COLUMNS, FILES, SCRIPTS, with_line
from key_changes import KEYS, KEYS_OF_OWN_SURFACES, KEYS_OF_VARIANTS
from repository import PAPER, PARTS, QUICK, ROOT, SCHEMAS, environment, leaves, run_snakemake
from rule_graph import DRAWN, all_following
from snakemake.cli import main as snakemake

pytestmark = pytest.mark.study

LIBRARY = ROOT / "workflow/hardcontact"
#: Modules that are changed: the first of every folder, and all beside the folders. Of all others
#: it is enough that a job has them as inputs.
MODULES = sorted(
    path.relative_to(ROOT).as_posix()
    for path in [
        *(sorted(room.glob("[a-z]*.py"))[0] for room in LIBRARY.glob("[a-z]*/")),
        *LIBRARY.glob("[a-z]*.py"),
    ]
)

#: Imports what a script imports; then, for they may come later, all imports inside of functions.
LOAD = """
import ast, importlib, inspect, sys
def imports(path):
    for node in ast.walk(ast.parse(open(path).read())):
        if isinstance(node, ast.Import | ast.ImportFrom) and "hardcontact" in ast.unparse(node):
            yield ast.unparse(node)
def modules():
    return {m.__file__ for name, m in sys.modules.items() if name.split(".")[0] == "hardcontact"}
pending, done = {sys.argv[1]}, set()
for name in sys.argv[2:]:
    importlib.import_module(name)
while pending := (pending | modules()) - done:
    for path in pending:
        for line in imports(path):
            exec(line)
    done |= pending
    pending = set()
print(*modules(), sep="\\n")
"""


def loaded(script, *modules):
    """Return the modules of the library, as paths, that a script and given modules load."""
    run = subprocess.run(
        [sys.executable, "-c", LOAD, str(ROOT / "workflow/scripts" / script), *modules],
        env=environment(ROOT),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return {os.path.relpath(path, ROOT) for path in run.stdout.split()}


def run_dry(folder):
    """Run Snakemake dry in a folder, in this process; what it prints goes to a file there."""
    os.chdir(folder)
    # With its own library, not with that of this process.
    for name in [name for name in sys.modules if name.partition(".")[0] == "hardcontact"]:
        del sys.modules[name]
    sys.path.insert(0, str(folder / "workflow"))
    sys.stdout = sys.stderr = open("output", "w", buffering=1)
    snakemake(["-n", "--configfile", QUICK, "overlay.yaml"])


def dry_run(folder):
    """Return the rules of a dry run in a folder that shares the finished results, or its error.

    In a process that is forked where Snakemake is imported: this saves half of the time.
    """
    process = multiprocessing.get_context("fork").Process(target=run_dry, args=(folder,))
    process.start()
    process.join()
    text = (folder / "output").read_text()
    if process.exitcode:
        return text
    return set(re.findall(r"^(?:local)?rule (\w+):\n", text, re.M)) - {"all"}


@pytest.fixture(scope="module")
def loads():
    """Rule -> modules that its script loads, those included that it draws by."""
    programs = {
        rule: ("draw_figure.py", f"hardcontact.figures.{rule.removeprefix('draw_')}")
        if rule in DRAWN
        else (f"{rule}.py",)
        for rule in sorted(ALL)
    }
    with ThreadPool(2) as pool:
        return dict(zip(programs, pool.starmap(loaded, programs.values()), strict=True))


@pytest.fixture(scope="module")
def inputs(finished):
    """Rule -> the modules among the inputs of each of its jobs, as Snakemake sums them up."""
    lines = run_snakemake(finished, "--detailed-summary").stdout.splitlines()
    header = next(number for number, line in enumerate(lines) if line.startswith("output_file\t"))
    modules = {}
    for row in csv.DictReader(lines[header:], delimiter="\t"):
        paths = row["input-file(s)"].split(",")
        library = {path for path in paths if path.startswith("workflow/hardcontact/")}
        modules.setdefault(row["rule"], []).append(library)
    return modules


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
        rules = pool.map(dry_run, requests.values(), chunksize=1)
    shutil.rmtree(top)
    return dict(zip(requests, rules, strict=True))


def test_every_key_is_in_the_matrix():
    matrix = [*KEYS, *KEYS_OF_VARIANTS, *KEYS_OF_OWN_SURFACES, "effort"]
    assert sorted(matrix) == sorted(leaves(PAPER))


def test_every_column_is_in_the_matrix():
    """But for one that a substitute has no text in: test_job_counts.py changes it."""
    assert {*COLUMNS, "dataset"} == SCHEMAS["surfaces"]["properties"].keys()


def test_every_resource_is_in_the_matrix():
    used = {
        path.relative_to(ROOT).as_posix()
        for folder in ("paper", "spectra")
        for path in (ROOT / "resources" / folder).glob("*.csv")
    }
    other = {  # alternatives that no surface names
        f"resources/spectra/{name}.csv" for name in ("ncd-published", "uncd-measured", "uncd-tem")
    }
    of_crn = ROOT / "config/crn.tsv"  # surfaces of a study of their own
    other |= {line.split("\t")[4] for line in of_crn.read_text("utf-8").splitlines()}
    assert used - other <= set(FILES)


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_reruns_what_depends_on_it(reruns, name):
    assert reruns[name] == CHANGES[name][2]


@pytest.mark.parametrize("rule", sorted(ALL))
def test_the_modules_that_a_script_loads_are_inputs_of_its_jobs(loads, inputs, rule):
    """So that a change of one has the effect of a change of the script, which is in the matrix."""
    assert rule in inputs
    for modules in inputs[rule]:
        assert modules == loads[rule]


@pytest.mark.parametrize("path", MODULES)
def test_a_module_reruns_the_rules_whose_scripts_load_it(reruns, loads, path):
    assert reruns[path] == all_following({rule for rule in loads if path in loads[rule]})


def test_no_script_reads_the_configuration():
    for name in SCRIPTS:
        text = (ROOT / "workflow/scripts" / name).read_text()
        assert not re.search(r"snakemake\.config|config\[|\.yaml['\"]", text), name
