"""Snakemake finds no fault in the rules, and the cluster profile fits them."""

import re

import yaml
from repository import ROOT, snakemake


def test_lint_finds_only_missing_environments(repository):
    lint_messages = re.findall(r"^    \* (.*):$", snakemake(repository, "--lint").stdout, re.M)
    assert set(lint_messages) == {"Specify a conda environment or container for each rule."}


def test_the_cluster_profile_names_existing_rules(repository):
    """Snakemake ignores unknown names of rules."""
    rules = {line.split()[0] for line in snakemake(repository, "--list-rules").stdout.splitlines()}
    for name in ("own_surfaces", "answer_surfaces"):  # of studies of own surfaces
        text = (repository / f"workflow/rules/{name}.smk").read_text()
        rules |= set(re.findall(r"^ *rule (\w+):", text, re.M))
    profile = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())
    assert (profile["groups"].keys() | profile["set-resources"].keys()) - rules == set()
    assert profile["default-resources"].keys() == {"mem_mb", "runtime"}
    assert set(profile["groups"].values()) == profile["group-components"].keys()


def test_the_cluster_profile_groups_the_rules_that_end_soon(repository):
    """Rules of one short job, such as a figure, share SLURM jobs."""
    rules = {line.split()[0] for line in snakemake(repository, "--list-rules").stdout.splitlines()}
    short_rules = {rule for rule in rules if re.match("aggregate|answer|compare|draw|judge", rule)}
    short_rules.remove("answer")  # a target
    profile = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())
    assert short_rules - profile["groups"].keys() == set()
