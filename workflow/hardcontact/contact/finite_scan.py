"""Whether scans and windows are large enough for the force, and pixels small enough.

A sphere finds the summits that it touches within the draw size 2 sqrt(2 R sigma/t), where it comes
to rest t rms heights sigma above the mean plane (`theory.summits`). A smaller scan, mirrored,
shows the same summits everywhere, and the force on it is too large.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from scipy.special import erf

from hardcontact.contact.contact import Contact

#: Mean force on mirrored windows over that on the random surfaces of 20 µm they were cut out of, by
#: the size of the window over the draw size: the least and the greatest ratio up to that size.
#: Measured on ten Gaussian surfaces of rms height 2 to 50 nm (roll-off 300 to 2000 nm, H = 0.5 to
#: 0.84), 24 each, R = 20 to 250 µm, rho = 2 and 5.6 nm, windows of 0.6 to 10 µm, each ratio within
#: 1 to 10 %. Larger windows had 0.95 to 1.14.
RATIOS = {0.125: (8.0, 17.0), 0.25: (3.0, 9.0), 0.5: (1.5, 3.6), 1.0: (1.1, 2.0), 2.0: (1.0, 1.5)}
#: Size over the draw size from which a scan is large enough, and the smallest that was tried.
LARGE_ENOUGH, LEAST_TRIED = max(RATIOS), 0.12


def finite_scan_ratio(size: float, draw_size: float) -> tuple[float, float]:
    """Return the least and greatest of the force on a scan over that on a large one, of RATIOS."""
    ratios = (ratio for limit, ratio in RATIOS.items() if size < limit * draw_size)
    return next(ratios, (1.0, 1.0))


def with_sizes(
    force: xr.Dataset, topography: xr.Dataset, contact: Contact, draw_sizes: Mapping[str, float]
) -> xr.Dataset:
    """Return predicted forces (surface) with how scans, window and pixels compare with contacts.

    The topography has ``scan_size`` and ``pixel_size`` (surface) in nm, draw sizes (nm) are given
    by surface. A smooth sphere attracts by exp(-r²/(2 R rho)) at the distance r from its apex (Eq.
    3 of the paper), of which a square window of the edge L holds erf(L/sqrt(8 R rho))².
    """
    scans = topography[["scan_size", "pixel_size"]].sel(surface=force["surface"])
    lengths = [draw_sizes[name] for name in force["surface"].values.tolist()]
    sizes = zip(scans["scan_size"].values.tolist(), lengths, strict=True)
    ratios = [finite_scan_ratio(size, draw_size) for size, draw_size in sizes]
    share = erf(contact.window / np.sqrt(8 * contact.radius * force["rho"].values)) ** 2
    in_window = {
        "units": "1",
        "long_name": "share of the attraction of a smooth sphere within the window",
    }
    return force.assign(
        draw_size=("surface", lengths, {"units": "nm"}),
        finite_scan_ratio=(("surface", "bound"), ratios, {"units": "1"}),
        pixel_area=("surface", scans["pixel_size"].values ** 2, {"units": "nm2"}),
        window_share=("rho", share, in_window),
    ).assign_attrs(window=contact.window, contact_area=contact.area)
