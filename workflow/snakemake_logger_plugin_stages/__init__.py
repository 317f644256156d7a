"""What a run shows in the terminal: a line a stage, the jobs done and the time left.

A plugin that Snakemake finds by the name of this package. A stage is all jobs of one rule. Dry
runs, `--quiet` and `--verbose` show Snakemake's own log, which `.snakemake/log` has of every run.
"""

import os
import sys
import threading
import time
from collections import Counter
from collections.abc import Mapping
from datetime import timedelta
from functools import partial
from itertools import takewhile
from logging import WARNING, LogRecord

from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_stages.costs import Stage, read_stages, stage_of

#: The logger of what a study itself says.
STUDY = "snakemake.logging.study"
#: Seconds after which a line says how far the run is, if nothing else did.
SILENCE = 30
#: Exceptions that tell once more of a job that has failed.
OF_JOBS = ("CalledProcessError", "RuleException")
#: What Snakemake says at the end of a run in which a job has failed.
NOT_ALL = "At least one job did not complete successfully."
#: Options whose words on the command line are configuration files, or keys with values.
CONFIGFILE, CONFIG = ("--configfile", "--configfiles"), ("--config", "-C")
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
        self._stream = sys.stdout if settings.stdout else sys.stderr
        self._stages: dict[str, Stage] = {}
        self._planned: dict[str, int] = {}  # jobs of each rule
        self._done = Counter[str]()
        self._rules: dict[int, str] = {}  # by job
        self._begin: dict[str, float] = {}  # of the first job of each rule
        self._ended = threading.Event()
        self._last_line = time.monotonic()
        if not self._own_log:
            self._say("Planning the run ...")

    def emit(self, record: LogRecord) -> None:
        """Show what begins, what ends, and what is to be read."""
        event, said = getattr(record, "event", None), vars(record)
        if event == LogEvent.ERROR and not self._planned and (faults := _faults_of_words()):
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
        elif event == LogEvent.ERROR and self._planned and _tells_again(record):
            pass
        elif (
            record.levelno >= WARNING
            or record.name == STUDY
            or record.getMessage() == NOTHING_TO_BE_DONE_MSG
        ):
            self._say(self.format(record))

    def _say(self, text: str) -> None:
        self._last_line = time.monotonic()
        print(text, file=self._stream, flush=True)

    def _plan(self, jobs: dict[str, int]) -> None:
        """Show how many jobs there will be, by rule, and about how long they take."""
        stages, self._planned = read_stages(), {**jobs}
        self._total = self._planned.pop("total")
        self._stages = {rule: stage_of(rule, stages) for rule in self._planned}
        self._run_begin = time.monotonic()
        minutes = self._cost(self._planned) / (os.cpu_count() or 1) / 60
        how_long = f"about {minutes:.0f} minutes" if minutes > 1.5 else "about a minute or less"
        self._say(f"{self._total} jobs, {how_long} on grids of a quick study")
        threading.Thread(target=self._break_silence, daemon=True).start()

    def _cost(self, jobs: Mapping[str, int]) -> float:
        """Return the processor time (s) of jobs of a quick study, by rule."""
        return sum(self._stages[rule].seconds * count for rule, count in jobs.items())

    def _position(self) -> str:
        """Return how many jobs have ended and how long the others take, by what they cost."""
        done = f"{self._done.total()} of {self._total} jobs done"
        if not (spent := self._cost(self._done)):
            return done
        elapsed = time.monotonic() - self._run_begin
        left = elapsed * (self._cost(self._planned) / spent - 1)
        return f"{done}, about {timedelta(seconds=round(max(left, 0)))} left"

    def _break_silence(self) -> None:
        """Say how far the run is, where nothing else did for a while."""
        while not self._ended.wait(1):
            if time.monotonic() - self._last_line > SILENCE:
                self._say(self._position())

    def _start(self, job: int, rule: str) -> None:
        self._rules[job] = rule
        self._begin.setdefault(rule, time.monotonic())

    def _finish(self, rule: str) -> None:
        """Count a job that has ended; of a rule without further jobs show a line."""
        self._done[rule] += 1
        if self._done[rule] == self._planned[rule]:
            took = timedelta(seconds=round(time.monotonic() - self._begin[rule]))
            name, jobs = self._stages[rule].name, self._planned[rule]
            self._say(f"{name:40}{jobs:4} jobs in {took}, {self._position()}")

    def close(self) -> None:
        """End the thread that breaks silence."""
        self._ended.set()
        super().close()


def _tells_again(record: LogRecord) -> bool:
    """Return whether an error is that of a job that has failed, which has a line already."""
    return vars(record)["exception"] in OF_JOBS or record.getMessage().endswith(NOT_ALL)


def _words_of(options: tuple[str, ...]) -> list[str]:
    """Return the words of options on the command line."""
    words = list[str]()
    for place, word in enumerate(sys.argv):
        option, _, value = word.partition("=")
        if option in options:
            after = takewhile(lambda word: not word.startswith("-"), sys.argv[place + 1 :])
            words += [value] if value else after
    return words


def _faults_of_words() -> str:
    """Return what is wrong with the configuration on the command line, a line each.

    Snakemake tells neither the file nor the line of a file, nor the key.
    """
    from hardcontact.config.configuration import refuse_unreadable
    from hardcontact.config.faults import refuse_all

    checks = [
        *(partial(refuse_unreadable, path) for path in _words_of(CONFIGFILE)),
        *(partial(_refuse_pair, word) for word in _words_of(CONFIG)),
    ]
    try:
        refuse_all(checks)
    except ValueError as error:
        return "\n".join(f"error: {line}" for line in str(error).splitlines())
    return ""


def _refuse_pair(word: str) -> None:
    """Refuse a word of `--config` that is no KEY=VALUE, or whose key has dots."""
    key, equals, value = word.partition("=")
    if not equals:
        raise ValueError(
            f"--config: expected KEY=VALUE, found {word} (targets stand before --config)"
        )
    section, dot, name = key.partition(".")
    if dot:
        nested = f"{{{name.replace('.', ': {')}: {value}" + "}" * key.count(".")
        raise ValueError(f"--config: expected '{section}={nested}', found {word}")
