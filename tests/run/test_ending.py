"""A run obeys Ctrl-C until its end, and then logs its answer or how to resume it."""

import json
import logging
import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest
from repository import ROOT, TINY, copy_repository, environment
from studies import tiny_files

from hardcontact.run import ending


@pytest.mark.parametrize("made_now", ["answer.html", "claims.csv"])
def test_the_answer_is_logged_only_by_a_run_that_makes_it(tmp_path, caplog, made_now):
    answer = {"headline": ["Waves matter."], "verdicts": [], "notes": []}
    (tmp_path / "answer.json").write_text(json.dumps(answer))
    page = str(tmp_path / "answer.html")
    dag = SimpleNamespace(finished_jobs=[SimpleNamespace(output=[tmp_path / made_now])])
    with caplog.at_level(logging.INFO, ending.logger.name):
        ending.log_answer(SimpleNamespace(dag=dag), page)
    lines = ["Waves matter.", f"The answer is made: open {page}"]
    assert caplog.messages == (lines if made_now == "answer.html" else [])


@pytest.mark.parametrize("page_is_made", [True, False])
def test_a_failed_run_is_resumed_only_if_files_are_missing(caplog, page_is_made):
    check, page = SimpleNamespace(output=[]), SimpleNamespace(output=["answer.html"])
    unfinished = [check] if page_is_made else [check, page]
    dag = SimpleNamespace(needrun_jobs=lambda: unfinished)
    ending.log_how_to_resume(SimpleNamespace(dag=dag))
    assert caplog.messages == ([] if page_is_made else [ending.RESUME])


def listen_to_ctrl_c():
    """Obey Ctrl-C again, which shells make programs in the background ignore."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.study
def test_a_stopped_run_reports_that_the_same_command_continues_it(tmp_path, project_folder):
    study = copy_repository(tmp_path / "study")
    # Three jobs, one after the other: the first ends before the others begin.
    files = tiny_files()
    master = files.path(files.patterns.masters, "uncd", realization=1, side="short")
    with subprocess.Popen(
        [sys.executable, "-m", "snakemake", master, "--configfile", TINY],
        cwd=study, env=environment(study), text=True, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=listen_to_ctrl_c,
    ) as run:  # fmt: skip
        messages = []
        for line in run.stdout:
            if "jobs done" in line:
                begin = time.monotonic()
                for _ in range(2):
                    os.killpg(run.pid, signal.SIGINT)  # Ctrl-C reaches all processes of a terminal.
            messages.append(line.rstrip())
    assert run.returncode == 130 and time.monotonic() - begin < 5
    assert messages[-1] == ending.RESUME and "jobs done" in messages[-2]
    assert not [*study.glob(".snakemake/locks/*")]


#: A run on a cluster: Snakemake cancels its jobs at the first Ctrl-C.
CLUSTER_RUN = """
import time
from types import SimpleNamespace
from hardcontact.run import ending

ending.handle_interrupts(SimpleNamespace(local_exec=False, persistence=None))
for state in ("running", "cancelling"):
    try:
        print(state, flush=True)
        time.sleep(60)
    except KeyboardInterrupt:
        pass
"""


def test_a_second_ctrl_c_ends_a_run_on_a_cluster_without_a_traceback():
    with subprocess.Popen(
        [sys.executable, "-c", CLUSTER_RUN],
        env=environment(ROOT), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        preexec_fn=listen_to_ctrl_c,
    ) as run:  # fmt: skip
        for state in ("running", "cancelling"):
            assert run.stdout.readline() == f"{state}\n"
            run.send_signal(signal.SIGINT)
        begin = time.monotonic()
        assert run.stdout.read() == f"{ending.RESUME}\n"
    assert run.returncode == 130 and time.monotonic() - begin < 5
