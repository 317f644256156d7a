"""Bad configurations: one line, the key, what was expected and found."""

import datetime

import pytest
from refusals import assert_says, refusal
from studies import numbers

from hardcontact.config import configuration


@pytest.mark.parametrize(
    ("key", "value", "parts"),
    [
        ("studdy", "a", ["found studdy (did you mean study?)"]),
        ("effort", "quik", ["config key effort: expected full or quick, found 'quik'"]),
        ("sphere.radius", 250, ["a length with a unit, such as 5.6 nm or 250 um, found 250"]),
        ("scan.pixel", 5, ["config key scan:", "pixels", "found pixel"]),
        ("contact.hardness", "25 GPa m", ["config key contact.hardness:", "Pa", "'25 GPa m'"]),
        ("sphere.radius", "-250 um", ["config key sphere.radius:", "10 to 1e+09 nm", "-250 um"]),
        (
            "contact.preload",
            1.0e-5,
            ["config key contact.preload:", "a force with a unit, such as 10 uN,", "1e-05"],
        ),
        ("contact.preload", "nan uN", ["config key contact.preload:", "'nan uN'"]),
        ("contact.preload", "9**9**9 uN", ["config key contact.preload:", "'9**9**9 uN'"]),
        ("contact.count", 0, ["config key contact.count:", "at least 1", "found 0"]),
        ("contact.count", 20.0, ["contact.count:", "a whole number", "found 20.0"]),
        ("contact.count", datetime.date(2026, 1, 2), ["a whole number", "found 2026-01-02"]),
        ("contact.count", True, ["contact.count:", "a whole number", "found True"]),
        ("scales.small.pixels", 8191, ["scales.small.pixels:", "a multiple of 2", "found 8191"]),
        ("scales.small.cutoffs", ["1e300 nm"], ["cutoffs.0:", "0.01 to 1e+09 nm", "'1e300 nm'"]),
        ("store", "results/../a", ["config key store:", "letters", "'results/../a'"]),
        ("study", "a\n", ["config key study:", "letters", "'a\\n'"]),
        ("inference.confidence", float("nan"), ["inference.confidence:", "a number", "nan"]),
        ("a\nb", 1, ["(top level)", "found 'a\\nb'"]),
        ("scales.sphere_roughness", "yes", ["true or false", "found 'yes'"]),
        (
            "scales.small.cutoffs",
            [5],
            ["config key scales.small.cutoffs.0:", "a length with a unit", "5"],
        ),
        ("scales.small.cutoffs", [], ["config key scales.small.cutoffs:", "at least 1 entries"]),
        ("scans", "some", ["config key scans:", "expected all", "a list", "'some'"]),
        ("inference.confidence", 95, ["inference.confidence:", "at most 0.999", "found 95"]),
        ("sphere", "ruby", ["config key sphere:", "a mapping", "found 'ruby'"]),
        (
            "robustness.heights.skewness",
            [0, 0.0],
            ["robustness.heights.skewness:", "each entry once"],
        ),
    ],
)
def test_key_refused(key, value, parts):
    assert_says(refusal(numbers, key, value), "config key", "expected", *parts)


def test_quantities_become_numbers():
    config = numbers("sphere.radius", "0.25 mm", "robustness.hardnesses", ["16 GPa", "0.047 TPa"])
    assert config["sphere"]["radius"] == 250e3
    assert config["robustness"]["hardnesses"] == [16e9, 47e9]


def test_no_key_is_guessed_that_is_not_near():
    assert "did you mean" not in refusal(numbers, "colour", 1)


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("scan: {size: 1 nm}\ncontact: {count: 1}\nscan: {pixels: 2}", "scan"),
        ("contact:\n  count: 1\n  count: 2", "contact.count"),
    ],
)
def test_a_key_given_twice(tmp_path, text, key):
    path = tmp_path / "a.yaml"
    path.write_text(text)
    assert refusal(configuration.refuse_repeated_keys, path) == (
        f"{path}: line 3: expected each key once, found {key} again"
    )


@pytest.mark.parametrize(
    "text",
    [
        "contact: {count: 1}\nrobustness: {count: 1}",
        "scan: &a {size: 1 nm, again: *a}\ncontact: *a",  # an alias that holds itself
        '{\n\t"seed": 1\n}',  # JSON with tabs
        "",
    ],
)
def test_a_key_given_once(tmp_path, text):
    path = tmp_path / "a.yaml"
    path.write_text(text)
    configuration.refuse_repeated_keys(path)


@pytest.mark.parametrize(
    ("content", "part"),
    [
        (b"", "found: nothing"),
        (b"# a comment", "found: nothing"),
        (b"- 1", "found: [1]"),
        (b"word", "found: word"),
        (b"a: caf\xe9", "no UTF-8"),
        ("a: 1".encode("utf-16"), "no UTF-8"),
        (b"a: 1\0", "#x0000"),
        (b"a: 1\nb:\n\t- 1", "line 3: found character '\\t'"),
        (b"a: [1\n", "line 2"),
        (b"a: 1\n---\nb: 2", "line 2"),
        (b"a: 2026-13-45", "month"),
        (b"a: " + b"9" * 5000, "4300 digits"),
        (b"a: " + b"[" * 50_000, "too many levels"),
        (b"a: !!python/object/apply:os.mkdir [made]", "line 1"),
        (None, "Is a directory"),
    ],
)
def test_what_is_no_configuration_is_named(tmp_path, content, part):
    path = tmp_path / "a.yaml"
    path.mkdir() if content is None else path.write_bytes(content)
    message = refusal(configuration.refuse_unreadable, path)
    assert message.startswith(f"{path}: expected YAML with keys at its top, found: ")
    assert_says(message, part)
    assert len(message.splitlines()) == 1 and len(message) < 300
