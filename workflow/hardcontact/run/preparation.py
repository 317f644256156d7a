"""The preparation of a run: checks of its surroundings, and parts of all rules."""

import logging
import os
import tempfile
from pathlib import Path
from typing import Any

from snakemake.io import strip_wildcard_constraints
from snakemake.settings.types import ExecMode
from snakemake.utils import min_version

from hardcontact.files.paths import StudyPaths
from hardcontact.records.code import ROOT, code_inputs, refuse_other_versions
from hardcontact.run.ending import end_run_at_fault, kill_run_at_next_interrupt, refuse
from hardcontact.run.reruns import MIN_SNAKEMAKE, plan_by_records

#: Size in bytes up to which a job keeps freed memory for its next array. Returning it to the system
#: costs some jobs a fifth of their time.
REUSED_MEMORY = 256 * 1024**2


def prepare_run(workflow: Any) -> None:
    """Refuse a run that would fail with any configuration; otherwise prepare this process.

    Jobs keep freed memory, Ctrl-C kills the run, and records decide what runs again.
    """
    min_version(MIN_SNAKEMAKE)
    # On a full disk Snakemake cannot write its log, and would print a traceback for each message.
    logging.raiseExceptions = False
    _refuse_elsewhere(workflow)
    # Jobs inherit these variables; values set by the user are kept.
    os.environ.setdefault("MALLOC_MMAP_THRESHOLD_", str(REUSED_MEMORY))
    os.environ.setdefault("MALLOC_TRIM_THRESHOLD_", str(REUSED_MEMORY))
    refuse_unwritable_folders(".snakemake")  # Snakemake's own attempt ends in a traceback.
    if plans_the_run(workflow):
        kill_run_at_next_interrupt(workflow)
        with end_run_at_fault():
            refuse_other_versions()
        plan_by_records(workflow)


def _refuse_elsewhere(workflow: Any) -> None:
    """Refuse another clone's library, use as a module, and another working directory."""
    rules_folder = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).resolve()
    snakefile = Path(workflow.main_snakefile).resolve()
    working_folder = Path.cwd().resolve()
    if working_folder != ROOT or not (
        rules_folder.is_relative_to(ROOT) and snakefile.is_relative_to(ROOT)
    ):
        refuse(
            f"working directory: expected {ROOT}, because this environment has its library "
            f"(README.md), found {working_folder}, with {snakefile} and the rules of {rules_folder}"
        )


def refuse_unwritable_folders(*folders: str) -> None:
    """Refuse folders that cannot be written to."""
    for folder in folders:
        try:
            Path(folder).mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            refuse(f"{folder}: expected a folder to write to, found: {error.strerror}")


def plans_the_run(workflow: Any) -> bool:
    """Return True if this process plans the run; False if it executes a job of the run."""
    return bool(workflow.exec_mode == ExecMode.DEFAULT)


def complete_rules(workflow: Any, paths: StudyPaths) -> None:
    """Give each rule with a script a log and, if it writes files, its code and a benchmark.

    Its code, the script and the modules that the script imports, are inputs: if they change, the
    files are made again. A rule may name more code.
    """
    for rule in workflow.rules:
        if rule.norun:
            continue
        # What Snakemake itself does for the directives `log` and `benchmark`.
        rule.log_modifier = rule.benchmark_modifier = workflow.modifier.path_modifier
        output = strip_wildcard_constraints(rule.output[0]) if rule.output else ""
        rule.set_log(paths.run_file("logs", ".log", rule.name, output))
        if rule.output:
            rule.benchmark = paths.run_file("benchmarks", ".tsv", rule.name, output)
            if "code" not in rule.input.keys():
                rule.set_input(code=code_inputs(Path(rule.script).name))
