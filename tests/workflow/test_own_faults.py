"""After full disks, altered files and failing jobs, a study continues and loses nothing.

All on the small study of your surfaces, whose undisturbed results are the reference.
"""

import os
import shutil
import subprocess
import sys
from contextlib import contextmanager
from textwrap import indent

import pytest
from comparison import differences
from own_studies import run_quick
from refusals import assert_says
from repository import ROOT, environment, run_snakemake_with_forks
from scan_files import truncate_file

pytestmark = pytest.mark.study

RESULTS, STORE = "results/several-quick", "results/store-several-quick"


def run(study, *arguments, **options):
    return run_quick(study, "several", *arguments, overlays=["few.yaml"], **options)


def errors(output):
    """Return the distinct error lines of a run; a retried job repeats its lines."""
    assert "Traceback" not in output, output
    return sorted({line for line in output.splitlines() if line.startswith("error:")})


@pytest.fixture
def copy(own_study, tmp_path):
    """Copy the finished study, to be changed."""
    return shutil.copytree(own_study, tmp_path / "copy", symlinks=True)


# Disks that are full, and folders that cannot be written to


def mount(*arguments):
    """Mount something, or skip the test where that is not permitted."""
    try:
        subprocess.run(["mount", *map(str, arguments)], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"mounting is not permitted here: {getattr(error, 'stderr', error)}")


@contextmanager
def disk(folder, size):
    """Make a folder a disk of its own."""
    folder.mkdir(exist_ok=True)
    mount("-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder)
    try:
        yield folder
    finally:
        subprocess.run(["umount", folder], check=True)


def fill(folder, room):
    """Leave a number of bytes of a disk free; return the file that fills the disk."""
    path = folder / "filler"
    with open(path, "wb", buffering=0) as file:
        try:
            while file.write(bytes(4096)):
                pass
        except OSError:
            pass
    os.truncate(path, path.stat().st_size - room)
    return path


JOB = """
import numpy, xarray
from hardcontact.base.dataset import write_dataset
from hardcontact.records.job import job_log
heights = (("y", "x"), numpy.ones((512, 512)), {})
with job_log("a.log"):
    write_dataset(xarray.Dataset({"heights": heights}), "made/a.nc")
"""


@pytest.mark.parametrize("room", [0, 100_000])
def test_a_job_on_a_full_disk_ends_in_one_line(tmp_path, room):
    """There may be no room for the log, and netCDF must not crash."""
    with disk(tmp_path / "disk", "400k") as folder:
        fill(folder, room)
        job = subprocess.run(
            [sys.executable, "-c", JOB],
            cwd=folder, env=environment(ROOT), capture_output=True, text=True,
        )  # fmt: skip
        assert len(job.stderr.splitlines()) == 1 and job.returncode == 1, job.stderr
        message = "error: made/a.nc: expected a file to be written, found:"
        assert_says(job.stderr, message, "MB of the disk are free")
        assert list(folder.glob("made/*")) == []


# Altered files


def flip_a_bit(path):
    """Change a file without changing its size or its time."""
    status, content = path.stat(), bytearray(path.read_bytes())
    content[len(content) * 2 // 3] ^= 1
    path.write_bytes(content)
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))


def test_altered_files_are_refused_until_they_are_deleted_and_made_again(copy, own_study):
    (forces,) = (copy / STORE / "pull_off").glob("*/sphere/*/*/*/*/twin/*/scan-1.nc")
    (filtered,) = (copy / STORE / "filtered/edges").rglob("twin/*/*/*/*.nc")
    spectra = copy / RESULTS / "spectra.nc"
    altered_files = (forces, filtered, spectra)
    flip_a_bit(forces)
    truncate_file(filtered, 0.7)
    flip_a_bit(spectra)
    # `verify` names them.
    verified = run(copy, "verify")
    assert verified.returncode == 1 and "to resume" not in verified.stdout
    for path in altered_files:
        assert f"{path.relative_to(copy)}: is not the file" in verified.stdout
    targets = ["force", "adhesion", "band"]  # Each reads one altered file.
    for name in ("adhesion", "filtered_forces"):
        (copy / RESULTS / f"{name}.nc").unlink()
    # An altered final file stops a run before its jobs remove anything.
    refused_run = run(copy, *targets)
    (line,) = errors(refused_run.stdout)
    assert refused_run.returncode == 1 and (copy / RESULTS / "force.nc").is_file()
    assert_says(line, f"{spectra.relative_to(copy)}: expected the file that the study wrote")
    spectra.unlink()
    # An altered intermediate stops the job that reads it.
    failed_run = run(copy, *targets, "--keep-going", run=run_snakemake_with_forks)
    assert failed_run.returncode == 1
    messages = "\n".join(errors(failed_run.stdout))
    for path in (forces, filtered):
        assert_says(messages, f"{path.relative_to(copy)}: expected the file that the study wrote")
    # Deleted files are made again as they were.
    for path in (forces, filtered):
        path.unlink()
    done = run(copy, *targets, run=run_snakemake_with_forks)
    assert done.returncode == 0 and errors(done.stdout) == [], done.stdout
    assert differences(copy / "results", own_study / "results") == []


# Jobs that fail


def insert_lines(study, script, lines):
    """Insert lines into a script, where its job begins."""
    path = study / f"workflow/scripts/{script}.py"
    head, begin, tail = path.read_text().partition("(snakemake) as job:\n")
    assert begin
    path.write_text(f"{head}{begin}{indent(lines, '    ')}\n{tail}")


FAILS_ONCE = """
from pathlib import Path
tried = Path("tried").exists()
Path("tried").touch()
if not tried:
    raise RuntimeError("fails once")
"""


def test_a_failing_job_is_repeated_and_does_not_stop_others(copy, own_study):
    insert_lines(copy, "describe_study", FAILS_ONCE)
    insert_lines(copy, "answer_surfaces", 'raise RuntimeError("fails always")')
    (copy / RESULTS / "fit.nc").unlink()
    failed = run(copy)
    assert failed.returncode == 1
    answer = f"{RESULTS}/logs/answer_surfaces.log"
    assert errors(failed.stdout) == [
        f"error: fails always (see {answer})",
        f"error: fails once (see {RESULTS}/logs/describe_study.log)",
    ]
    assert_says(failed.stdout, "Error in rule answer_surfaces:")
    assert_says((copy / answer).read_text(), "Traceback", "RuntimeError: fails always")
    for name in ("configuration.yaml", "fit.nc"):
        assert (copy / RESULTS / name).is_file()
