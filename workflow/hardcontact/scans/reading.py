"""Read scans of any microscope, in a child process, because their bytes may be hostile.

The child can open and write no file, and has limits of time and, on Linux, of memory.
"""

import faulthandler
import io
import json
import logging
import multiprocessing
import os
import resource
import sys
import tempfile
import warnings
import zipfile
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from hardcontact.scans.heights import RefusedFile
from hardcontact.surfaces.height_map import HeightMap

#: The largest file in bytes: four times a map of 8192 x 8192 pixels in single precision.
MAX_FILE_BYTES = 2**30
#: Memory that the child may add, in bytes: for any file, more for each byte read, and at most.
SMALL_FILE_MEMORY = 2**29
MEMORY_PER_BYTE = 200
MAX_MEMORY = 4 * 2**30
#: Processor time of the child in s: for any file, more for each 2**20 bytes read, and at most.
SMALL_FILE_SECONDS = 2
SECONDS_PER_MEGABYTE = 10
MAX_SECONDS = 120
#: Elapsed time in s, with waits for a processor: five times the longest processor time.
MAX_WAIT_SECONDS = 600
#: Pixels under a mask of the file are heights (keep), or undefined (exclude).
MASKS = ("keep", "exclude")
#: The longest message in characters.
MAX_MESSAGE_LENGTH = 2000


class ReadingOptions(NamedTuple):
    """How scans are read; tip radius, unit and size serve files that state none.

    Undefined pixels are filled by default, because commands, which use these options, print how
    many they fill; `hardcontact new` writes the key `scan.undefined_pixels` into the study, too.
    The defaults of this key and of `read_scan` refuse undefined pixels, because filled ones are
    smoother than the surface. `api.read_spectrum` fills them as `hardcontact predict` does.
    """

    tip_radius: float | None = None  #: In nm.
    unit: str = "none"  #: Unit of length, or units of positions and of heights.
    map_size: float | str = "none"  #: Longer side in nm.
    levelling: str = "plane"  #: One of LEVELLING_METHODS.
    mask: str = "keep"  #: One of MASKS.
    undefined_pixels: str = "harmonic"  #: Fills gaps; "refuse" refuses a scan with gaps.

    def read_scan(self, path: str | Path, dataset: str) -> HeightMap:
        """Read a scan, not levelled; later steps use the tip radius and the levelling."""
        return read_scan(path, dataset, self.undefined_pixels, self.unit, self.map_size, self.mask)


#: How scans are read if the user gives no option.
DEFAULT_OPTIONS = ReadingOptions()


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    unit: str = DEFAULT_OPTIONS.unit,
    map_size: float | str = DEFAULT_OPTIONS.map_size,
    mask: str = DEFAULT_OPTIONS.mask,
) -> HeightMap:
    """Read a square of a map, or a line scan, not levelled.

    The arguments are those of `api.read_scan`. Raises ValueError, in one line, if the scan cannot
    be used.
    """
    from hardcontact.scans.formats import read_fields

    fields = read_in_child(read_fields, Path(path), dataset, undefined_pixels, unit, map_size, mask)
    fields["notes"] = tuple(" ".join(note.split()) for note in fields["notes"])
    return HeightMap(path=str(path), **fields)


def list_scans(path: str | Path) -> list[str]:
    """Return the names of a container's data files, or one empty name for any other file."""
    # `read_scan` refuses a missing file.
    if not (Path(path).is_file() and zipfile.is_zipfile(path)):
        return [""]
    from hardcontact.scans.open_file import list_datasets

    return list(read_in_child(list_datasets, Path(path))["datasets"])


