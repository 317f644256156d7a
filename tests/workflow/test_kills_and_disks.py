"""Kills, folders of others, full disks and one core: one line, nothing lost, the same values."""

import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

import kill
import pytest
from comparison import differences
from faults import OF_ALTERED, alter, but_missing, errors, others
from refusals import assert_says
from repository import ROOT, copy_repository, environment, run_snakemake

from hardcontact.config.patterns import STUDY_VARIANT, Patterns

pytestmark = pytest.mark.system


def mount(*arguments):
    """Mount something, or skip the test where that is not permitted."""
    try:
        subprocess.run(
            ["mount", *map(str, arguments)], check=True, stderr=subprocess.PIPE, text=True
        )
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"mounting is not permitted here: {getattr(error, 'stderr', error)}")


def unmount(folder):
    subprocess.run(["umount", folder], check=True)


@contextmanager
def disk(folder, size):
    """A disk of its own at a folder."""
    mount("-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder)
    try:
        yield folder
    finally:
        unmount(folder)


def resize(folder, size):
    mount("-o", f"remount,size={size}", folder)


def fill(folder):
    """Leave no byte free; returns the file that takes them."""
    path = folder / "filler"
    with open(path, "wb", buffering=0) as file:
        try:
            while file.write(bytes(4096)):
                pass
        except OSError:
            pass
    return path


# Killed


def test_killed_at_random_moments(finished, tmp_path):
    assert kill.harness(tmp_path, finished, kills=20, seed=1) == []


#: Lines that make a job say that it runs, and wait until it may go on.
WAIT = """
import time
from pathlib import Path
Path("waiting").touch()
while not Path("go").exists():
    time.sleep(0.1)
"""


@pytest.fixture
def running(finished_copy, tmp_path):
    """The study in a run whose last job but one waits for a file `go`."""
    alter(finished_copy, WAIT)
    run = kill.Round(finished_copy, None, tmp_path / "first.log")
    try:
        while not (finished_copy / "waiting").exists():
            assert run.process.poll() is None, run.output.read_text()
            time.sleep(0.1)
        yield run
    finally:
        run.kill()


def test_after_a_kill_the_study_goes_on(running, finished):
    assert running.kill()
    (running.study / "go").touch()
    run = run_snakemake(running.study)
    assert run.returncode == 0 and errors(run.stdout) == [], run.stdout
    lines = differences(running.study / "results", finished / "results")
    assert others(lines, *OF_ALTERED) == []


# Folders that others hold


def test_two_runs_at_once(running, finished):
    def second(*arguments, **overlay):
        return run_snakemake(running.study, *arguments, overlays=[overlay] if overlay else [])

    refused = second()
    assert refused.returncode != 0 and "cannot be locked" in refused.stdout, refused.stdout
    assert "\nlocalrule " not in refused.stdout
    patterns = Patterns("results/other", "store-other", "ruby")
    spectrum = patterns.calibrated_spectrum.format(surface="uncd", variant=STUDY_VARIANT)
    beside = second(f"results/{spectrum}", study="other", store="results/store-other")
    assert beside.returncode == 0, beside.stdout
    assert running.process.poll() is None
    (running.study / "go").touch()
    assert running.finish() == 0, running.output.read_text()
    assert errors(running.output.read_text()) == []
    lines = differences(running.study / "results", finished / "results")
    assert f"{spectrum}: not in the reference" in lines
    assert others(lines, *OF_ALTERED, "store-other/") == []


@contextmanager
def read_only(folder):
    """A folder in which nothing can be written; root is only stopped by a mount."""
    if os.geteuid():
        folder.chmod(0o555)
        yield
        folder.chmod(0o755)
        return
    mount("--bind", folder, folder)
    try:
        mount("-o", "remount,bind,ro", folder)
        yield
    finally:
        unmount(folder)


@pytest.mark.parametrize("name", ["results/quick", "results/store-quick", ".snakemake"])
def test_a_read_only_folder(finished_copy, name):
    def state():
        paths = (finished_copy / "results").rglob("*")
        return {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in paths}

    # One file without others that are made from it: those could not be replaced, which Snakemake
    # tells before the study can.
    (finished_copy / "results/quick/ro-crate-metadata.json").unlink()
    folder = finished_copy / name
    if name == ".snakemake":  # the folder has to be made, in one that is read-only
        shutil.rmtree(folder)
        folder = finished_copy
    before = state()
    with read_only(folder):
        run = run_snakemake(finished_copy)
    assert run.returncode != 0
    assert len(errors(run.stdout)) == 1, run.stdout
    assert_says(errors(run.stdout)[0], f"{name}: expected a folder to write to, found")
    assert "\nlocalrule " not in run.stdout
    after = state()
    changed = [path for path in before | after if before.get(path) != after.get(path)]
    assert changed == []


# Full disks and one core


@pytest.mark.parametrize("room", [0, 100_000])
@pytest.mark.parametrize(
    "write",
    [
        'dataset.write(xarray.Dataset({"heights": heights}), "made/a.nc")',
        'dataset.write(xarray.Dataset({"heights": heights}), "made/a.nc", "NETCDF3_64BIT")',
    ],
)
def test_a_job_on_a_full_disk_ends_in_one_line(tmp_path, write, room):
    """Even where there is no room for its log; netCDF must not crash."""
    job = f"""
import numpy, xarray
from hardcontact.records import dataset, log
heights = (("y", "x"), numpy.ones((512, 512)), {{}})
with log.job_log("a.log"):
    {write}
"""
    with disk(tmp_path, "400k"):
        filler = fill(tmp_path)
        os.truncate(filler, filler.stat().st_size - room)
        run = subprocess.run(
            [sys.executable, "-c", job],
            cwd=tmp_path,
            env=environment(ROOT),
            capture_output=True,
            text=True,
        )
        assert len(run.stderr.splitlines()) == 1, run.stderr
        expected = "error: made/a.nc: expected a file to be written, found:"
        assert_says(run.stderr, expected, "MB of the disk are free")
        assert run.returncode == 1
        assert list(tmp_path.glob("made/*")) == []


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """A study to run on one core, on a disk of its own where one may be mounted."""
    folder = tmp_path_factory.mktemp("alone")
    with suppress(pytest.skip.Exception):
        mount("-t", "tmpfs", "tmpfs", folder)
    yield copy_repository(folder / "study")
    shutil.rmtree(folder / "study")
    if os.path.ismount(folder):
        unmount(folder)


def test_a_full_disk(alone, finished):
    """First the disk is too small, then full to the last byte, then large enough."""
    if not os.path.ismount(alone.parent):
        pytest.skip("mounting is not permitted here")
    command = ("topography", "--cores", "1")
    used = shutil.disk_usage(alone.parent).used
    resize(alone.parent, used + 3_000_000)
    for _ in range(2):
        run = run_snakemake(alone, *command)
        assert run.returncode != 0
        errors(run.stdout)
        assert "No space left on device" in run.stdout or "MB of the disk are free" in run.stdout
        assert list(kill.damaged(alone / "results", since=0)) == []
        filler = fill(alone.parent)
    filler.unlink()
    resize(alone.parent, 1_000_000_000)
    run = run_snakemake(alone, *command)
    assert run.returncode == 0 and errors(run.stdout) == [], run.stdout
    assert (alone / "results/quick/topography.nc").is_file()
    assert but_missing(differences(alone / "results", finished / "results")) == []


def test_one_core_gives_the_same_values(alone, finished):
    """Of the forces; `python tests/workflow/kill.py --kills 0 --cores 1` compares the whole."""
    targets = ("adhesion", "scales")
    run = run_snakemake(alone, *targets, "--cores", "1")
    assert run.returncode == 0 and "Provided cores: 1 " in run.stdout, run.stdout
    assert list(kill.leftovers(alone, *targets)) == []
    made = [alone / f"results/quick/{name}.nc" for name in ("adhesion", "contact", "scales")]
    assert all(path.is_file() for path in made)
    assert but_missing(differences(alone / "results", finished / "results")) == []
