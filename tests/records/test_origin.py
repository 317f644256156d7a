"""The origin of a file: equal origins have equal texts, and every file has a record."""

import json
import os
from importlib.metadata import version

import pytest
from refusals import assert_says, refusal

from hardcontact.records.origin import (
    Origin,
    canonical_json,
    file_digests,
    keep_records,
    record_path,
    refuse_edited_files,
)


def test_parameters_have_one_text():
    assert canonical_json({"b": [1, 2.5], "a": "µ"}) == '{"a":"µ","b":[1,2.5]}'
    assert canonical_json({"a": 1}) != canonical_json({"a": 1.0})


def test_attributes_distinguish_inputs_and_code():
    data, script = {"data.nc": "1"}, {"script.py": "2"}

    def attributes(input_digests):
        return Origin("{}", input_digests, ["script.py"]).attributes()

    study = attributes(data | script)
    assert json.loads(study["versions"])["numpy"] == version("numpy")
    assert json.loads(study["input_digests"]) == data | script
    other_data = attributes({"data.nc": "3"} | script)
    assert {key for key in study if study[key] != other_data[key]} == {"input_digests"}
    other_script = attributes(data | {"script.py": "3"})
    differences = {key for key in study if study[key] != other_script[key]}
    assert differences == {"input_digests", "code_digest"}


@pytest.fixture
def made_file(tmp_path):
    """Return a file that a job made, with its record."""
    path = tmp_path / "made.nc"
    path.write_bytes(bytes(100))
    keep_records([path], Origin("{}", {"scan.txt": "1"}, []))
    return path


def test_a_changed_file_of_a_job_is_refused(made_file, tmp_path):
    user_file = tmp_path / "given.csv"
    user_file.write_bytes(bytes(100))
    refuse_edited_files(file_digests([made_file, user_file]))
    for content in (b"\1" + bytes(99), bytes(99), bytes(101), b""):  # a bit, truncated, longer
        made_file.write_bytes(content)
        os.utime(made_file, (0, 0))
        user_file.write_bytes(content)
        message = refusal(refuse_edited_files, file_digests([made_file, user_file]))
        assert_says(message, str(made_file), "delete it")
        assert str(user_file) not in message


@pytest.mark.parametrize("content", [b"", b"\xff\0", b"{", b"[]", b"{}", b'{"sha256": "1"}'])
def test_a_damaged_record_refuses_its_file(made_file, content):
    record_path(made_file).write_bytes(content)
    assert_says(
        refusal(refuse_edited_files, file_digests([made_file])),
        "made.nc: expected a complete record",
    )
