"""Opening files of scans: any format SurfaceTopography reads, contact.engineering containers.

Nothing is unpacked to disk, nothing in a file is executed, and sizes are checked before anything
is read. `scans` calls this in a process of its own.
"""

import io
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray
from SurfaceTopography import Topography, open_topography
from SurfaceTopography.Exceptions import CannotDetectFileFormat, MetadataAlreadyFixedByFile
from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

__all__ = ["RefusedScan", "heights_of"]

#: Pixels along an edge of a scan: substitutes have no fewer, and masters at least twice as many.
PIXELS = (16, 8192)
#: The largest file, or archive once unpacked, and the largest meta.yml of a container, in bytes.
FILE_LIMIT = 2**30
META_LIMIT = 2**20
#: Pixels and heights of a scan in nm, 1 pm to 1 cm: the range of all microscopes, and squares of
#: these keep their digits. A damaged header may state any number.
LENGTHS = (1e-3, 1e7)
#: The largest mean slope: no tip follows 84 degrees; heights read from a wrong place in a file
#: are steeper.
SLOPE_LIMIT = 10


class RefusedScan(Exception):
    """A scan that cannot be used; the text says what was expected and what was found."""


def heights_of(
    path: Path, dataset: str, undefined_pixels: str
) -> tuple[NDArray[np.float64], float]:
    """Return the heights and the pixel size of a scan.

    Parameters
    ----------
    path : Path
        Of a scan or a container.
    dataset : str
        The member of a container; empty for any other file.
    undefined_pixels : str
        ``"refuse"`` or the name of an interpolation of SurfaceTopography.

    Returns
    -------
    heights : numpy.ndarray
        (y, x) in nm.
    pixel_size : float
        In nm.

    Raises
    ------
    RefusedScan
        If the scan cannot be used.
    """
    try:
        topography = _opened(path, dataset)
    except CannotDetectFileFormat:
        raise RefusedScan(
            "expected a whole file in a format that SurfaceTopography reads, "
            "found one that none of its readers takes"
        ) from None
    factor = _unit_in_nm(topography)
    if topography.has_undefined_data:
        topography = _filled(topography, undefined_pixels)
    heights = np.asarray(topography.heights(), dtype=float).T * factor
    pixel_sizes = np.asarray(topography.physical_sizes, float) * factor / topography.nb_grid_pts
    return heights, _checked_pixel_size(heights, pixel_sizes)


def _opened(path: Path, dataset: str) -> Topography:
    """Return the height map in a file, or in one member of a container."""
    if not path.is_file():
        raise RefusedScan("expected a scan, found no such file")
    size = path.stat().st_size
    if size == 0:
        raise RefusedScan("expected a scan, found an empty file")
    if size > FILE_LIMIT:
        raise RefusedScan(f"expected a file of at most {FILE_LIMIT} bytes, found {size}")
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            _check_archive(archive)
            if "meta.yml" in archive.namelist():
                return _open_member(archive, dataset)
    if dataset:
        raise RefusedScan(f"expected a whole container with a dataset {dataset!r}, found none")
    return _topography(open_topography(str(path)), {})


def _check_archive(archive: zipfile.ZipFile) -> None:
    """Refuse an archive that unpacks to too much, or not to one file a name, before reading it."""
    members = archive.infolist()
    size = sum(member.file_size for member in members)
    if size > FILE_LIMIT:
        raise RefusedScan(f"expected at most {FILE_LIMIT} bytes once unpacked, found {size}")
    if len({member.filename for member in members}) < len(members):
        raise RefusedScan("expected an archive with each file once, found one repeated")
    if any(member.flag_bits & 1 for member in members):
        raise RefusedScan("expected an archive without a password, found an encrypted file")


def _topography(reader: Any, stated: dict[str, Any]) -> Topography:
    """Return the height map of a reader; `stated` are metadata that the file itself lacks."""
    channel, (least, most) = reader.default_channel, PIXELS
    if (
        channel.dim == 2
        and not least <= min(channel.nb_grid_pts) <= max(channel.nb_grid_pts) <= most
    ):
        pixels = " x ".join(map(str, channel.nb_grid_pts))
        raise RefusedScan(f"expected {least} to {most} pixels along an edge, found {pixels}")
    if channel.physical_sizes is None and "physical_sizes" not in stated:
        raise RefusedScan(
            "expected a file that states the physical size of the scan, found none: "
            "the file is damaged, or its format has none"
        )
    return reader.topography(**stated)


class _MetaLoader(yaml.SafeLoader):
    """Plain data only; the containers' tuples are read as lists, nothing is executed."""


_MetaLoader.add_constructor(
    "tag:yaml.org,2002:python/tuple",
    yaml.SafeLoader.construct_yaml_seq,  # type: ignore[type-var]
)


