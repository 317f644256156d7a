"""Folders are held by one run at a time."""

import os

import pytest
from refusals import assert_says, refusal

from hardcontact.records.whole_file import PART, hold


def test_a_folder_is_held_once_and_freed_of_unfinished_files(tmp_path):
    folder = tmp_path / "results"
    (folder / "store").mkdir(parents=True)
    kept = folder / "store" / "kept.nc"
    kept.touch()
    for place in (folder, kept.parent):
        (place / f"{PART}x.nc").write_text("half")
    held = hold(folder)
    assert list(folder.rglob("*.nc")) == [kept]
    message = refusal(hold, folder)
    assert_says(message, "results: expected no other run in this folder, found one")
    held.close()
    hold(folder).close()


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").touch()
    message = refusal(hold, tmp_path / "file" / "results")
    assert_says(message, "results: expected a folder to write to, found: Not a directory")


@pytest.mark.skipif(not os.geteuid(), reason="root may write anywhere")
def test_a_folder_that_cannot_be_written_to_is_named(tmp_path):
    tmp_path.chmod(0o555)
    assert_says(refusal(hold, tmp_path), "expected a folder to write to, found: Permission denied")
    tmp_path.chmod(0o755)
