"""A file is made again if its parameters, versions or inputs, or what led to these, changed."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from hardcontact.records import origin
from hardcontact.records.origin import (
    Origin,
    canonical_json,
    file_digests,
    keep_records,
    record_path,
    refuse_edited_files,
)
from hardcontact.run import reruns


class Job:
    """A job as Snakemake has it, as far as plans need it."""

    def __init__(self, output, *inputs, **parameters):
        self.output, self.input = output, inputs
        self.params = SimpleNamespace(parameters=parameters)


def make_with_record(job):
    """Write the file of a job with its record."""
    Path(job.output).write_text(f"made from {job.input}")
    keep_records(
        [job.output], Origin(canonical_json(job.params.parameters), file_digests(job.input), [])
    )


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Make scan.txt -> forces.nc -> fit.nc; return both jobs by their file."""
    monkeypatch.chdir(tmp_path)
    Path("scan.txt").write_text("scan")
    Path("code.py").write_text("code")
    jobs = {
        "forces.nc": Job("forces.nc", "./scan.txt", "code.py", radius=5.0),
        "fit.nc": Job("fit.nc", "forces.nc", "code.py", work=0.05),
    }
    for job in jobs.values():
        make_with_record(job)
    return jobs


def changes(study, path):
    """Return what changed since a file of the study was made."""
    dependencies = {study["fit.nc"]: {study["forces.nc"]: ["forces.nc"]}, study["forces.nc"]: {}}
    return reruns.Reruns(dependencies).changes(study[path], path)


NOTHING = reruns.Changes(set(), set(), set())


def test_an_unchanged_study_is_not_made_again(study):
    assert changes(study, "forces.nc") == changes(study, "fit.nc") == NOTHING


def test_changed_parameters_are_named_with_both_values(study):
    study["fit.nc"].params.parameters = {"work": 0.06}
    assert changes(study, "fit.nc") == ({"work=0.05"}, {"work=0.06"}, set())


def test_another_version_of_a_package_is_a_change(study, monkeypatch):
    monkeypatch.setattr(reruns, "versions", lambda: origin.versions() | {"scipy": "0.1"})
    assert changes(study, "fit.nc").current == {'scipy="0.1"'}


def test_inputs_are_compared_by_content_whatever_their_times(study, tmp_path):
    (tmp_path / "other.txt").write_text("another scan")
    (tmp_path / "other.txt").replace("scan.txt")
    assert changes(study, "forces.nc").inputs == {"scan.txt"}
    assert changes(study, "fit.nc") == NOTHING  # until the forces are made again


def test_added_and_removed_inputs_are_changes(study):
    study["fit.nc"].input = ("forces.nc", "scan.txt")
    assert changes(study, "fit.nc").inputs == {"scan.txt", "code.py"}


@pytest.mark.parametrize(
    "damage",
    [
        Path.unlink,
        lambda path: path.write_bytes(b""),
        lambda path: path.write_bytes(path.read_bytes().replace(b"{", b"[", 2)),
        lambda path: path.write_bytes(path.read_bytes().replace(b'work\\"', b"work")),
        lambda path: path.write_bytes(path.read_bytes().replace(b"parameters", b"qarameters")),
    ],
)
def test_a_file_without_a_whole_record_is_made_again(study, damage):
    damage(record_path("fit.nc"))
    assert changes(study, "fit.nc").recorded == {"no complete record of fit.nc"}


def test_changes_behind_a_missing_intermediate_are_found(study):
    Path("forces.nc").unlink()
    record_path("forces.nc").unlink()
    assert changes(study, "fit.nc") == NOTHING
    Path("scan.txt").write_text("another scan")
    assert changes(study, "fit.nc").inputs == {"forces.nc"}


def test_a_large_file_counts_as_its_record_says(study, monkeypatch):
    """The job that uses it compares it with the record."""
    Path("forces.nc").write_text("another file")
    assert changes(study, "fit.nc").inputs == {"forces.nc"}
    monkeypatch.setattr(reruns, "MAX_READ_SIZE", 0)
    assert changes(study, "fit.nc") == NOTHING


def test_an_input_that_somebody_changed_is_refused_before_a_job_removes_files(study):
    made_file_digests = reruns.Reruns({}).made_file_digests
    Path("scan.txt").write_text("another scan")  # which no job made
    refuse_edited_files(made_file_digests(["scan.txt"]))
    Path("forces.nc").write_text("changed by hand")
    with pytest.raises(ValueError, match=r"^forces\.nc: expected the file that the study wrote"):
        refuse_edited_files(made_file_digests(["forces.nc"]))
    record_path("forces.nc").write_text("{")  # whose file is made again
    refuse_edited_files(made_file_digests(["forces.nc"]))
