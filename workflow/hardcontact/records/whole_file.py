"""Files that appear whole or not at all, and folders that one run at a time works in."""

import fcntl
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

#: Names of files that are not whole yet begin with this.
PART = ".part-"


@contextmanager
def whole_file(path: str | Path) -> Iterator[str]:
    """Give a temporary path beside `path`; rename it if the block succeeds, else remove it.

    Folders above the file are made. A ValueError of one line says that it cannot be written.
    """
    path = Path(path)
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=PART, suffix=path.suffix)
        os.close(handle)
        yield temporary
        mask = os.umask(0)  # which cannot be read but by setting it
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, path)
    except OSError as error:
        there = next(folder for folder in path.parents if folder.exists())
        raise ValueError(
            f"{path}: expected a file to be written, found: {error.strerror or error}; "
            f"{shutil.disk_usage(there).free / 1e6:.1f} MB of the disk are free"
        ) from error
    finally:
        if temporary:
            Path(temporary).unlink(missing_ok=True)


def hold(folder: str | Path) -> TextIO:
    """Keep every other run out of a folder until this process ends.

    Unfinished files of jobs that were killed, anywhere below it, are removed. The folder is made if
    there is none, and released by the system when the process ends, however it ends: after a run
    that was killed there is nothing to unlock. The open file that is returned is to be kept until
    then. A ValueError of one line says that another run holds the folder or that it is unwritable.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = open(folder / ".lock", "w")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            file.close()
            raise
    except BlockingIOError:
        raise ValueError(
            f"{folder}: expected no other run in this folder, found one; "
            "wait until it has ended, or stop it"
        ) from None
    except OSError as error:
        raise ValueError(
            f"{folder}: expected a folder to write to, found: {error.strerror}"
        ) from None
    for path in folder.rglob(f"{PART}*"):
        path.unlink(missing_ok=True)
    return file


def refuse_future(folder: str | Path) -> None:
    """Refuse files of the future anywhere below a folder, a line each, as a ValueError.

    All that is made from such a file is older than it, and would be made again in every run.
    """
    now = time.time() + 60  # clocks of machines that share a file system differ a little
    paths = (path for path in sorted(Path(folder).rglob("*")) if path.lstat().st_mtime > now)
    lines = [
        f"{path}: expected a file of the past, found one of {time.ctime(path.lstat().st_mtime)}; "
        "give it a time of today (touch)"
        for path in paths
    ]
    if lines:
        raise ValueError("\n".join(lines))
