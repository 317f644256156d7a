"""Folders of results: one run at a time works in each."""

import fcntl
from pathlib import Path
from typing import TextIO

from hardcontact.records.whole_file import remove_parts

__all__ = ["hold"]


def hold(folder: str | Path) -> TextIO:
    """Keep every other run out of a folder until this process ends; remove unfinished files.

    The system releases the folder when the process ends, however it ends: after a run that was
    killed there is nothing to unlock.

    Parameters
    ----------
    folder : str or Path
        It is made if there is none.

    Returns
    -------
    file object
        The open file to be kept until the folder may be released.

    Raises
    ------
    ValueError
        In one line, if another run holds the folder or nothing can be written there.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = open(folder / ".lock", "w")
    except OSError as error:
        raise _unwritable(folder, error) from None
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        file.close()
        if not isinstance(error, BlockingIOError):
            raise _unwritable(folder, error) from None
        raise ValueError(
            f"{folder}: expected no other run in this folder, found one; "
            "wait until it has ended, or stop it"
        ) from None
    remove_parts(folder)
    return file


def _unwritable(folder: Path, error: OSError) -> ValueError:
    return ValueError(f"{folder}: expected a folder to write to, found: {error.strerror}")
