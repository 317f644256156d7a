"""Reading scans of any microscope, and preparing them.

`limited_process` reads the file in a child process. SurfaceTopography is imported when the first
scan is read.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
import xarray as xr

from hardcontact.records import dataset as labelled
from hardcontact.surfaces.height_map import LEVELLING, HeightMap, flat_map, prepared_scan
from hardcontact.surfaces.limited_process import read_in_child


@dataclass(frozen=True)
class Measurement:
    """One topography of a file: a map or a line scan."""

    path: str
    dataset: str  #: The data file in a container, the channel of any other file, or empty.
    channel: str  #: Name of the channel that was read.
    file_unit: str  #: Unit of length that the file, or its container, states.
    kind: str  #: ``"map"`` or ``"profile"``.
    heights: np.ndarray  #: (y, x), or (n,) of a profile, in nm, on uniform spacing, without gaps.
    pixel_size: float  #: In nm; of a profile its spacing.
    tip_radius: float | None  #: In nm, if the file or its container states one.
    notes: tuple[str, ...]  #: What was changed or chosen in reading, in words for the user.
    undefined: int  #: Undefined pixels among those kept, before they were filled.

    def stored(self) -> xr.Dataset:
        """Return the dataset that `read_stored` reads: heights in float64, else attributes."""
        dimensions = ("y", "x") if self.kind == "map" else ("x",)
        attributes = {field.name: getattr(self, field.name) for field in fields(self)}
        del attributes["heights"]
        attributes["tip_radius"] = np.nan if self.tip_radius is None else self.tip_radius
        attributes["notes"] = "; ".join(self.notes)
        heights = (dimensions, self.heights, {"units": "nm", "long_name": "height as read"})
        return xr.Dataset({"heights": heights}, attrs=attributes)


def read_stored(path: str) -> Measurement:
    """Read a netCDF file of `Measurement.stored`; one that cannot be read is a ValueError."""
    stored = labelled.read(path)
    tip_radius, notes = float(stored.attrs["tip_radius"]), stored.attrs["notes"]
    return Measurement(
        path=stored.attrs["path"],
        dataset=stored.attrs["dataset"],
        channel=stored.attrs["channel"],
        file_unit=stored.attrs["file_unit"],
        kind=stored.attrs["kind"],
        heights=stored["heights"].values,
        pixel_size=float(stored.attrs["pixel_size"]),
        tip_radius=None if np.isnan(tip_radius) else tip_radius,
        notes=tuple(notes.split("; ")) if notes else (),
        undefined=int(stored.attrs["undefined"]),
    )


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
