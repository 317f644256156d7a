"""The pull-off force as a sum over pixels, and the force at larger separations.

Eq. 2 of the paper gives the attraction of a pixel at the gap g as (W/rho) exp(-g/rho) A_pix. The
functions here return sums of exp(-g/rho) at closest approach; `pull_off_force` turns them into
forces.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

#: An energy per area of 1 J/m² times a length of 1 nm is a force of 1e-9 N.
NEWTON_PER_JOULE_M2_NM = 1e-9


def pull_off_force(
    total: ArrayLike, rho: ArrayLike, pixel_size: float, work_of_adhesion: float
) -> Floats:
    """Return the pull-off force (N, positive) from sums of exp(-gap/rho): Eq. 3.

    The sums at closest approach and the ranges of adhesion rho, in nm, broadcast; the pixel size is
    in nm and W, the work of adhesion, in J/m². A ValueError tells that a sum exceeds the range of
    floats, as it does where the highest point outside the window stands many hundred rho above the
    contact.
    """
    if not np.isfinite(total).all():
        raise ValueError(
            "expected a range of adhesion that resolves the relief of the surface, "
            f"found rho = {np.min(rho):g} nm, too small for it"
        )
    of_a_pixel = work_of_adhesion / np.asarray(rho) * pixel_size**2 * NEWTON_PER_JOULE_M2_NM
    return np.asarray(of_a_pixel * np.asarray(total))


def opened_total(outside: ArrayLike, gaps: Floats, contact_pixels: int, rho: float) -> Floats:
    """Return the sum (...) of exp(-gap/rho) at the approach where some pixels touch.

    At this approach every gap is larger by the same length than at that of `outside` (...), of
    `outside_sums`, where the pixels of all gaps (..., k), in nm and ascending, touch; pixels that
    are no longer in contact add to the sum with the gap that has opened there. The contact pixels
    are 1 (rigid contact) to k, rho is in nm.
    """
    approach = gaps[..., contact_pixels - 1]
    opened = np.exp((approach[..., None] - gaps[..., contact_pixels:]) / rho).sum(axis=-1)
    return np.asarray(contact_pixels + opened + outside * np.exp((approach - gaps[..., -1]) / rho))


def force_separation(pull_off: float, rho: float, separation: ArrayLike) -> Floats:
    """Return the force (N, negative: attractive) at separations (nm) beyond closest approach.

    The bodies keep their deformed shape, so that all gaps grow alike and Eq. 3 decays with rho.
    """
    return -pull_off * np.exp(-np.asarray(separation) / rho)
