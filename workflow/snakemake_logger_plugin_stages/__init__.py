"""What a run shows in the terminal: a line a stage, a bar while it runs, and the time left.

A plugin that Snakemake finds by the name of this package. A stage is all jobs of one rule. Dry
runs, `--quiet` and `--verbose` show Snakemake's own log, which `.snakemake/log` has of every run.
"""

import os
import sys
import threading
import time
from datetime import timedelta
from functools import partial
from itertools import takewhile
from logging import WARNING, LogRecord

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    Task,
    TextColumn,
    TimeElapsedColumn,
)
from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_stages.costs import read_stages, stage_of

#: The logger of what a study itself says.
STUDY = "snakemake.logging.study"
#: Seconds after which a line says how far the run is, if nothing else did.
SILENCE = 30
#: Exceptions that tell once more of a job that has failed.
OF_JOBS = ("CalledProcessError", "RuleException")
#: Options whose words on the command line are configuration files.
CONFIGFILE = ("--configfile", "--configfiles")
#: Exceptions whose last line tells a user all: of configuration files that cannot be read.
OF_FILES = ("FileNotFoundError", "IsADirectoryError", "PermissionError", "RecursionError")


class LogHandler(LogHandlerBase):
    """Shows stages, what Snakemake warns of, and what the study says."""

    writes_to_stream = True
    writes_to_file = False
    has_filter = False
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self) -> None:
        """Prepare to show a run."""
        settings = self.common_settings
        self._own_log = bool(settings.dryrun or settings.verbose or settings.quiet)
        self._console = Console(file=sys.stdout if settings.stdout else sys.stderr, highlight=False)
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            console=self._console,
            transient=True,
            disable=not self._console.is_terminal,
        )
        self._tasks: dict[str, Task] = {}
        self._rules: dict[int, str] = {}
        self._cost: dict[str, float] = {}  # of a job, relative to the others
        self._spent = self._begin = 0.0
        self._ended = threading.Event()
        self._last_line = time.monotonic()
        if not self._own_log:
            self._say("Planning the run ...")

    def emit(self, record: LogRecord) -> None:
        """Show what begins, what ends, and what is to be read."""
        event, said = getattr(record, "event", None), vars(record)
        if event == LogEvent.ERROR and not self._tasks and (faults := _faults_of_files()):
            self._say(faults)
        elif event == LogEvent.ERROR and said["exception"] in OF_FILES:
            self._say("error: " + record.getMessage().strip().splitlines()[-1])
        elif self._own_log:
            self._say(self.format(record))
        elif event == LogEvent.RUN_INFO:
            self._plan(said["stats"])
        elif event == LogEvent.JOB_INFO:
            self._start(said["jobid"], said["rule_name"])
            if said["rule_msg"]:
                self._say(said["rule_msg"])
        elif event == LogEvent.JOB_FINISHED:
            self._finish(self._rules[said["job_id"]])
        elif event == LogEvent.JOB_ERROR:
            self._say(f"Error in rule {said['rule_name']}: see {', '.join(said['log'])}")
        elif event == LogEvent.ERROR and said["exception"] in OF_JOBS and self._tasks:
            pass
        elif (
            record.levelno >= WARNING
            or record.name == STUDY
            or record.getMessage() == NOTHING_TO_BE_DONE_MSG
        ):
            self._say(self.format(record))

    def _say(self, text: str) -> None:
        self._last_line = time.monotonic()
        self._console.print(text, markup=False, soft_wrap=True)

    def _plan(self, jobs: dict[str, int]) -> None:
        """Show how many jobs there will be: by rule, and in total."""
        stages = read_stages()
        for rule, count in jobs.items():
            stage = stage_of(rule, stages)
            task = self._progress.add_task(stage.name, total=count, start=False, visible=False)
            self._tasks[rule] = self._progress.tasks[task]
            self._cost[rule] = 0 if rule == "total" else stage.seconds
        self._begin = time.monotonic()
        minutes = self._whole_cost() / (os.cpu_count() or 1) / 60
        how_long = f"about {minutes:.0f} minutes" if minutes > 1.5 else "about a minute or less"
        self._say(f"{jobs['total']} jobs, {how_long} on grids of a quick study")
        self._show("total")
        self._progress.start()
        threading.Thread(target=self._break_silence, daemon=True).start()

    def _whole_cost(self) -> float:
        return sum(cost * (self._tasks[rule].total or 0) for rule, cost in self._cost.items())

    def _position(self) -> str:
        """Return how many jobs have ended and how long the others take, by what they cost."""
        total, elapsed = self._tasks["total"], time.monotonic() - self._begin
        done = f"{total.completed:.0f} of {total.total:.0f} jobs done"
        if not self._spent:
            return done
        left = elapsed * (self._whole_cost() / self._spent - 1)
        return f"{done}, about {timedelta(seconds=round(max(left, 0)))} left"

    def _break_silence(self) -> None:
        """Say how far the run is, where nothing else did for a while."""
        while not self._ended.wait(1):
            if time.monotonic() - self._last_line > SILENCE:
                self._say(self._position())

    def _show(self, rule: str) -> None:
        task = self._tasks[rule]
        self._progress.start_task(task.id)
        self._progress.update(task.id, visible=True)

    def _start(self, job: int, rule: str) -> None:
        """Show the bar of a rule from its first job on."""
        self._rules[job] = rule
        if not self._tasks[rule].started:
            self._show(rule)

    def _finish(self, rule: str) -> None:
        """Count a job that has ended; of a rule without further jobs a line stays."""
        stage, total = self._tasks[rule], self._tasks["total"]
        for task in (stage, total):
            self._progress.advance(task.id)
        self._spent += self._cost[rule]
        if stage.finished:
            self._progress.update(stage.id, visible=False)
            took = timedelta(seconds=round(stage.finished_time or 0))
            self._say(
                f"{stage.description:40}{stage.total:4.0f} jobs in {took}, {self._position()}"
            )

    def close(self) -> None:
        """Take the bars away."""
        self._ended.set()
        self._progress.stop()
        super().close()


def _faults_of_files() -> str:
    """Return what is wrong with the configuration files of the command line, a line each.

    Snakemake tells neither the file nor the line.
    """
    from hardcontact.config.configuration import refuse_unreadable
    from hardcontact.config.faults import refuse_all

    paths = list[str]()
    for place, word in enumerate(sys.argv):
        option, _, value = word.partition("=")
        if option in CONFIGFILE:
            after = takewhile(lambda word: not word.startswith("-"), sys.argv[place + 1 :])
            paths += [value] if value else after
    try:
        refuse_all(partial(refuse_unreadable, path) for path in paths)
    except ValueError as error:
        return "\n".join(f"error: {line}" for line in str(error).splitlines())
    return ""