def _open_member(container: zipfile.ZipFile, dataset: str) -> Topography:
    """Return the named scan of a contact.engineering container, read in memory."""
    size = container.getinfo("meta.yml").file_size
    if size > META_LIMIT:
        raise RefusedScan(f"expected a meta.yml of at most {META_LIMIT} bytes, found {size}")
    text = container.read("meta.yml")
    try:
        entry = _entry_of(yaml.load(text, Loader=_MetaLoader), dataset)
        member = entry["datafile"]["original"]
    except (yaml.YAMLError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise RefusedScan(
            "expected a meta.yml that lists surfaces, their topographies and the data file of "
            f"each, found: {type(error).__name__}: {error}"
        ) from None
    if member not in container.namelist():
        raise RefusedScan(f"expected the data file {member} in the container, found none")
    reader = open_topography(io.BytesIO(container.read(member)))
    # Metadata of the container count only if the data file has none: its height scale would
    # calibrate a calibrated file twice.
    stated: dict[str, Any] = {}
    for key, value in (
        ("physical_sizes", tuple(entry.get("size") or ()) or None),
        ("unit", entry.get("unit")),
        ("height_scale_factor", entry.get("height_scale")),
    ):
        try:
            if value is not None:
                _topography(reader, stated | {key: value})
                stated[key] = value
        except MetadataAlreadyFixedByFile:
            pass
    return _topography(reader, stated)


def _entry_of(meta: Any, dataset: str) -> dict[str, Any]:
    """Return what a container's meta.yml says of the one scan of this name or data file."""
    entries = [entry for surface in meta["surfaces"] for entry in surface["topographies"]]
    chosen: list[dict[str, Any]] = [
        entry for entry in entries if dataset in (entry["datafile"]["original"], entry["name"])
    ]
    if not chosen:
        known = ", ".join(sorted({entry["name"] for entry in entries}))
        raise RefusedScan(f"expected the column dataset to name one of {known}; found {dataset!r}")
    if len(chosen) > 1:
        files = ", ".join(entry["datafile"]["original"] for entry in chosen)
        raise RefusedScan(
            f"expected one scan {dataset!r}, found {files}; name one of these instead"
        )
    return chosen[0]


def _unit_in_nm(topography: Topography) -> float:
    """Return the unit of a height map in nm; refuse a map without size or unit of length."""
    if topography.dim != 2:
        raise RefusedScan("expected a height map, found a line scan")
    if topography.physical_sizes is None or not isinstance(topography.unit, str):
        raise RefusedScan(
            "expected a physical size and a unit, "
            f"found size {topography.physical_sizes}, unit {topography.unit}"
        )
    try:
        return float(get_unit_conversion_factor(topography.unit, "nm"))
    except ValueError:
        raise RefusedScan(f"expected a unit of length, found {topography.unit!r}") from None


def _filled(topography: Topography, method: str) -> Topography:
    """Return a height map whose undefined pixels are interpolated, unless that is refused."""
    count = int(np.ma.getmaskarray(topography.heights()).sum())
    if method == "refuse":
        raise RefusedScan(
            f"expected no undefined pixels, found {count}; "
            "the key scan.undefined_pixels: harmonic fills them"
        )
    if count == topography.heights().size:
        raise RefusedScan(f"expected heights, found {count} undefined pixels and no other")
    return topography.interpolate_undefined_data(method)


def _checked_pixel_size(heights: NDArray[np.float64], pixel_sizes: NDArray[np.float64]) -> float:
    """Return the pixel size (nm) of heights (y, x) in nm on pixels of these sizes along x and y.

    Heights and pixels that no scan has are refused.
    """
    if not np.isfinite(heights).all():
        raise RefusedScan(
            f"expected finite heights, found {np.count_nonzero(~np.isfinite(heights))} that are not"
        )
    rows, columns = heights.shape
    if rows != columns:
        raise RefusedScan(f"expected a square scan, found {columns} x {rows} pixels")
    along_x, along_y = pixel_sizes
    if not (pixel_sizes > 0).all() or abs(along_x / along_y - 1) > 1e-3:
        raise RefusedScan(f"expected square pixels, found {along_x:.6g} nm x {along_y:.6g} nm")
    pixel_size, low, high = pixel_sizes.mean(), heights.min(), heights.max()
    least, most = LENGTHS
    if not least <= pixel_size <= most or max(-low, high) > most or 0 < high - low < least:
        raise RefusedScan(
            f"expected pixels and differences of height from {least:g} to {most:g} nm, "
            f"found pixels of {pixel_size:.6g} nm and heights from {low:.6g} to {high:.6g} nm"
        )
    slope = np.abs(np.diff(heights)).mean() / pixel_size
    if slope > SLOPE_LIMIT:
        raise RefusedScan(f"expected a mean slope of at most {SLOPE_LIMIT}, found {slope:.3g}")
    return float(pixel_size)
