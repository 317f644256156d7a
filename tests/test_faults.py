"""Kills, full disks, damaged files, folders of others, jobs that fail: one line, nothing lost."""

import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

import kill
import pytest
from comparison import differences
from conftest import ROOT, assert_says, copy_repository, cut, run_snakemake

#: What tells of the script that drew Fig. 1, beside the figure.
OF_FIG1 = ("quick/provenance/fig1.json", "quick/ro-crate-metadata.json")


def errors(run):
    """The different lines in which a run names its errors; a retried job says its own twice."""
    assert "Traceback" not in run.stdout, run.stdout
    return sorted({line for line in run.stdout.splitlines() if line.startswith("error:")})


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


def unreadable(results):
    return list(kill.damaged(results, since=0))


def alter(study, script, line):
    """Put a line into a script, where its log has begun."""
    path = study / f"workflow/scripts/{script}.py"
    head, begin, rest = path.read_text().partition("log.start(snakemake.log[0])\n")
    assert begin
    path.write_text(f"{head}{begin}{line}\n{rest}")


# Killed


def test_killed_at_random_moments(finished, tmp_path):
    assert kill.harness(tmp_path, finished, kills=20, seed=1) == []


#: A job that says that it runs and waits until it may go on.
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
    alter(finished_copy, "draw_fig1", WAIT)
    run = kill.Round(finished_copy, None, tmp_path / "first.log")
    try:
        while not (finished_copy / "waiting").exists():
            assert run.process.poll() is None, run.output.read_text()
            time.sleep(0.1)
        yield run
    finally:
        run.kill()


def test_after_a_kill_nothing_is_to_be_unlocked(running, finished):
    assert running.kill()
    (running.study / "go").touch()
    run = run_snakemake(running.study)
    assert run.returncode == 0 and errors(run) == [], run.stdout
    others = differences(running.study / "results", finished / "results")
    assert [line for line in others if not line.startswith(OF_FIG1)] == []


# Folders that others hold


def test_two_runs_at_once(running, finished):
    def second(*arguments, **overlay):
        return run_snakemake(running.study, *arguments, overlays=[overlay] if overlay else [])

    for folder, overlay in {
        "results/quick": {},
        "results/store-quick": {"study": "second"},  # the store is written to as well
    }.items():
        refused = second(**overlay)
        assert refused.returncode != 0
        assert len(errors(refused)) == 1, refused.stdout
        assert_says(errors(refused)[0], f"{folder}: expected no other run", "found one", "wait")
        assert "\nlocalrule " not in refused.stdout
    spectrum = "store-other/spectra/uncd-substitute.nc"
    beside = second(f"results/{spectrum}", study="other", store="results/store-other")
    assert beside.returncode == 0, beside.stdout
    assert running.process.poll() is None
    (running.study / "go").touch()
    assert running.finish() == 0, running.output.read_text()
    assert errors(subprocess.CompletedProcess([], 0, running.output.read_text())) == []
    others = differences(running.study / "results", finished / "results")
    assert f"{spectrum}: not in the reference" in others
    expected = (*OF_FIG1, "store-other/")
    assert [line for line in others if not line.startswith(expected)] == []


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
        found = (finished_copy / "results").rglob("*")
        return {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in found}

    for path in finished_copy.glob("results/quick/*/fig1.*"):
        path.unlink()
    (finished_copy / "results/quick/ro-crate-metadata.json").unlink()
    folder = finished_copy / name
    if name == ".snakemake":  # is to be made, where nothing can be
        shutil.rmtree(folder)
        folder = finished_copy
    before = state()
    with read_only(folder):
        run = run_snakemake(finished_copy)
    assert run.returncode != 0
    assert len(errors(run)) == 1, run.stdout
    assert_says(errors(run)[0], f"{name}: expected a folder to write to, found")
    assert "\nlocalrule " not in run.stdout
    after = state()
    changed = [path for path in before | after if before.get(path) != after.get(path)]
    assert {path.name for path in changed} <= {".lock"}  # of the folder that was held first


# Full disks and one core


