"""Height maps and line scans, their files in the study, and their mirror images."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from hardcontact.base.dataset import read_dataset
from hardcontact.base.formatting import format_length
from hardcontact.base.units import NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from SurfaceTopography import Topography, UniformLineScan


@dataclass(frozen=True, eq=False)
class HeightMap:
    """Heights in nm on square pixels (y, x) of a map, or at the points (x,) of a line scan.

    Heights increase away from the material. The pixel size (nm) is also the spacing of the points
    of a line scan. A periodic map repeats beyond its borders. The source is ``"measured"`` or
    ``"substitute"``. `pixels` and `size` assume a square: other maps are cropped when read.
    """

    heights: np.ndarray
    pixel_size: float
    periodic: bool = False
    source: str = "measured"
    path: str = "scan"  #: Path of the file, as messages name it.
    #: The scan of a container, or the channel of another file, that the user names; empty for the
    #: only or the default one.
    dataset: str = ""
    channel: str = ""  #: Name of the channel that was read, also if it is the default one.
    file_unit: str = "nm"  #: Unit of length that the file, its container or the user states.
    tip_radius: float | None = None  #: In nm, if the file or its container states one.
    notes: tuple[str, ...] = ()  #: What was changed or chosen in reading, each in one line.
    undefined_count: int = 0  #: Number of kept pixels that were undefined before they were filled.
    #: Numbers of defects by code and name, after `level_and_list_defects`.
    defects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def __repr__(self) -> str:
        """Return pixels, their size, the rms height and the source."""
        counts = " x ".join(map(str, reversed(self.heights.shape)))
        origin = f"periodic, {self.source}" if self.periodic else self.source
        return (
            f"HeightMap({counts} pixels of {format_length(self.pixel_size)}, rms height "
            f"{format_length(float(self.heights.std()))}, {origin})"
        )

    @property
    def name(self) -> str:
        """The path of the file, and its dataset if one is named."""
        return f"{self.path}: {self.dataset}" if self.dataset else self.path

    @property
    def kind(self) -> str:
        """The kind of scan: ``"map"`` or ``"line scan"``."""
        return "map" if self.heights.ndim == 2 else "line scan"

    @property
    def pixels(self) -> int:
        """Pixels along each side of a square map, or points of a line scan."""
        return int(self.heights.shape[0])

    @property
    def size(self) -> float:
        """Width of a square map, or length of a line scan, in nm."""
        return self.pixels * self.pixel_size

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the heights of a map in nm over positions in µm, in new axes if none are given."""
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1] if axes is None else axes
        height, width = np.multiply(self.heights.shape, self.pixel_size / 1e3)
        image = axes.imshow(self.heights, origin="lower", extent=(0, width, 0, height))
        axes.set(xlabel="x (µm)", ylabel="y (µm)")
        axes.figure.colorbar(image, ax=axes, label="height (nm)")
        return axes

    def to_dataset(self) -> xr.Dataset:
        """Return heights with coordinates in nm; all other fields but defects are attributes."""
        axes = ("y", "x")[-self.heights.ndim :]
        positions = [(0.5 + np.arange(count)) * self.pixel_size for count in self.heights.shape]
        coordinates = {
            axis: (axis, position, NM | {"long_name": f"{axis} position"})
            for axis, position in zip(axes, positions, strict=True)
        }
        labels = NM | {"long_name": "surface height", "pixel_size": float(self.pixel_size)}
        attributes = {
            **{name: getattr(self, name) for name in TEXT_FIELDS},
            "periodic": int(self.periodic),
            "tip_radius": np.nan if self.tip_radius is None else self.tip_radius,
            "notes": "\n".join(self.notes),
            "undefined": self.undefined_count,
        }
        return xr.Dataset({"heights": (axes, self.heights, labels)}, coordinates, attributes)


#: Fields of a height map that are texts and attributes of the same name.
TEXT_FIELDS = ("source", "path", "channel", "file_unit", "dataset")


def load_height_map(path: str) -> HeightMap:
    """Load a height map from a netCDF file of the study; raises ValueError if it is unreadable."""
    map_dataset = read_dataset(path)
    heights = map_dataset["heights"]
    attributes = map_dataset.attrs
    texts: dict[str, Any] = {name: str(attributes[name]) for name in TEXT_FIELDS}
    tip_radius = float(attributes["tip_radius"])
    return HeightMap(
        heights.values,
        float(heights.attrs["pixel_size"]),
        bool(attributes["periodic"]),
        **texts,
        tip_radius=None if np.isnan(tip_radius) else tip_radius,
        notes=tuple(str(attributes["notes"]).splitlines()),
        undefined_count=int(attributes["undefined"]),
    )


def to_surface_topography(scan: HeightMap) -> "Topography | UniformLineScan":
    """Return a scan as an object of SurfaceTopography, whose first axis is x."""
    from SurfaceTopography import Topography, UniformLineScan

    heights = np.asarray(scan.heights, dtype=float).T
    if scan.kind == "line scan":
        return UniformLineScan(heights, scan.size, unit="nm")
    sizes = tuple(count * scan.pixel_size for count in heights.shape)
    return Topography(heights, sizes, unit="nm")


def mirror_scan(scan: HeightMap) -> HeightMap:
    """Return a map and its mirror images as a periodic map (2y, 2x), as in the paper."""
    mirrored_along_x = np.concatenate([scan.heights, scan.heights[:, ::-1]], axis=1)
    heights = np.concatenate([mirrored_along_x, mirrored_along_x[::-1]], axis=0)
    return replace(scan, heights=heights, periodic=True)


def mirror_in_float32(scan: HeightMap) -> HeightMap:
    """Return the mirrored map in float32, the precision of the study's files."""
    return mirror_scan(replace(scan, heights=scan.heights.astype(np.float32)))


def refuse_line_scan(scan: HeightMap) -> None:
    """Raise ValueError for a line scan."""
    if scan.kind != "map":
        raise ValueError(f"{scan.path}: expected a height map, found a line scan")
