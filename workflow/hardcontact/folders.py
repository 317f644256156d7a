"""Folders of results: one run at a time works in each."""

import fcntl
from pathlib import Path

from hardcontact.dataset import remove_parts

__all__ = ["hold"]


def hold(folder):
    """Keep every other run out of a folder until this process ends, and clear it of half files.

    The system lets go of the folder when the process ends, however it ends: a run that was killed
    leaves nothing to unlock. Returns the open file that must be kept.
    Raises ValueError if another run holds the folder or nothing can be written there.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = open(folder / ".lock", "w")
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise ValueError(
            f"{folder}: expected no other run in this folder, found one; "
            "wait until it has ended, or stop it"
        ) from None
    except OSError as error:
        raise ValueError(
            f"{folder}: expected a folder to write to, found: {error.strerror}"
        ) from None
    remove_parts(folder)
    return file
