"""The configuration and the surfaces of a run: a study that would fail later is refused."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

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
from hardcontact.records.code import ROOT
from hardcontact.records.origin import file_digests, refuse_edited_files
from hardcontact.run.ending import end_run_at_fault, refuse
from hardcontact.run.preparation import plans_the_run


def finished_configuration(config: Mapping[str, Any]) -> str:
    """Return the path of the configuration of a finished study, by default the paper's."""
    path = f"results/{config.get('study', 'paper')}/configuration.yaml"
    if not os.path.isfile(path):
        refuse(f"{path}: expected the configuration of a finished study, found no such file")
    with end_run_at_fault():
        refuse_edited_files(file_digests([path]))
    return path


def complete_configuration(workflow: Any, config: dict[str, Any]) -> dict[str, Any]:
    """Complete, in place, the configuration that Snakemake merged; return it as numbers.

    Snakemake leaves nested values of the command line as text; here they are parsed as YAML. Keys
    under `quick` are checked even if they are not used. `overwrite` is no key of a study: it lets
    another study replace the paper's.
    """
    with end_run_at_fault():
        if plans_the_run(workflow):
            _refuse_grids_of_paper(workflow, config)
        command_line = workflow.config_settings.config
        nested = {key: item for key, item in command_line.items() if not isinstance(item, str)}
        config.update(apply_effort(merge_overlay(config, yaml_values(nested))))
        overwrite = yaml_values(config.pop("overwrite", False))
        study = numeric_configuration(config)
        if plans_the_run(workflow) and overwrite is not True:
            _refuse_changed_project_study(config)
        if study["quick"]:
            numeric_configuration(apply_effort(config | {"effort": "quick"}), "effort quick: ")
        return study


def _refuse_grids_of_paper(workflow: Any, config: Mapping[str, Any]) -> None:
    """Refuse the paper's quick grids for the user's surfaces, in either order of overlays."""
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
    project_study = numeric_configuration(project)
    study = numeric_configuration(config)
    changes = [
        f"{key}: {shorten(get_key(config, key))} in place of {shorten(get_key(project, key))}"
        for key, _ in key_fields(Study)
        if key != "quick" and get_key(project_study, key) != get_key(study, key)
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


def checked_selection(workflow: Any, study: dict[str, Any]) -> Selection:
    """Return the surfaces and scans of the study; refuse a study that would fail later."""
    with end_run_at_fault():
        rows = selected_scans(surface_table(study["surfaces"]), study["scans"])
        if plans_the_run(workflow):
            # Imported here, as the libraries that read scans would cost every job almost a second.
            from hardcontact.run.checks import check_study

            check_study(study, rows)
    return Selection(rows, study["sphere"]["surface"], digest_surfaces(rows), surfaces_of_table1())
