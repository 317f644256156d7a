"""The repository: its parts, its configuration, copies of it, and Snakemake run in a copy."""

import os
import shutil
import sys
from pathlib import Path

import yaml
from forked_runs import fork_jobs, load_job_packages, run_program, run_programs

ROOT = Path(__file__).parents[2]
#: Files and folders that a study needs.
STUDY_FILES = [
    "Snakefile", "environment.txt", "README.md", "CITATION.cff", "workflow", "config", "resources",
    "profiles", "tests/tiny.yaml",
]  # fmt: skip
#: The paper's study on grids so small that its numbers test nothing but the code.
TINY = "tests/tiny.yaml"
PAPER = yaml.safe_load((ROOT / "config/config.yaml").read_text())
#: The table of surfaces as text, with its header.
ROWS = (ROOT / "config/surfaces.tsv").read_text()
#: The header of a description of a substitute.
DESCRIPTION_HEADER = (
    "longest_nm,shortest_nm,model,plateau_nm4,rolloff_nm,hurst,hurst_change,table,evidence,source\n"
)
#: Folders that tools leave in the repository.
CACHES = shutil.ignore_patterns("__pycache__", "*.egg-info")


def copy_repository(target, source=ROOT, ignore=CACHES):
    """Copy the files that a study needs, without results; return `target`."""
    (target / "tests").mkdir(parents=True)
    for name in STUDY_FILES:
        if (source / name).is_dir():
            shutil.copytree(source / name, target / name, ignore=ignore)
        else:
            shutil.copy2(source / name, target / name)
    return target


def linked_copy(finished, folder):
    """Copy the sources of a finished study, to be changed, and link its results."""
    copy_repository(folder, finished, ignore=None)
    for name in ("results", ".snakemake"):
        (folder / name).symlink_to(finished / name)
    return folder


def environment(folder):
    """Return the environment that makes a copy of the repository use its own library.

    The installed package is the library of the original.
    """
    paths = {"PATH": Path(sys.executable).parent, "PYTHONPATH": Path(folder, "workflow")}
    return os.environ | {
        name: os.pathsep.join(filter(None, [str(path), os.environ.get(name)]))
        for name, path in paths.items()
    }


def run_snakemake(folder, *arguments):
    """Run Snakemake in a copy of the repository; return the exit code and the output."""
    return run_program(folder, "snakemake.cli", arguments, environment(folder))


def run_snakemake_with_forks(folder, *arguments):
    """As `run_snakemake`, with jobs as forks: most take less time than a Python needs to start."""
    load_job_packages()
    (run,) = run_programs(folder, "snakemake.cli", [arguments], environment(folder), fork_jobs)
    return run


def snakemake_outputs(folder, runs):
    """Return the outputs of several runs without jobs, which load the library of a copy once."""
    results = run_programs(folder, "snakemake.cli", runs, environment(folder), load_library)
    assert [run.stdout for run in results if run.returncode] == []
    return [run.stdout for run in results]


def load_library():
    """Import most of what a run imports before its jobs, and find the code of all scripts."""
    from hardcontact.records.code import SCRIPTS, code_inputs
    from hardcontact.run import checks, preparation, reruns  # noqa: F401

    for script in SCRIPTS.glob("*.py"):
        code_inputs(script.name)


def run_tiny_study(folder, *arguments, overlays=()):
    """Run the tiny study in a copy of the repository, with further overlays (dicts)."""
    files = [TINY]
    for number, overlay in enumerate(overlays):
        files.append(f"overlay-{number}.yaml")
        Path(folder, files[-1]).write_text(yaml.safe_dump(overlay))
    return run_snakemake_with_forks(folder, *arguments, "--configfile", *files)


def dotted_keys(tree, path=()):
    """Yield the keys of a configuration, with dots between their parts."""
    for key, value in tree.items():
        if isinstance(value, dict) and value:
            yield from dotted_keys(value, (*path, key))
        else:
            yield ".".join((*path, key))
