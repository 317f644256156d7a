"""Reading scans of any microscope, and preparing them."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import numpy as np
import xarray as xr

from hardcontact.base import dataset as labelled
from hardcontact.surfaces.height_map import LEVELLING, HeightMap, flat_map, mirror_stitch
from hardcontact.surfaces.limited_process import read_in_child
from hardcontact.surfaces.scan_defects import scan_defects


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
    #: Of `scan_defects`, once the measurement is `examined`.
    defects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def stored(self) -> xr.Dataset:
        """Return the dataset that `read_stored` reads: heights in float64, else attributes."""
        attributes = asdict(self) | {
            "tip_radius": np.nan if self.tip_radius is None else self.tip_radius,
            "notes": "; ".join(self.notes),
        }
        heights = attributes.pop("heights")
        del attributes["defects"]
        dimensions = ("y", "x") if self.kind == "map" else ("x",)
        labels = {"units": "nm", "long_name": "height as read"}
        return xr.Dataset({"heights": (dimensions, heights, labels)}, attrs=attributes)


def read_stored(path: str) -> Measurement:
    """Read a measurement from a netCDF file of the study; raises ValueError if that fails."""
    stored = labelled.read(path)
    words = ("path", "dataset", "channel", "file_unit", "kind")
    tip_radius, notes = float(stored.attrs["tip_radius"]), stored.attrs["notes"]
    return Measurement(
        **{name: stored.attrs[name] for name in words},
        heights=stored["heights"].values,
        pixel_size=float(stored.attrs["pixel_size"]),
        tip_radius=None if np.isnan(tip_radius) else tip_radius,
        notes=tuple(notes.split("; ")) if notes else (),
        undefined=int(stored.attrs["undefined"]),
    )


def read_measurement(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    unit: str = "none",
    edge: float | str = "none",
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
        The unit of length of a file that states none, or ``"none"``; two, as ``"mm,nm"``, are of
        positions and of heights.
    edge : float or str
        The longer edge in nm of a map, or the length of a line scan, whose file states none, or
        ``"none"``.

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
    from hardcontact.surfaces.scan_formats import read_measurement_fields

    fields = read_in_child(
        read_measurement_fields, Path(path), dataset, undefined_pixels, unit, edge
    )
    fields["notes"] = tuple(fields["notes"])
    return Measurement(path=str(path), **fields)


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    basis: str = "measured",
    unit: str = "none",
    edge: float | str = "none",
) -> HeightMap:
    """Read a height map as `read_measurement` does; raises ValueError for a line scan."""
    return height_map(read_measurement(path, dataset, undefined_pixels, unit, edge), basis)


def list_measurements(path: str | Path) -> list[str]:
    """Return the names by which `read_measurement` finds the topographies of a file.

    They are the data files in a container, in its order, and one empty name for any other file.
    Raises ValueError, in one line, if the file is missing or the container cannot be used.
    """
    from hardcontact.surfaces.scan_formats import list_datasets

    return list(read_in_child(list_datasets, Path(path))["datasets"])


def height_map(measurement: Measurement, basis: str = "measured") -> HeightMap:
    """Return the height map that was measured, in float64; raises ValueError for a line scan."""
    if measurement.kind != "map":
        raise ValueError(f"{measurement.path}: expected a height map, found a line scan")
    return HeightMap(measurement.heights, measurement.pixel_size, False, basis)


def flatten(
    measurement: Measurement, sphere_radius: float | None = None, levelling: str = "plane"
) -> Measurement:
    """Return a measurement, a map without its sphere and levelled.

    The radius of the sphere is in nm, None for a flat surface. A line scan keeps its heights.
    """
    if levelling not in LEVELLING:
        raise ValueError(f"levelling: expected {', '.join(LEVELLING)}, found {levelling}")
    if measurement.kind != "map":
        return measurement
    flat = flat_map(height_map(measurement), sphere_radius, levelling)
    return replace(measurement, heights=flat.heights)


def examine(
    measurement: Measurement, sphere_radius: float | None = None, levelling: str = "plane"
) -> Measurement:
    """Return a measurement as `flattened` makes it, with its defects."""
    from scipy.signal import detrend  # A slow import.

    flat = flatten(measurement, sphere_radius, levelling)
    levelled = flat.heights if flat.kind == "map" else detrend(flat.heights)
    defects = scan_defects(measurement.heights, levelled, measurement.pixel_size)
    return replace(flat, defects=defects)


#: Titles of the files that hold what `prepared` returns.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
STITCHED = "scan and its mirror images, periodic"


def level_and_stitch(
    measurement: Measurement,
    basis: str,
    sphere_radius: float | None = None,
    levelling: str = "plane",
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return a measured map levelled, and then mirror-stitched, both as datasets.

    The levelled scan of a sphere, of a radius in nm, also keeps the heights as they were read, in
    the variable `as_scanned`. Attributes hold channel, unit and notes of the file.
    """
    scan = height_map(measurement, basis)
    flat = flat_map(scan, sphere_radius, levelling)
    levelled, stitched = flat.dataset(), mirror_stitch(flat).dataset()
    if sphere_radius is not None:
        labels = {"units": "nm", "long_name": "height of the sphere as scanned"}
        levelled["as_scanned"] = (("y", "x"), scan.heights.astype("float32"), labels)
    described = {
        "channel": measurement.channel,
        "file_unit": measurement.file_unit,
        "notes": "; ".join(measurement.notes),
    }
    return levelled.assign_attrs(described), stitched.assign_attrs(described)
