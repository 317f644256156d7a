"""Checks before the first job of a run, which refuse in one line a run that would fail."""

import logging
import os
import sys
import tempfile
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

import yaml
from snakemake.io import strip_wildcard_constraints
from snakemake.settings.types import ExecMode
from snakemake.utils import min_version

from hardcontact.base.published import surfaces_of_table1
from hardcontact.config.configuration import (
    apply_effort,
    get_key,
    merge,
    read_yaml,
    refuse_unreadable,
)
from hardcontact.config.faults import key_fields, run_checks, shorten
from hardcontact.config.model import NONE, Study, numeric_configuration
from hardcontact.config.selected_surfaces import (
    Selection,
    digest_files,
    selected_scans,
    surface_table,
)
from hardcontact.files.patterns import Patterns
from hardcontact.records.code import ROOT, code_inputs
from hardcontact.records.origin import digests, refuse_changed
from hardcontact.records.packages import refuse_other_versions, write_pins
from hardcontact.run.endings import end_at_interrupt
from hardcontact.run.reruns import MIN_SNAKEMAKE, plan_by_records

#: Size in bytes up to which a job keeps freed memory for its next array. Returning it to the system
#: costs some jobs a fifth of their time.
REUSED_MEMORY = 256 * 1024**2


def _refuse(message: object) -> NoReturn:
    """End the run with one line per fault."""
    sys.exit("\n".join(f"error: {line}" for line in str(message).splitlines()))


def prepare(workflow: Any) -> None:
    """Refuse a run that would fail with any configuration."""
    min_version(MIN_SNAKEMAKE)
    # On a full disk Snakemake's own log cannot be written: what it prints is enough, no tracebacks.
    logging.raiseExceptions = False
    _refuse_elsewhere(workflow)
    # The jobs inherit them; those that a user has set stay.
    os.environ.setdefault("MALLOC_MMAP_THRESHOLD_", str(REUSED_MEMORY))
    os.environ.setdefault("MALLOC_TRIM_THRESHOLD_", str(REUSED_MEMORY))
    refuse_unwritable_folders(".snakemake")  # Snakemake's own attempt ends in a traceback.
    if _plans_the_run(workflow):
        _refuse_touch()
        end_at_interrupt(workflow)
        try:
            refuse_other_versions()
        except ValueError as error:
            _refuse(error)
        plan_by_records(workflow)


def _refuse_touch() -> None:
    """Refuse to renew times, which decide nothing; without files Snakemake ends in a traceback."""
    if {"--touch", "-t"} & {*sys.argv[1:]}:
        _refuse(
            "snakemake: --touch has no effect, because records of inputs, not file times, decide "
            "what runs again; `snakemake -n` lists the jobs"
        )


def _refuse_elsewhere(workflow: Any) -> None:
    """Refuse another clone's library, use as a module, and another working directory."""
    rules_folder = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).resolve()
    snakefile = Path(workflow.main_snakefile).resolve()
    working_folder = Path.cwd().resolve()
    if working_folder != ROOT or not (
        rules_folder.is_relative_to(ROOT) and snakefile.is_relative_to(ROOT)
    ):
        _refuse(
            f"working directory: expected {ROOT}, because this environment has its library "
            f"(README.md), found {working_folder}, with {snakefile} and the rules of {rules_folder}"
        )


def _plans_the_run(workflow: Any) -> bool:
    """Return True if this process plans the run; False if it executes a job of the run."""
    return bool(workflow.exec_mode == ExecMode.DEFAULT)


def finished_configuration(config: Mapping[str, Any]) -> str:
    """Return the path of the configuration of a finished study.

    The key `study` of the command line names the study; without it, the study is the paper's. A
    missing or changed configuration is refused.
    """
    path = f"results/{config.get('study', 'paper')}/configuration.yaml"
    if not os.path.isfile(path):
        _refuse(f"{path}: expected the configuration of a finished study, found no such file")
    try:
        refuse_changed(digests([path]))
    except ValueError as error:
        _refuse(error)
    return path


