"""Configurations are read as numbers, or refused; targets and documentation follow from them."""

import datetime

import pytest
from refusals import assert_says, refusal
from repository import ROOT
from studies import paper_configuration

from hardcontact.config import configuration, key_tables
from hardcontact.config.faults import collect_faults, raise_faults
from hardcontact.config.user_files import refuse_unreadable


@pytest.mark.parametrize(
    ("key", "value", "message_parts"),
    [
        ("study", "lock.txt", ["study:", "without .txt at the end", "'lock.txt'"]),
        ("study", "my ", ["study:", "letters", "'my '"]),
        ("study", "store", ["store:", "apart from results/store", "results/store"]),
        ("studdy", "a", ["(top level)", "found studdy (did you mean study?)"]),
        ("hardness", "3 GPa", ["found hardness (did you mean contact: {hardness: ...}?)"]),
        ("a\nb", 1, ["(top level)", "found 'a\\nb'"]),
        ("substitutes.pixel", 5, ["substitutes:", "found pixel (did you mean pixels?)"]),
        ("sphere", "ruby", ["sphere:", "a mapping", "found 'ruby'"]),
        ("effort", "quik", ["effort: expected full or quick, found 'quik'"]),
        ("band.sphere_roughness", "yes", ["true or false", "found 'yes'"]),
        ("contact.preload", 1e-5, ["a force with a unit, such as 10uN,", "found 1e-05"]),
        ("contact.hardness", "30 Gpa", ["found '30 Gpa' (did you mean GPa?)"]),
        ("sphere.radius", "-250 um", ["sphere.radius:", "10 nm to 1 m", "-250 um"]),
        ("band.short.cutoffs", ["1e300 nm"], ["cutoffs.0:", "10 pm to 1 m", "'1e300 nm'"]),
        ("band.short.cutoffs", [], ["band.short.cutoffs:", "at least 1 item,"]),
        ("scans", "some", ["scans:", "expected a list", "'some'"]),
        ("contact.contacts_per_row", 0, ["greater than or equal to 1,", "found 0"]),
        ("contact.contacts_per_row", datetime.date(2026, 1, 2), ["a whole", "found 2026-01-02"]),
        ("band.short.pixels", 8191, ["band.short.pixels:", "a multiple of 2", "found 8191"]),
        ("intervals.confidence", float("nan"), ["intervals.confidence:", "a finite number", "nan"]),
        ("store", "results/../a", ["store:", "letters", "'results/../a'"]),
    ],
)
def test_a_faulty_value_is_refused_with_its_key(key, value, message_parts):
    message = refusal(paper_configuration, {key: value})
    assert_says(message, "config key ", "expected", *message_parts)


@pytest.mark.parametrize(
    ("content", "message_part"),
    [
        (b"", "found: nothing"),
        (b"- 1", "found: [1]"),
        ("a: 1".encode("utf-16"), "'utf-8' codec"),
        (b"a: 1\0", "#x0000"),
        (b"a: 1\nb:\n\t- 1", "line 3"),
        (b"a: 1\n---\nb: 2", "line 2"),
        (
            b"substitutes: {size: 1 nm}\ncontact: {contacts_per_row: 1}\nsubstitutes: {pixels: 2}",
            "key substitutes again",
        ),
        (b"contact:\n  contacts_per_row: 1\n  contacts_per_row: 2", "line 3"),
        (b"a: 2026-13-45", "month"),
        pytest.param(b"a: " + b"9" * 5000, "4300 digits", id="many digits"),
        pytest.param(b"a: " + b"[" * 1_000, "maximum recursion depth", id="deep lists"),
        (b"a: !!python/object/apply:os.mkdir [made]", "line 1"),
        (None, "Is a directory"),
    ],
)
def test_a_file_that_is_no_configuration_is_refused(tmp_path, content, message_part):
    path = tmp_path / "a.yaml"
    path.mkdir() if content is None else path.write_bytes(content)
    message = refusal(refuse_unreadable, path)
    assert message.startswith(f"{path}: expected YAML with keys at its top, found: ")
    assert_says(message, message_part)
    assert len(message.splitlines()) == 1 and len(message) < len(str(path)) + 200


def test_each_fault_is_reported_once_in_order():
    faults = []
    for lines in (["b: expected"], [], ["a: expected", "b: expected"]):
        with collect_faults(faults):
            raise_faults(lines)
    assert refusal(raise_faults, faults) == "b: expected\na: expected"
    with pytest.raises(ZeroDivisionError), collect_faults(faults):  # not a fault of the input
        1 / 0  # noqa: B018


DOCUMENTATION = (ROOT / "config/README.md").read_text("utf-8")


def test_the_configuration_and_its_documentation_are_made_from_the_keys():
    remedy = "not current: run python -m hardcontact.config.key_tables"
    assert key_tables.configuration_yaml() == (ROOT / "config/config.yaml").read_text("utf-8"), (
        remedy
    )
    assert key_tables.update_columns(DOCUMENTATION) == DOCUMENTATION, remedy


def test_quantities_of_the_paper_are_assumed_unless_they_are_given():
    contact = {"hardness": "5 GPa", "preload": "10 uN"}
    config = configuration.numeric_configuration({"contact": contact})
    assumed = configuration.assumed_quantities(config | {"given_quantities": ["work", "radius"]})
    assert assumed == ["preload", "range of adhesion"]
