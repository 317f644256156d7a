"""Whether scans and windows are large enough for the force, and pixels small enough.

A sphere finds the summits that it touches within the search size 2 sqrt(2 R sigma/t), where it
comes to rest t rms heights sigma above the mean plane (`theory.summits`). A smaller scan, mirrored,
shows the same summits everywhere, and the force on it is too large.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf

from hardcontact.contact.contact import Contact

#: Mean force on a mirrored scan relative to that on the surface of 20 µm from which it was cut:
#: smallest and largest ratio, by the size of the scan relative to the search size. Larger scans had
#: 0.95 to 1.14. Source: scans of 0.6 to 10 µm on 24 realizations each of ten Gaussian surfaces (rms
#: height 2 to 50 nm, roll-off 300 to 2000 nm, H = 0.5 to 0.84), R = 20 to 250 µm, rho = 2 and 5.6
#: nm. Each ratio is known to 1 to 10 %.
RATIOS = {0.125: (8.0, 17.0), 0.25: (3.0, 9.0), 0.5: (1.5, 3.6), 1.0: (1.1, 2.0), 2.0: (1.0, 1.5)}
#: Size relative to the search size from which a scan is large enough, and the smallest tested one.
LARGE_SIZE_RATIO = max(RATIOS)
SMALLEST_SIZE_RATIO = 0.12
#: Smallest share of the force on a smooth sphere in a window without a caution.
MIN_WINDOW_SHARE = 0.99


def finite_scan_ratio(size: float, search_size: float) -> tuple[float, float]:
    """Return the smallest and largest force on a scan relative to a large one, from RATIOS."""
    ratios = (ratio for limit, ratio in RATIOS.items() if size < limit * search_size)
    return next(ratios, (1.0, 1.0))


def window_share(contact: Contact, rho: ArrayLike) -> NDArray[np.float64]:
    """Return the share of the attraction of a smooth sphere within the window, at ranges (nm).

    The attraction is proportional to exp(-r²/(2 R rho)) at the distance r from its apex (Eq. 3 of
    the paper). A square window of width L therefore holds the share erf(L/sqrt(8 R rho))² of it.
    """
    return np.asarray(erf(contact.window / np.sqrt(8 * contact.radius * np.asarray(rho))) ** 2)
