"""Fixtures: a copy of the repository, the finished tiny study, and the tiers of tests."""

import os
import shutil
import sys
import tempfile

import pytest
from hypothesis import configuration, settings
from repository import ROOT, copy_repository, run_tiny_study
from shared_study import shared_study
from xdist.scheduler import LoadFileScheduling

# Each process has one thread, because processes share the cores. NumPy reads this when it is
# imported, and nothing above imports it.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Tests leave nothing in the repository.
sys.dont_write_bytecode = True
settings.register_profile("study", database=None)
settings.load_profile("study")
HYPOTHESIS_FOLDER = tempfile.TemporaryDirectory(prefix="hypothesis-")
configuration.set_hypothesis_home_dir(HYPOTHESIS_FOLDER.name)

#: Fixtures that compute a study.
STUDIES = {"finished", "own_study", "probe"}


def pytest_unconfigure():
    """Remove the files of hypothesis."""
    HYPOTHESIS_FOLDER.cleanup()


def pytest_xdist_auto_num_workers(config):
    """Run tests that start Snakemake in one process, because it uses all cores itself."""
    return None if "not study" in config.option.markexpr else 0


def pytest_xdist_make_scheduler(config, log):
    """Run all tests of a file in one process, because they share fixtures."""
    return LoadFileScheduling(config, log)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark tests that need a finished study with `study`, unless they test the system.

    They begin, because they take longest.
    """
    for item in items:
        if STUDIES & set(item.fixturenames) and not item.get_closest_marker("system"):
            item.add_marker("study")
    items.sort(key=lambda item: item.get_closest_marker("study") is None)


@pytest.fixture
def write_table(tmp_path):
    """Return a function that writes lines as a table, and returns its path."""

    def write(*lines):
        path = tmp_path / "my.csv"
        path.write_text("\n".join(lines) + "\n", "utf-8")
        return str(path)

    return write


@pytest.fixture
def project_folder(monkeypatch):
    """Work in the top folder of the repository."""
    monkeypatch.chdir(ROOT)


@pytest.fixture(scope="module")
def repository(tmp_path_factory):
    """Copy the repository, without results."""
    return copy_repository(tmp_path_factory.mktemp("repository") / "study")


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """Return a copy of the repository with the finished tiny study; not to be changed."""
    return shared_study(tmp_path_factory, tiny_study)


@pytest.fixture(scope="session")
def results(finished):
    """Return the results of the tiny study; not to be changed."""
    return finished / "results" / "tiny"


def tiny_study(folder):
    """Run the tiny study in a copy of the repository inside a folder; return the copy."""
    copy = copy_repository(folder / "study")
    run = run_tiny_study(copy)
    assert run.returncode == 0, run.stdout[-3000:]
    return copy


@pytest.fixture
def finished_copy(finished, tmp_path):
    """Copy the finished tiny study, to be changed, and remove the copy (90 MB) afterwards."""
    yield shutil.copytree(finished, tmp_path / "copy")
    shutil.rmtree(tmp_path / "copy")


@pytest.fixture
def quick_predictions(monkeypatch):
    """Predict with fewer cutoffs and contacts, by the same code in a fifth of the time."""
    monkeypatch.setattr("hardcontact.theory.closed_form.CUTOFF_COUNT", 8)
    monkeypatch.setattr("hardcontact.commands.predict.CONTACTS_PER_ROW", 8)
