"""Reading scans of any microscope, within limits on time and memory.

A scan is read by a process of its own, because damaged or hostile bytes may make a reader, or the
C libraries below it, crash, hang or fill the memory. SurfaceTopography is imported when the first
scan is read.
"""

import json
import logging
import multiprocessing
import os
import resource
import sys
import tempfile
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import IO, Any

import numpy as np

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.measurement import Measurement

#: What reading one scan may take: bytes beyond those of this process, and seconds of computing.
MEMORY_LIMIT = 4 * 2**30
TIME_LIMIT = 120
#: Exit code of a process that refused a scan and wrote the reason.
REFUSED = 3


def read_measurement(
    path: str | Path, dataset: str = "", undefined_pixels: str = "refuse"
) -> Measurement:
    """Read a topography: a map, or a line scan.

    Parameters
    ----------
    path : str or Path
        Any format SurfaceTopography reads, or a contact.engineering container (.zip).
    dataset : str
        The member of a container, by its name or data file; empty for any other file.
    undefined_pixels : str
        ``"refuse"``, or the name of an interpolation of SurfaceTopography (``"harmonic"``) that
        fills them.

    Returns
    -------
    Measurement
        A map cropped to its central square, or a profile on uniform spacing, in float64.

    Raises
    ------
    ValueError
        In one line, if the scan is missing, unreadable, too large, without physical size or unit,
        on pixels that are not square, reentrant, of absurd size, height or slope, or has undefined
        pixels that may not be filled.
    """
    fields, heights = _in_a_process(_measurement, Path(path), dataset, undefined_pixels)
    notes = tuple(fields.pop("notes"))
    return Measurement(**fields, notes=notes, heights=heights)


def read_scan(
    path: str | Path, dataset: str = "", undefined_pixels: str = "refuse", basis: str = "measured"
) -> HeightMap:
    """Read a height map in float64, not periodic, as `read_measurement` reads it.

    The basis says what the scan is: ``"measured"`` or ``"substitute"``. A ValueError of one line
    tells that `read_measurement` refuses it or that it is a line scan.
    """
    return height_map(read_measurement(path, dataset, undefined_pixels), basis)


def height_map(measurement: Measurement, basis: str) -> HeightMap:
    """Return the height map that was measured; a line scan is a ValueError."""
    if measurement.kind != "map":
        raise ValueError(f"{measurement.path}: expected a height map, found a line scan")
    return HeightMap(measurement.heights, measurement.pixel_size, False, basis)


def flattened(measurement: Measurement, flat: Callable[[HeightMap], HeightMap]) -> Measurement:
    """Return a measured map as `flat` makes it of a height map; a line scan stays as it is."""
    if measurement.kind != "map":
        return measurement
    return replace(measurement, heights=flat(height_map(measurement, "measured")).heights)


def described(measurement: Measurement) -> dict[str, str]:
    """Return what a file says of a scan and what was done in reading it, as attributes."""
    return {
        "channel": measurement.channel,
        "file_unit": measurement.file_unit,
        "notes": "; ".join(measurement.notes),
    }


def list_measurements(path: str | Path) -> list[str]:
    """Return the names by which `read_measurement` finds the topographies of a scan or container.

    They are the data files in a container, in its order; one empty name of any other file. A file
    that is missing, or a container that cannot be used, is a ValueError in one line.
    """
    fields, _ = _in_a_process(_datasets, Path(path))
    return list(fields["datasets"])


#: What a file holds: fields that JSON can hold, and heights.
Content = tuple[dict[str, Any], np.ndarray]


def _measurement(path: Path, dataset: str, undefined_pixels: str) -> Content:
    from hardcontact.surfaces.scan_formats import measurement_of

    fields = dict(vars(measurement_of(path, dataset, undefined_pixels)))
    heights = fields.pop("heights")
    return fields, heights


def _datasets(path: Path) -> Content:
    from hardcontact.surfaces.scan_formats import datasets_of

    return {"datasets": datasets_of(path)}, np.empty(0)


def _in_a_process(read: Callable[..., Content], path: Path, *choices: str) -> Content:
    """Return what `read` does of a file, in a process of its own."""
    # Imported before the process is forked: once for all scans, and outside its limits.
    import hardcontact.surfaces.scan_formats  # noqa: F401

    with tempfile.TemporaryFile(buffering=0) as answer:
        process = multiprocessing.get_context("fork").Process(
            target=_answer, args=(answer, read, path, *choices), daemon=True
        )
        process.start()
        process.join(5 * TIME_LIMIT)  # time on the clock, with waits for a processor or a disk
        process.kill()
        process.join()
        answer.seek(0)
        if process.exitcode == 0:
            return json.loads(answer.readline()), np.load(answer)
        if process.exitcode == REFUSED:
            raise ValueError(f"{path}: {answer.read().decode()}")
    raise ValueError(
        f"{path}: expected a readable scan, found one whose reader crashes or takes more than "
        f"{TIME_LIMIT} s (exit code {process.exitcode})"
    )


def _answer(answer: IO[bytes], read: Callable[..., Content], path: Path, *choices: str) -> None:
    """Write what is read of a file to the file `answer`, or why it is refused.

    Runs in a process of its own, silently: readers log, warn and print.
    """
    from hardcontact.surfaces.measurement import RefusedScan

    _quiet_and_limited()
    try:
        fields, heights = read(path, *choices)
    except RefusedScan as error:
        reason = str(error)
    except Exception as error:  # damaged bytes may raise anything in a reader
        text = f"{type(error).__name__}: {error}"[:200]
        reason = f"expected a readable scan, found one damaged or of an unknown kind ({text})"
    else:
        answer.write(json.dumps(fields).encode() + b"\n")
        np.save(answer, heights)
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
