"""Reading scans of any microscope, and preparing them.

`limited_process` reads the file in a child process. SurfaceTopography is imported when the first
scan is read.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import xarray as xr

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.limited_process import read_in_child
from hardcontact.surfaces.measurement import Measurement, read_stored
from hardcontact.surfaces.topography import LEVELLING, flat_map, prepared_scan

#: Titles of the files that hold what `prepared` returns.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
STITCHED = "scan and its mirror images, periodic"


def read_measurement(
    path: str | Path, dataset: str = "", undefined_pixels: str = "refuse", unit: str = "none"
) -> Measurement:
    """Read a topography: a map cropped to its central square, or a line scan on uniform spacing.

    Parameters
    ----------
    path : str or Path
        A file in any format SurfaceTopography reads, or a contact.engineering container (.zip).
    dataset : str
        The member of a container, by its name or data file; of any other file the channel, or empty
        for its own choice.
    undefined_pixels : str
        ``"refuse"``, or the interpolation of SurfaceTopography (``"harmonic"``) that fills them.
    unit : str
        The unit of length of a file that states none, or ``"none"``.

    Returns
    -------
    Measurement
        Not levelled, in nm.

    Raises
    ------
    ValueError
        If the scan is missing, unreadable, too large, without physical size or unit, reentrant, of
        absurd size, height or slope, or has undefined pixels that may not be filled; one line.
    """
    from hardcontact.surfaces.scan_formats import measurement_of

    fields = read_in_child(measurement_of, Path(path), dataset, undefined_pixels, unit)
    fields["notes"] = tuple(fields["notes"])
    return Measurement(path=str(path), **fields)


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    basis: str = "measured",
    unit: str = "none",
) -> HeightMap:
    """Read a height map as `read_measurement` does; a line scan is a ValueError."""
    return height_map(read_measurement(path, dataset, undefined_pixels, unit), basis)


def list_measurements(path: str | Path) -> list[str]:
    """Return the names by which `read_measurement` finds the topographies of a scan or container.

    They are the data files in a container, in its order; one empty name of any other file. A file
    that is missing, or a container that cannot be used, is a ValueError in one line.
    """
    from hardcontact.surfaces.scan_formats import datasets_of

    return list(read_in_child(datasets_of, Path(path))["datasets"])


def height_map(measurement: Measurement, basis: str = "measured") -> HeightMap:
    """Return the height map that was measured, in float64; a line scan is a ValueError.

    The basis says what the scan is: ``"measured"`` or ``"substitute"``.
    """
    if measurement.kind != "map":
        raise ValueError(f"{measurement.path}: expected a height map, found a line scan")
    return HeightMap(measurement.heights, measurement.pixel_size, False, basis)


def flattened(
    measurement: Measurement, sphere_radius: float | None = None, levelling: str = "plane"
) -> Measurement:
    """Return a measured map as `flat_map` makes it; a line scan stays as it is.

    The radius, in nm, is that of the sphere that is subtracted, None for a flat surface.
    """
    if levelling not in LEVELLING:
        raise ValueError(f"levelling: expected {' or '.join(LEVELLING)}, found {levelling}")
    if measurement.kind != "map":
        return measurement
    flat = flat_map(height_map(measurement), sphere_radius, levelling)
    return replace(measurement, heights=flat.heights)


def flat_measurements(
    files: Sequence[str], sphere_radius: float | None, levelling: str
) -> list[Measurement]:
    """Return the stored measurements of a surface, each as `flattened` makes it."""
    return [flattened(read_stored(file), sphere_radius, levelling) for file in files]


def prepared(
    measurement: Measurement,
    basis: str,
    sphere_radius: float | None = None,
    levelling: str = "plane",
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return a measured map levelled and stitched, as of `topography.prepared_scan`."""
    described = {
        "channel": measurement.channel,
        "file_unit": measurement.file_unit,
        "notes": "; ".join(measurement.notes),
    }
    return prepared_scan(height_map(measurement, basis), sphere_radius, levelling, described)
