"""Sums of exp(-gap/rho) over the pixels of the window outside contact, for an array of contacts.

At a contact, the pixel p has the gap g(p) + m: its reference gap g = y - u - z (`geometry`), and
the height m of the apex at which all contact pixels touch. Outside contact the attraction is

    S = sum over the window without the contact pixels of exp(-(g(p) + m)/rho).

All contacts share the substrate. So one product of matrices (`smooth_sphere`), or one correlation
(`rough_sphere`), gives the sums over the whole windows of all contacts at once. But each contact
has other contact pixels to leave out. This is done in one of two ways:

- `sums_by_subtraction`: the sum over the whole window, less the sum over the contact pixels. It is
  fast, but loses digits at short ranges, because a pixel that penetrates by d has the term
  exp(d/rho), which must cancel.
- `_sums_by_omission`, for short ranges and rough spheres: three sums without negative terms. Here
  a touched pixel is a pixel of the substrate that touches in any contact of the array.

      S = sum over pixels that are not touched, for all contacts at once
        + sum over pixels that are touched, but not by this contact
        + sum over the images of this contact's own pixels.

  The substrate is periodic. If the window is wider than a period, it has several images of each
  pixel. Of a contact pixel only one image touches; the others attract like any pixel.

Exponentials are relative to the highest points of z and u, so that none overflows.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import ThreadpoolController

from hardcontact.base.arrays import Floats
from hardcontact.contact.bearing_area import ContactPixels
from hardcontact.contact.force_sum.rough_sphere import rough_sphere_terms
from hardcontact.contact.force_sum.smooth_sphere import smooth_sphere_terms, sums_by_subtraction
from hardcontact.contact.force_sum.touched_pixels import TouchedPixels, exponential
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.numerical_limits import DEPTH_OVER_RANGE

#: Finds the threads of libraries; made once, because the search takes milliseconds.
THREAD_POOLS = ThreadpoolController()
#: Largest penetration, in ranges of adhesion, at which contact pixels are subtracted, by the
#: precision of heights. Rounding errors grow by its exponential: 7 times in single, 400 times in
#: double precision.
MAX_PENETRATION = {np.float32: 2.0, np.float64: 6.0}


def outside_sums(bodies: Bodies, contact_pixels: ContactPixels, ranges: Sequence[float]) -> Floats:
    """Return the sum (rho, contact_y, contact_x) of exp(-(g + m)/rho) outside contact.

    m is the height of the apex at which all contact pixels touch.
    """
    all_ranges = np.asarray(ranges, float)
    sums = np.empty((len(all_ranges), *contact_pixels.reference_gaps.shape[:2]))
    can_subtract = _can_subtract(bodies, contact_pixels, all_ranges)
    with THREAD_POOLS.limit(limits=1, user_api="blas"):
        if can_subtract.any():
            subtracted_ranges = all_ranges[can_subtract].tolist()
            sums[can_subtract] = sums_by_subtraction(bodies, contact_pixels, subtracted_ranges)
        if not can_subtract.all():
            omitted_ranges = all_ranges[~can_subtract].tolist()
            sums[~can_subtract] = _sums_by_omission(bodies, contact_pixels, omitted_ranges)
    return sums


def _can_subtract(
    bodies: Bodies, contact_pixels: ContactPixels, ranges: Floats
) -> NDArray[np.bool_]:
    """Return the mask of ranges (rho,) at which `sums_by_subtraction` has enough digits."""
    if bodies.sphere_roughness is not None:  # Subtraction needs a smooth sphere.
        return np.zeros(len(ranges), bool)
    gaps = contact_pixels.reference_gaps
    penetration = (gaps[..., -1] - gaps[..., 0]).max()
    depth = gaps[..., -1].max() + bodies.substrate.heights.max()
    precision = bodies.substrate.heights.dtype.type
    return np.asarray(
        (penetration <= MAX_PENETRATION[precision] * ranges)
        & (depth <= DEPTH_OVER_RANGE[precision] * ranges)
    )


def _sums_by_omission(
    bodies: Bodies, contact_pixels: ContactPixels, ranges: Sequence[float]
) -> Floats:
    """Return `outside_sums` as the three sums of the module's docstring."""
    substrate = bodies.substrate
    roughness = bodies.sphere_roughness
    touched_pixels = TouchedPixels(bodies, contact_pixels)
    touched_heights = substrate.heights[touched_pixels.row, touched_pixels.column].astype(float)
    highest_substrate = float(substrate.heights.max())
    highest_roughness = 0.0 if roughness is None else float(roughness.heights.max())
    highest = highest_substrate + highest_roughness
    sums = np.empty((len(ranges), *contact_pixels.reference_gaps.shape[:2]))
    compute_terms = smooth_sphere_terms if roughness is None else rough_sphere_terms
    all_terms = compute_terms(bodies, touched_pixels, ranges)
    for k, (rho, (untouched_sums, sphere_factor_at)) in enumerate(
        zip(ranges, all_terms, strict=True)
    ):
        substrate_factor = exponential(touched_heights, highest_substrate, rho)
        for index in np.ndindex(untouched_sums.shape):
            touched_terms = substrate_factor * sphere_factor_at(index)
            sums[k][index] = touched_pixels.sum_outside(
                index, float(untouched_sums[index]), touched_terms, highest, rho
            )
    return sums
