"""Files that appear completely or not at all."""

import glob
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

#: Prefix of the names of incomplete files.
PART = ".part-"


@contextmanager
def atomic_file(path: str | Path) -> Iterator[str]:
    """Yield a temporary path in the same folder; rename it if the block succeeds, else remove it.

    Missing folders are made. The content reaches the disk before the name, so that no power loss
    leaves half a file. Raises ValueError, with one line, if the file cannot be written.
    """
    path = Path(path)
    temporary = path.with_name(f"{PART}{secrets.token_hex(4)}-{path.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield str(temporary)
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as error:
        existing = next(folder for folder in path.parents if folder.exists())
        raise ValueError(
            f"{path}: expected a file to be written, found: {error.strerror or error}; "
            f"{shutil.disk_usage(existing).free / 1e6:.1f} MB of the disk are free"
        ) from error
    finally:
        if path.parent.is_dir():
            temporary.unlink(missing_ok=True)


def remove_parts(path: str | Path) -> None:
    """Remove incomplete versions of a file from killed processes; nobody else may write it now."""
    path = Path(path)
    for part in path.parent.glob(f"{PART}*-{glob.escape(path.name)}"):
        part.unlink(missing_ok=True)
