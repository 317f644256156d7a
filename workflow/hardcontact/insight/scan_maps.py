"""The map of the rigid pull-off force on one scan, and how many contacts its mean needs.

Of a smooth sphere the force of `pull_off.pull_off_of_pair` needs no search for each contact:
closest approach is a dilation, and the sum over all pixels a product over both axes. Errors of
means, of contacts at random places and in arrays, are standard deviations over the mean of the map.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypedDict

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray
from scipy import stats
from threadpoolctl import threadpool_limits

from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION, pull_off_force
from hardcontact.adhesion.sphere_sums import exponential, folded
from hardcontact.contact.closest_approach import closest_gaps, touching_pixels
from hardcontact.contact.geometry import Bodies, ContactArray, bodies
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.surfaces.height_map import HeightMap

Floats = NDArray[np.float64]

#: Largest height of the substrate above the touching pixel, in ranges of adhesion: beyond it
#: exp(-gap/rho) would fall among the numbers that floats hold with fewer digits.
STEEPEST = 600.0
#: Contacts along an edge of the arrays whose error is computed.
COUNTS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 17, 20, 28, 40, 57, 80)
#: Edges of the classes of forces, over the force of a smooth sphere on a plane.
CLASSES = np.geomspace(1e-6, 1e2, 161)
#: How the contacts on a scan lie.
SAMPLINGS = ["random", "array"]


def at_every_pixel(bodies: Bodies, pixels: int) -> Bodies:
    """Return bodies with a contact at each of the first pixels of the substrate, along either axis.

    Half a period of a mirror-stitched surface is its scan, and the other half its mirror image.
    """
    return replace(bodies, geometry=replace(bodies.geometry, positions=np.arange(pixels)))


def rigid_pull_off(bodies: Bodies, ranges: Sequence[float]) -> Floats:
    """Return the rigid pull-off force (rho, contact, contact) in N at W = 1 J/m², smooth sphere.

    F = W/rho A_pix exp((g0 + h_max)/rho) sum exp((h - h_max - s)/rho), with the smallest gap g0 at
    zero approach and the sum over the analysis window: Eq. 3. The sum is G exp((h - h_max)/rho)
    G^T, where G (contact, n) is exp(-s/rho) along one axis, `folded`. Nothing is left out or
    interpolated. ValueError if the sphere is rough, or a range of adhesion is too small for the
    relief of the surface.
    """
    if bodies.roughness is not None:
        raise ValueError("expected a smooth sphere, found a rough one: its sum is not separable")
    heights, geometry = bodies.substrate.heights, bodies.geometry
    h_max = float(heights.max())
    below_highest = closest_gaps(heights, geometry) + h_max
    forces = np.empty((len(ranges), *below_highest.shape))
    for force, rho in zip(forces, ranges, strict=True):
        exponents = below_highest / rho
        if exponents.max() > STEEPEST:
            raise ValueError(
                "expected a range of adhesion that resolves the relief of the surface, "
                f"found rho = {rho:g} nm, too small for it"
            )
        of_sphere = folded(len(heights), geometry, rho)
        with threadpool_limits(1, "blas"):  # so that the sums do not depend on their number
            sums = of_sphere @ (exponential(heights, h_max, rho) @ of_sphere.T)
        totals = np.exp(exponents) * sums
        force[:] = pull_off_force(totals, rho, geometry.pixel_size, WORK_OF_ADHESION)
    return forces


class MapSettings(TypedDict):
    """How maps are made and what is asked of them."""

    radius: float  #: Of the smooth sphere in nm.
    contact: ContactArray  #: Analysis window, and the array of contacts beside the map.
    ranges: list[float]  #: Ranges of adhesion in nm.
    reference_rho: float  #: That of the maps that are kept, one of the ranges.
    tolerance: float  #: Relative error of a mean.
    confidence: float  #: Probability that the mean is within the tolerance, and of the intervals.


def force_maps(stitched: HeightMap, settings: MapSettings) -> xr.Dataset:
    """Return the map of one mirror-stitched scan, and the errors of means of contacts on it.

    ``heights`` and ``pull_off_force`` (row, column) of the scan, the latter at the reference range;
    ``touched_pixels``; by ``rho`` the means, ``variation``, the correlation, ``array_error`` (rho,
    contacts), ``contacts_needed`` (rho, sampling) and ``distribution`` (rho, sample,
    relative_force).
    """
    ranges = settings["ranges"]
    pair = bodies(stitched, None, settings["radius"], settings["contact"])
    scan = stitched.pixels // 2
    mapped = at_every_pixel(pair, scan)
    everywhere, contacts = rigid_pull_off(mapped, ranges), rigid_pull_off(pair, ranges)
    reference = everywhere[list(ranges).index(settings["reference_rho"])]
    numbers = [_numbers(forces, stitched.pixel_size, settings) for forces in everywhere]
    smooth = dmt_pull_off(WORK_OF_ADHESION, settings["radius"])
    distributions = [
        [_distribution(sample / smooth) for sample in samples]
        for samples in zip(everywhere, contacts, strict=True)
    ]
    axes, over = ("row", "column"), ("rho", "sample", "relative_force")
    heights = stitched.heights[:scan, :scan].astype("float32")
    share = {"units": "1", "long_name": "share of the forces per decade"}
    variables: dict[str, Any] = {
        "heights": (axes, heights, {"units": "nm", "long_name": "surface height"}),
        "pull_off_force": (axes, reference.astype("float32"), FORCE),
        "scan_size": ((), scan * stitched.pixel_size, {"units": "nm"}),
        "touched_pixels": ((), _touched_pixels(mapped)),
        "map_mean": ("rho", everywhere.mean(axis=(1, 2))),
        "map_median": ("rho", np.median(everywhere, axis=(1, 2))),
        "contacts_mean": ("rho", contacts.mean(axis=(1, 2))),
        "distribution": (over, distributions, share),
    }
    further = {"array_error": ["contacts"], "contacts_needed": ["sampling"]}
    for name in numbers[0]:
        of_ranges = [of_range[name] for of_range in numbers]
        variables[name] = (["rho", *further.get(name, [])], of_ranges)
    return xr.Dataset(
        variables,
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
    touching = np.array(touching_pixels(bodies.substrate.heights, bodies.geometry)) % period
    row, column = np.minimum(touching, period - 1 - touching)
    return len(np.unique(row * period + column))


def _numbers(forces: np.ndarray, pixel_size: float, settings: MapSettings) -> dict[str, Any]:
    """Return the numbers of one map (n, n) in N."""
    counts, error = _counts(len(forces)), settings["tolerance"] / normal_quantile(settings)
    errors = np.array([array_error(forces, int(count)) for count in counts])
    length, area = correlation(forces, pixel_size)
    spread = variation(forces)
    at_random = max(1.0, (spread / error) ** 2)
    return {
        "variation": spread,
        "correlation_length": length,
        "correlated_places": forces.size * pixel_size**2 / area,
        "array_error": errors,
        "contacts_needed": [at_random, contacts_for_error(counts**2, errors, error)],
    }


def _distribution(relative: np.ndarray) -> np.ndarray:
    """Return the share of forces (over that of a smooth sphere) per decade in each of CLASSES."""
    number, _ = np.histogram(relative, CLASSES)
    return number / relative.size / np.diff(np.log10(CLASSES))


def variation(forces: Floats) -> float:
    """Return the standard deviation of forces over their mean: the error of a single contact."""
    return float(forces.std() / forces.mean())


def array_error(forces: Floats, count: int) -> float:
    """Return the error of the mean of a square array of contacts on the scan and its mirror images.

    It is the root mean square of array mean over map mean minus one of all arrays there are: the
    same array at every shift within one of its steps. `count` contacts along an edge span the
    period of 2n pixels of the stitched scan, as `contact_positions` does.
    """
    period = 2 * len(forces)
    shifts = np.arange(-(-period // count))
    places = (shifts[:, None] + np.arange(count) * period // count) % period
    on_scan = np.minimum(places, period - 1 - places)
    rows = forces[on_scan].mean(axis=1)
    means = rows[:, on_scan].mean(axis=2)
    return float(np.sqrt(np.mean((means / forces.mean() - 1) ** 2)))


def contacts_for_error(contacts: ArrayLike, errors: ArrayLike, error: float) -> float:
    """Return the number of contacts beyond which errors stay within a limit.

    Of ascending numbers (k,) and their errors (k,) it is interpolated in the logarithms; the first
    number if all errors are within the limit, NaN if the last one is not.
    """
    numbers, found = np.asarray(contacts, float), np.asarray(errors, float)
    (beyond,) = np.nonzero(found > error)
    if not beyond.size:
        return float(numbers[0])
    if beyond[-1] == len(found) - 1:
        return float("nan")
    ends = [beyond[-1] + 1, beyond[-1]]  # errors ascend from the first to the second
    with np.errstate(divide="ignore"):
        at = np.interp(np.log(error), np.log(found[ends]), np.log(numbers[ends]))
    return float(np.exp(at))


class Correlation(NamedTuple):
    """How far the force at one place tells that at another."""

    #: Distance (nm) at which the correlation, averaged over directions, falls to 1/e; NaN where it
    #: does not within half the scan.
    length: float
    #: Integral (nm²) of the correlation over the plane, up to its first zero: an area much larger
    #: than it has as many independent contacts as it holds such areas.
    area: float


def correlation(forces: Floats, pixel_size: float) -> Correlation:
    """Return the correlation of a map (n, n), which does not continue itself beyond its edges."""
    half = len(forces) // 2
    lags = _autocorrelation(forces)[: half + 1, : 2 * half + 1]
    rows, columns = np.arange(half + 1)[:, None], np.arange(-half, half + 1)
    # The map of lags is symmetric about zero: rows of negative lag count with those of positive.
    weight = np.where(rows > 0, 2.0, 1.0) * np.ones_like(columns)
    distance = np.rint(np.hypot(rows, columns)).astype(int)
    near = distance <= half
    number = np.bincount(distance[near], weight[near])
    integral = np.bincount(distance[near], (weight * lags)[near])
    radial = integral / number
    level, length = np.exp(-1), np.nan
    (below,), (negative,) = np.nonzero(radial < level), np.nonzero(radial <= 0)
    if below.size:
        at = below[0]
        length = at - (level - radial[at]) / (radial[at - 1] - radial[at])
    end = negative[0] if negative.size else len(radial)
    return Correlation(float(length) * pixel_size, integral[:end].sum() * pixel_size**2)


def _autocorrelation(forces: Floats) -> Floats:
    """Return the correlation at lags (row, column) from 0 to n/2 and from -n/2 to n/2.

    Each lag is averaged over the pairs of pixels that it has on the map.
    """
    pixels = len(forces)
    half = pixels // 2
    padded = np.fft.rfft2(forces - forces.mean(), s=(2 * pixels, 2 * pixels))
    products = np.fft.irfft2(np.abs(padded) ** 2, s=(2 * pixels, 2 * pixels))
    columns = np.arange(-half, half + 1)
    pairs = (pixels - np.arange(half + 1))[:, None] * (pixels - np.abs(columns))
    covariance = products[: half + 1, columns] / pairs
    return np.asarray(covariance / covariance[0, half])
