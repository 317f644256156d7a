"""Progress of a loop in the log of a job."""

import logging
from collections.abc import Iterable, Iterator
from typing import TypeVar

Step = TypeVar("Step")
_logger = logging.getLogger("hardcontact")


def progress(steps: Iterable[Step], total: int, name: str) -> Iterator[Step]:
    """Yield steps and log how many are done, about ten times in all; `name` is their plural."""
    for done, step in enumerate(steps, start=1):
        yield step
        if done == total or done * 10 // total > (done - 1) * 10 // total:
            _logger.info("%s: %d of %d", name, done, total)
