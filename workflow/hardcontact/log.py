"""The log of a job: how far it is, and its error in one line."""

import logging
import os
import sys

__all__ = ["progress", "start"]

_logger = logging.getLogger("hardcontact")


def start(path):
    """Write the job's log to `path`; an error goes there in full and to stderr in one line."""
    sys.excepthook = _report
    # Where the log cannot be written, the one line on stderr is all there is.
    logging.raiseExceptions, logging.lastResort = False, None
    handler = logging.FileHandler(path, mode="w", encoding="utf-8")
    handler.setFormatter(logging.Formatter("%(asctime)s %(message)s", "%H:%M:%S"))
    _logger.addHandler(handler)
    _logger.setLevel(logging.INFO)


def _report(kind, error, trace):
    _logger.error("failed", exc_info=(kind, error, trace))
    print(f"error: {' '.join(str(error).split()) or kind.__name__}", file=sys.stderr, flush=True)
    os._exit(1)  # netCDF that could not write crashes when Python cleans up


def progress(steps, total, what):
    """Pass `steps` on and log how many of `total` are done, about every tenth."""
    for done, step in enumerate(steps, start=1):
        yield step
        if done == total or done * 10 // total > (done - 1) * 10 // total:
            _logger.info("%s: %d of %d", what, done, total)
