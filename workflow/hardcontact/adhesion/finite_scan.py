"""Whether a scan is large enough for the force: its size against that from which a contact draws.

The sphere touches where a peak rises above its paraboloid: peaks of the height sigma count up to
the distance sqrt(2 R sigma) from the apex. A smaller scan, mirrored, shows the same peaks
everywhere, and the force on it is too large.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

__all__ = ["FiniteScan", "finite_scan", "finite_scan_warning", "with_finite_scan_notes"]

#: Mean force on mirrored windows over that on the random surfaces of 20 µm they were cut out of, by
#: the size of the window over the draw size: the least and the greatest ratio up to that size.
#: Measured on Gaussian surfaces of rms height 2 to 50 nm (roll-off 930 nm, H = 0.84), R = 20 and
#: 250 µm, rho = 2 to 10 nm, windows of 1.25 to 5 µm, each ratio within 2 to 10 %; a second code
#: found the same on four spectra, and up to 4 below 0.25.
RATIOS = {0.125: (2.0, 6.4), 0.25: (2.0, 4.0), 0.5: (1.1, 2.3), 1.0: (1.0, 1.5), 2.0: (1.0, 1.2)}


class FiniteScan(NamedTuple):
    """A scan against the contacts that are made on it.

    Attributes
    ----------
    draw_size : float
        Edge of the area within which a contact finds its peaks, 2 sqrt(2 R sigma), in nm.
    share : float
        Size of the scan over it.
    ratio : tuple of float
        Least and greatest ratio of the force on such a scan to that on a large one, as found on
        synthetic surfaces; 1 and 1 where the scan is large enough.
    """

    draw_size: float
    share: float
    ratio: tuple[float, float]


def finite_scan(size: float, rms_height: float, radius: float) -> FiniteScan:
    """Return how the size of a scan compares with that from which a contact draws.

    Parameters
    ----------
    size : float
        Edge of the scan in nm.
    rms_height : float
        Of the scan in nm.
    radius : float
        Of the sphere in nm.

    Returns
    -------
    FiniteScan
        Its ratio is that of RATIOS; the range of adhesion hardly matters for it.
    """
    draw_size = 2 * float(np.sqrt(2 * radius * rms_height))
    share = size / draw_size
    ratio = next((found for limit, found in RATIOS.items() if share < limit), (1.0, 1.0))
    return FiniteScan(draw_size, share, ratio)


def finite_scan_warning(size: float, rms_height: float, radius: float) -> str:
    """Return a sentence that warns of a scan too small, with both sizes and the ratio of forces.

    Lengths are those of `finite_scan`, in nm. A scan that is large enough needs no warning: the
    text is empty.
    """
    found = finite_scan(size, rms_height, radius)
    least, greatest = found.ratio
    if greatest == 1:
        return ""
    times = f"{least:g} to {greatest:g}" if least > 1 else f"up to {greatest:g}"
    return (
        f"a contact finds its peaks within {found.draw_size / 1e3:.2g} µm, the scan is "
        f"{size / 1e3:.2g} µm, {found.share:.2g} of that: on synthetic surfaces the mean force on "
        f"such scans was {times} times that on large ones"
    )


def with_finite_scan_notes(force: xr.Dataset, topography: xr.Dataset, radius: float) -> xr.Dataset:
    """Return predicted forces with the warning about the scans of each surface.

    Parameters
    ----------
    force : xarray.Dataset
        Of `predicted_force`, over surface.
    topography : xarray.Dataset
        With ``scan_size`` and ``rms_height_mean`` (surface) in nm.
    radius : float
        Of the sphere in nm.

    Returns
    -------
    xarray.Dataset
        With ``finite_scan_note`` (surface), empty where scans are large enough.
    """
    of_surfaces = topography[["scan_size", "rms_height_mean"]].sel(surface=force["surface"])
    notes = [
        finite_scan_warning(float(size), float(rms), radius)
        for size, rms in zip(
            of_surfaces["scan_size"].values, of_surfaces["rms_height_mean"].values, strict=True
        )
    ]
    return force.assign(finite_scan_note=("surface", notes))
