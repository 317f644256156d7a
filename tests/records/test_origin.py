"""The origin of a file: equal origins have equal texts, and every file has a record."""

import os

import pytest
from refusals import assert_says, refusal

from hardcontact.records.origin import (
    Origin,
    file_digests,
    keep_records,
    record_path,
    refuse_edited_files,
)


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
    for content in (
        b"\1" + bytes(99),
        bytes(99),
        bytes(101),
        b"",
    ):  # a bit, truncated, longer, empty
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
