"""Rigid pull-off of a smooth sphere at any number of contacts, up to every pixel of a scan.

The force of `pull_off.pull_off_of_pair` without a search for each contact: closest approach is a
dilation, and the sum over all pixels a product over both axes.

The map of the rigid pull-off force on one scan, and how many contacts its mean needs.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import stats
from threadpoolctl import threadpool_limits

from hardcontact.adhesion.force_sum import pull_off_force
from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION
from hardcontact.contact.closest_approach import closest_gaps, touching_pixels
from hardcontact.contact.geometry import Bodies, ContactArray, ContactGeometry, bodies
from hardcontact.inference.smooth_sphere import dmt_pull_off
from hardcontact.insight.map_statistics import (
    array_error,
    contacts_for_error,
    correlation,
    variation,
)
from hardcontact.surfaces.height_map import HeightMap

__all__ = [
    "MapSettings",
    "SAMPLINGS",
    "at_every_pixel",
    "force_maps",
    "normal_quantile",
    "rigid_pull_off",
]

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


#: Contacts along an edge of the arrays whose error is computed.
COUNTS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 17, 20, 28, 40, 57, 80)

#: Edges of the classes of forces, over the force of a smooth sphere on a plane.
CLASSES = np.geomspace(1e-6, 1e2, 161)

#: How the contacts on a scan lie.
SAMPLINGS = ["random", "array"]


class MapSettings(TypedDict):
    """How maps are made and what is asked of them.

    Attributes
    ----------
    radius : float
        Of the smooth sphere in nm.
    contact : ContactArray
        Analysis window, and the array of contacts beside the map.
    ranges : list of float
        Ranges of adhesion in nm.
    reference_rho : float
        That of the maps that are kept, one of the ranges.
    tolerance : float
        Relative error of a mean.
    confidence : float
        Probability that the mean is within the tolerance, and of the intervals.
    """

    radius: float
    contact: ContactArray
    ranges: list[float]
    reference_rho: float
    tolerance: float
    confidence: float


def force_maps(stitched: HeightMap, settings: MapSettings) -> xr.Dataset:
    """Return the map of one scan, its mean and spread, and the errors of means of contacts.

    Parameters
    ----------
    stitched : HeightMap
        The scan beside its mirror images.
    settings : MapSettings
        Sphere, contacts, ranges and the error asked for.

    Returns
    -------
    xarray.Dataset
        ``heights`` and ``pull_off_force`` (row, column) of the scan, the latter at the reference
        range; ``touched_pixels``; by ``rho`` the means, ``variation``, the correlation,
        ``array_error`` (rho, contacts), ``contacts_needed`` (rho, sampling) and ``distribution``
        (rho, sample, relative_force).
    """
    ranges = settings["ranges"]
    pair = bodies(stitched, None, settings["radius"], settings["contact"])
    scan = stitched.pixels // 2
    mapped = at_every_pixel(pair, scan)
    everywhere = rigid_pull_off(mapped, ranges)
    contacts = rigid_pull_off(pair, ranges)
    reference = everywhere[list(ranges).index(settings["reference_rho"])]
    numbers = [_numbers(forces, stitched.pixel_size, settings) for forces in everywhere]
    smooth = dmt_pull_off(WORK_OF_ADHESION, settings["radius"])
    distributions = [
        [_distribution(sample / smooth) for sample in samples]
        for samples in zip(everywhere, contacts, strict=True)
    ]
    axes = ("row", "column")
    heights = stitched.heights[:scan, :scan].astype("float32")
    return xr.Dataset(
        {
            "heights": (axes, heights, {"units": "nm", "long_name": "surface height"}),
            "pull_off_force": (axes, reference.astype("float32"), FORCE),
            "scan_size": ((), scan * stitched.pixel_size, {"units": "nm"}),
            "touched_pixels": ((), _touched_pixels(mapped)),
            "map_mean": ("rho", everywhere.mean(axis=(1, 2))),
            "map_median": ("rho", np.median(everywhere, axis=(1, 2))),
            "contacts_mean": ("rho", contacts.mean(axis=(1, 2))),
            "distribution": (
                ("rho", "sample", "relative_force"),
                distributions,
                {"units": "1", "long_name": "share of the forces per decade"},
            ),
            **{
                name: (("rho", *dimensions), [of_range[name] for of_range in numbers])
                for name, dimensions in {
                    "variation": (),
                    "correlation_length": (),
                    "correlated_places": (),
                    "array_error": ("contacts",),
                    "contacts_needed": ("sampling",),
                }.items()
            },
        },
        {
            "rho": ("rho", ranges, {"units": "nm", "long_name": "range of adhesion"}),
            "row": range(scan),
            "column": range(scan),
            "sample": ["all positions", "array of contacts"],
            "sampling": SAMPLINGS,
            "contacts": np.square(_counts(scan)),
            "relative_force": np.sqrt(CLASSES[1:] * CLASSES[:-1]),
        },
    )


def _counts(pixels: int) -> np.ndarray:
    """Return the contacts along the edges of arrays that fit on a scan two pixels apart."""
    return np.array([count for count in COUNTS if 2 * count <= pixels])


def normal_quantile(settings: MapSettings) -> float:
    """Return the standard deviations that a mean keeps within with the confidence asked for."""
    return float(stats.norm.ppf((1 + settings["confidence"]) / 2))


def _touched_pixels(bodies: Bodies) -> int:
    """Return how many pixels of a scan touch at some position on it, mirror images as one."""
    period = bodies.substrate.pixels
    touching = (
        pixel % period for pixel in touching_pixels(bodies.substrate.heights, bodies.geometry)
    )
    row, column = (np.minimum(pixel, period - 1 - pixel) for pixel in touching)
    return len(np.unique(row * period + column))


def _numbers(forces: np.ndarray, pixel_size: float, settings: MapSettings) -> dict[str, Any]:
    """Return the numbers of one map (n, n) in N."""
    counts, error = _counts(len(forces)), settings["tolerance"] / normal_quantile(settings)
    errors = np.array([array_error(forces, int(count)) for count in counts])
    length, area = correlation(forces, pixel_size)
    spread = variation(forces)
    return {
        "variation": spread,
        "correlation_length": length,
        "correlated_places": forces.size * pixel_size**2 / area,
        "array_error": errors,
        "contacts_needed": [
            max(1.0, (spread / error) ** 2),
            contacts_for_error(counts**2, errors, error),
        ],
    }


def _distribution(relative: np.ndarray) -> np.ndarray:
    """Return the share of forces (over that of a smooth sphere) per decade in each of CLASSES."""
    number, _ = np.histogram(relative, CLASSES)
    return number / relative.size / np.diff(np.log10(CLASSES))
