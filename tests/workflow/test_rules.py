"""Snakemake finds no fault in the rules, and the cluster profile fits them."""

import re

import pytest
import yaml
from repository import ROOT, run_snakemake, snakemake_outputs

from hardcontact.report.figures.listing import PAPER_FIGURES
from snakemake_logger_plugin_stages.command_line import PAPER_TARGETS

pytestmark = pytest.mark.study

PROFILE = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())


@pytest.fixture(scope="module")
def rules(repository):
    """Return the names of all rules of the paper's study and its targets."""
    (output,) = snakemake_outputs(repository, [["--list-rules"]])
    return {line.split()[0] for line in output.splitlines()}


def test_lint_finds_only_missing_environments(repository):
    lint_messages = re.findall(r"^    \* (.*):$", run_snakemake(repository, "--lint").stdout, re.M)
    assert set(lint_messages) == {"Specify a conda environment or container for each rule."}


def test_the_cluster_profile_names_existing_rules(rules):
    """Snakemake ignores unknown names of rules."""
    own_rules = set()
    for name in ("spectra", "both_bodies", "own_surfaces", "answer_surfaces"):
        text = (ROOT / f"workflow/rules/{name}.smk").read_text()
        own_rules |= set(re.findall(r"^ *rule (\w+):", text, re.M))
    named_rules = PROFILE["groups"].keys() | PROFILE["set-resources"].keys()
    assert named_rules - rules - own_rules == set()
    assert PROFILE["default-resources"].keys() == {"mem_mb", "runtime"}
    assert set(PROFILE["groups"].values()) == PROFILE["group-components"].keys()


def test_the_cluster_profile_groups_the_rules_that_end_soon(rules):
    """Rules of one short job, such as a figure, share SLURM jobs."""
    short_rules = {rule for rule in rules if re.match("aggregate|answer|compare|draw", rule)}
    # `answer` is a target.
    assert short_rules - {"answer"} - PROFILE["groups"].keys() == set()


def test_messages_name_the_targets(rules):
    assert {*PAPER_TARGETS, *PAPER_FIGURES} <= rules
