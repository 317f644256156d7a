"""Reading scans: the file of any microscope, within limits that damaged or hostile bytes keep to.

A scan is read by a process of its own; nothing is unpacked to disk and nothing in it is executed.
"""

import io
import logging
import multiprocessing
import os
import resource
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np
import yaml
from SurfaceTopography import open_topography
from SurfaceTopography.Exceptions import CannotDetectFileFormat, MetadataAlreadyFixedByFile
from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

__all__ = ["read_scan"]

#: Pixels along an edge of a scan: substitutes have no fewer, and masters at least twice as many.
PIXELS = (16, 8192)
#: The largest file, or archive once unpacked, and the largest meta.yml of a container, in bytes.
FILE_LIMIT = 2**30
META_LIMIT = 2**20
#: Pixels and heights of a scan in nm, 1 pm to 1 cm: no microscope resolves less or reaches
#: further, and squares of these keep their digits. A damaged header says anything.
LENGTHS = (1e-3, 1e7)
#: The largest mean slope: no tip follows 84 degrees, bytes read from a wrong place exceed it.
SLOPE_LIMIT = 10
#: What reading one scan may take: bytes beyond those of this process, and seconds of computing.
MEMORY_LIMIT = 4 * 2**30
TIME_LIMIT = 120
#: Exit code of the process that has read a scan and said why it cannot be used.
REFUSED = 3


def read_scan(path, dataset="", undefined_pixels="refuse"):
    """Heights (y, x) in nm and the pixel size in nm of a measured scan.

    path: any format SurfaceTopography reads, or a contact.engineering container (.zip), of which
    `dataset` names one member by its name or data file; undefined_pixels: "refuse", or the name
    of an interpolation of SurfaceTopography ("harmonic") that fills them.

    A process of its own reads, within MEMORY_LIMIT and TIME_LIMIT: damaged or hostile bytes may
    make any of some forty readers, or the C libraries below them, crash, hang or fill the memory.
    What it found comes back as plain numpy arrays or one line of text, nothing else.

    Raises ValueError, in one line, if the scan is missing, unreadable, too large, without physical
    size or unit, not square, on pixels that are not square, of absurd size, height or
    slope, or has undefined pixels that may not be filled.
    """
    with tempfile.TemporaryFile(buffering=0) as answer:
        reading = multiprocessing.get_context("fork").Process(
            target=_answer, args=(answer, Path(path), dataset, undefined_pixels), daemon=True
        )
        reading.start()
        reading.join(5 * TIME_LIMIT)  # it may wait for a processor or a disk, but not for ever
        reading.kill()
        reading.join()
        answer.seek(0)
        if reading.exitcode == 0:
            return np.load(answer), float(np.load(answer))
        if reading.exitcode == REFUSED:
            raise ValueError(f"{path}: {answer.read().decode()}")
    raise ValueError(
        f"{path}: expected a readable scan, found one whose reader crashes or takes more than "
        f"{TIME_LIMIT} s (exit code {reading.exitcode})"
    )


def _answer(answer, path, dataset, undefined_pixels):
    """Read a scan into the file `answer`: arrays of heights and pixel size, or why there are none.

    Runs in a process of its own, silently: readers log, warn and print what they meet.
    """
    logging.disable()
    for stream in (1, 2):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_CPU, TIME_LIMIT)
    if sys.platform == "linux":  # elsewhere only time is limited
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        _limit(resource.RLIMIT_AS, pages * resource.getpagesize() + MEMORY_LIMIT)
    try:
        heights, pixel_size = _checked(_open(path, dataset), undefined_pixels)
    except _Refused as error:
        reason = str(error)
    except CannotDetectFileFormat:
        reason = (
            "expected a whole file in a format that SurfaceTopography reads, "
            "found one that none of its readers takes"
        )
    except Exception as error:  # a reader meets damaged bytes in any way it likes
        found = f"{type(error).__name__}: {error}"[:200]
        reason = f"expected a readable scan, found one damaged or of an unknown kind ({found})"
    else:
        np.save(answer, heights)
        np.save(answer, pixel_size)
        return
    printable = "".join(letter if letter.isprintable() else " " for letter in reason[:2000])
    answer.write(" ".join(printable.split()).encode())
    sys.exit(REFUSED)


def _limit(kind, most):
    """Limit a resource of this process, or leave it at a lower limit that it came with."""
    _, hard = resource.getrlimit(kind)
    resource.setrlimit(kind, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))


class _Refused(Exception):
    """A scan that cannot be used."""


def _open(path, dataset):
    if not path.is_file():
        raise _Refused("expected a scan, found no such file")
    size = path.stat().st_size
    if size == 0:
        raise _Refused("expected a scan, found an empty file")
    if size > FILE_LIMIT:
        raise _Refused(f"expected a file of at most {FILE_LIMIT} bytes, found {size}")
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            _check_archive(archive)
            if "meta.yml" in archive.namelist():
                return _open_member(archive, dataset)
    if dataset:
        raise _Refused(f"expected a whole container with a dataset {dataset!r}, found none")
    return _topography(open_topography(str(path)), {})


def _check_archive(archive):
    """Refuse an archive that unpacks to too much, or not to one file a name, before reading it."""
    members = archive.infolist()
    size = sum(member.file_size for member in members)
    if size > FILE_LIMIT:
        raise _Refused(f"expected at most {FILE_LIMIT} bytes once unpacked, found {size}")
    if len({member.filename for member in members}) < len(members):
        raise _Refused("expected an archive with each file once, found one repeated")
    if any(member.flag_bits & 1 for member in members):
        raise _Refused("expected an archive without a password, found an encrypted file")


