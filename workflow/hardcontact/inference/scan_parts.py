"""Parts of scans: the jackknife over the parts gives the interval of a mean force.

How much would a mean force change on other scans of the surface? The jackknife leaves out one part
of the scans after the other and looks how much the mean force changes. With the logarithms L_i of
the mean over all n parts but the i-th, and their mean M, the variance of the logarithm is

    (n - 1)/n x sum over i of (L_i - M)^2.

If a surface has three scans or more, the parts are the scans, which are independent. Otherwise they
are the quarters of each scan: four parts for one scan, eight for two. A contact belongs to the
quarter above which it lies. Quarters are correlated, because the same summits attract contacts of
several quarters, so the variance is corrected (`ScanParts.variance_correction`). If contacts touch
fewer patches (`contact.patches`) than there are quarters, some quarters share a patch, and there is
no interval.

A map, along the dimension ``map``, is a mirrored scan, a master or a whole surface.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import MAX_LOG_DEVIATION, student_quantile
from hardcontact.contact.contact import CONTACT_AXES

#: Fewer scans are divided into quarters, because two hardly show how scans vary.
ENOUGH_SCANS = 3
#: Smaller half widths of logarithms come from rounding.
MIN_HALF_WIDTH = 1e-9
#: Parts that correlate more count as one part.
SAME_CORRELATION = 1 - 1e-9


class IntervalSource(StrEnum):
    """The origin of the interval of a mean, or why it is missing: `interval_source` of files."""

    SCANS, QUARTERS = "scans", "quarters"
    #: There is a single part, or all parts count as one (SAME_CORRELATION).
    ONE_PART = "none"
    #: Contacts touch too few patches.
    FEW_PATCHES = "few_patches"
    #: Forces were measured at a single site.
    ONE_SITE = "one_site"


class Variance(NamedTuple):
    """Variance of the logarithm of a statistic from one cause, such as few scans."""

    value: Floats  #: (...), NaN where the variance is unknown.
    degrees_of_freedom: float


@dataclass(frozen=True, eq=False)
class ScanParts:
    """Parts of the scans of one surface: the scans themselves, or their quarters."""

    part_of_contact: NDArray[np.int_]  #: (map, contact_y, contact_x) numbers of parts.
    correlation_matrix: Floats  #: (part, part), of mean forces on parts.
    scan_count: int
    touched_patches: float = np.inf  #: Fewest patches that the contacts on a scan touch.

    @property
    def are_quarters(self) -> bool:
        """Whether the parts are quarters, so that an interval is conditional on these scans."""
        return self.scan_count < ENOUGH_SCANS

    @property
    def part_count(self) -> int:
        """Number of parts."""
        return len(self.correlation_matrix)

    @property
    def mean_correlation(self) -> float:
        """Mean correlation of two parts."""
        count = self.part_count
        return float((self.correlation_matrix.sum() - count) / max(count * (count - 1), 1))

    @property
    def interval_source(self) -> IntervalSource:
        """The origin of an interval, or why it is missing."""
        if not self.are_quarters:
            return IntervalSource.SCANS
        if self.part_count < 2 or self.mean_correlation > SAME_CORRELATION:
            return IntervalSource.ONE_PART
        touches_few_patches = self.touched_patches * self.scan_count < self.part_count
        return IntervalSource.FEW_PATCHES if touches_few_patches else IntervalSource.QUARTERS

    @property
    def variance_correction(self) -> tuple[float, float]:
        """The factor that corrects the jackknife variance, and its degrees of freedom.

        If n parts have the mean correlation c, they scatter less about their mean: the jackknife
        gives 1 - c times the variance of independent parts. But the variance of their mean is
        1 + (n - 1) c times as large. So the factor is (1 + (n - 1) c)/(1 - c), 1 for c = 0. The
        degrees of freedom are Satterthwaite's for the correlation matrix minus its column means,
        n - 1 for c = 0. Both are NaN if there is no interval.
        """
        if self.interval_source not in (IntervalSource.SCANS, IntervalSource.QUARTERS):
            return np.nan, np.nan
        count = self.part_count
        correlation = self.mean_correlation
        centred = (np.eye(count) - 1 / count) @ self.correlation_matrix
        degrees_of_freedom = np.trace(centred) ** 2 / np.trace(centred @ centred)
        return (1 + (count - 1) * correlation) / (1 - correlation), float(degrees_of_freedom)


def fewest_touched_patches(adhesion: xr.Dataset) -> dict[str, float]:
    """Return the smallest number of patches that the contacts on a scan touch, by surface.

    For each scan, the scan of the sphere that touches most patches counts.
    """
    patches = adhesion.touched_patches.max("sphere_scan").min("scan")
    return {str(name): float(patches.sel(surface=name)) for name in patches.surface.values}


def quarters_of_contacts(contacts_per_row: int, tiles: int) -> NDArray[np.int_]:
    """Return the quarter (contact_y, contact_x), 0 to 3, of the scan that holds each contact.

    A mirrored map repeats the mirrored scan `tiles` times along each axis. If a map is not
    mirrored, the second half along an axis is the middle half of its period.
    """
    # Positions of `contact_positions` in widths of the scan; the second width is its mirror image.
    unfolded = 2 * tiles * (np.arange(contacts_per_row) + 0.25) / contacts_per_row % 2
    is_second_half = (np.minimum(unfolded, 2 - unfolded) >= 0.5).astype(int)
    return np.asarray(2 * is_second_half[:, None] + is_second_half)


def parts_of_scans(
    scan_of_map: NDArray[np.int_],
    quarters: NDArray[np.int_],
    period: float,
    weight_deviation: float,
    touched_patches: float = np.inf,
) -> ScanParts:
    """Return the parts of the scans of a surface: three or more scans, otherwise quarters.

    `scan_of_map` (map,) numbers the scan of each map, `quarters` come from `quarters_of_contacts`.
    The `period` in nm is the width of a mirrored scan or a whole surface. Around a contact, the
    surface attracts with a Gaussian weight (Eq. 3 of the paper), whose `weight_deviation` is
    sqrt(R rho) in nm.
    """
    scans, scan = np.unique(scan_of_map, return_inverse=True)
    if len(scans) >= ENOUGH_SCANS:
        part_of_contact = np.broadcast_to(scan[:, None, None], (len(scan), *quarters.shape))
        return ScanParts(part_of_contact, np.eye(len(scans)), len(scans), touched_patches)
    # Contacts may lie on fewer than four quarters.
    numbers, quarter = np.unique(quarters, return_inverse=True)
    part_of_contact = scan[:, None, None] * len(numbers) + quarter.reshape(quarters.shape)
    scan_matrix = _correlation_of_quarters(period, weight_deviation)[np.ix_(numbers, numbers)]
    correlation_matrix = np.asarray(np.kron(np.eye(len(scans)), scan_matrix), float)
    return ScanParts(part_of_contact, correlation_matrix, len(scans), touched_patches)


def parts_of_maps(
    forces: xr.Dataset, radius: float, rho: float, touched_patches: float = np.inf
) -> ScanParts:
    """Return the parts of maps, each of another scan or surface; all lengths are in nm."""
    quarters = quarters_of_contacts(forces.sizes["contact_y"], 1)
    period = float(forces.attrs["period"])
    maps = np.arange(forces.sizes["map"])
    return parts_of_scans(maps, quarters, period, float(np.sqrt(radius * rho)), touched_patches)


def _correlation_of_quarters(period: float, weight_deviation: float) -> Floats:
    """Return the correlation (4, 4) of the mean forces on the quarters of a periodic map.

    Along one axis, the surface attracts the contacts of one half with a weight: a step, 1 on this
    half and 0 on the other, smoothed by a Gaussian. A weight is 1/2 plus cosines of odd orders k,
    with the amplitudes 2/(k pi) before smoothing; the weight of the other half is 1/2 minus them.
    With S, the sum of amplitude²/2, the mean square of a weight is 1/4 + S, and the mean product of
    both is 1/4 - S. If roughness is uncorrelated, these are variance and covariance of the forces
    on the halves. A quarter is a half along each axis, so the correlations of both axes multiply.
    """
    order = np.arange(1, 2000, 2)  # the sum over higher orders is below 1e-4
    squared_smoothing = np.exp(-((2 * np.pi * order * weight_deviation / period) ** 2))
    half_square_sum = (2 / (np.pi * order) ** 2 * squared_smoothing).sum()
    correlation = (0.25 - half_square_sum) / (0.25 + half_square_sum)
    halves = np.array([[1.0, correlation], [correlation, 1.0]])
    return np.kron(halves, halves)


def delete_one_logarithms(
    scan_parts: ScanParts, map_dimension: str, statistic: Callable[[xr.DataArray], xr.DataArray]
) -> Floats:
    """Return the logarithms (part, ...) of a statistic over all parts except one.

    The statistic (...) is a function of the mask (map, contact_y, contact_x) of kept contacts.
    """
    part_of_contact = xr.DataArray(scan_parts.part_of_contact, dims=(map_dimension, *CONTACT_AXES))
    part_numbers = range(scan_parts.part_count)
    statistics = [statistic(part_of_contact != part_number).values for part_number in part_numbers]
    return np.asarray(np.log(statistics))


def jackknife_variance(logarithms: Floats, scan_parts: ScanParts) -> Variance:
    """Return the corrected jackknife variance of the logarithm of a statistic.

    `logarithms` (part, ...) come from `delete_one_logarithms`. If the parts are scans, the variance
    is that of `base.statistics.jackknife_interval`, which knows no quarters.
    """
    factor, degrees_of_freedom = scan_parts.variance_correction
    return Variance((len(logarithms) - 1) * logarithms.var(axis=0) * factor, degrees_of_freedom)


def interval_half_width(variances: Sequence[Variance], confidence: float) -> Floats:
    """Return the half width (...) of the interval of a logarithm with independent variances.

    It follows from Student's t with Satterthwaite's degrees of freedom, and is at most
    MAX_LOG_DEVIATION. NaN if a variance is NaN; 0 if the variances are mere rounding errors.
    """
    total = np.asarray(sum(variance.value for variance in variances))
    divisor = np.where(total > 0, total, 1.0)
    terms = [(cause.value / divisor) ** 2 / cause.degrees_of_freedom for cause in variances]
    degrees_of_freedom = 1 / np.where(total > 0, sum(terms), 1.0)
    quantile = student_quantile(degrees_of_freedom, confidence)
    half_width = np.minimum(quantile * np.sqrt(total), MAX_LOG_DEVIATION)
    return np.where(half_width < MIN_HALF_WIDTH, 0.0, half_width)


def log_force_ratio(
    changed_force: xr.DataArray, force: xr.DataArray, scan_parts: ScanParts, confidence: float
) -> tuple[Floats, Floats]:
    """Return the logarithm (...) of a ratio of mean forces, and its jackknife interval (..., 2).

    The means of forces (map, ..., contact_y, contact_x) are over maps and contacts.
    """
    dimensions = ["map", *CONTACT_AXES]

    def ratio(is_kept: xr.DataArray) -> xr.DataArray:
        return changed_force.where(is_kept).mean(dimensions) / force.where(is_kept).mean(dimensions)

    logarithms = delete_one_logarithms(scan_parts, "map", ratio)
    half_width = interval_half_width([jackknife_variance(logarithms, scan_parts)], confidence)
    log_ratio = np.log(ratio(xr.DataArray(True)).values)
    return log_ratio, np.stack([log_ratio - half_width, log_ratio + half_width], axis=-1)


def sample_deviations(
    rng: np.random.Generator, logarithms: Floats, scan_parts: ScanParts, sample_count: int
) -> Floats:
    """Sample deviations (sample, ...) of the logarithm of a statistic from its mean over parts.

    Deviations follow Student's t; `logarithms` come from `delete_one_logarithms`. The random
    numbers do not depend on the correlation of parts, so that all ranges of adhesion share them.
    """
    part_count = len(logarithms)
    factor, degrees_of_freedom = scan_parts.variance_correction
    normal = rng.standard_normal((sample_count, part_count))
    probability = rng.uniform(size=sample_count)
    chi_squared = 2 * scipy.special.gammaincinv(degrees_of_freedom / 2, probability)
    scale = np.sqrt(factor * (part_count - 1) / part_count * degrees_of_freedom / chi_squared)
    deviations = np.tensordot(scale[:, None] * normal, logarithms - logarithms.mean(axis=0), axes=1)
    return np.asarray(np.clip(deviations, -MAX_LOG_DEVIATION, MAX_LOG_DEVIATION))
