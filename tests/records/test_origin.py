"""What determined a file: equal texts for equal origins."""

import hashlib
import json
import os
import subprocess
from importlib.metadata import version

import pytest
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.records.origin import (
    Origin,
    canonical,
    digest,
    digests,
    keep_digests,
    kept_digest,
    pinned_versions,
    refuse_changed,
)


def test_parameters_have_one_text():
    assert canonical({"b": [1, 2.5], "a": "µ"}) == '{"a":"µ","b":[1,2.5]}'
    assert canonical({"a": 1, "b": 2}) == canonical({"b": 2, "a": 1})
    assert canonical({"a": 1}) != canonical({"a": 1.0})


def test_digests_are_those_of_contents(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    first.write_bytes(b"1")
    second.write_bytes(b"2")
    assert digest(first) == hashlib.sha256(b"1").hexdigest()
    assert digests([first, second, first]) == {str(path): digest(path) for path in (first, second)}


def test_attributes_tell_parameters_inputs_and_code_apart():
    data, script = ({path: text} for path, text in (("data.nc", "1"), ("script.py", "2")))
    before = Origin("{}", data | script, ["script.py"]).attributes()
    assert json.loads(before["versions"])["numpy"] == version("numpy")
    assert json.loads(before["input_digests"]) == data | script
    after = Origin("{}", {"data.nc": "3"} | script, ["script.py"]).attributes()
    assert {key for key in before if before[key] != after[key]} == {"input_digests"}
    last = Origin("{}", data | {"script.py": "3"}, ["script.py"]).attributes()
    assert {key for key in before if before[key] != last[key]} == {"input_digests", "code_digest"}


def test_a_file_that_was_changed_after_it_was_made_is_refused(tmp_path):
    made, given = tmp_path / "made.nc", tmp_path / "given.csv"
    for path in (made, given):
        path.write_bytes(bytes(100))
    keep_digests([made])
    refuse_changed(digests([made, given]))
    assert kept_digest(given) is None
    for changed in (b"\1" + bytes(99), bytes(99), bytes(101), b""):  # a bit, truncated, longer
        made.write_bytes(changed)
        os.utime(made, (0, 0))
        given.write_bytes(changed)
        said = refusal(refuse_changed, digests([made, given]))
        assert_says(said, str(made), "delete it")
        assert str(given) not in said


@pytest.mark.parametrize("content", [b"", b"\xff\0", b"0" * 63, b"\n"])
def test_a_damaged_digest_refuses_its_file(tmp_path, content):
    made = tmp_path / "made.nc"
    made.write_bytes(bytes(100))
    keep_digests([made])
    (tmp_path / ".sha256/made.nc.sha256").write_bytes(content)
    assert_says(refusal(refuse_changed, digests([made])), "made.nc: expected", "delete it")


def test_kept_digests_are_those_that_other_programs_check(tmp_path):
    (tmp_path / "a.nc").write_text("content")
    keep_digests([tmp_path / "a.nc"])
    command = ["sha256sum", "-c", ".sha256/a.nc.sha256"]
    check = subprocess.run(command, cwd=tmp_path, capture_output=True)
    assert check.returncode == 0


def test_pins_are_read_and_other_requirements_are_not(tmp_path):
    path = tmp_path / "environment.txt"
    path.write_text(
        "# numpy==0 is a comment\n-c workflow/constraints.txt\n-e .\n"
        "numpy==2.0\nxarray>=1\n--no-index\npytest[extra]==1\n"
    )
    assert pinned_versions(path) == {"numpy": version("numpy"), "pytest": version("pytest")}


def test_a_package_that_is_not_installed_is_named(tmp_path):
    path = tmp_path / "environment.txt"
    path.write_text("no-such-package==1\n")
    assert_says(refusal(pinned_versions, path), "environment.txt: expected", "no-such-package")


def test_every_pin_of_the_environment_is_read():
    lines = (ROOT / "environment.txt").read_text().splitlines()
    versions = pinned_versions(ROOT / "environment.txt")
    assert {"numpy", "snakemake"} <= versions.keys()
    assert len(versions) == sum("==" in line and not line.startswith("#") for line in lines)
