"""Parts of scans that vary by themselves: the interval of a few scans comes from them.

With three scans of a surface or more, the parts are the scans. With fewer, they are the quarters
of each scan: contacts of a mirrored scan are grouped by the quarter in which they lie. Quarters are
not independent: a contact feels the surface around it with the weight exp(-r²/(2 R rho)), with
which the paraboloid r²/2R enters Eq. 3 of the paper, so that contacts of different quarters feel
the same peaks. R, rho and the size of the scan say how much, which corrects the variance. Where
contacts touch fewer places than there are quarters, some of these are one draw, and give none.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import xarray as xr

CONTACTS = ("contact_y", "contact_x")
#: Fewer scans than these are divided into quarters.
ENOUGH_SCANS = 3
#: Half widths of logarithms: less is rounding, more is as good as infinite.
ROUNDING, ENDLESS = 1e-9, 50.0
#: An interval that spans a wider factor to each side bounds nothing of use.
UNBOUNDED = float(np.log(1e3))
#: Parts that correlate more are the same.
SAME = 1 - 1e-9


class Variance(NamedTuple):
    """Variance of the logarithm of a statistic from one source."""

    value: np.ndarray  #: (...), NaN where it is not known.
    freedom: float  #: Degrees of freedom it is known with.


@dataclass(frozen=True, eq=False)
class Parts:
    """Parts of the scans of one surface."""

    #: (map, contact_y, contact_x), the number of the part in which a contact of a map lies.
    of_contact: np.ndarray
    correlation: np.ndarray  #: (part, part), of mean forces of parts.
    scans: int  #: The scans they are parts of.
    places: float = np.inf  #: The fewest places that the contacts of a scan touch.

    @property
    def conditional(self) -> bool:
        """Whether the parts are quarters, so that an interval is conditional on these scans."""
        return self.scans < ENOUGH_SCANS

    @property
    def touches_few(self) -> bool:
        """Whether the contacts of a scan touch fewer places than it has quarters."""
        return self.conditional and self.places * self.scans < len(self.correlation)

    @property
    def shared(self) -> float:
        """Mean correlation of two parts."""
        count = len(self.correlation)
        return float((self.correlation.sum() - count) / max(count * (count - 1), 1))

    @property
    def widening(self) -> tuple[float, float]:
        """Factor on the variance of the delete-one jackknife, and its degrees of freedom.

        The variance is (n - 1)/n sum (l_i - l)². Parts of the mean correlation c lower it by the
        factor 1 - c and raise the variance of their mean by 1 + (n - 1) c, which is corrected. The
        degrees of freedom are those of Satterthwaite for the correlation matrix C:
        (tr HC)²/tr (HC)² with H = 1 - 1/n. NaN where these parts give no interval.
        """
        count, shared = len(self.correlation), self.shared
        if count < 2 or shared > SAME or self.touches_few:
            return np.nan, np.nan
        centred = (np.eye(count) - 1 / count) @ self.correlation
        freedom = np.trace(centred) ** 2 / np.trace(centred @ centred)
        return (1 + (count - 1) * shared) / (1 - shared), float(freedom)

    @property
    def source(self) -> str:
        """What an interval comes from: "scans", "quarters" of them or, of one part, "none".

        There is none from "few_places" either.
        """
        if not self.conditional:
            return "scans"
        if len(self.correlation) < 2 or self.shared > SAME:
            return "none"
        return "few_places" if self.touches_few else "quarters"


def quarters_of_contacts(count: int, tiles: int) -> np.ndarray:
    """Return the quarter of the scan in which each contact of an array (count, count) lies.

    A map is a mirrored scan, repeated `tiles` times along an edge; contacts lie as
    `contact_positions` says. Quarters are 2 in the second half along y, plus 1 in that along x.
    """
    unfolded = 2 * tiles * (np.arange(count) + 0.25) / count % 2  # in edges of the scan
    half = (np.minimum(unfolded, 2 - unfolded) >= 0.5).astype(int)
    return np.asarray(2 * half[:, None] + half)


def parts_of_scans(
    scan_of_map: np.ndarray,
    quarters: np.ndarray,
    size: float,
    reach: float,
    places: float = np.inf,
) -> Parts:
    """Return the parts of the scans of a surface: scans if there are three, otherwise quarters.

    `scan_of_map` (map,) is the number of the scan that each map is made of, `quarters` (contact_y,
    contact_x) are of `quarters_of_contacts`; `size` is the edge of a scan, `reach` sqrt(R rho), the
    deviation of the weight with which a contact feels the surface, both in nm. `places` are those
    of Parts.
    """
    scans, scan = np.unique(scan_of_map, return_inverse=True)
    if len(scans) >= ENOUGH_SCANS:
        of_contact = np.broadcast_to(scan[:, None, None], (len(scan), *quarters.shape))
        return Parts(of_contact, np.eye(len(scans)), len(scans), places)
    numbers, quarter = np.unique(quarters, return_inverse=True)
    of_contact = scan[:, None, None] * len(numbers) + quarter.reshape(quarters.shape)
    correlation = _correlation_of_quarters(size, reach)[np.ix_(numbers, numbers)]
    return Parts(of_contact, np.kron(np.eye(len(scans)), correlation), len(scans), places)


def _correlation_of_quarters(size: float, reach: float) -> np.ndarray:
    """Return the correlation (4, 4) of mean forces of the quarters of a mirrored scan.

    Along one axis contacts of one half together feel its indicator, smoothed by a Gaussian of the
    deviation s = `reach`: 1/2 ± sum_k a_k cos(k pi x/L) exp(-(k pi s/L)²/2) over odd k, where
    a_k = ±2/(k pi) are the Fourier coefficients of a step. Roughness without correlation of its own
    gives the covariances 1/4 ± sum_k a_k² exp(-(k pi s/L)²)/2 of a half with itself and the other.
    """
    order = np.arange(1, 2000, 2)
    step = 2 / (np.pi * order) ** 2 * np.exp(-((np.pi * order * reach / size) ** 2))
    other = (0.25 - step.sum()) / (0.25 + step.sum())
    halves = np.array([[1.0, other], [other, 1.0]])
    return np.kron(halves, halves)


def left_out_logarithms(
    parts: Parts, maps: str, statistic: Callable[[xr.DataArray], xr.DataArray]
) -> np.ndarray:
    """Return the logarithms (part, ...) of a statistic of all parts but one.

    The statistic (...) is a function of which contacts (maps, contact_y, contact_x) are kept.
    """
    return np.array(
        [
            np.log(statistic(xr.DataArray(parts.of_contact != part, dims=(maps, *CONTACTS))).values)
            for part in range(len(parts.correlation))
        ]
    )


def jackknife_variance(left_out: np.ndarray, parts: Parts) -> Variance:
    """Return the variance of the delete-one jackknife, corrected by `Parts.widening`.

    `left_out` (part, ...) is of `left_out_logarithms`.
    """
    factor, freedom = parts.widening
    return Variance((len(left_out) - 1) * left_out.var(axis=0) * factor, freedom)


def half_width(sources: Sequence[Variance], confidence: float) -> np.ndarray:
    """Return the half width of the interval of a logarithm whose variance has several sources.

    Student's t with the sum of the variances v_i (...) of independent sources, and the degrees of
    freedom of Welch and Satterthwaite: (sum v_i)²/sum(v_i²/f_i). NaN where a variance is, and where
    all are rounding.
    """
    from scipy import special

    total = np.asarray(sum(source.value for source in sources))
    positive = np.where(total > 0, total, 1.0)
    inverse = sum((source.value / positive) ** 2 / source.freedom for source in sources)
    inverse = np.where(total > 0, inverse, 1.0)
    quantile = special.stdtrit(1 / inverse, (1 + confidence) / 2)
    half = np.minimum(quantile * np.sqrt(total), ENDLESS)
    return np.where(half > ROUNDING, half, np.nan)


def logarithmic_interval(value: np.ndarray, half: np.ndarray) -> np.ndarray:
    """Return the interval (..., 2) of a positive value from the half width of its logarithm.

    From zero to infinity, which is no bound, where it would span a factor of a thousand or more to
    each side: Student's t of one degree of freedom, from two realizations, can span any.
    """
    finite = value[..., None] * np.exp(np.stack([-half, half], axis=-1))
    return np.where((half > UNBOUNDED)[..., None], [0.0, np.inf], finite)


def sampled_deviations(
    rng: np.random.Generator, left_out: np.ndarray, parts: Parts, samples: int
) -> np.ndarray:
    """Draw deviations (samples, ...) of the logarithm of a statistic from its mean over parts.

    They are of Student's t, as in `half_width`; `left_out` (part, ...) is of `left_out_logarithms`.
    With the same generator, parts that differ in their correlation alone share their random
    numbers. NaN for fewer than two parts.
    """
    from scipy import special

    count = len(left_out)
    factor, freedom = parts.widening
    normal, level = rng.standard_normal((samples, count)), rng.uniform(size=samples)
    chi_squared = 2 * special.gammaincinv(freedom / 2, level)
    scale = np.sqrt(factor * (count - 1) / count * freedom / chi_squared)
    drawn = np.tensordot(scale[:, None] * normal, left_out - left_out.mean(axis=0), axes=1)
    return np.asarray(np.clip(drawn, -ENDLESS, ENDLESS))
