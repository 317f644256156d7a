"""The end of a run: a refusal, Ctrl-C, a failure or its answer."""

import json
import logging
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import psutil

#: Logger of the study's own messages, which a terminal shows with the stages of a run.
logger = logging.getLogger("snakemake.logging.study")
#: The last line of a run that ended before all its files were made.
RESUME = "The run is incomplete: repeat the command to resume."


def refuse(message: object) -> NoReturn:
    """End the run with one line per fault."""
    sys.exit("\n".join(f"error: {line}" for line in str(message).splitlines()))


@contextmanager
def end_run_at_fault() -> Iterator[None]:
    """End the run with one line per fault if the block raises ValueError."""
    try:
        yield
    except ValueError as error:
        refuse(error)


def log_answer(workflow: Any, page: str) -> None:
    """Log the answer at the end of a run that makes its page, and end Snakemake's timers."""
    if page in {str(path) for job in workflow.dag.finished_jobs for path in job.output}:
        answer = json.loads(Path(page).with_name("answer.json").read_text("utf-8"))
        grave_notes = [note["text"] for note in answer["notes"] if note["grave"]]
        for line in [*answer["headline"], *answer["verdicts"], *grave_notes]:
            logger.info(line)
        logger.info(f"The answer is made: open {page}")
    _cancel_timers()


def log_how_to_resume(workflow: Any) -> None:
    """Log how to resume a failed or stopped run that makes files, and end Snakemake's timers."""
    if any(job.output for job in workflow.dag.needrun_jobs()):
        logger.error(RESUME)
    _cancel_timers()


def _cancel_timers() -> None:
    """Cancel Snakemake's timers, for which the process would wait although no work is left."""
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
    os._exit(130)  # the exit code of a program that Ctrl-C ended


def kill_run_at_next_interrupt(workflow: Any) -> None:
    """Kill the run, and its jobs if there are any, at the next Ctrl-C."""
    signal.signal(signal.SIGINT, lambda *_: _kill_run(workflow))


def handle_interrupts(workflow: Any) -> None:
    """Kill the run and its jobs at the first Ctrl-C, because Snakemake would wait for jobs.

    On a cluster the first Ctrl-C lets Snakemake cancel the jobs, and the second kills the run.
    """
    if workflow.local_exec:
        # Threads and jobs that begin from here on inherit the blocked signal.
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
