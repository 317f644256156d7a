"""Reading scans of any microscope, within limits on time and memory, and preparing them.

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
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import IO, Any, TypedDict

import numpy as np
import xarray as xr

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.measurement import INFLATION, Measurement, RefusedScan
from hardcontact.surfaces.topography import LEVELLING, flat_map, prepared_scan

#: What reading any scan may take: bytes beyond those of this process, and seconds of computing.
MEMORY_LIMIT = 4 * 2**30
TIME_LIMIT = 120
#: What reading a small one may take, to which a larger one adds INFLATION bytes a byte, and
#: MEGABYTE seconds for each 2**20 bytes.
SMALL_MEMORY, SMALL_TIME, MEGABYTE = 2**29, 2, 10
#: Exit code of a process that refused a scan and wrote the reason.
REFUSED = 3
#: Titles of the files that hold what `prepared_file` returns.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
STITCHED = "scan and its mirror images, periodic"


def read_measurement(
    path: str | Path, dataset: str = "", undefined_pixels: str = "refuse", unit: str = "none"
) -> Measurement:
    """Read a topography: a map cropped to its central square, or a line scan on uniform spacing.

    The file is in any format SurfaceTopography reads, or a contact.engineering container (.zip);
    `dataset` is the member of a container, by its name or data file; of any other file the channel,
    or empty for its own choice. The unit of length, or ``"none"``, is of a file that states none;
    `undefined_pixels` is ``"refuse"``, or the name of an interpolation of SurfaceTopography
    (``"harmonic"``) that fills them. It is a ValueError in one line if the scan is missing,
    unreadable, too large, without physical size or unit, reentrant, of absurd size, height or
    slope, or has undefined pixels that may not be filled.
    """
    from hardcontact.surfaces.scan_formats import measurement_of

    fields = _in_a_process(measurement_of, Path(path), dataset, undefined_pixels, unit)
    fields["notes"] = tuple(fields["notes"])
    return Measurement(**fields)


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    basis: str = "measured",
    unit: str = "none",
) -> HeightMap:
    """Read a height map in float64, not periodic, as `read_measurement` reads it.

    The basis says what the scan is: ``"measured"`` or ``"substitute"``. A ValueError of one line
    tells that `read_measurement` refuses it or that it is a line scan.
    """
    return height_map(read_measurement(path, dataset, undefined_pixels, unit), basis)


def height_map(measurement: Measurement, basis: str) -> HeightMap:
    """Return the height map that was measured; a line scan is a ValueError."""
    if measurement.kind != "map":
        raise ValueError(f"{measurement.path}: expected a height map, found a line scan")
    return HeightMap(measurement.heights, measurement.pixel_size, False, basis)


def prepared_file(
    path: str,
    *,
    basis: str,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    unit: str = "none",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> tuple[xr.Dataset, xr.Dataset]:
    """Read a scan and prepare it: levelled and stitched, as of `topography.prepared_scan`.

    The basis is ``"measured"`` or ``"substitute"``; `dataset`, `undefined_pixels` and `unit` are
    as of `read_measurement`, the levelling is a key of `topography.LEVELLING`. The radius, in nm,
    is that of a scan of the sphere, None of a flat surface.
    """
    measurement = read_measurement(path, dataset, undefined_pixels, unit)
    described = {
        "channel": measurement.channel,
        "file_unit": measurement.file_unit,
        "notes": "; ".join(measurement.notes),
    }
    return prepared_scan(height_map(measurement, basis), sphere_radius, levelling, described)


def flat_measurement(
    path: str | Path,
    dataset: str = "",
    *,
    undefined_pixels: str = "refuse",
    unit: str = "none",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> Measurement:
    """Read a measured topography: a map levelled as in `prepared_file`, a line scan as it is."""
    if levelling not in LEVELLING:
        raise ValueError(f"levelling: expected {' or '.join(LEVELLING)}, found {levelling}")
    measurement = read_measurement(path, dataset, undefined_pixels, unit)
    return flattened(measurement, sphere_radius, levelling)


class Measuring(TypedDict):
    """How the measurements of a surface are read, and the radii of their tips."""

    datasets: list[str]  #: As of `read_measurement`, of each.
    tip_radii: list[float | None]  #: In nm; None of a tip that is not given.
    undefined_pixels: str
    unit: str
    levelling: str
    sphere_radius: float | None  #: In nm, None of a flat surface.


def flat_measurements(paths: Iterable[str], measuring: Measuring) -> list[Measurement]:
    """Read the measurements of a surface, each as `flat_measurement` does."""
    return [
        flat_measurement(
            path,
            dataset,
            undefined_pixels=measuring["undefined_pixels"],
            unit=measuring["unit"],
            levelling=measuring["levelling"],
            sphere_radius=measuring["sphere_radius"],
        )
        for path, dataset in zip(paths, measuring["datasets"], strict=True)
    ]


def flattened(
    measurement: Measurement, sphere_radius: float | None, levelling: str = "plane"
) -> Measurement:
    """Return a measured map as `flat_map` makes it; a line scan stays as it is."""
    if measurement.kind != "map":
        return measurement
    flat = flat_map(height_map(measurement, "measured"), sphere_radius, levelling)
    return replace(measurement, heights=flat.heights)


def list_measurements(path: str | Path) -> list[str]:
    """Return the names by which `read_measurement` finds the topographies of a scan or container.

    They are the data files in a container, in its order; one empty name of any other file. A file
    that is missing, or a container that cannot be used, is a ValueError in one line.
    """
    from hardcontact.surfaces.scan_formats import datasets_of

    return list(_in_a_process(datasets_of, Path(path))["datasets"])


def _in_a_process(read: Callable[..., dict[str, Any]], path: Path, *choices: str) -> dict[str, Any]:
    """Return what `read` finds in a file, in a process of its own: JSON but for the heights.

    What it needs is imported before the process is forked: once for all scans, outside its limits.
    """
    size = path.stat().st_size if path.is_file() else 0
    seconds = min(TIME_LIMIT, SMALL_TIME + MEGABYTE * size // 2**20)
    memory = min(MEMORY_LIMIT, SMALL_MEMORY + INFLATION * size)
    with tempfile.TemporaryFile(buffering=0) as answer:
        process = multiprocessing.get_context("fork").Process(
            target=_answer, args=(answer, seconds, memory, read, path, *choices), daemon=True
        )
        process.start()
        process.join(5 * TIME_LIMIT)  # time on the clock, with waits for a processor or a disk
        process.kill()
        process.join()
        answer.seek(0)
        if process.exitcode == 0:
            return {**json.loads(answer.readline()), "heights": np.load(answer)}
        if process.exitcode == REFUSED:
            raise ValueError(f"{path}: {answer.read().decode()}")
    raise ValueError(
        f"{path}: expected a readable scan, found one whose reader crashes or takes more than "
        f"{seconds} s, which files of this size may take (exit code {process.exitcode})"
    )


def _answer(
    answer: IO[bytes],
    seconds: int,
    memory: int,
    read: Callable[..., dict[str, Any]],
    path: Path,
    *choices: str,
) -> None:
    """Write what is read of a file to the file `answer`, or why it is refused.

    Runs in a process of its own, silently: readers log, warn and print.
    """
    _quiet_and_limited(seconds, memory)
    try:
        found = read(path, *choices)
    except RefusedScan as error:
        reason = str(error)
    except Exception as error:  # damaged bytes may raise anything in a reader
        text = f"{type(error).__name__}: {error}"[:200]
        reason = f"expected a readable scan, found one damaged or of an unknown kind ({text})"
    else:
        heights = found.pop("heights", np.empty(0))
        shown = {key: _printable(value) for key, value in found.items()}
        answer.write(json.dumps(shown).encode() + b"\n")
        np.save(answer, heights)
        return
    answer.write(" ".join(_printable(reason[:2000]).split()).encode())
    sys.exit(REFUSED)


def _printable(found: Any) -> Any:
    """Return a text, or a list of them, with blanks for what a terminal would obey; else as is."""
    if isinstance(found, list):
        return [_printable(part) for part in found]
    if not isinstance(found, str):
        return found
    return "".join(letter if letter.isprintable() else " " for letter in found)


def _quiet_and_limited(seconds: int, memory: int) -> None:
    """Silence this process and limit its time, and its memory beyond what it has, in bytes."""
    logging.disable()
    warnings.simplefilter("ignore")
    for stream in (1, 2):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_CPU, seconds)
    if sys.platform == "linux":  # elsewhere only time is limited
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        _limit(resource.RLIMIT_AS, pages * resource.getpagesize() + memory)


def _limit(kind: int, most: int) -> None:
    """Limit a resource of this process; a lower limit that it already has stays."""
    _, hard = resource.getrlimit(kind)
    resource.setrlimit(kind, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
