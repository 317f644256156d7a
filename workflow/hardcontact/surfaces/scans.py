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
    kind: str  #: ``"map"`` or ``"line scan"``.
    heights: np.ndarray  #: (y, x), or (n,) of a profile, in nm, on uniform spacing, without gaps.
    pixel_size: float  #: In nm; of a profile its spacing.
    tip_radius: float | None  #: In nm, if the file or its container states one.
    notes: tuple[str, ...]  #: What was changed or chosen in reading, in words for the user.
    undefined: int  #: Undefined pixels among those kept, before they were filled.
    #: The result of `scan_defects`, after `examine`.
    defects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def to_dataset(self) -> xr.Dataset:
        """Return the dataset for `read_stored`: heights in float64, other fields as attributes."""
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
    """Read a measurement from a file of the study; raises ValueError if it cannot be read."""
    dataset = labelled.read(path)
    words = ("path", "dataset", "channel", "file_unit", "kind")
    tip_radius = float(dataset.attrs["tip_radius"])
    notes = dataset.attrs["notes"]
    return Measurement(
        **{name: dataset.attrs[name] for name in words},
        heights=dataset["heights"].values,
        pixel_size=float(dataset.attrs["pixel_size"]),
        tip_radius=None if np.isnan(tip_radius) else tip_radius,
        notes=tuple(notes.split("; ")) if notes else (),
        undefined=int(dataset.attrs["undefined"]),
    )


def read_measurement(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    unit: str = "none",
    map_size: float | str = "none",
) -> Measurement:
    """Read a topography in nm, not levelled: the central square of a map, or a line scan.

    `dataset` names a member of a container, or a channel. `unit` (two: of positions, heights) and
    `map_size`, the longer side in nm, serve files that state none. Raises ValueError, in one line,
    if the scan cannot be used, or has undefined pixels and their interpolation is ``"refuse"``.
    """
    from hardcontact.surfaces.scan_formats import read_measurement_fields

    fields = read_in_child(
        read_measurement_fields, Path(path), dataset, undefined_pixels, unit, map_size
    )
    fields["notes"] = tuple(fields["notes"])
    return Measurement(path=str(path), **fields)


def read_scan(
    path: str | Path,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    basis: str = "measured",
    unit: str = "none",
    map_size: float | str = "none",
) -> HeightMap:
    """Read a height map with `read_measurement`; raises ValueError for a line scan."""
    return height_map(read_measurement(path, dataset, undefined_pixels, unit, map_size), basis)


def list_measurements(path: str | Path) -> list[str]:
    """Return the names of a container's data files, or one empty name for any other file.

    Raises ValueError, with one line, if the file is missing or the container cannot be used.
    """
    from hardcontact.surfaces.scan_formats import list_datasets

    return list(read_in_child(list_datasets, Path(path))["datasets"])


def height_map(measurement: Measurement, basis: str = "measured") -> HeightMap:
    """Return the height map of a measurement; raises ValueError for a line scan."""
    if measurement.kind != "map":
        raise ValueError(f"{measurement.path}: expected a height map, found a line scan")
    return HeightMap(measurement.heights, measurement.pixel_size, False, basis)


def flatten(
    measurement: Measurement, sphere_radius: float | None = None, levelling: str = "plane"
) -> Measurement:
    """Return a measurement whose map is levelled, without its sphere (radius in nm), if any.

    A line scan keeps its heights. Raises ValueError if the levelling is unknown.
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
    """Return a measurement from `flatten`, with its defects."""
    from scipy.signal import detrend  # A slow import.

    flat = flatten(measurement, sphere_radius, levelling)
    levelled = flat.heights if flat.kind == "map" else detrend(flat.heights)
    defects = scan_defects(measurement.heights, levelled, measurement.pixel_size)
    return replace(flat, defects=defects)


#: Titles of the files with the results of `level_and_stitch`.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
STITCHED = "scan and its mirror images, periodic"


def level_and_stitch(
    measurement: Measurement,
    basis: str,
    sphere_radius: float | None = None,
    levelling: str = "plane",
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return a levelled map and its mirror-stitched map (y, x) in nm, with the file's attributes.

    The levelled scan of a sphere (radius in nm) also has ``as_scanned``, the heights as read.
    """
    scan = height_map(measurement, basis)
    flat = flat_map(scan, sphere_radius, levelling)
    levelled = flat.dataset()
    stitched = mirror_stitch(flat).dataset()
    if sphere_radius is not None:
        labels = {"units": "nm", "long_name": "height of the sphere as scanned"}
        levelled["as_scanned"] = (("y", "x"), scan.heights.astype("float32"), labels)
    file_attributes = {
        "channel": measurement.channel,
        "file_unit": measurement.file_unit,
        "notes": "; ".join(measurement.notes),
    }
    return levelled.assign_attrs(file_attributes), stitched.assign_attrs(file_attributes)