def checked_configuration(workflow: Any, config: dict[str, Any]) -> dict[str, Any]:
    """Complete the configuration that Snakemake merged; return it with quantities as numbers.

    Files and values of the command line are read alike: nested values of the latter, which
    Snakemake leaves as text, become those of YAML. Keys under `quick` are checked even where they
    are not used. A faulty configuration is refused.
    """
    try:
        if _plans_the_run(workflow):
            files = map(os.path.relpath, workflow.configfiles)
            run_checks(partial(refuse_unreadable, path) for path in files)
            _refuse_grids_of_paper(workflow, config)
        command_line = workflow.config_settings.config
        nested = {key: item for key, item in command_line.items() if not isinstance(item, str)}
        config.update(apply_effort(merge(config, yaml_values(nested))))
        overwrite = yaml_values(config.pop("overwrite", False))
        numbers = numeric_configuration(config)
        if _plans_the_run(workflow) and overwrite is not True:
            _refuse_unnamed(config)
        if numbers["quick"]:
            numeric_configuration(apply_effort(config | {"effort": "quick"}), "effort quick: ")
        return numbers
    except ValueError as error:
        _refuse(error)


def _refuse_grids_of_paper(workflow: Any, config: Mapping[str, Any]) -> None:
    """Refuse the paper's quick grids for the user's surfaces, in either order of overlays."""
    quick = ROOT / "config/quick.yaml"
    if config["published"] == NONE and quick in map(Path.resolve, map(Path, workflow.configfiles)):
        raise ValueError(
            "--configfile: expected --config effort=quick for your surfaces (published: none), "
            "found config/quick.yaml, whose grids are for the surfaces of the paper"
        )


def _refuse_unnamed(config: Mapping[str, Any]) -> None:
    """Refuse other values for a study whose name is the project's own."""
    name = config["study"]
    project_config = read_yaml("config/config.yaml")
    if name == "quick":
        project_config = merge(project_config, read_yaml("config/quick.yaml"))
    if name != project_config["study"]:
        return
    numbers, asked_numbers = numeric_configuration(project_config), numeric_configuration(config)
    changes = [
        f"{key}: {shorten(get_key(config, key))} for {shorten(get_key(project_config, key))}"
        for key, _ in key_fields(Study)
        if key != "quick" and get_key(numbers, key) != get_key(asked_numbers, key)
    ]
    if changes:
        raise ValueError(
            f"study {name}: expected the values of the project, found {', '.join(changes)}: give "
            f"the study a name (study: my-name), or replace results/{name} with --config "
            "overwrite=true"
        )


def yaml_values(value: Any) -> Any:
    """Return a value whose texts, at any depth, are read as YAML; text that is no YAML stays."""
    if isinstance(value, dict):
        return {key: yaml_values(item) for key, item in value.items()}
    if isinstance(value, list):
        return [yaml_values(item) for item in value]
    try:
        return yaml.safe_load(value) if isinstance(value, str) else value
    except (ValueError, yaml.YAMLError):
        return value


def checked_selection(workflow: Any, configuration: dict[str, Any]) -> Selection:
    """Return the surfaces and scans of the study; refuse a study that would fail later."""
    try:
        rows = selected_scans(surface_table(configuration["surfaces"]), configuration["scans"])
        if _plans_the_run(workflow):
            # Imported here, as the libraries that read scans would cost every job almost a second.
            from hardcontact.run.checks import check_study

            check_study(configuration, rows)
        write_pins()  # A run that is refused writes nothing.
    except ValueError as error:
        _refuse(error)
    return Selection(
        rows, configuration["sphere"]["surface"], digest_files(rows), surfaces_of_table1()
    )


def complete_rules(workflow: Any, patterns: Patterns) -> None:
    """Give each rule with a script a log and, if it writes files, its code and a benchmark.

    Its code, the script and what this imports, are inputs, because a change of these makes files
    anew. A rule may name more code.
    """
    for rule in workflow.rules:
        if rule.norun:
            continue
        # What Snakemake itself does for the directives `log` and `benchmark`.
        rule.log_modifier = rule.benchmark_modifier = workflow.modifier.path_modifier
        output = strip_wildcard_constraints(rule.output[0]) if rule.output else ""
        rule.set_log(patterns.run_file("logs", ".log", rule.name, output))
        if rule.output:
            rule.benchmark = patterns.run_file("benchmarks", ".tsv", rule.name, output)
            if "code" not in rule.input.keys():
                rule.set_input(code=code_inputs(Path(rule.script).name))


def refuse_unwritable_folders(*folders: str) -> None:
    """Refuse folders that cannot be written to."""
    for folder in folders:
        try:
            Path(folder).mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            _refuse(f"{folder}: expected a folder to write to, found: {error.strerror}")