@pytest.mark.parametrize("room", [0, 100_000])
@pytest.mark.parametrize("file_format", ["NETCDF4", "NETCDF3_64BIT"])
def test_a_job_on_a_full_disk_ends_in_one_line(tmp_path, file_format, room):
    """Even where there is no room for its log; netCDF must not crash."""
    job = f"""
import numpy, os
from hardcontact import dataset, log
log.start("a.log")
data = dataset.height_map(numpy.ones((512, 512)), 1.0, periodic=False)
made_from = dict(title="a", parameters="{{}}", inputs=[], code=[])
dataset.write(data, "made/a.nc", **made_from, file_format="{file_format}")
"""
    with disk(tmp_path, "400k"):
        filler = fill(tmp_path)
        os.truncate(filler, filler.stat().st_size - room)
        run = subprocess.run(
            [sys.executable, "-c", job],
            cwd=tmp_path,
            env=os.environ | {"PYTHONPATH": str(ROOT / "workflow")},
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
        errors(run)
        assert "No space left on device" in run.stdout or "MB of the disk are free" in run.stdout
        assert unreadable(alone / "results") == []
        filler = fill(alone.parent)
    filler.unlink()
    resize(alone.parent, 1_000_000_000)
    run = run_snakemake(alone, *command)
    assert run.returncode == 0 and errors(run) == [], run.stdout
    assert (alone / "results/quick/topography.nc").is_file()
    others = differences(alone / "results", finished / "results")
    assert [line for line in others if not line.endswith(": missing")] == []


def test_one_core_gives_the_same_values(alone, finished):
    """Of the forces; `python tests/kill.py --kills 0 --cores 1` compares the whole study."""
    targets = ("adhesion", "scales")
    run = run_snakemake(alone, *targets, "--cores", "1")
    assert run.returncode == 0 and "Provided cores: 1 " in run.stdout, run.stdout
    assert list(kill.leftovers(alone, *targets)) == []
    made = [alone / f"results/quick/{name}.nc" for name in ("adhesion", "contact", "scales")]
    assert all(path.is_file() for path in made)
    others = differences(alone / "results", finished / "results")
    assert [line for line in others if not line.endswith(": missing")] == []


# Damaged files


def test_deleted_results_are_made_again(finished_copy):
    for path in ("figures/fig1.png", "indent.nc", "claims.csv", "configuration.yaml"):
        (finished_copy / "results/quick" / path).unlink()
    run = run_snakemake(finished_copy, "-n")
    for rule in ("draw_fig1", "measure_indents", "evaluate_claims", "keep_configuration"):
        assert f"\nrule {rule}:" in run.stdout, rule


@pytest.mark.parametrize(
    ("path", "expected", "targets"),
    [
        ("store-quick/scans/uncd/scan-1-flat.nc", "a complete netCDF file", ["topography"]),
        ("store-quick/substitutes/uncd/scan-1-flat.nc", "a whole file", ["topography"]),
        ("quick/provenance/fig5.json", "a whole record", []),
        ("quick/claims.csv", "a whole table", []),
        ("quick/figures/fig5.csv", "the file that the study wrote", []),
    ],
)
def test_a_truncated_file_is_deleted_and_made_again(
    finished_copy, finished, path, expected, targets
):
    truncated = cut(finished_copy / "results" / path, 0.7)
    run = run_snakemake(finished_copy, *targets)
    assert run.returncode != 0
    assert len(errors(run)) == 1, run.stdout
    assert_says(errors(run)[0], f"results/{path}: expected {expected}", "found")
    truncated.unlink()
    run = run_snakemake(finished_copy, *targets)
    assert run.returncode == 0, run.stdout
    # An intermediate that nothing is to be made from any more stays away.
    others = differences(finished_copy / "results", finished / "results")
    assert [line for line in others if not line.endswith(".nc: missing")] == []


# Jobs that fail


def test_a_job_that_fails_once_is_tried_again(finished_copy, finished):
    alter(
        finished_copy,
        "draw_fig1",
        "from pathlib import Path\n"
        "tried = Path('tried').exists()\n"
        "Path('tried').touch()\n"
        "if not tried:\n"
        "    raise RuntimeError('fails once')",
    )
    run = run_snakemake(finished_copy)
    assert run.returncode == 0, run.stdout
    assert errors(run) == ["error: fails once"]
    others = differences(finished_copy / "results", finished / "results")
    assert [line for line in others if not line.startswith(OF_FIG1)] == []


def test_a_job_that_always_fails_lets_the_others_finish(finished_copy, finished):
    alter(finished_copy, "draw_fig1", "raise RuntimeError('fails always')")
    other = "results/quick/figures/fig5.png"
    (finished_copy / other).unlink()
    run = run_snakemake(finished_copy, "--cores", "1")
    assert run.returncode == 1
    assert errors(run) == ["error: fails always"]
    log = "results/quick/logs/draw_fig1.log"
    assert_says(run.stdout, "Error in rule draw_fig1:")
    assert run.stdout.count(f"\nfailed: see {log}\n") == 1 and run.stdout.count("\nfailed:") == 1
    assert_says((finished_copy / log).read_text(), "Traceback", "RuntimeError: fails always")
    assert (finished_copy / other).read_bytes() == (finished / other).read_bytes()
