"""Files that appear whole or not at all, and folders that one run at a time works in."""

import fcntl
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

#: Names of files that are not whole yet begin with this.
PART = ".part-"


@contextmanager
def whole_file(path: str | Path) -> Iterator[str]:
    """Give a temporary path beside `path`; rename it if the block succeeds, else remove it.

    Parameters
    ----------
    path : str or Path
        The file to be written; folders above it are made.

    Yields
    ------
    str
        The path to write to.

    Raises
    ------
    ValueError
        In one line, if the file cannot be written.
    """
    path = Path(path)
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=PART, suffix=path.suffix)
        os.close(handle)
        yield temporary
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        raise ValueError(
            f"{path}: expected a file to be written, found: {error.strerror or error}; "
            f"{_free_megabytes(path.parent):.1f} MB of the disk are free"
        ) from error
    finally:
        if temporary:
            Path(temporary).unlink(missing_ok=True)


def remove_parts(folder: str | Path) -> None:
    """Remove the unfinished files of jobs that were killed, anywhere below a folder."""
    for path in Path(folder).rglob(f"{PART}*"):
        path.unlink(missing_ok=True)


def _free_megabytes(folder: Path) -> float:
    while not folder.exists():
        folder = folder.parent
    return shutil.disk_usage(folder).free / 1e6


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


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
