"""The preparation of a run: its surroundings, its configuration, its surfaces and all its rules.

A study that would fail later is refused.
"""

import logging
import os
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml
from snakemake.io import strip_wildcard_constraints
from snakemake.settings.types import ExecMode
from snakemake.utils import min_version

from hardcontact.base.published import surfaces_of_table1
from hardcontact.config.configuration import (
    apply_effort,
    get_key,
    is_paper_study,
    merge_overlay,
    numeric_configuration,
)
from hardcontact.config.faults import key_fields, shorten
from hardcontact.config.keys import Study
from hardcontact.config.selected_surfaces import (
    Selection,
    digest_surfaces,
    selected_scans,
    surface_table,
)
from hardcontact.config.user_files import read_yaml
from hardcontact.files.paths import StudyPaths
from hardcontact.records.code import ROOT, code_inputs, refuse_other_versions
from hardcontact.records.origin import file_digests, refuse_edited_files
from hardcontact.run.ending import end_run_at_fault, kill_run_at_next_interrupt, refuse
from hardcontact.run.reruns import MIN_SNAKEMAKE, plan_by_records

#: Size in bytes up to which a job keeps freed memory for its next array. Returning it to the system
#: costs some jobs a fifth of their time.
REUSED_MEMORY = 256 * 1024**2


def prepare_run(workflow: Any) -> None:
    """Refuse a run that would fail with any configuration; otherwise prepare this process."""
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
    """Refuse a run in another folder than the top folder of the clone whose library is installed.

    The rules and the main Snakefile must be in this clone, too. So no other workflow can use the
    rules as a module.
    """
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
    """Make folders, and refuse those that cannot be written to."""
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
    """Add to each rule with a script a log and, if it writes files, a benchmark and its code.

    The input `code` is the script and the modules that it imports, so that changed code makes the
    outputs again. `workflow/README.md` shows a rule as written and as run.
    """
    for rule in workflow.rules:
        if rule.norun:  # It has no script, only inputs.
            continue
        # What Snakemake itself does for the directives `log` and `benchmark`.
        rule.log_modifier = rule.benchmark_modifier = workflow.modifier.path_modifier
        output = strip_wildcard_constraints(rule.output[0]) if rule.output else ""
        rule.set_log(paths.run_file("logs", ".log", rule.name, output))
        if rule.output:
            rule.benchmark = paths.run_file("benchmarks", ".tsv", rule.name, output)
            if "code" not in rule.input.keys():
                rule.set_input(code=code_inputs(Path(rule.script).name))


def finished_configuration(config: Mapping[str, Any]) -> str:
    """Return the path of the configuration of a finished study, by default the paper's."""
    path = f"results/{config.get('study', 'paper')}/configuration.yaml"
    if not os.path.isfile(path):
        refuse(f"{path}: expected the configuration of a finished study, found no such file")
    with end_run_at_fault():
        refuse_edited_files(file_digests([path]))
    return path


def complete_configuration(workflow: Any, config: dict[str, Any]) -> dict[str, Any]:
    """Complete, in place, the configuration that Snakemake merged; return it as numbers."""
    with end_run_at_fault():
        if plans_the_run(workflow):
            _refuse_grids_of_paper(workflow, config)
        # Snakemake leaves nested values of the command line as text.
        command_line = workflow.config_settings.config
        nested = {key: item for key, item in command_line.items() if not isinstance(item, str)}
        config.update(apply_effort(merge_overlay(config, yaml_values(nested))))
        # No key of a study: it lets other values replace the paper's study.
        overwrite = yaml_values(config.pop("overwrite", False))
        study = numeric_configuration(config)
        if plans_the_run(workflow):
            if overwrite is not True:
                _refuse_changed_project_study(config)
            _announce_changed_values(config)
        if study["quick"]:  # Its keys are checked even if they are not used.
            numeric_configuration(apply_effort(config | {"effort": "quick"}), "effort quick: ")
        return study


def _refuse_grids_of_paper(workflow: Any, config: Mapping[str, Any]) -> None:
    """Refuse the paper's quick grids for your surfaces, in either order of overlays."""
    quick = ROOT / "config/quick.yaml"
    overlays = [Path(path).resolve() for path in workflow.configfiles]
    if not is_paper_study(config) and quick in overlays:
        raise ValueError(
            "--configfile: expected --config effort=quick for your surfaces (published: none), "
            "found config/quick.yaml, whose grids are for the surfaces of the paper"
        )


def _refuse_changed_project_study(config: Mapping[str, Any]) -> None:
    """Refuse a study with the name of the paper's full or quick study, but with other values."""
    name = config["study"]
    project = read_yaml("config/config.yaml")
    if name == "quick":
        project = merge_overlay(project, read_yaml("config/quick.yaml"))
    if name != project["study"]:
        return
    if changes := _changed_values(config, project):
        raise ValueError(
            f"study {name}: expected the values of the project, found {', '.join(changes)}: give "
            f"the study a name (study: my-name), or replace results/{name} with --config "
            "overwrite=true"
        )


def _announce_changed_values(config: Mapping[str, Any]) -> None:
    """Print the values that differ from those of an earlier run of this study."""
    path = Path(f"results/{config['study']}/configuration.yaml")
    try:
        changes = _changed_values(config, yaml.safe_load(path.read_text("utf-8")))
    except (OSError, KeyError, ValueError, yaml.YAMLError):  # not there, of another version, edited
        return
    if changes:
        line = f"study {config['study']}: makes again what depends on {', '.join(changes)}"
        print(line, file=sys.stderr, flush=True)


def _changed_values(config: Mapping[str, Any], reference: Mapping[str, Any]) -> list[str]:
    """Return the keys with other values than in a reference configuration, and both values."""
    study, reference_study = numeric_configuration(config), numeric_configuration(reference)
    return [
        f"{key}: {shorten(get_key(config, key))} in place of {shorten(get_key(reference, key))}"
        for key, _ in key_fields(Study)
        if key != "quick" and get_key(reference_study, key) != get_key(study, key)
    ]


def yaml_values(value: Any) -> Any:
    """Return a value with its texts, at any depth, read as YAML; text that is no YAML stays."""
    if isinstance(value, dict):
        return {key: yaml_values(item) for key, item in value.items()}
    if isinstance(value, list):
        return [yaml_values(item) for item in value]
    try:
        return yaml.safe_load(value) if isinstance(value, str) else value
    except (ValueError, yaml.YAMLError):
        return value


def checked_selection(workflow: Any, study: dict[str, Any]) -> Selection:
    """Return the surfaces and scans of the study; refuse a study that would fail later."""
    with end_run_at_fault():
        rows = selected_scans(surface_table(study["surfaces"]), study["scans"])
        if plans_the_run(workflow):
            # Imported here, as the libraries that read scans would cost every job almost a second.
            from hardcontact.run.checks import check_study

            check_study(study, rows)
    return Selection(rows, study["sphere"]["surface"], digest_surfaces(rows), surfaces_of_table1())
