"""How both edges of the critical band scale with R, rho and the contact area F/H.

The attraction reaches sqrt(2 R rho) along the surface (Eq. 3 of the paper) and the contact
sqrt(F/H). If one of them set an edge, the edge would be proportional to it: exponents of 1 for
sqrt(R) and sqrt(rho), or for sqrt(F/H). An edge that belongs to the surface has the exponents 0.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.adhesion.all_surfaces import Described, with_names
from hardcontact.numbers.statistics import Sampling, bounds, jackknife_interval, with_interval
from hardcontact.scales.critical_band import POOLED, critical_band
from hardcontact.scales.stacked_masters import stacked_forces
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments, roll_off

#: What an edge may follow: sqrt(R) and sqrt(rho), together the reach of the attraction, sqrt(F/H).
LENGTHS = ["radius", "rho", "contact"]

#: Combinations that an exponent is fitted to: all, and those of either side of the roll-off.
PARTS = ["all", "reach below roll-off", "reach above roll-off"]

#: What the interval of an exponent says of an edge and a length: see `dependence`.
PROPORTIONAL, INDEPENDENT, PARTLY = "proportional", "independent", "partly"
STEEPER, FALLING, UNDECIDED = "steeper", "falling", "undecided"
DEPENDENCE = [PROPORTIONAL, PARTLY, INDEPENDENT, STEEPER, FALLING, UNDECIDED]

COMBINATION = ["radius", "area", "rho"]


def stacked_scaling(
    masters: Mapping[tuple[Any, ...], xr.Dataset],
    spectra: Mapping[str, Spectrum],
    described: Described,
) -> xr.Dataset:
    """Return the ratios of all masters, and what the spectrum says of each surface.

    The masters are of `scaled_pull_off`, by (surface, realization, side). ``ratio`` (surface,
    realization, side, cutoff_wavelength, radius, area, rho) is of filtered over unfiltered force,
    NaN at cutoffs of the other side; ``unfiltered_wavelength`` (surface, side) and ``contact_area``
    (side, area) stand beside ``rms_height`` and ``roll_off`` (surface) in nm, the latter the
    wavelength whose octave holds most of the variance of heights; label and basis.
    """
    stacked = stacked_forces(masters)
    of_surfaces = [spectra[name] for name in stacked["surface"].values.tolist()]
    nm = {"units": "nm"}
    return with_names(stacked, described).assign(
        contact_area=stacked["contact_area"].isel(surface=0, realization=0, drop=True),
        rms_height=("surface", [all_scales_moments(one)[0] for one in of_surfaces], nm),
        roll_off=("surface", [roll_off(one) for one in of_surfaces], nm),
    )


def edge_scaling(scaling: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return edges, exponents and what they say of all surfaces, of `stacked_scaling`.

    The tolerance is the relative change of the force that counts; the confidence of the sampling is
    that of all intervals. ``edge`` (side, surface, radius, area, rho) is in nm with its interval
    over realizations, NaN where it is open; ``exponent`` (side, surface, part, length) by least
    squares of ln(edge) against the logarithms of LENGTHS, with intervals by the jackknife over
    realizations, and ``reach_exponent`` (side, surface, part) against sqrt(2 R rho) in place of R
    and rho apart; ``explained`` (side, surface, part), the share of the variance of ln(edge) that
    the first explains, and ``edges_found`` of the same; ``dependence`` as exponent; the variables
    of the surfaces, and ``reach`` (radius, rho), sqrt(2 R rho) in nm. Open edges are left out:
    where some are open, exponents are those of the combinations that have an edge.
    """
    reach = (2 * scaling["radius"] * scaling["rho"]) ** 0.5
    scaling = scaling.assign(reach=reach.assign_attrs(units="nm"))
    edges = _edges(scaling, tolerance, sampling)
    unsampled = Sampling(sampling.seed, 0, sampling.confidence)
    count = scaling.sizes["realization"]
    left_out = [
        _fits(scaling, _edges(scaling.isel(realization=kept), tolerance, unsampled)["edge"])
        for kept in (np.delete(np.arange(count), one) for one in range(count if count > 2 else 0))
    ]
    fits = _fits(scaling, edges["edge"])
    for name in ("exponent", "reach_exponent"):
        fits = fits.assign(_with_interval(fits[name], left_out, sampling.confidence))
    low, high = bounds(fits, "exponent")
    fits = fits.assign(dependence=(low.dims, dependence(low, high)))
    kept = scaling[["rms_height", "roll_off", "reach", "contact_area", "label", "basis"]]
    return xr.merge([edges, fits, kept]).assign_attrs(
        tolerance=tolerance, confidence=sampling.confidence
    )


