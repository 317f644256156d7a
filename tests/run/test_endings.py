"""The messages at the end of a run: of its answer, and after Ctrl-C."""

import os
import signal
import subprocess
import sys
import time

import pytest
from repository import ROOT, TINY, copy_repository, environment
from studies import tiny_files

from hardcontact.run import endings


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
    assert messages[-1] == endings.RESUME and "jobs done" in messages[-2]
    assert not [*study.glob(".snakemake/locks/*")]


#: A run on a cluster: Snakemake cancels its jobs at the first Ctrl-C.
CLUSTER_RUN = """
import time
from types import SimpleNamespace
from hardcontact.run import endings

endings.stop_jobs_at_interrupt(SimpleNamespace(local_exec=False, persistence=None))
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
        assert run.stdout.read() == f"{endings.RESUME}\n"
    assert run.returncode == 130 and time.monotonic() - begin < 5
