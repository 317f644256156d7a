"""What determined a file: equal texts for equal origins, and a record beside every file."""

import json
import os
from importlib.metadata import version

import pytest
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.base.origin import (
    Origin,
    canonical,
    digests,
    keep_records,
    pinned_versions,
    record_path,
    refuse_changed,
)


def test_parameters_have_one_text():
    assert canonical({"b": [1, 2.5], "a": "µ"}) == '{"a":"µ","b":[1,2.5]}'
    assert canonical({"a": 1}) != canonical({"a": 1.0})


def test_attributes_distinguish_inputs_and_code():
    data, script = {"data.nc": "1"}, {"script.py": "2"}
    before = Origin("{}", data | script, ["script.py"]).attributes()
    assert json.loads(before["versions"])["numpy"] == version("numpy")
    assert json.loads(before["input_digests"]) == data | script
    after = Origin("{}", {"data.nc": "3"} | script, ["script.py"]).attributes()
    assert {key for key in before if before[key] != after[key]} == {"input_digests"}
    last = Origin("{}", data | {"script.py": "3"}, ["script.py"]).attributes()
    assert {key for key in before if before[key] != last[key]} == {"input_digests", "code_digest"}


@pytest.fixture
def made(tmp_path):
    """Return a file that a job made, with its record."""
    path = tmp_path / "made.nc"
    path.write_bytes(bytes(100))
    keep_records([path], Origin("{}", {"scan.txt": "1"}, []))
    return path


def test_a_changed_file_of_a_job_is_refused(made, tmp_path):
    given = tmp_path / "given.csv"
    given.write_bytes(bytes(100))
    refuse_changed(digests([made, given]))
    for changed in (b"\1" + bytes(99), bytes(99), bytes(101), b""):  # a bit, truncated, longer
        made.write_bytes(changed)
        os.utime(made, (0, 0))
        given.write_bytes(changed)
        message = refusal(refuse_changed, digests([made, given]))
        assert_says(message, str(made), "delete it")
        assert str(given) not in message


@pytest.mark.parametrize("content", [b"", b"\xff\0", b"{", b"[]", b"{}", b'{"sha256": "1"}'])
def test_a_damaged_record_refuses_its_file(made, content):
    record_path(made).write_bytes(content)
    assert_says(refusal(refuse_changed, digests([made])), "made.nc: expected a whole record")


def test_pins_are_read_and_other_requirements_are_not(tmp_path):
    path = tmp_path / "environment.txt"
    path.write_text(
        "# numpy==0 is a comment\n-c workflow/constraints.txt\n-e .\n"
        "numpy==2.0\nxarray>=1\n--no-index\npytest[extra]==1\n"
    )
    assert pinned_versions(path) == {"numpy": version("numpy"), "pytest": version("pytest")}
    assert {"numpy", "snakemake"} <= pinned_versions(ROOT / "environment.txt").keys()
