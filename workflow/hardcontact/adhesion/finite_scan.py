"""Whether scans and windows are large enough for the force, and pixels small enough.

The sphere touches where a peak rises above its paraboloid: peaks of the height sigma count up to
the distance sqrt(2 R sigma) from the apex. A smaller scan, mirrored, shows the same peaks
everywhere, and the force on it is too large. A window that ends before the forces do makes them too
small. A pixel larger than the area that carries the preload touches alone.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.contact.bearing_area import Load

#: Mean force on mirrored windows over that on the random surfaces of 20 µm they were cut out of, by
#: the size of the window over the draw size: the least and the greatest ratio up to that size.
#: Measured on Gaussian surfaces of rms height 2 to 50 nm (roll-off 930 nm, H = 0.84), R = 20 and
#: 250 µm, rho = 2 to 10 nm, windows of 1.25 to 5 µm, each ratio within 2 to 10 %; a second code
#: found the same on four spectra, and up to 4 below 0.25.
RATIOS = {0.125: (2.0, 6.4), 0.25: (2.0, 4.0), 0.5: (1.1, 2.3), 1.0: (1.0, 1.5), 2.0: (1.0, 1.2)}
#: Size over the draw size from which a scan is large enough, and the smallest that was tried:
#: 1.25 µm under the larger sphere, of the greatest rms height.
LARGE_ENOUGH, LEAST_TRIED = max(RATIOS), 0.125


class FiniteScan(NamedTuple):
    """A scan against the contacts that are made on it."""

    #: Edge in nm of the area within which a contact finds its peaks, 2 sqrt(2 R sigma).
    draw_size: float
    share: float  #: The size of the scan over it.
    #: Least and greatest of the force on such a scan over that on a large one, of RATIOS; 1 and 1
    #: where the scan is large enough.
    ratio: tuple[float, float]


def finite_scan(size: float, rms_height: float, radius: float) -> FiniteScan:
    """Return how the size of a scan compares with that from which a contact draws; all in nm.

    The range of adhesion hardly matters for the ratio.
    """
    draw_size = 2 * float(np.sqrt(2 * radius * rms_height))
    share = size / draw_size
    ratio = next((found for limit, found in RATIOS.items() if share < limit), (1.0, 1.0))
    return FiniteScan(draw_size, share, ratio)


def with_finite_scans(force: xr.Dataset, topography: xr.Dataset, radius: float) -> xr.Dataset:
    """Return predicted forces (surface) with how the scans of each surface compare with contacts.

    The topography has ``scan_size`` and ``rms_height_mean`` (surface) in nm; so is the radius of
    the sphere. The forces gain ``draw_size`` (surface) in nm and ``finite_scan_ratio`` (surface,
    bound), the least and greatest ratio of `finite_scan`.
    """
    of_surfaces = topography.sel(surface=force["surface"])
    sizes, heights = (
        of_surfaces[name].values.tolist() for name in ("scan_size", "rms_height_mean")
    )
    found = [finite_scan(*one, radius) for one in zip(sizes, heights, strict=True)]
    return force.assign(
        draw_size=("surface", [one.draw_size for one in found], {"units": "nm"}),
        finite_scan_ratio=(("surface", "bound"), [one.ratio for one in found], {"units": "1"}),
    )


def with_window_share(force: xr.Dataset, window: float, radius: float) -> xr.Dataset:
    """Return predicted forces, over rho in nm, with the share of the force that the window holds.

    A smooth sphere attracts by exp(-r²/(2 R rho)) at the distance r from its apex (Eq. 3 of the
    paper), of which a square window of the edge L holds erf(L/sqrt(8 R rho))². L and R are in nm;
    the share is ``window_share`` (rho), with the attribute ``window`` in nm.
    """
    from scipy.special import erf

    share = erf(window / np.sqrt(8 * radius * force["rho"].values)) ** 2
    long_name = "share of the force on a smooth sphere that the window holds"
    attributes = {"units": "1", "long_name": long_name}
    return force.assign(window_share=("rho", share, attributes)).assign_attrs(window=window)


def with_contact_area(force: xr.Dataset, topography: xr.Dataset, load: Load) -> xr.Dataset:
    """Return predicted forces with the area that carries the preload, and that of a pixel.

    The topography has ``pixel_size`` (surface) in nm. The forces gain ``pixel_area`` (surface) and
    the attribute ``contact_area``, both in nm².
    """
    pixel_area = topography["pixel_size"].sel(surface=force["surface"]) ** 2
    return force.assign(pixel_area=pixel_area.assign_attrs(units="nm2")).assign_attrs(
        contact_area=load["preload"] / load["hardness"] * 1e18
    )
