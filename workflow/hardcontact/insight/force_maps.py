"""Rigid pull-off of a smooth sphere at any number of contacts, up to every pixel of a scan.

The force of `pull_off.pull_off_of_pair` without a search for each contact: closest approach is a
dilation, and the sum over all pixels a product over both axes.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from hardcontact.adhesion.force_sum import pull_off_force
from hardcontact.adhesion.pull_off import WORK_OF_ADHESION
from hardcontact.contact.closest_approach import closest_gaps
from hardcontact.contact.geometry import Bodies, ContactGeometry

__all__ = ["at_every_pixel", "rigid_pull_off"]

Floats = NDArray[np.float64]

#: Largest height of the substrate above the touching pixel, in ranges of adhesion: beyond it
#: exp(-gap/rho) would fall among the numbers that floats hold with fewer digits.
STEEPEST = 600.0


def at_every_pixel(bodies: Bodies, pixels: int) -> Bodies:
    """Return bodies with a contact at each of the first pixels of the substrate.

    Parameters
    ----------
    bodies : Bodies
        Substrate and sphere.
    pixels : int
        Along either axis: half a period of a mirror-stitched surface is its scan, and the other
        half its mirror image.

    Returns
    -------
    Bodies
        The same with other positions.
    """
    return replace(bodies, geometry=replace(bodies.geometry, positions=np.arange(pixels)))


def rigid_pull_off(bodies: Bodies, ranges: Sequence[float]) -> Floats:
    """Return the rigid pull-off force of every contact at W = 1 J/m².

    F = W/rho A_pix exp((g0 + h_max)/rho) sum exp((h - h_max - s)/rho), with the smallest gap g0 at
    zero approach and the sum over the analysis window: Eq. 3. Nothing is left out or interpolated.

    Parameters
    ----------
    bodies : Bodies
        With a smooth sphere.
    ranges : sequence of float
        Ranges of adhesion in nm.

    Returns
    -------
    numpy.ndarray
        (rho, contact, contact) in N.

    Raises
    ------
    ValueError
        If the sphere is rough, or a range of adhesion is too small for the relief of the surface.
    """
    if bodies.roughness is not None:
        raise ValueError("expected a smooth sphere, found a rough one: its sum is not separable")
    heights, geometry = bodies.substrate.heights, bodies.geometry
    below_highest = closest_gaps(heights, geometry) + float(heights.max())
    forces = np.empty((len(ranges), *below_highest.shape))
    for force, rho in zip(forces, ranges, strict=True):
        exponents = below_highest / rho
        if exponents.max() > STEEPEST:
            raise ValueError(
                "expected a range of adhesion that resolves the relief of the surface, "
                f"found rho = {rho:g} nm, too small for it"
            )
        sums = np.exp(exponents) * _separable_sums(heights, geometry, rho)
        force[:] = pull_off_force(sums, rho, geometry.pixel_size, WORK_OF_ADHESION)
    return forces


def _separable_sums(heights: Floats, geometry: ContactGeometry, rho: float) -> Floats:
    """Return the sum of exp((h - h_max - s)/rho) over the window of every contact.

    It is G exp((h - h_max)/rho) G^T, where G (contact, n) is exp(-s/rho) along one axis, summed
    over the periodic images in the window: (contact, contact).
    """
    offset = geometry.offsets()
    weight = np.exp(-geometry.paraboloid(offset) / rho)
    of_sphere = np.array(
        [np.bincount((one + offset) % len(heights), weight, len(heights))
         for one in geometry.positions]
    )  # fmt: skip
    attraction = np.exp(np.subtract(heights, heights.max(), dtype=float) / rho)
    with threadpool_limits(1, "blas"):  # so that the sums do not depend on their number
        return np.asarray(of_sphere @ (attraction @ of_sphere.T))
