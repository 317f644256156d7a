"""A scan as it is read from its file: levelled, the sphere subtracted if there is one; stitched."""

from functools import partial
from pathlib import Path

import xarray as xr

from hardcontact.surfaces.measurement import Measurement
from hardcontact.surfaces.scans import described, flattened, height_map, read_measurement
from hardcontact.surfaces.topography import LEVELLING, flat_map, prepared_scan

#: Titles of the files that hold what `prepared_file` returns.
LEVELLED = "levelled scan, the sphere subtracted if it shows one"
STITCHED = "scan and its mirror images, periodic"


def prepared_file(
    path: str,
    *,
    basis: str,
    dataset: str = "",
    undefined_pixels: str = "refuse",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> tuple[xr.Dataset, xr.Dataset]:
    """Read a scan and prepare it: levelled and stitched, as of `topography.prepared_scan`.

    The file is of a microscope, or of a substitute, as the basis ``"measured"`` or ``"substitute"``
    says. `dataset` and `undefined_pixels` are as of `scans.read_measurement`, the levelling is a
    key of `topography.LEVELLING`; substitutes need none of these. The radius, in nm, is that of a
    scan of the sphere, None of a flat surface.
    """
    measurement = read_measurement(path, dataset, undefined_pixels)
    return prepared_scan(
        height_map(measurement, basis), sphere_radius, LEVELLING[levelling], described(measurement)
    )


def flat_measurement(
    path: str | Path,
    dataset: str = "",
    *,
    undefined_pixels: str = "refuse",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> Measurement:
    """Read a measured topography: a map levelled as in `prepared_file`, a line scan as it is."""
    if levelling not in LEVELLING:
        raise ValueError(f"levelling: expected {' or '.join(LEVELLING)}, found {levelling}")
    flat = partial(flat_map, sphere_radius=sphere_radius, levelled=LEVELLING[levelling])
    return flattened(read_measurement(path, dataset, undefined_pixels), flat)