def read_in_child(
    reader: Callable[..., dict[str, Any]], path: Path, *arguments: str | float
) -> dict[str, Any]:
    """Return what a reader makes of the bytes of a file in a child process, or raise ValueError.

    The child sends two messages, the fields as JSON and the heights as a NumPy array, because to
    load them runs no code. If the child is killed for its time or memory, no message comes.
    """
    size = _file_size(path)
    seconds = min(MAX_SECONDS, SMALL_FILE_SECONDS + SECONDS_PER_MEGABYTE * size // 2**20)
    memory = min(MAX_MEMORY, SMALL_FILE_MEMORY + MEMORY_PER_BYTE * size)
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    with tempfile.TemporaryDirectory() as folder:
        child = context.Process(
            target=_run_child,
            args=(sender, folder, seconds, memory, reader, path.absolute(), *arguments),
            daemon=True,
        )
        child.start()
        sender.close()
        try:
            if not receiver.poll(MAX_WAIT_SECONDS):
                raise EOFError
            answer: dict[str, Any] = json.loads(receiver.recv_bytes())
            answer["heights"] = np.load(io.BytesIO(receiver.recv_bytes()))
        except EOFError:
            answer = {
                "refused": "expected a readable scan, found a file whose reader stops by itself or "
                f"takes more than {seconds} s or {memory >> 20} MB, which a file of this size may "
                "take: save the heights as text or netCDF"
            }
        finally:
            child.kill()
            child.join()
            receiver.close()
    if "refused" in answer:
        raise ValueError(f"{path}: {' '.join(answer['refused'].split())}")
    return answer


def _file_size(path: Path) -> int:
    """Return the size of a file in bytes; raise ValueError if it cannot be a scan."""
    if path.is_dir():
        raise ValueError(
            f"{path}: expected a scan, found a folder: name a file in it; hardcontact "
            "new takes all of them"
        )
    if not path.is_file():
        reason = "no regular file" if path.exists() else "no such file"
        raise ValueError(f"{path}: expected a scan, found {reason}")
    size = path.stat().st_size
    if not 0 < size <= MAX_FILE_BYTES:
        raise ValueError(f"{path}: expected a scan of 1 to {MAX_FILE_BYTES} bytes, found {size}")
    return size


def _run_child(
    sender: Connection,
    folder: str,
    seconds: int,
    memory: int,
    reader: Callable[..., dict[str, Any]],
    path: Path,
    *arguments: str | float,
) -> None:
    """Send the answer of a reader, whose log and prints are dropped."""
    faulthandler.disable()
    logging.disable()
    warnings.simplefilter("ignore")
    for output in (1, 2):  # standard output, standard error
        os.dup2(os.open(os.devnull, os.O_WRONLY), output)
    try:
        content = path.read_bytes()
        os.chdir(folder)
        _limit_resources(seconds, memory)
        answer = reader(content, *arguments)
    except RefusedFile as error:
        answer = {"refused": str(error)[:MAX_MESSAGE_LENGTH]}
    except Exception as error:  # damaged bytes may raise anything in a reader
        answer = {
            "refused": "expected a readable scan, found one that its reader cannot follow "
            f"({type(error).__name__}: {str(error)[:200]}): save the heights as text or netCDF"
        }
    array = io.BytesIO()
    np.save(array, answer.pop("heights", np.empty(0)))
    sendable = {key: _replace_control_characters(value) for key, value in answer.items()}
    sender.send_bytes(json.dumps(sendable).encode())
    sender.send_bytes(array.getbuffer())


def _replace_control_characters(value: Any) -> Any:
    """Return a text or a list with blanks for control characters, any other value unchanged."""
    if isinstance(value, list):
        return [_replace_control_characters(item) for item in value]
    if isinstance(value, str):
        return "".join(letter if letter.isprintable() else " " for letter in value)
    return value


def _limit_resources(seconds: int, memory: int) -> None:
    """Limit the time (s) and the added memory (bytes) of this process, and let it open no file."""
    limits = {
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_FSIZE: 0,  # writes nothing
        resource.RLIMIT_NOFILE: 0,  # opens nothing; open files stay open
        resource.RLIMIT_CPU: seconds,
    }
    if sys.platform == "linux":  # elsewhere the memory is not limited
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        limits[resource.RLIMIT_AS] = pages * resource.getpagesize() + memory
    for kind, limit in limits.items():
        _, hard_limit = resource.getrlimit(kind)
        limit = limit if hard_limit == resource.RLIM_INFINITY else min(limit, hard_limit)
        resource.setrlimit(kind, (limit, hard_limit))
