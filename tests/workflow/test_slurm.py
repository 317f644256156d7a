"""The profile for SLURM, on a cluster of this machine alone."""

import contextlib
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import pytest
from comparison import differences
from refusals import assert_says
from repository import TINY, copy_repository, environment

pytestmark = pytest.mark.system

PROFILE = "profiles/slurm"
PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"]
#: The group with the job to be cancelled, and the rule that it then computes.
CANCELLED = ("cutoffs", "compute_filtered_forces")
#: Files are visible at once on one machine, and jobs are short.
LOCAL_OPTIONS = ["--slurm-init-seconds-before-status-checks", "2", "--latency-wait", "5"]
#: Seconds that a run may take.
RUN_SECONDS = 1800
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
# Neither systemd nor cgroups are expected.
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=0
# Jobs that have ended can be asked about until the end.
MinJobAge=3600
KillWait=2
# Memory is measured each second.
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=1
JobAcctGatherParams=OverMemoryKill
# What no node of a partition can give is refused at once.
EnforcePartLimits=ALL
# A busy machine answers late.
MessageTimeout=90
SlurmdTimeout=0
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory}
PartitionName=study Nodes={host} Default=YES
PartitionName=members Nodes={host} AllowAccounts=members
"""


def obstacle():
    """Return the reason if SLURM cannot run here, or an empty text."""
    missing_programs = [program for program in PROGRAMS if not shutil.which(program)]
    if missing_programs:
        return f"needs slurm-wlm and munge of Debian: no {', '.join(missing_programs)}"
    return "" if os.geteuid() == 0 else "needs root"


def until(condition, description, seconds=120):
    """Return the first true value of a condition; raise TimeoutError if there is none."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.3)
    raise TimeoutError(f"waited {seconds} s for {description}")


def ask(*command):
    """Return the output of a command without outer blanks; empty if it fails."""
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


def configure(folder):
    """Write the files of a cluster of this machine, and set SLURM_CONF and PATH."""
    node = ask("slurmd", "-C")
    with socket.socket() as first_socket, socket.socket() as second_socket:
        ports = []
        for free_socket in (first_socket, second_socket):
            free_socket.bind(("127.0.0.1", 0))
            ports.append(free_socket.getsockname()[1])
    path = folder / "slurm.conf"
    path.write_text(
        CONFIGURATION.format(
            folder=folder,
            host=re.search(r"NodeName=(\S+)", node)[1],
            cpus=re.search(r"CPUs=(\d+)", node)[1],
            memory=re.search(r"RealMemory=(\d+)", node)[1],
            ports=ports,
        )
    )
    (folder / "munge.key").write_bytes(os.urandom(128))
    (folder / "munge.key").chmod(0o600)
    for name in ("state", "spool"):
        (folder / name).mkdir()
    os.environ["SLURM_CONF"] = str(path)
    # The executor starts the steps of a job without this variable. STEP_DELAY makes a job last.
    srun = folder / "bin/srun"
    srun.parent.mkdir()
    srun.write_text(
        f'#!/bin/sh\nsleep ${{STEP_DELAY:-0}}\nSLURM_CONF={path} exec {shutil.which("srun")} "$@"\n'
    )
    srun.chmod(0o755)
    os.environ["PATH"] = f"{srun.parent}:{os.environ['PATH']}"


@contextlib.contextmanager
def run_slurm(folder):
    """Run SLURM with all its files in a folder, and stop its daemons at the end."""
    configure(folder)
    files = {"key-file": "key", "socket": "socket", "pid-file": "pid", "seed-file": "seed"}
    munge = [f"--{option}={folder}/munge.{name}" for option, name in files.items()]
    daemons = []

    def start(*command):
        with open(folder / f"{command[0]}.log", "w") as log:
            daemons.append(subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT))

    try:
        start("munged", "--foreground", f"--log-file={folder}/munge.log", *munge)
        until((folder / "munge.socket").exists, "munged")
        start("slurmctld", "-D")
        start("slurmd", "-D")
        until(lambda: ask("sinfo", "-h", "-o", "%T") == "idle", "an idle node")
        yield
    except BaseException:
        for log in folder.glob("*.log"):
            print(f"--- {log.name}", *log.read_text().splitlines()[-15:], sep="\n")
        raise
    finally:
        if len(daemons) == 3:
            ask("scancel", "--user", "root")
            with contextlib.suppress(TimeoutError):
                until(lambda: not ask("squeue", "-h", "-t", "running,completing"), "jobs to end")
        for daemon in reversed(daemons):
            stop(daemon, signal.SIGTERM)


def stop(process, signal_number):
    """End one process by a signal, or by force if it does not end within 30 s."""
    process.send_signal(signal_number)
    try:
        process.wait(30)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def job_to_cancel(study):
    """Return the number of the running SLURM job of CANCELLED, or an empty text."""
    group, rule = CANCELLED
    if not any((study / "results").glob(f"*/logs/{rule}/**/*.log")):  # A job begins with its log.
        return ""
    for line in ask("squeue", "-h", "-t", "running", "-o", "%i %k").splitlines():
        job, comment = line.split(maxsplit=1)
        if comment.startswith(f"rule_{group}_"):
            return job
    return ""


