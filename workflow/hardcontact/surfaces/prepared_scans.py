"""A scan as it is read from its file: levelled, the sphere subtracted if there is one; stitched."""

import xarray as xr

from hardcontact.surfaces.scans import described, height_map, read_measurement
from hardcontact.surfaces.topography import LEVELLING, prepared_scan

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
    """Read a scan and prepare it.

    Parameters
    ----------
    path : str
        Of the file of a microscope, or of a substitute.
    basis : str
        ``"measured"`` or ``"substitute"``.
    dataset, undefined_pixels : str
        As of `scans.read_measurement`; substitutes need neither.
    levelling : str
        A key of `topography.LEVELLING`; substitutes have no scan lines.
    sphere_radius : float or None
        In nm, of a scan of the sphere; None of a flat surface.

    Returns
    -------
    levelled, stitched : xarray.Dataset
        As of `topography.prepared_scan`.
    """
    measurement = read_measurement(path, dataset, undefined_pixels)
    return prepared_scan(
        height_map(measurement, basis),
        sphere_radius,
        LEVELLING[levelling],
        described(measurement),
    )
