"""Files are traced to their sources and compared with the existing files."""

import re
import shutil
import sys
from pathlib import Path

import pytest

from hardcontact.commands import command_line
from hardcontact.records.origin import Origin, file_digests, keep_records, record_path
from hardcontact.records.verification import verify_study

# A small study: source.txt -> store/a.nc -> results/final.nc -> results/answer.html


def make(path, inputs):
    """Make a file from others, with any content."""
    Path(path).parent.mkdir(exist_ok=True)
    Path(path).write_text(path)
    keep_records([path], Origin("{}", file_digests(inputs), []))


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Work in a folder with the small study."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "source.txt").write_text("source")
    (tmp_path / "code.py").write_text("code")
    make("store/a.nc", ["source.txt", "code.py"])
    make("store/of_another_study.nc", ["source.txt"])
    make("results/final.nc", ["store/a.nc", "code.py"])
    make("results/answer.html", ["results/final.nc"])
    return tmp_path


def test_an_unchanged_study_has_no_faults(study):
    counts = "results: 3 files checked, 0 faults, 0 inputs not at hand"
    assert verify_study("results") == ([], [counts])


@pytest.mark.parametrize(
    ("path", "outputs"),
    [
        ("source.txt", ["store/a.nc"]),
        ("code.py", ["results/final.nc", "store/a.nc"]),
        ("results/final.nc", ["results/answer.html"]),
        ("results/answer.html", []),
    ],
)
def test_a_changed_file_is_a_fault_and_one_of_each_of_its_outputs(study, path, outputs):
    (study / path).write_text("other")
    fault_lines = {f"{output}: does not match its input {path}" for output in outputs}
    if path.startswith("results/"):
        fault_lines.add(f"{path}: is not the file that the study wrote")
    assert set(verify_study("results")[0]) == fault_lines


def test_missing_inputs_are_counted_and_missing_outputs_are_faults(study):
    (study / "store/a.nc").unlink()
    (study / "results/answer.html").unlink()
    faults, (unfinished, counts) = verify_study("results")
    assert unfinished == "results/answer.html: is missing, so the study is not finished"
    assert counts == "results: 3 files checked, 1 faults, 1 inputs not at hand"
    assert faults == ["results/answer.html: expected a file of the study, found none"]


@pytest.mark.parametrize(
    "path", ["results/notes.txt", "results/answer.html", "store/a.nc", "store/nobody_s.nc"]
)
def test_a_file_without_a_record_is_a_fault(study, path):
    (study / path).touch()
    record_path(study / path).unlink(missing_ok=True)
    (study / "results/logs").mkdir()
    (study / "results/logs/make.log").touch()
    assert verify_study("results")[0] == [f"{path}: expected a record of its origin, found none"]


def test_a_lost_folder_of_records_is_a_fault(study):
    make("results/store/b.nc", ["source.txt"])
    make("results/first/final.nc", ["results/store/b.nc"])
    shutil.rmtree("results/store/.origin")
    faults, _ = verify_study("results/first")
    assert faults == ["results/store/b.nc: expected a record of its origin, found none"]


def test_files_made_with_other_versions_are_reported_but_no_faults(study):
    path = record_path("results/answer.html")
    path.write_text(path.read_text().replace('\\"scipy\\":\\"', '\\"scipy\\":\\"0.'))
    faults, (versions, _) = verify_study("results")
    assert faults == []
    assert versions.startswith("1 files, such as results/answer.html, were made with scipy 0.")


def file_times(folder):
    return {path: path.stat().st_mtime_ns for path in [folder, *folder.rglob("*")]}


@pytest.mark.parametrize("faulty", [False, True])
def test_a_command_checks_an_archive_from_elsewhere_and_writes_nothing(
    study, monkeypatch, capsys, faulty
):
    make("results/first/final.nc", ["source.txt"])
    make("results/first/answer.html", ["results/first/final.nc"])
    if faulty:
        (study / "results/first/final.nc").write_text("other")
    times = file_times(study)
    monkeypatch.chdir("/")
    monkeypatch.setattr(sys, "argv", ["hardcontact", "verify", str(study / "results/first")])
    assert command_line.main() == int(faulty)
    assert "results/first: 2 files checked" in capsys.readouterr().out
    assert file_times(study) == times


@pytest.mark.study
def test_a_finished_study_has_no_faults(finished, monkeypatch):
    monkeypatch.chdir(finished)
    faults, (counts,) = verify_study("results/tiny")
    assert faults == [] and counts.endswith("0 faults, 0 inputs not at hand")
    # All files of the store were checked, and the results.
    store_count = len(list((finished / "results/store-tiny").rglob("*.nc")))
    assert int(re.search(r"(\d+) files checked", counts)[1]) > store_count
