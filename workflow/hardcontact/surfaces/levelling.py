"""Levelling: planes, bows and spheres are subtracted from scans, and scan lines aligned."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import scipy
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.units import NM
from hardcontact.surfaces.height_map import (
    HeightMap,
    mirror_in_float32,
    refuse_line_scan,
    to_surface_topography,
)
from hardcontact.surfaces.streaks import fill_streaks


def level_plane(scan: HeightMap) -> HeightMap:
    """Return a scan minus its least-squares plane or line.

    It equals ``detrend`` of SurfaceTopography, whose import would be slow.
    """
    heights = np.asarray(scan.heights, dtype=float).T
    axes = np.meshgrid(*(np.arange(count) / count for count in heights.shape), indexing="ij")
    design = np.column_stack([np.ones(heights.size), *(axis.ravel() for axis in axes)])
    offset, *slopes = np.linalg.lstsq(design, heights.ravel(), rcond=None)[0]
    levelled = heights - offset
    for slope, axis in zip(slopes, axes, strict=True):
        levelled = levelled - slope * axis
    return replace(scan, heights=levelled.T)


def squared_projections(phase: Floats) -> tuple[Floats, Floats]:
    """Return the shares of the variance of waves that the mean and the slope of a line contain.

    Levelling removes them. The wave is exp(2 i `phase` u) for |u| <= 1/2. Its projections on 1 and
    sqrt(12) u are spherical Bessel functions of the phase.
    """
    return scipy.special.spherical_jn(0, phase) ** 2, 3 * scipy.special.spherical_jn(1, phase) ** 2


def level_lines(scan: HeightMap) -> HeightMap:
    """Return a scan without streaks, its lines along x aligned, minus its least-squares plane.

    Each line loses its least-squares line and its median. This removes drift and jumps of the
    feedback, but also real roughness whose wavevector points along y.
    """
    heights, is_filled = fill_streaks(level_plane(scan).heights)
    scan = replace(scan, heights=heights)
    streak_lines = int(is_filled.any(axis=1).sum())
    if streak_lines:
        note = f"streaks along {streak_lines} lines filled from the lines beside them"
        scan = replace(scan, notes=(*scan.notes, note))
    aligned = to_surface_topography(scan).scan_line_align(direction="x", mode="median", degree=1)
    return level_plane(replace(scan, heights=aligned.heights().T))


def level_quadratic(scan: HeightMap) -> HeightMap:
    """Return a scan minus its least-squares polynomial of second order, to remove a bow."""
    return replace(scan, heights=to_surface_topography(scan).detrend("curvature").heights().T)


#: Ways to level a scan, by their names in the configuration.
LEVELLING: dict[str, Callable[[HeightMap], HeightMap]] = {
    "plane": level_plane,
    "lines": level_lines,
    "quadratic": level_quadratic,
}


def remove_form(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> HeightMap:
    """Return a levelled scan; first the sphere that a map shows (radius in nm) is subtracted.

    The sphere's apex is put at the centre: elsewhere it would only add a plane, which levelling
    removes. A line scan loses its mean line, whatever the levelling.
    """
    if levelling not in LEVELLING:
        raise ValueError(f"levelling: expected {', '.join(LEVELLING)}, found {levelling}")
    if scan.kind == "line scan":
        return level_plane(scan)
    if sphere_radius is not None:
        rows, columns = scan.heights.shape
        y = (np.arange(rows) - (rows - 1) / 2) * scan.pixel_size
        x = (np.arange(columns) - (columns - 1) / 2) * scan.pixel_size
        heights = scan.heights + (y[:, None] ** 2 + x**2) / (2 * sphere_radius)
        scan = replace(scan, heights=heights)
    return LEVELLING[levelling](scan)


#: Titles of the files with the two results of `level_and_mirror`.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
MIRRORED = "scan and its mirror images, periodic"


def level_and_mirror(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return a levelled map and its mirrored map as datasets, in float32.

    The levelled scan of a sphere also has ``as_scanned``, the heights as read.
    """
    refuse_line_scan(scan)
    flat = remove_form(scan, sphere_radius, levelling)
    levelled = flat.to_dataset()
    levelled["heights"] = levelled["heights"].astype("float32")
    if sphere_radius is not None:
        labels = NM | {"long_name": "height of the sphere as scanned"}
        levelled["as_scanned"] = (("y", "x"), scan.heights.astype("float32"), labels)
    return levelled, mirror_in_float32(flat).to_dataset()