def start_run(study, log, *words, **variables):
    """Start a run of the tiny study through SLURM, with words and variables of its command."""
    command = [sys.executable, "-m", "snakemake", *words, "--workflow-profile", PROFILE]
    with open(log, "w") as out:
        return subprocess.Popen(
            [*command, "--configfile", TINY, *LOCAL_OPTIONS],
            cwd=study, env=environment(study) | variables, stdout=out, stderr=subprocess.STDOUT,
        )  # fmt: skip


def run_and_cancel(study, log, targets):
    """Run targets of the tiny study through SLURM and cancel one job; return its number."""
    run = start_run(study, log, *targets, "--verbose")
    try:
        job = until(lambda: run.poll() is not None or job_to_cancel(study), "a job", RUN_SECONDS)
        assert run.poll() is None, f"ended before a job could be cancelled: {log.read_text()}"
        ask("scancel", job)
        assert run.wait(RUN_SECONDS) == 0, log.read_text()[-3000:]
    finally:
        if run.poll() is None:
            stop(run, signal.SIGINT)
    return job


def check_recovery(cancelled, log):
    """Expect the cancelled job to be submitted again, and all other jobs to succeed."""
    lines = ask("scontrol", "-o", "show", "job").splitlines()
    jobs = [dict(re.findall(r"(\w+)=(\S+)", line)) for line in lines]
    states = {job["JobId"]: job["JobState"] for job in jobs}
    assert states.pop(cancelled) == "CANCELLED", states
    assert set(states.values()) == {"COMPLETED"}, states

    submissions = defaultdict(list)
    for job, number in re.findall(r"Job (\S+) has been submitted with SLURM jobid (\d+)", log):
        submissions[job].append(number)
    ((first_number, _),) = [numbers for numbers in submissions.values() if cancelled in numbers]
    assert first_number == cancelled, submissions


# Tests


class Fault(NamedTuple):
    """A fault of a job."""

    options: str  #: Words of the command that make the fault.
    reason: str  #: A part of SLURM's message.
    key: str  #: The key that mends the fault.
    variables: dict = {}  #: Environment of the command.


FAULTS = [
    Fault("--default-resources slurm_partition=nowhere", "Invalid partition", "slurm_partition"),
    Fault("--default-resources slurm_partition=members slurm_account=nobody", "Invalid account",
          "slurm_account"),
    Fault("--set-resources compute_filtered_forces:runtime=1", "DUE TO TIME LIMIT", "runtime",
          {"STEP_DELAY": "100"}),
    Fault("--set-resources compute_filtered_forces:mem_mb=60", "exceeded memory limit", "mem_mb"),
]  # fmt: skip


@pytest.fixture
def cluster(monkeypatch):
    """Run a SLURM on this machine."""
    folders = [str(Path(sys.executable).parent), os.environ["PATH"], "/usr/sbin", "/sbin"]
    monkeypatch.setenv("PATH", os.pathsep.join(folders))
    monkeypatch.setenv("SLURM_CONF", "")
    if reason := obstacle():
        pytest.skip(reason)
    with tempfile.TemporaryDirectory(prefix="slurm-") as name:
        folder = Path(name)
        folder.chmod(0o755)  # munged wants others to reach its socket
        with run_slurm(folder):
            yield


def test_a_job_that_slurm_refuses_or_ends_has_one_line_with_the_remedy(
    cluster, finished_copy, tmp_path
):
    filtered = [*(finished_copy / "results/store-tiny/filtered/edges").rglob("*.nc")]
    runs = []
    for number, (fault, target) in enumerate(zip(FAULTS, filtered, strict=False)):
        target.unlink()
        words = [target.relative_to(finished_copy), *fault.options.split(), "--retries", "0"]
        # A run that ends removes empty folders of logs, in which others begin theirs.
        words += ["--slurm-logdir", tmp_path / f"logs-{number}"]
        log = tmp_path / f"{number}"
        runs.append(start_run(finished_copy, log, *words, **fault.variables))
    codes = [run.wait(RUN_SECONDS) for run in runs]
    assert codes == [1] * len(FAULTS)
    for number, fault in enumerate(FAULTS):
        text = (tmp_path / f"{number}").read_text()
        (line,) = [line for line in text.splitlines() if "compute_filtered_forces" in line]
        assert_says(line, "SLURM job cutoffs_compute_filtered_forces: ", fault.reason)
        assert_says(line, f"change {fault.key}")
        assert not re.search("sacct|Error|Traceback", text), text


def test_slurm_recovers_a_cancelled_job_and_gives_the_same_values(cluster, finished, tmp_path):
    """Forces on masters of one surface are computed as without SLURM."""
    filtered = (finished / "results/store-tiny/filtered/edges").rglob("uncd/**/*.nc")
    targets = [path.relative_to(finished).as_posix() for path in filtered]
    study, log = copy_repository(tmp_path / "study"), tmp_path / "log"
    cancelled = run_and_cancel(study, log, targets)
    check_recovery(cancelled, log.read_text())
    lines = differences(study / "results", finished / "results")
    assert all((study / target).is_file() for target in targets)
    assert [line for line in lines if not line.endswith(": missing")] == []
