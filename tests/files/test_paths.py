"""Paths name what files depend on: swept values, scans, and digests of all other values."""

import re

import pytest
from repository import ROOT
from studies import paper_configuration, study_files

from hardcontact.config.configuration import study_contact
from hardcontact.files.chunks import Chunks
from hardcontact.files.settings import intermediate_kinds, settings_digest

pytestmark = pytest.mark.usefixtures("project_folder")


def test_only_scans_of_the_sphere_have_its_shape():
    plan = study_files(scans=[1], measured_surfaces=["ruby", "uncd"]).plan
    assert plan.sphere_radius("ruby") == 250e3 and plan.sphere_radius("uncd") is None


def test_masters_of_substitutes_of_the_paper_have_a_scan_each_and_others_take_turns():
    plan = study_files(scans=[2, 5], measured_surfaces=["mcd"]).plan
    assert [plan.master_scan_number("uncd", number) for number in (1, 2, 3, 4)] == [2, 5, 6, 7]
    assert [plan.master_scan_number("mcd", number) for number in (1, 2, 3)] == [2, 5, 2]
    plan.study = plan.study | {"published": "none"}
    assert [plan.master_scan_number("uncd", number) for number in (1, 2, 3, 4)] == [2, 5, 2, 5]


# Forces


def force_paths(values=None):
    """Return the paths of forces on scans, pools, whole surfaces and masters."""
    files = study_files(values)
    chunks = Chunks(files)
    patterns = files.patterns
    return [
        *files.paths(patterns.pull_off, files.plan.substrate_scan_ids),
        *files.paths(patterns.pool, chunks.pools),
        *files.paths(patterns.whole_surfaces, chunks.whole_surfaces),
        *files.paths(patterns.master_forces, chunks.master_forces("edges")),
        *files.paths(patterns.master_forces, chunks.master_forces("edge_shifts")),
    ]


@pytest.mark.parametrize(
    ("key", "value", "name"),
    [
        ("sphere.radius", "300 um", "R300um"),
        ("contact.preload", "12 uN", "F12uN"),
        ("contact.hardness", "30 GPa", "H30GPa"),
        ("adhesion.range", "3 nm", "rho3nm"),
    ],
)
def test_paths_of_forces_name_swept_values(key, value, name):
    assert all(name in path for path in force_paths({key: value}))
    assert not any(name in path for path in force_paths())


def test_paths_do_not_depend_on_the_units_of_a_value():
    written_otherwise = {
        "sphere.radius": "0.25 mm", "contact.preload": "0.01 mN",
        "contact.hardness": "25000 MPa", "adhesion.range": "0.0056 um",
    }  # fmt: skip
    assert force_paths(written_otherwise) == force_paths()
    assert study_contact(paper_configuration()).loading_name == "H25GPa-F10uN"


# Digests


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
def test_files_with_the_roughness_of_another_sphere_have_another_digest(kind):
    plan = study_files({"published": "none"}, measured_surfaces=["uncd", "ruby"]).plan
    digests = set()
    for plan.selection.sphere_digest in ("first", "second"):
        digests.add(settings_digest(intermediate_kinds(plan), kind))
    assert len(digests) == 2