def _topography(reader, stated):
    """The height map of a reader; stated: what is known beside the file."""
    channel, (least, most) = reader.default_channel, PIXELS
    if (
        channel.dim == 2
        and not least <= min(channel.nb_grid_pts) <= max(channel.nb_grid_pts) <= most
    ):
        found = " x ".join(map(str, channel.nb_grid_pts))
        raise _Refused(f"expected {least} to {most} pixels along an edge, found {found}")
    if channel.physical_sizes is None and "physical_sizes" not in stated:
        raise _Refused(
            "expected a file that states the physical size of the scan, found none: "
            "the file is damaged, or its format has none"
        )
    return reader.topography(**stated)


class _MetaLoader(yaml.SafeLoader):
    """Plain data only; the containers' tuples are read as lists, nothing is executed."""


_MetaLoader.add_constructor("tag:yaml.org,2002:python/tuple", yaml.SafeLoader.construct_yaml_seq)


def _open_member(container, dataset):
    """The named scan of a contact.engineering container, read in memory: nothing is unpacked."""
    size = container.getinfo("meta.yml").file_size
    if size > META_LIMIT:
        raise _Refused(f"expected a meta.yml of at most {META_LIMIT} bytes, found {size}")
    text = container.read("meta.yml")
    try:
        entry = _entry_of(yaml.load(text, Loader=_MetaLoader), dataset)
        member = entry["datafile"]["original"]
    except (yaml.YAMLError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise _Refused(
            "expected a meta.yml that lists surfaces, their topographies and the data file of "
            f"each, found: {type(error).__name__}: {error}"
        ) from None
    if member not in container.namelist():
        raise _Refused(f"expected the data file {member} in the container, found none")
    reader = open_topography(io.BytesIO(container.read(member)))
    # What the container says holds only where the data file itself is silent: applying its
    # height scale to a calibrated file would calibrate it twice.
    kept = {}
    for key, value in (
        ("physical_sizes", tuple(entry.get("size") or ()) or None),
        ("unit", entry.get("unit")),
        ("height_scale_factor", entry.get("height_scale")),
    ):
        try:
            if value is not None:
                _topography(reader, kept | {key: value})
                kept[key] = value
        except MetadataAlreadyFixedByFile:
            pass
    return _topography(reader, kept)


def _entry_of(meta, dataset):
    """What a container's meta.yml says of the one scan of this name or data file."""
    entries = [entry for surface in meta["surfaces"] for entry in surface["topographies"]]
    chosen = [
        entry for entry in entries if dataset in (entry["datafile"]["original"], entry["name"])
    ]
    if not chosen:
        known = ", ".join(sorted({entry["name"] for entry in entries}))
        raise _Refused(f"expected the column dataset to name one of {known}; found {dataset!r}")
    if len(chosen) > 1:
        files = ", ".join(entry["datafile"]["original"] for entry in chosen)
        raise _Refused(f"expected one scan {dataset!r}, found {files}; name one of these instead")
    return chosen[0]


def _checked(topography, undefined_pixels):
    if topography.dim != 2:
        raise _Refused("expected a height map, found a line scan")
    if topography.physical_sizes is None or not isinstance(topography.unit, str):
        raise _Refused(
            "expected a physical size and a unit, "
            f"found size {topography.physical_sizes}, unit {topography.unit}"
        )
    try:
        factor = get_unit_conversion_factor(topography.unit, "nm")
    except ValueError:
        raise _Refused(f"expected a unit of length, found {topography.unit!r}") from None
    if topography.has_undefined_data:
        topography = _filled(topography, undefined_pixels)
    heights = np.asarray(topography.heights(), dtype=float).T * factor
    if not np.isfinite(heights).all():
        raise _Refused(
            f"expected finite heights, found {np.count_nonzero(~np.isfinite(heights))} that are not"
        )
    pixels = np.asarray(topography.physical_sizes, float) * factor / topography.nb_grid_pts
    if heights.shape[0] != heights.shape[1]:
        raise _Refused(
            f"expected a square scan, found {heights.shape[1]} x {heights.shape[0]} pixels"
        )
    if not (pixels > 0).all() or abs(pixels[0] / pixels[1] - 1) > 1e-3:
        raise _Refused(f"expected square pixels, found {pixels[0]:.6g} nm x {pixels[1]:.6g} nm")
    pixel_size, low, high = pixels.mean(), heights.min(), heights.max()
    least, most = LENGTHS
    if not least <= pixel_size <= most or max(-low, high) > most or 0 < high - low < least:
        raise _Refused(
            f"expected pixels and differences of height from {least:g} to {most:g} nm, "
            f"found pixels of {pixel_size:.6g} nm and heights from {low:.6g} to {high:.6g} nm"
        )
    slope = np.abs(np.diff(heights)).mean() / pixel_size
    if slope > SLOPE_LIMIT:
        raise _Refused(f"expected a mean slope of at most {SLOPE_LIMIT}, found {slope:.3g}")
    return heights, float(pixel_size)


def _filled(topography, method):
    count = int(np.ma.count_masked(topography.heights()))
    if method == "refuse":
        raise _Refused(
            f"expected no undefined pixels, found {count}; "
            "the key scan.undefined_pixels: harmonic fills them"
        )
    if count == topography.heights().size:
        raise _Refused(f"expected heights, found {count} undefined pixels and no other")
    return topography.interpolate_undefined_data(method)
