"""Reading scans of any microscope, within limits on time and memory.

A scan is read by a process of its own, because damaged or hostile bytes may make a reader, or the
C libraries below it, crash, hang or fill the memory. SurfaceTopography is imported when the first
scan is read.
"""

import logging
import multiprocessing
import os
import resource
import sys
import tempfile
import warnings
from pathlib import Path
from typing import IO

import numpy as np

from hardcontact.surfaces.height_map import HeightMap

__all__ = ["read_scan"]

#: What reading one scan may take: bytes beyond those of this process, and seconds of computing.
MEMORY_LIMIT = 4 * 2**30
TIME_LIMIT = 120
#: Exit code of a process that refused a scan and wrote the reason.
REFUSED = 3


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    basis: str = "measured",
) -> HeightMap:
    """Read a scan.

    Parameters
    ----------
    path : str or Path
        Any format SurfaceTopography reads, or a contact.engineering container (.zip).
    dataset : str
        The member of a container, by its name or data file; empty for any other file.
    undefined_pixels : str
        ``"refuse"``, or the name of an interpolation of SurfaceTopography (``"harmonic"``) that
        fills them.
    basis : str
        What the scan is: ``"measured"`` or ``"substitute"``.

    Returns
    -------
    HeightMap
        Not periodic; heights in float64.

    Raises
    ------
    ValueError
        In one line, if the scan is missing, unreadable, too large, without physical size or unit,
        not square, on pixels that are not square, of absurd size, height or slope, or has
        undefined pixels that may not be filled.
    """
    # Imported before the process is forked: once for all scans, and outside its limits.
    import hardcontact.surfaces.scan_formats  # noqa: F401

    with tempfile.TemporaryFile(buffering=0) as answer:
        reading = multiprocessing.get_context("fork").Process(
            target=_answer, args=(answer, Path(path), dataset, undefined_pixels), daemon=True
        )
        reading.start()
        reading.join(5 * TIME_LIMIT)  # time on the clock, with waits for a processor or a disk
        reading.kill()
        reading.join()
        answer.seek(0)
        if reading.exitcode == 0:
            return HeightMap(np.load(answer), float(np.load(answer)), False, basis)
        if reading.exitcode == REFUSED:
            raise ValueError(f"{path}: {answer.read().decode()}")
    raise ValueError(
        f"{path}: expected a readable scan, found one whose reader crashes or takes more than "
        f"{TIME_LIMIT} s (exit code {reading.exitcode})"
    )


def _answer(answer: IO[bytes], path: Path, dataset: str, undefined_pixels: str) -> None:
    """Write heights and pixel size of a scan to the file `answer`, or why there are none.

    Runs in a process of its own, silently: readers log, warn and print.
    """
    from hardcontact.surfaces.scan_formats import RefusedScan, heights_of

    _quiet_and_limited()
    try:
        heights, pixel_size = heights_of(path, dataset, undefined_pixels)
    except RefusedScan as error:
        reason = str(error)
    except Exception as error:  # damaged bytes may raise anything in a reader
        text = f"{type(error).__name__}: {error}"[:200]
        reason = f"expected a readable scan, found one damaged or of an unknown kind ({text})"
    else:
        np.save(answer, heights)
        np.save(answer, pixel_size)
        return
    printable = "".join(letter if letter.isprintable() else " " for letter in reason[:2000])
    answer.write(" ".join(printable.split()).encode())
    sys.exit(REFUSED)


def _quiet_and_limited() -> None:
    """Silence this process and limit its time and memory."""
    logging.disable()
    warnings.simplefilter("ignore")
    for stream in (1, 2):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_CPU, TIME_LIMIT)
    if sys.platform == "linux":  # elsewhere only time is limited
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        _limit(resource.RLIMIT_AS, pages * resource.getpagesize() + MEMORY_LIMIT)


def _limit(kind: int, most: int) -> None:
    """Limit a resource of this process; a lower limit that it already has stays."""
    _, hard = resource.getrlimit(kind)
    resource.setrlimit(kind, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
