"""The log of a job: progress, and errors in one line that names the log."""

import logging
import subprocess
import sys

from repository import ROOT, environment

from hardcontact.records.job import job_log, progress


def run(folder, block, path="a.log"):
    """Run a block whose log is kept, in a process of its own."""
    program = f"from hardcontact.records.job import job_log\nwith job_log({path!r}):\n    {block}\n"
    return subprocess.run(
        [sys.executable, "-c", program],
        cwd=folder,
        env=environment(ROOT),
        capture_output=True,
        text=True,
    )


def test_an_error_is_one_line_and_in_full_in_the_log(tmp_path):
    failed = run(tmp_path, "raise ValueError('a\\n b')")
    assert failed.returncode == 1
    assert failed.stderr == "error: a b (see a.log)\n"
    text = (tmp_path / "a.log").read_text()
    assert "Traceback" in text and "ValueError: a\n b" in text


def test_an_interrupt_ends_without_a_word(tmp_path):
    stopped = run(tmp_path, "raise KeyboardInterrupt")
    assert (stopped.returncode, stopped.stdout, stopped.stderr) == (130, "", "")


def test_an_error_without_words_is_named(tmp_path):
    assert run(tmp_path, "raise RuntimeError").stderr == "error: RuntimeError (see a.log)\n"


def test_a_log_that_cannot_be_written_is_not_named(tmp_path):
    failed = run(tmp_path, "raise ValueError('never raised')", path="none/a.log")
    assert failed.returncode == 1
    assert failed.stderr.startswith("error: [Errno 2] No such file") and "see" not in failed.stderr


def test_a_block_that_succeeds_says_nothing(tmp_path):
    run_well = run(tmp_path, "pass")
    assert (run_well.returncode, run_well.stdout, run_well.stderr) == (0, "", "")
    assert (tmp_path / "a.log").read_text() == ""


def test_the_exit_code_of_a_block_stays(tmp_path):
    left = run(tmp_path, "raise SystemExit(3)")
    assert (left.returncode, left.stderr) == (3, "")


def test_progress_passes_steps_on_and_is_logged_about_ten_times(tmp_path):
    with job_log(tmp_path / "a.log"):
        assert list(progress(range(25), 25, "contacts")) == list(range(25))
    lines = (tmp_path / "a.log").read_text().splitlines()
    assert lines[-1].endswith("contacts: 25 of 25") and len(lines) == 10
    assert logging.getLogger("hardcontact").handlers == []


def test_progress_of_few_steps_is_logged_at_each(tmp_path):
    with job_log(tmp_path / "a.log"):
        assert list(progress(iter("ab"), 2, "scans")) == ["a", "b"]
    lines = (tmp_path / "a.log").read_text().splitlines()
    assert [line.split(" ", 1)[1] for line in lines] == ["scans: 1 of 2", "scans: 2 of 2"]
