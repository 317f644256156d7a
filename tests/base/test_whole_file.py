"""Files are written whole or not at all."""

from pathlib import Path

import pytest
from refusals import assert_says

from hardcontact.base.whole_file import PART, whole_file


def test_a_file_appears_when_the_block_has_ended(tmp_path):
    path = tmp_path / "made" / "a.txt"
    with whole_file(path) as temporary:
        Path(temporary).write_text("whole")
        assert not path.exists() and Path(temporary).suffix == ".txt"
    assert path.read_text() == "whole"
    assert [entry.name for entry in path.parent.iterdir()] == ["a.txt"]


def test_a_failing_write_keeps_the_old_file(tmp_path):
    (tmp_path / "old.nc").write_text("whole")
    (tmp_path / f"{PART}old.nc").write_text("half of an earlier file, of a killed process")
    for target in (tmp_path / "new.nc", tmp_path / "old.nc"):
        with pytest.raises(RuntimeError), whole_file(target) as temporary:
            Path(temporary).write_text("half")
            raise RuntimeError
    assert [path.read_text() for path in tmp_path.iterdir()] == ["whole"]


def test_a_refusal_of_the_system_is_one_line(tmp_path):
    (tmp_path / "file").touch()
    path = tmp_path / "file" / "a.nc"  # a folder cannot be made where a file is
    with pytest.raises(ValueError) as caught, whole_file(path):
        pass
    message = str(caught.value)
    assert_says(
        message, f"{path}: expected a file to be written, found:", "MB of the disk are free"
    )
    assert len(message.splitlines()) == 1
