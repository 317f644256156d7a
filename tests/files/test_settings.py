"""The digest of a kind of intermediate covers all on which its files depend."""

import re

import pytest
from repository import ROOT
from studies import study_files

from hardcontact.files.settings import settings_digest, store_kinds


def test_rules_of_intermediates_take_no_values_of_the_configuration_but_settings():
    """Paths have the digest of the settings: of all that a rule takes from keys."""
    rules = []
    for path in (ROOT / "workflow/rules").glob("*.smk"):
        rules += re.findall(r"^ *rule\b.*?^ *output:(.*?)^ *script:", path.read_text(), re.M | re.S)
    parameters = [rule.partition("params:")[2] for rule in rules if "STORE." in rule]
    assert parameters
    values = re.compile(r"\b(STUDY|CONTACT_ARGUMENTS|SAMPLING|config)\b|PLAN\.contact\b")
    assert [text for text in parameters if values.search(text)] == []


@pytest.mark.parametrize("kind", ["both_bodies", "hindcast", "octave_forces", "masters", "sampled"])
def test_files_with_the_roughness_of_another_sphere_have_another_digest(project_folder, kind):
    plan = study_files({"published": "none"}, measured_surfaces=["uncd", "ruby"]).plan
    digests = set()
    for plan.selection.sphere_digest in ("first", "second"):
        digests.add(settings_digest(store_kinds(plan), kind))
    assert len(digests) == 2
