"""Height maps and line scans: levelling, subtracting the sphere, mirror stitching, rms metrics."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from hardcontact.base import dataset
from hardcontact.base.formatting import format_length
from hardcontact.base.units import NM
from hardcontact.surfaces.streaks import fill_streaks

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from SurfaceTopography import Topography, UniformLineScan


@dataclass(frozen=True, eq=False)
class HeightMap:
    """A surface on square pixels, or a line scan; heights grow out of the material.

    Heights (y, x), or (x,) of a line scan, and the width of a pixel are in nm. A periodic map
    repeats beyond its borders. The basis is ``"measured"`` or ``"substitute"``.
    """

    heights: np.ndarray
    pixel_size: float
    periodic: bool = False
    basis: str = "measured"
    path: str = "scan"  #: Path of the file, as messages name it.
    member: str = ""  #: Data file in a container, the channel of any other file, or empty.
    channel: str = ""  #: Name of the channel that was read.
    file_unit: str = "nm"  #: Unit of length that the file, or its container, states.
    tip_radius: float | None = None  #: In nm, if the file or its container states one.
    notes: tuple[str, ...] = ()  #: What was changed or chosen in reading, in words for the user.
    undefined_count: int = 0  #: Number of kept pixels that were undefined before they were filled.
    #: The result of `scan_defects`, after `scan_with_defects`.
    defects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def __repr__(self) -> str:
        """Return pixels, their size and the rms height."""
        counts = " x ".join(map(str, reversed(self.heights.shape)))
        kind = f"periodic, {self.basis}" if self.periodic else self.basis
        return (
            f"HeightMap({counts} pixels of {format_length(self.pixel_size)}, rms height "
            f"{format_length(float(self.heights.std()))}, {kind})"
        )

    @property
    def name(self) -> str:
        """The path of the file and, if the file has several scans, the name of this one in it."""
        return f"{self.path}: {self.member}" if self.member else self.path

    @property
    def kind(self) -> str:
        """The kind of scan: ``"map"`` or ``"line scan"``."""
        return "map" if self.heights.ndim == 2 else "line scan"

    @property
    def pixels(self) -> int:
        """Pixels per row of a square map, or points of a line scan."""
        return int(self.heights.shape[0])

    @property
    def size(self) -> float:
        """Width of a square map, or length of a line scan, in nm."""
        return self.pixels * self.pixel_size

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the heights in nm over positions in µm.

        Parameters
        ----------
        axes : matplotlib.axes.Axes or None
            Axes to draw in; None for new axes.

        Returns
        -------
        matplotlib.axes.Axes
            The axes, with a colour bar.
        """
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
        coordinates = {
            axis: (
                (axis,),
                (0.5 + np.arange(count)) * self.pixel_size,
                NM | {"long_name": f"{axis} position"},
            )
            for axis, count in zip(axes, self.heights.shape, strict=True)
        }
        labels = {
            "units": "nm",
            "long_name": "surface height",
            "pixel_size": float(self.pixel_size),
        }
        attributes = {
            **{name: getattr(self, name) for name in TEXT_FIELDS},
            "dataset": self.member,
            "periodic": int(self.periodic),
            "tip_radius": np.nan if self.tip_radius is None else self.tip_radius,
            "notes": "; ".join(self.notes),
            "undefined": self.undefined_count,
        }
        return xr.Dataset({"heights": (axes, self.heights, labels)}, coordinates, attributes)


#: Fields of a height map that are texts and attributes of the same name.
TEXT_FIELDS = ("basis", "path", "channel", "file_unit")


