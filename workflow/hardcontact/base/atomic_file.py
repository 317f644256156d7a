"""Write files that are complete or missing: each is written under another name and then renamed."""

import glob
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

#: Prefix of the names of incomplete files.
INCOMPLETE_PREFIX = ".part-"


@contextmanager
def atomic_file(path: str | Path) -> Iterator[str]:
    """Yield a temporary path in the same folder; rename it if the block succeeds, else remove it.

    Raises ValueError, with one line, if the file cannot be written.
    """
    path = Path(path)
    temporary = path.with_name(f"{INCOMPLETE_PREFIX}{secrets.token_hex(4)}-{path.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield str(temporary)
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())  # Otherwise a power loss may leave an empty file.
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


def write_text_file(path: str | Path, text: str) -> None:
    """Write a text by `atomic_file`."""
    with atomic_file(path) as temporary:
        Path(temporary).write_text(text, "utf-8")


def remove_incomplete_files(path: str | Path) -> None:
    """Remove the incomplete versions of a file, left by killed jobs; no job may be writing it."""
    path = Path(path)
    for incomplete_path in path.parent.glob(f"{INCOMPLETE_PREFIX}*-{glob.escape(path.name)}"):
        incomplete_path.unlink(missing_ok=True)