def _with_interval(
    exponent: xr.DataArray, left_out: list[xr.Dataset], confidence: float
) -> dict[str, Any]:
    """Return exponents with their interval, from fits that leave a realization out.

    The jackknife of a positive number is Student's t of its logarithm, here the exponent.
    """
    interval = np.full((*exponent.shape, 2), np.nan)
    if left_out:
        others = np.exp([one[exponent.name].values for one in left_out])
        interval = np.log(jackknife_interval(np.exp(exponent.values), others, confidence))
    dimensions = [str(name) for name in exponent.dims]
    attributes = {"units": "1", "long_name": "exponent of the edge of the band"}
    return with_interval(
        str(exponent.name), dimensions, exponent.values, interval, attributes, confidence
    )


def dependence(low: ArrayLike, high: ArrayLike) -> NDArray[np.str_]:
    """Return which one of DEPENDENCE the intervals of exponents, from low to high, say.

    An edge is PROPORTIONAL to a length where the interval holds 1 and not 0, INDEPENDENT of it
    where it holds 0 and not 1, UNDECIDED where it holds both. An interval that holds neither lies
    between 0 and 1 (PARTLY), above 1 (STEEPER) or below 0 (FALLING). Without an interval it is
    UNDECIDED.
    """
    low, high = np.asarray(low), np.asarray(high)
    known = np.isfinite(low) & np.isfinite(high)
    zero, one = ((low <= number) & (number <= high) for number in (0, 1))
    conditions = [~known | (zero & one), one, zero, low > 1, high < 0]
    return np.select(conditions, [UNDECIDED, PROPORTIONAL, INDEPENDENT, STEEPER, FALLING], PARTLY)


def _edges(scaling: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ``edge`` (side, surface, radius, area, rho) in nm, with its interval.

    To `critical_band` every combination on a surface is a surface of its own.
    """
    one = scaling["ratio"].isel(realization=0, cutoff_wavelength=0, drop=True)
    ends = scaling["unfiltered_wavelength"].broadcast_like(one)
    cases = xr.Dataset({"ratio": scaling["ratio"], "unfiltered_wavelength": ends})
    stacked = cases.stack(case=["surface", *COMBINATION])
    names = [":".join(map(str, case)) for case in stacked["case"].values]
    named = stacked.drop_vars(["case", "surface", *COMBINATION]).rename(case="surface")
    band = critical_band(named.assign_coords(surface=names), tolerance, sampling)
    found = band[["critical_wavelength", "critical_wavelength_interval"]].drop_sel(group=POOLED)
    found = found.rename(
        group="case", critical_wavelength="edge", critical_wavelength_interval="edge_interval"
    )
    unstacked = found.assign_coords(stacked["case"].coords).unstack("case")
    return unstacked.reindex(surface=scaling["surface"])


def _fits(scaling: xr.Dataset, edge: xr.DataArray) -> xr.Dataset:
    """Return exponents, explained share and number of edges of every side, surface and part."""
    below = scaling["reach"] < scaling["roll_off"]
    taken = xr.concat([xr.ones_like(below), below, ~below], "part").assign_coords(part=PARTS)
    logarithms = [np.log(scaling[name]) / 2 for name in ("radius", "rho", "contact_area")]
    exponent, explained, found, of_reach = xr.apply_ufunc(
        _fit,
        np.log(edge),
        taken,
        *logarithms,
        input_core_dims=[COMBINATION, ["radius", "rho"], ["radius"], ["rho"], ["area"]],
        output_core_dims=[["length"], [], [], []],
        vectorize=True,
    )
    return xr.Dataset(
        {
            "exponent": exponent.transpose("side", "surface", "part", "length"),
            "reach_exponent": of_reach.transpose("side", "surface", "part"),
            "explained": explained.assign_attrs(units="1"),
            "edges_found": found.assign_attrs(units="1"),
        }
    ).assign_coords(length=LENGTHS)


def _fit(
    edge: np.ndarray, taken: np.ndarray, radius: np.ndarray, rho: np.ndarray, contact: np.ndarray
) -> tuple[np.ndarray, float, int, float]:
    """Return exponents (3,), the explained share of the variance, edges, the exponent of the reach.

    edge: logarithms (radius, area, rho), NaN where open; taken: (radius, rho); the others are
    logarithms of square roots. Exponents of lengths that the edges do not tell apart are NaN.
    """
    lengths = np.broadcast_arrays(radius[:, None, None], rho, contact[:, None])
    known = np.isfinite(edge) & taken.astype(bool)[:, None, :]
    first, second, third = (length[known] for length in lengths)
    values = edge[known]
    exponents, share = _regression(values, [first, second, third])
    (of_reach, _), _ = _regression(values, [first + second, third])
    return exponents, share, len(values), float(of_reach)


def _regression(values: np.ndarray, predictors: list[np.ndarray]) -> tuple[np.ndarray, float]:
    """Return slopes of values (n,) against predictors (n,), and the explained share of variance."""
    design = np.stack([np.ones(values.shape), *predictors], axis=-1)
    count = len(predictors) + 1
    if len(values) <= count or np.linalg.matrix_rank(design) < count:
        return np.full(count - 1, np.nan), np.nan
    solution = np.linalg.lstsq(design, values)[0]
    spread = values.var()
    share = 1 - (values - design @ solution).var() / spread if spread > 0 else np.nan
    return solution[1:], float(share)
