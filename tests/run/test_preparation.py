"""A run refuses faults before its first job."""

import logging
from copy import deepcopy
from types import SimpleNamespace

import pytest
import yaml
from refusals import assert_says
from repository import PAPER, ROOT, TINY
from snakemake.cli import parse_config
from snakemake.settings.types import ExecMode
from snakemake.utils import update_config

from hardcontact.config.configuration import apply_effort
from hardcontact.run import preparation


def refusal_line(call, *arguments, parts=("expected", "found")):
    """Return the line of the refusal of a run, which has all parts."""
    with pytest.raises(SystemExit) as caught:
        call(*arguments)
    (line,) = str(caught.value).splitlines()
    assert_says(line, "error: ", *parts)
    return line


def planned_workflow(*configfiles):
    """Return an object like Snakemake's workflow of a planned run."""
    return SimpleNamespace(
        exec_mode=ExecMode.DEFAULT,
        configfiles=configfiles,
        config_settings=SimpleNamespace(config={}),
    )


def configured(*words):
    """Return a workflow and the configuration of the paper with words of `--config`."""
    workflow = planned_workflow()
    workflow.config_settings.config = parse_config(words)
    config = deepcopy(PAPER)
    update_config(config, workflow.config_settings.config)
    return workflow, config


@pytest.mark.parametrize(
    ("rules_folder", "main", "working"),
    [
        ("other", "other/Snakefile", ROOT),
        (ROOT, "Snakefile", ROOT),
        (ROOT, ROOT / "Snakefile", "."),
    ],
)
def test_a_run_in_another_folder_is_refused(tmp_path, monkeypatch, rules_folder, main, working):
    monkeypatch.chdir(tmp_path / working)
    monkeypatch.setattr(logging, "raiseExceptions", True)
    folder = SimpleNamespace(get_path_or_uri=lambda secret_free: tmp_path / rules_folder)
    workflow = SimpleNamespace(current_basedir=folder, main_snakefile=tmp_path / main)
    assert_says(refusal_line(preparation.prepare_run, workflow), str(tmp_path), str(ROOT))


def test_the_grids_of_the_paper_are_refused_for_own_surfaces():
    quick = ROOT / "config/quick.yaml"
    for configfiles in ((quick, ROOT / TINY), (ROOT / TINY, quick)):
        workflow = planned_workflow(*configfiles)
        line = refusal_line(
            preparation.complete_configuration, workflow, PAPER | {"published": "none"}
        )
        assert_says(line, "config/quick.yaml", "--config effort=quick")


def test_keys_of_the_quick_study_are_checked_in_a_full_run():
    overlay = {"quick": {"contact": {"contacts_per_row": 0}}}
    line = refusal_line(preparation.complete_configuration, planned_workflow(), PAPER | overlay)
    assert_says(line, "effort quick", "contact.contacts_per_row", "found 0")


def test_a_study_of_the_project_has_other_values_only_if_asked():
    preparation.complete_configuration(*configured("contact={hardness: 25GPa}"))  # the same
    harder = "contact={hardness: 30 GPa}"
    line = refusal_line(preparation.complete_configuration, *configured(harder))
    assert_says(
        line, "study paper", "contact.hardness: '30 GPa' in place of '25 GPa'", "overwrite=true"
    )
    for words in ((harder, "overwrite=true"), (harder, "study=harder")):
        preparation.complete_configuration(*configured(*words))


def test_a_run_says_which_values_of_an_earlier_run_it_replaces(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    earlier = tmp_path / "results/harder/configuration.yaml"
    earlier.parent.mkdir(parents=True)
    harder = {"study": "harder", "contact": PAPER["contact"] | {"hardness": "30 GPa"}}
    earlier.write_text(yaml.safe_dump(PAPER | harder), "utf-8")
    for hardness, line in (("30 GPa", ""), ("40 GPa", "'40 GPa' in place of '30 GPa'")):
        words = (f"contact={{hardness: {hardness}}}", "study=harder")
        preparation.complete_configuration(*configured(*words))
        printed = capsys.readouterr().err
        assert line in printed
        assert bool(printed) == bool(line)
    for edited in ("unknown: key", "contact: {hardness: 3"):
        earlier.write_text(edited, "utf-8")
        preparation.complete_configuration(*configured("study=harder"))
        assert capsys.readouterr().err == ""


def test_a_quick_study_has_its_own_folders():
    own_configuration = PAPER | {"study": "own", "store": "results/own-store", "effort": "quick"}
    harder = {"study": "harder", "contact": PAPER["contact"] | {"hardness": "30 GPa"}}
    quick = {"quick": {"contact": {"contacts_per_row": 6}}}
    for overlays, study in (({}, "own-quick"), (harder, "harder-quick")):
        config = apply_effort(own_configuration | quick | overlays)
        assert (config["study"], config["store"]) == (study, "results/own-store-quick")
        assert apply_effort(config) == config
        assert config["contact"]["contacts_per_row"] == 6


@pytest.mark.parametrize("text", ["2026-13-45", "'a: b: c'", "four", "2.5"])
def test_a_faulty_value_of_the_command_line_is_refused_with_its_key(text):
    arguments = configured(f"asperities={{contacts: {text}}}")
    line = refusal_line(preparation.complete_configuration, *arguments)
    assert_says(line, "config key asperities.contacts", "a whole number", text.strip("'"))
