"""The lines of a run in the terminal: one a stage, with the jobs done and the time left.

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
from datetime import timedelta
from difflib import get_close_matches
from functools import partial
from itertools import takewhile
from logging import WARNING, LogRecord

from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_stages.costs import Stage, read_stages, stage_of

#: The logger of a study's own messages.
STUDY_LOGGER = "snakemake.logging.study"
#: Seconds without a line after which a line reports the progress.
MAX_SILENCE_SECONDS = 30
#: Exceptions that repeat the failure of a job.
JOB_EXCEPTIONS = ("CalledProcessError", "RuleException")
#: Snakemake's message at the end of a run in which a job has failed.
INCOMPLETE_MESSAGE = "At least one job did not complete successfully."
#: Options whose words on the command line are configuration files, or keys with values.
CONFIGFILE = ("--configfile", "--configfiles")
CONFIG = ("--config", "-C")
#: Exceptions for unreadable configuration files, whose last line is all that a user needs.
FILE_EXCEPTIONS = ("FileNotFoundError", "IsADirectoryError", "PermissionError", "RecursionError")


class LogHandler(LogHandlerBase):
    """Shows stages, Snakemake's warnings and the study's messages."""

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
        """Show stages that begin or end, and messages."""
        event = getattr(record, "event", None)
        fields = vars(record)
        if event == LogEvent.ERROR and not self._planned and (faults := _command_line_faults()):
            self._say(faults)
        elif event == LogEvent.ERROR and fields["exception"] == "MissingRuleException":
            self._say(_missing_target(record.getMessage()))
        elif event == LogEvent.ERROR and fields["exception"] in FILE_EXCEPTIONS:
            self._say("error: " + record.getMessage().strip().splitlines()[-1])
        elif self._own_log:
            self._say(self.format(record))
        elif event == LogEvent.RUN_INFO:
            self._plan(fields["stats"])
        elif event == LogEvent.JOB_INFO:
            self._start(fields["jobid"], fields["rule_name"])
            if fields["rule_msg"]:
                self._say(fields["rule_msg"])
        elif event == LogEvent.JOB_FINISHED:
            self._finish(self._rules[fields["job_id"]])
        elif event == LogEvent.JOB_ERROR:
            logs = [log for log in fields["log"] if os.path.isfile(log)]
            self._say(
                f"Error in rule {fields['rule_name']}" + f": see {', '.join(logs)}" * bool(logs)
            )
        elif event == LogEvent.ERROR and self._planned and _repeats_failure(record):
            pass
        elif (
            record.levelno >= WARNING
            or record.name == STUDY_LOGGER
            or record.getMessage() == NOTHING_TO_BE_DONE_MSG
        ):
            self._say(self.format(record))

    def _say(self, text: str) -> None:
        self._last_line = time.monotonic()
        print(text, file=self._stream, flush=True)

    def _plan(self, jobs: dict[str, int]) -> None:
        """Show the number of planned jobs and about the time that they take."""
        stages = read_stages(_effort())
        self._planned = {**jobs}
        self._total = self._planned.pop("total")
        self._stages = {rule: stage_of(rule, stages) for rule in self._planned}
        self._run_begin = time.monotonic()
        minutes = math.ceil(self._cost(self._planned) / (os.cpu_count() or 1) / 60)
        how_long = f"about {minutes} minutes" if minutes > 1 else "about a minute or less"
        self._say(f"{self._total} jobs, {how_long}")
        threading.Thread(target=self._break_silence, daemon=True).start()

    def _cost(self, jobs: Mapping[str, int]) -> float:
        """Return the processor time (s) of numbers of jobs by rule."""
        return sum(self._stages[rule].seconds * count for rule, count in jobs.items())

    def _position(self) -> str:
        """Return the number of finished jobs, and the remaining time from the costs of jobs."""
        done = f"{self._done.total()} of {self._total} jobs done"
        if not (spent := self._cost(self._done)):
            return done
        elapsed = time.monotonic() - self._run_begin
        remaining = elapsed * (self._cost(self._planned) / spent - 1)
        return f"{done}, about {timedelta(seconds=round(max(remaining, 0)))} left"

    def _break_silence(self) -> None:
        """Show the progress if there was no line for a while."""
        while not self._ended.wait(1):
            if time.monotonic() - self._last_line > MAX_SILENCE_SECONDS:
                self._say(self._position())

    def _start(self, job: int, rule: str) -> None:
        self._rules[job] = rule
        self._begin.setdefault(rule, time.monotonic())

    def _finish(self, rule: str) -> None:
        """Count a finished job; show a line if its rule has no further jobs."""
        self._done[rule] += 1
        if self._done[rule] == self._planned[rule]:
            took = timedelta(seconds=round(time.monotonic() - self._begin[rule]))
            name = self._stages[rule].name
            jobs = self._planned[rule]
            self._say(f"{name:40}{jobs:4} jobs in {took}, {self._position()}")

    def close(self) -> None:
        """End the thread that breaks silence."""
        self._ended.set()
        super().close()


def _repeats_failure(record: LogRecord) -> bool:
    """Return True if an error repeats the failure of a job, which has a line already."""
    return vars(record)["exception"] in JOB_EXCEPTIONS or record.getMessage().endswith(
        INCOMPLETE_MESSAGE
    )


def _option_words(options: tuple[str, ...]) -> list[str]:
    """Return the words of options on the command line."""
    words = list[str]()
    for index, word in enumerate(sys.argv):
        option, _, value = word.partition("=")
        if option in options:
            following = takewhile(lambda word: not word.startswith("-"), sys.argv[index + 1 :])
            words += [value] if value else following
    return words


def _effort() -> str:
    """Return the column of costs for the command line: "quick" for small grids, else "full"."""
    words = [*_option_words(CONFIGFILE), *_option_words(CONFIG)]
    is_quick = any(word in ("config/quick.yaml", "effort=quick") for word in words)
    return "quick" if is_quick else "full"


def _missing_target(message: str) -> str:
    """Return the line for a target that no rule makes, with a similar one if there is any."""
    from hardcontact.config.configuration import OWN_SURFACE_TARGETS, PAPER_TARGETS
    from hardcontact.report.figures.listing import PAPER_FIGURES

    name = message.partition("produce ")[2].partition(" ")[0]
    similar = get_close_matches(
        name, {*PAPER_TARGETS, *OWN_SURFACE_TARGETS, *PAPER_FIGURES, "crate"}, 1
    )
    question = f" (did you mean {similar[0]}?)" if similar else ""
    return f"error: expected a target of README.md or a file of the study, found {name}{question}"


def _command_line_faults() -> str:
    """Return a line for each fault of the configuration on the command line.

    Snakemake itself names neither the file, its line nor the key.
    """
    from hardcontact.config.configuration import refuse_unreadable
    from hardcontact.config.faults import refuse_all

    checks = [
        *(partial(refuse_unreadable, path) for path in _option_words(CONFIGFILE)),
        *(partial(_refuse_pair, word) for word in _option_words(CONFIG)),
    ]
    try:
        refuse_all(checks)
    except ValueError as error:
        return "\n".join(f"error: {line}" for line in str(error).splitlines())
    return ""


def _refuse_pair(word: str) -> None:
    """Refuse a word of `--config` that is not KEY=VALUE, or whose key has dots."""
    key, equals, value = word.partition("=")
    if not equals:
        raise ValueError(
            f"--config: expected KEY=VALUE, found {word} (targets stand before --config)"
        )
    section, dot, name = key.partition(".")
    if dot:
        nested = f"{{{name.replace('.', ': {')}: {value}" + "}" * key.count(".")
        raise ValueError(f"--config: expected '{section}={nested}', found {word}")
