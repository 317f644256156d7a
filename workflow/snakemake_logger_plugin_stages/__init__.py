"""The lines of a run in the terminal: one for each stage, with finished jobs and the time left.

A plugin that Snakemake finds by the name of this package. A stage is all jobs of one rule. Dry
runs, `--quiet` and `--verbose` show Snakemake's own log, which `.snakemake/log` has of every run.
"""

import math
import os
import sys
import threading
import time
from collections import Counter
from collections.abc import Mapping
from contextlib import suppress
from datetime import timedelta
from logging import WARNING, LogRecord
from pathlib import Path
from typing import Any

from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_stages.cluster import log_reasons, study_logger
from snakemake_logger_plugin_stages.command_line import cost_column, error_line, refuse_faults
from snakemake_logger_plugin_stages.costs import Stage, read_stages, stage_of
from snakemake_logger_plugin_stages.home import provide_home

#: The home of a user without a home that takes files.
HOME = Path(".snakemake/home")
#: Seconds without a line after which a line reports the progress: nobody waits longer in doubt.
MAX_SILENCE_SECONDS = 30
#: When jobs of this share of the planned cost are finished, their time counts as much as the table.
PRIOR_SHARE = 0.2
#: Exceptions that repeat the failure of a job.
JOB_EXCEPTIONS = ("CalledProcessError", "RuleException")
#: The end of a message that repeats the failure of a job.
INCOMPLETE_MESSAGE = "At least one job did not complete successfully."
#: Beginnings of messages of the executor for SLURM that are not shown: guesses of an account,
#: failures of sacct, and an error that the line of the job repeats.
EXECUTOR_MESSAGES = (
    "No SLURM account given",
    "No account was given",
    "Unable to guess SLURM account",
    "Both 'sacctmgr' and 'sshare'",
    "Failed to retrieve jobstep reason",
    "Exception in run_job",
)


