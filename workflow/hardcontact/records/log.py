"""The log of a job: its progress, and its error in one line."""

import logging
import os
import sys
import traceback
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TypeVar

_logger = logging.getLogger("hardcontact")

Step = TypeVar("Step")


@contextmanager
def job_log(path: str | Path) -> Iterator[None]:
    """Keep the log of a job; an error goes there in full and to stderr in one line.

    An error ends the process at once with exit code 1: netCDF that could not write crashes when
    Python cleans up.

    Parameters
    ----------
    path : str or Path
        The log.
    """
    # Where the log cannot be written, the line on stderr is all there is.
    logging.raiseExceptions, logging.lastResort = False, None
    try:
        handler = logging.FileHandler(path, mode="w", encoding="utf-8")
        handler.setFormatter(logging.Formatter("%(asctime)s %(message)s", "%H:%M:%S"))
        _logger.addHandler(handler)
        _logger.setLevel(logging.INFO)
        yield
    except Exception as error:
        _logger.error("failed\n%s", traceback.format_exc())
        print(_line(error, Path(path)), file=sys.stderr, flush=True)
        os._exit(1)
    else:
        _logger.removeHandler(handler)
        with suppress(OSError):  # the disk may be full
            handler.close()


def _line(error: Exception, path: Path) -> str:
    """Return an error in one line that names the log, if anything could be written there."""
    message = " ".join(str(error).split()) or type(error).__name__
    written = path.is_file() and path.stat().st_size > 0
    return f"error: {message} (see {path})" if written else f"error: {message}"


def progress(steps: Iterable[Step], total: int, what: str) -> Iterator[Step]:
    """Pass on steps and log how many of `total` are done, about ten times in all.

    Parameters
    ----------
    steps : iterable
        Passed on unchanged.
    total : int
        Number of steps.
    what : str
        Name of the steps, in the plural.

    Yields
    ------
    object
        Each step.
    """
    for done, step in enumerate(steps, start=1):
        yield step
        if done == total or done * 10 // total > (done - 1) * 10 // total:
            _logger.info("%s: %d of %d", what, done, total)