def read_height_map(path: str) -> HeightMap:
    """Read a height map from a netCDF file of the study; raises ValueError if it is unreadable."""
    map_dataset = dataset.read(path)
    heights = map_dataset["heights"]
    attributes = map_dataset.attrs
    texts: dict[str, Any] = {name: str(attributes[name]) for name in TEXT_FIELDS}
    tip_radius = float(attributes["tip_radius"])
    notes = attributes["notes"]
    return HeightMap(
        heights.values,
        float(heights.attrs["pixel_size"]),
        bool(attributes["periodic"]),
        **texts,
        member=str(attributes["dataset"]),
        tip_radius=None if np.isnan(tip_radius) else tip_radius,
        notes=tuple(notes.split("; ")) if notes else (),
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


def level(scan: HeightMap) -> HeightMap:
    """Return a scan minus its least-squares plane or line, equal to SurfaceTopography's."""
    heights = np.asarray(scan.heights, dtype=float).T
    axes = np.meshgrid(*(np.arange(count) / count for count in heights.shape), indexing="ij")
    design = np.column_stack([np.ones(heights.size), *(axis.ravel() for axis in axes)])
    offset, *slopes = np.linalg.lstsq(design, heights.ravel(), rcond=None)[0]
    levelled = heights - offset
    for slope, axis in zip(slopes, axes, strict=True):
        levelled = levelled - slope * axis
    return replace(scan, heights=levelled.T)


def level_lines(scan: HeightMap) -> HeightMap:
    """Return a scan without streaks, its lines along x aligned, minus its least-squares plane.

    Each line loses its least-squares line, then its median: drift and jumps of the feedback, and
    real roughness whose wavevector points along y. Source: ``ScanLineAlignedTopography``.
    """
    heights, is_filled = fill_streaks(level(scan).heights)
    scan = replace(scan, heights=heights)
    streak_lines = int(is_filled.any(axis=1).sum())
    if streak_lines:
        note = f"streaks along {streak_lines} lines filled from the lines beside them"
        scan = replace(scan, notes=(*scan.notes, note))
    aligned = to_surface_topography(scan).scan_line_align(direction="x", mode="median", degree=1)
    return level(replace(scan, heights=aligned.heights().T))


def level_quadratic(scan: HeightMap) -> HeightMap:
    """Return a scan minus its least-squares polynomial of second order, to remove a bow."""
    return replace(scan, heights=to_surface_topography(scan).detrend("curvature").heights().T)


#: Ways to level a scan, by their names in the configuration.
LEVELLING: dict[str, Callable[[HeightMap], HeightMap]] = {
    "plane": level,
    "lines": level_lines,
    "quadratic": level_quadratic,
}


def remove_form(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> HeightMap:
    """Return a levelled scan; first the sphere that a map shows (radius in nm) is subtracted.

    The apex of the paraboloid x²/2R is taken at the centre of the scan: elsewhere it would only
    add a plane, which levelling removes. A line scan loses its mean line, whatever the levelling.
    """
    if levelling not in LEVELLING:
        raise ValueError(f"levelling: expected {', '.join(LEVELLING)}, found {levelling}")
    if scan.kind == "line scan":
        return level(scan)
    if sphere_radius is not None:
        rows, columns = scan.heights.shape
        y = (np.arange(rows) - (rows - 1) / 2) * scan.pixel_size
        x = (np.arange(columns) - (columns - 1) / 2) * scan.pixel_size
        heights = scan.heights + (y[:, None] ** 2 + x**2) / (2 * sphere_radius)
        scan = replace(scan, heights=heights)
    return LEVELLING[levelling](scan)


def mirror_stitch(scan: HeightMap) -> HeightMap:
    """Return a periodic map (2y, 2x) of a scan and its mirror images, so that all edges match.

    Source: the paper, section Numerical Analysis of Results.
    """
    wide = np.concatenate([scan.heights, scan.heights[:, ::-1]], axis=1)
    return replace(scan, heights=np.concatenate([wide, wide[::-1]], axis=0), periodic=True)


def require_map(scan: HeightMap) -> HeightMap:
    """Return a scan that is a map; raises ValueError for a line scan."""
    if scan.kind != "map":
        raise ValueError(f"{scan.path}: expected a height map, found a line scan")
    return scan


#: Titles of the files with the results of `level_and_stitch`.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
STITCHED = "scan and its mirror images, periodic"


def level_and_stitch(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return a levelled map and its mirror-stitched map (y, x) in nm, in float32.

    The levelled scan of a sphere (radius in nm) also has ``as_scanned``, the heights as read.
    """
    flat = remove_form(require_map(scan), sphere_radius, levelling)
    flat = replace(flat, heights=flat.heights.astype("float32"))
    levelled = flat.to_dataset()
    if sphere_radius is not None:
        labels = NM | {"long_name": "height of the sphere as scanned"}
        levelled["as_scanned"] = (("y", "x"), scan.heights.astype("float32"), labels)
    return levelled, mirror_stitch(flat).to_dataset()


#: Metrics of a height map with their units and long names, in the order of Table 1.
METRICS = {
    "rms_height": ("nm", "rms height"),
    "rms_gradient": ("1", "rms gradient (2D slope)"),
    "rms_profile_slope": ("1", "rms slope of profiles along x"),
    "rms_half_laplacian": ("nm-1", "half the rms Laplacian (mean curvature)"),
    "rms_laplacian": ("nm-1", "rms Laplacian"),
    "skewness": ("1", "skewness of heights"),
    "kurtosis": ("1", "kurtosis of heights (3 for a Gaussian)"),
    "peak_to_valley": ("nm", "peak to valley"),
}
#: The metrics of Table 1, which does not define slope and curvature, by its rows for AFM scans.
TABLE1_METRICS = {
    "afm_rms_height": "rms_height",
    "afm_rms_slope": "rms_gradient",
    "afm_rms_curvature": "rms_half_laplacian",
}


def metrics(scan: HeightMap) -> dict[str, float]:
    """Return the METRICS of a scan.

    Derivatives are finite differences between neighbouring pixels, as in SurfaceTopography, at the
    pixels that have both derivatives.

    Parameters
    ----------
    scan : HeightMap
        Levelled, not periodic.

    Returns
    -------
    dict of str to float
        By name, such as ``rms_height``, in powers of nm.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> rms_height = hc.metrics(scan)["rms_height"]  # nm
    """
    heights = scan.heights.astype(float)
    pixel_size = scan.pixel_size
    slope_y = np.diff(heights, axis=0)[:, :-1] / pixel_size
    slope_x = np.diff(heights, axis=1)[:-1] / pixel_size
    bend = np.diff(heights, 2, axis=0)[:, 1:-1] + np.diff(heights, 2, axis=1)[1:-1]
    laplacian = float(np.sqrt((bend**2).mean())) / pixel_size**2
    flat_heights = heights.ravel()
    skewness, kurtosis = skewness_and_kurtosis(flat_heights)
    return {
        "rms_height": float(flat_heights.std()),
        "rms_gradient": float(np.sqrt((slope_x**2 + slope_y**2).mean())),
        "rms_profile_slope": float(np.sqrt((slope_x**2).mean())),
        "rms_half_laplacian": laplacian / 2,
        "rms_laplacian": laplacian,
        "skewness": skewness,
        "kurtosis": kurtosis,
        "peak_to_valley": float(np.ptp(flat_heights)),
    }


def skewness_and_kurtosis(heights: np.ndarray) -> tuple[float, float]:
    """Return skewness and kurtosis of heights of any shape; the kurtosis of a Gaussian is 3."""
    deviation = heights.ravel() - heights.mean()
    square = deviation**2
    variance = square.mean()
    skewness = float((square * deviation).mean() / variance**1.5)
    kurtosis = float((square**2).mean() / variance**2)
    return skewness, kurtosis