class LogHandler(LogHandlerBase):
    """Shows stages, Snakemake's warnings and errors, and the study's messages."""

    writes_to_stream = True
    writes_to_file = False
    has_filter = False
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self) -> None:
        """Prepare to show a run, before Snakemake reads any file."""
        provide_home(HOME)
        refuse_faults()
        log_reasons()
        settings = self.common_settings
        self._shows_snakemake_log = bool(settings.dryrun or settings.verbose or settings.quiet)
        self._stream = sys.stdout if settings.stdout else sys.stderr
        self._stages: dict[str, Stage] = {}
        self._planned: dict[str, int] = {}  # jobs of each rule
        self._cores = os.cpu_count() or 1
        self._crowding = 1.0  # processes per processor
        self._done = Counter[str]()
        self._rules: dict[int, str] = {}  # by job
        self._begin: dict[str, float] = {}  # time at which the first job of each rule began
        self._ended = threading.Event()
        self._last_line = time.monotonic()
        if not self._shows_snakemake_log:
            self._say("Planning the run ...")

    def emit(self, record: LogRecord) -> None:
        """Show stages that begin or end, and messages."""
        event = getattr(record, "event", None)
        fields = vars(record)
        if event == LogEvent.ERROR:
            self._show_error(record, fields["exception"])
        elif self._shows_snakemake_log:
            self._say(self.format(record))
        elif event == LogEvent.RESOURCES_INFO:
            self._cores = fields.get("cores", self._cores)
        elif event == LogEvent.RUN_INFO:
            self._plan(fields["stats"])
        elif event == LogEvent.JOB_INFO:
            self._start(fields["jobid"], fields["rule_name"], fields["rule_msg"])
        elif event == LogEvent.JOB_FINISHED:
            self._finish(self._rules[fields["job_id"]])
        elif event == LogEvent.JOB_ERROR:
            self._show_failure(fields)
        elif event == LogEvent.GROUP_ERROR or record.getMessage().startswith(EXECUTOR_MESSAGES):
            pass
        elif (
            record.levelno >= WARNING
            or record.name == study_logger.name
            or record.getMessage() == NOTHING_TO_BE_DONE_MSG
        ):
            self._say(self.format(record))

    def _say(self, text: str) -> None:
        self._last_line = time.monotonic()
        with suppress(BrokenPipeError):  # The reader of a pipe, such as `head`, may have ended.
            print(text, file=self._stream, flush=True)

    def _show_failure(self, fields: Mapping[str, Any]) -> None:
        """Show a job that failed, unless the study has shown why the cluster ended it."""
        # On a cluster the job has a message, and a job of a group is indented.
        if not fields["rule_msg"] and not fields["indent"]:
            logs = ", ".join(filter(os.path.isfile, fields["log"]))
            see = f": see {logs}" if logs else ""
            self._say(f"Error in rule {fields['rule_name']}{see}")

    def _show_error(self, record: LogRecord, exception: str) -> None:
        """Show an error, but not one that repeats the failure of a job, which has a line."""
        message = record.getMessage()
        if not self._planned:
            self._say(error_line(exception, message) or self.format(record))
        elif not (exception in JOB_EXCEPTIONS or message.endswith(INCOMPLETE_MESSAGE)):
            self._say(self.format(record))

    def _plan(self, jobs: dict[str, int]) -> None:
        """Show the number of planned jobs, and an estimate of their time."""
        stages = read_stages(cost_column())
        self._planned = {**jobs}
        self._total = self._planned.pop("total")
        self._stages = {rule: stage_of(rule, stages) for rule in self._planned}
        self._run_begin = time.monotonic()
        # Others' processes share the processors: as many as on average in the last minute.
        processes = os.getloadavg()[0] + self._cores
        self._crowding = max(1.0, processes / (os.cpu_count() or 1))
        minutes = math.ceil(self._cost(self._planned) / 60)
        how_long = f"about {minutes} minutes" if minutes > 1 else "about a minute or less"
        self._say(f"{_jobs(self._total)}, {how_long}")
        threading.Thread(target=self._break_silence, daemon=True).start()

    def _cost(self, jobs: Mapping[str, int]) -> float:
        """Return the time (s) that numbers of jobs by rule take on cores that others share."""
        seconds = sum(self._stages[rule].seconds * count for rule, count in jobs.items())
        return seconds / self._cores * self._crowding

    def _progress(self) -> str:
        """Return the number of finished jobs, and the remaining time from the costs of jobs.

        At first the table of costs counts more than the time of finished jobs, because most of the
        time has then gone into unfinished jobs.
        """
        planned, finished = self._cost(self._planned), self._cost(self._done)
        prior = PRIOR_SHARE * planned
        elapsed = time.monotonic() - self._run_begin
        remaining = (planned - finished) * (elapsed + prior) / (finished + prior)
        left = timedelta(seconds=round(max(remaining, 0)))
        return f"{self._done.total()} of {_jobs(self._total)} done, about {left} left"

    def _break_silence(self) -> None:
        """Show the progress if there was no line for a while."""
        while not self._ended.wait(1):
            if time.monotonic() - self._last_line > MAX_SILENCE_SECONDS:
                self._say(self._progress())

    def _start(self, job: int, rule: str, message: str | None) -> None:
        self._rules[job] = rule
        self._begin.setdefault(rule, time.monotonic())
        if message:
            self._say(message)

    def _finish(self, rule: str) -> None:
        """Count a finished job; show a line if its rule has no further jobs."""
        self._done[rule] += 1
        if self._done[rule] == self._planned[rule]:
            took = timedelta(seconds=round(time.monotonic() - self._begin[rule]))
            name, jobs = self._stages[rule].name, _jobs(self._planned[rule])
            self._say(f"{name:40}{jobs:>8} in {took}, {self._progress()}")

    def close(self) -> None:
        """End the thread that breaks silence."""
        self._ended.set()
        super().close()


def _jobs(count: int) -> str:
    return "1 job" if count == 1 else f"{count} jobs"
