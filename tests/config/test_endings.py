"""The messages at the end of a run: of its answer, and after Ctrl-C."""

import logging
import os
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from repository import TINY, copy_repository, environment
from studies import TINY_PATTERNS, TINY_SOURCES

from hardcontact.config import endings


@pytest.mark.parametrize(
    ("outputs", "messages"),
    [
        (
            ["answer.html", "answer.json"],
            ["Band 1 to 2 nm.", "Take care.", "The answer is made: open answer.html"],
        ),
        (["other.nc"], []),
    ],
)
def test_a_run_ends_with_its_headline_and_the_page_to_open(
    caplog, tmp_path, monkeypatch, outputs, messages
):
    monkeypatch.chdir(tmp_path)
    Path("answer.json").write_text(
        '{"headline": ["Band 1 to 2 nm."], "notes": [{"grave": true, "text": "Take care."}, '
        '{"grave": false, "text": "Less so."}]}'
    )
    caplog.set_level(logging.INFO, endings.logger.name)
    workflow = SimpleNamespace(dag=SimpleNamespace(jobs=[SimpleNamespace(output=outputs)]))
    endings.log_answer(workflow, "answer.html")
    assert caplog.messages == messages


def listen_to_ctrl_c():
    """Undo what a shell does to programs in the background, and they to theirs: ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.study
def test_a_stopped_run_reports_that_the_same_command_continues_it(tmp_path):
    study = copy_repository(tmp_path / "study")
    # Three jobs, one after the other: the first ends before the others begin.
    master = TINY_PATTERNS.small_master.format(
        surface="uncd", sources=TINY_SOURCES["uncd"], realization=1
    )
    with subprocess.Popen(
        [sys.executable, "-m", "snakemake", master, "--configfile", TINY],
        cwd=study, env=environment(study), text=True, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=listen_to_ctrl_c,
    ) as run:  # fmt: skip
        messages = []
        for line in run.stdout:
            if "jobs done" in line:
                os.killpg(run.pid, signal.SIGINT)  # Ctrl-C reaches all processes of a terminal.
            messages.append(line.rstrip())
    assert run.returncode == 130
    assert messages[-1] == endings.RESUME and "jobs done" in messages[-2]
    assert not [*study.glob(".snakemake/locks/*")]
