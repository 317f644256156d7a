"""The life of a run: checks before it, parts of all rules, Ctrl-C, its answer or failure."""

import json
import logging
import os
import signal
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any, NoReturn

import psutil
from snakemake.io import strip_wildcard_constraints
from snakemake.settings.types import ExecMode
from snakemake.utils import min_version

from hardcontact.files.paths import StudyPaths
from hardcontact.records.code import ROOT, code_inputs, refuse_other_versions
from hardcontact.run.reruns import MIN_SNAKEMAKE, plan_by_records

#: Size in bytes up to which a job keeps freed memory for its next array. Returning it to the system
#: costs some jobs a fifth of their time.
REUSED_MEMORY = 256 * 1024**2
#: Logger of the study's own messages, which a terminal shows with the stages of a run.
logger = logging.getLogger("snakemake.logging.study")
#: The last line of a run that failed or was stopped.
RESUME = "The run is incomplete: repeat the command to resume."


def prepare(workflow: Any) -> None:
    """Refuse a run that would fail with any configuration; otherwise prepare this process.

    Jobs keep freed memory, Ctrl-C kills the run, and records decide what runs again.
    """
    min_version(MIN_SNAKEMAKE)
    # On a full disk Snakemake's own log cannot be written: what it prints is enough, no tracebacks.
    logging.raiseExceptions = False
    _refuse_elsewhere(workflow)
    # Jobs inherit these variables; values set by the user are kept.
    os.environ.setdefault("MALLOC_MMAP_THRESHOLD_", str(REUSED_MEMORY))
    os.environ.setdefault("MALLOC_TRIM_THRESHOLD_", str(REUSED_MEMORY))
    refuse_unwritable_folders(".snakemake")  # Snakemake's own attempt ends in a traceback.
    if plans_the_run(workflow):
        kill_run_at_next_interrupt(workflow)
        try:
            refuse_other_versions()
        except ValueError as error:
            refuse(error)
        plan_by_records(workflow)


def _refuse_elsewhere(workflow: Any) -> None:
    """Refuse another clone's library, use as a module, and another working directory."""
    rules_folder = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).resolve()
    snakefile = Path(workflow.main_snakefile).resolve()
    working_folder = Path.cwd().resolve()
    if working_folder != ROOT or not (
        rules_folder.is_relative_to(ROOT) and snakefile.is_relative_to(ROOT)
    ):
        refuse(
            f"working directory: expected {ROOT}, because this environment has its library "
            f"(README.md), found {working_folder}, with {snakefile} and the rules of {rules_folder}"
        )


def refuse_unwritable_folders(*folders: str) -> None:
    """Refuse folders that cannot be written to."""
    for folder in folders:
        try:
            Path(folder).mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            refuse(f"{folder}: expected a folder to write to, found: {error.strerror}")


def plans_the_run(workflow: Any) -> bool:
    """Return True if this process plans the run; False if it executes a job of the run."""
    return bool(workflow.exec_mode == ExecMode.DEFAULT)


def complete_rules(workflow: Any, paths: StudyPaths) -> None:
    """Give each rule with a script a log and, if it writes files, its code and a benchmark.

    Its code, the script and the modules that this imports, are inputs: if they change, the files
    are made again. A rule may name more code.
    """
    for rule in workflow.rules:
        if rule.norun:
            continue
        # What Snakemake itself does for the directives `log` and `benchmark`.
        rule.log_modifier = rule.benchmark_modifier = workflow.modifier.path_modifier
        output = strip_wildcard_constraints(rule.output[0]) if rule.output else ""
        rule.set_log(paths.run_file("logs", ".log", rule.name, output))
        if rule.output:
            rule.benchmark = paths.run_file("benchmarks", ".tsv", rule.name, output)
            if "code" not in rule.input.keys():
                rule.set_input(code=code_inputs(Path(rule.script).name))


def refuse(message: object) -> NoReturn:
    """End the run with one line per fault."""
    sys.exit("\n".join(f"error: {line}" for line in str(message).splitlines()))


def log_answer(workflow: Any, page: str) -> None:
    """Log the answer at the end of a run that makes its page, and the page to open."""
    if page in {str(path) for job in workflow.dag.finished_jobs for path in job.output}:
        answer = Path(page).with_name("answer.json")
        content = json.loads(answer.read_text("utf-8"))
        grave_notes = [note["text"] for note in content["notes"] if note["grave"]]
        for line in [*content["headline"], *content["verdicts"], *grave_notes]:
            logger.info(line)
        logger.info(f"The answer is made: open {page}")
    _cancel_timers()


def log_how_to_resume(workflow: Any) -> None:
    """Log, after a failed or stopped run that makes files, that its command resumes it."""
    if any(job.output for job in workflow.dag.needrun_jobs()):
        logger.error(RESUME)
    _cancel_timers()


def _cancel_timers() -> None:
    """End without waiting for Snakemake's timers, since no work is left."""
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()


def _kill_run(workflow: Any) -> NoReturn:
    """Kill the run and its jobs, whose files are complete or missing, and print RESUME."""
    for process in psutil.Process().children(recursive=True):
        process.kill()
    if workflow.persistence:
        workflow.persistence.unlock()
    os.write(2, f"{RESUME}\n".encode())
    os._exit(130)


def kill_run_at_next_interrupt(workflow: Any) -> None:
    """Kill the run, and its jobs if there are any, at the next Ctrl-C."""
    signal.signal(signal.SIGINT, lambda *_: _kill_run(workflow))


def kill_jobs_at_interrupt(workflow: Any) -> None:
    """Kill the run and its jobs at Ctrl-C, which the jobs do not receive.

    Jobs would print tracebacks, and Snakemake would wait for them. On a cluster the first Ctrl-C
    lets Snakemake cancel the jobs; the second kills the run.
    """
    if workflow.local_exec:
        # Threads and jobs that begin from here on inherit what is blocked.
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})

        def wait() -> None:
            signal.sigwait({signal.SIGINT})
            _kill_run(workflow)

        threading.Thread(target=wait, daemon=True).start()
    else:

        def interrupt(*_: object) -> NoReturn:
            kill_run_at_next_interrupt(workflow)
            raise KeyboardInterrupt

        signal.signal(signal.SIGINT, interrupt)
