"""Files are written completely or not at all."""

import os
from itertools import count
from pathlib import Path

import pytest
import xarray as xr

from hardcontact.base.atomic_file import INCOMPLETE_PREFIX, atomic_file, remove_incomplete_files
from hardcontact.base.dataset import write_dataset
from hardcontact.records.origin import Origin, keep_records


def test_a_file_appears_when_the_block_has_ended(tmp_path):
    path = tmp_path / "made" / "a.txt"
    with atomic_file(path) as temporary:
        Path(temporary).write_text("content")
        assert not path.exists() and Path(temporary).suffix == ".txt"
    assert path.read_text() == "content"
    assert [entry.name for entry in path.parent.iterdir()] == ["a.txt"]


def test_parts_of_a_killed_process_are_removed_by_name(tmp_path):
    for name in (f"{INCOMPLETE_PREFIX}0a1b-a.nc", f"{INCOMPLETE_PREFIX}0a1b-b.nc", "a.nc"):
        (tmp_path / name).write_text("half")
    remove_incomplete_files(tmp_path / "a.nc")
    assert sorted(os.listdir(tmp_path)) == [f"{INCOMPLETE_PREFIX}0a1b-b.nc", "a.nc"]


def failing(call, number, calls):
    """Return a call of the system that fails if it is the one of this number among all calls."""

    def call_or_fail(*arguments):
        if next(calls) == number:
            raise OSError(28, "No space left on device")
        return call(*arguments)

    return call_or_fail


def test_a_failure_at_any_write_leaves_complete_files(tmp_path, monkeypatch):
    path = tmp_path / "a.nc"

    def write(text):
        write_dataset(xr.Dataset(attrs={"text": text}), path)
        keep_records([path], Origin("{}", {}, []))

    write("old" * 1000)
    for number in range(4):  # content and name of the file, and of its record
        calls = count()
        with monkeypatch.context() as patch, pytest.raises(ValueError, match="No space left"):
            for name in ("fsync", "replace"):
                patch.setattr(os, name, failing(getattr(os, name), number, calls))
            write("new" * 1000)
        with xr.open_dataset(path) as written:
            assert written.attrs["text"] == ("old" if number < 2 else "new") * 1000
        assert not [*tmp_path.rglob(f"{INCOMPLETE_PREFIX}*")]
