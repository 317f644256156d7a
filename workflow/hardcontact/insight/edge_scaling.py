"""How both edges of the critical band scale with R, rho and the contact area, and what sets them.

The attraction reaches sqrt(2 R rho) along the surface (Eq. 3 of the paper) and the contact
sqrt(F/H). If one of them set an edge, the edge would be proportional to it: exponents of 1 for
sqrt(R) and sqrt(rho), or for sqrt(F/H). An edge that belongs to the surface has the exponents 0.

Which regime a surface is in follows from three comparisons of lengths, all of the closed form
(`closed_form`) at one sphere, range and load:

- sigma/rho against m/sigma: the attraction comes from many points, or is frozen to single peaks.
- The diameter 2 sqrt(F/(pi H)) of the contact against the short edge. The closed form knows the
  range of adhesion, and that a contact flattens what is smaller than itself. If the longer of
  both set the edge, this would follow the contact alone where that is wider, otherwise the range
  alone; exponents of computed edges say how far that holds (`cause_exponents`).
- The reach sqrt(2 R rho) of the attraction against the roll-off of the spectrum. Roughness much
  longer than the reach lifts sphere and attraction alike, and far beyond the roll-off there is
  none: if one length stops the long edge, it is the shorter of the two. Neither is a sharp end: at
  the reach the attraction of a smooth sphere has fallen to 1/e, and the roll-off is the middle of
  an octave. Whether the edge stops there is for computed edges to say.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.adhesion.all_surfaces import Described, Parts, stacked_forces, with_names
from hardcontact.insight.closed_form import Contact, closed_form, edges
from hardcontact.numbers.statistics import Sampling, bounds, jackknife_interval, with_interval
from hardcontact.scales.critical_band import POOLED, critical_band
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments, roll_off
from hardcontact.surfaces.synthesis import SIDES

#: What an edge may follow: sqrt(R) and sqrt(rho), together the reach of the attraction, sqrt(F/H).
LENGTHS = ["radius", "rho", "contact"]
#: Combinations that an exponent is fitted to: all, and those of either side of the roll-off.
PARTS = ["all", "reach below roll-off", "reach above roll-off"]
#: What the interval of an exponent says of an edge and a length: see `dependence`.
PROPORTIONAL, INDEPENDENT, PARTLY = "proportional", "independent", "partly"
STEEPER, FALLING, UNDECIDED = "steeper", "falling", "undecided"
DEPENDENCE = [PROPORTIONAL, PARTLY, INDEPENDENT, STEEPER, FALLING, UNDECIDED]

#: The longer of two lengths that may set the short edge.
CONTACT, RANGE = "contact", "range"
#: The shorter of two lengths that may stop the long edge.
ROLL_OFF, REACH = "roll-off", "reach"

COMBINATION = ["radius", "area", "rho"]

Floats = NDArray[np.float64]


def stacked_scaling(
    masters: Parts, spectra: Mapping[str, Spectrum], described: Described
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

    The tolerance is the relative change of the force that counts. ``edge`` (side, surface, radius,
    area, rho) is in nm with its interval over realizations, NaN where it is open; ``exponent``
    (side, surface, part, length) by least squares of ln(edge) against the logarithms of LENGTHS,
    with intervals by the jackknife over realizations, and ``reach_exponent`` (side, surface, part)
    against sqrt(2 R rho) in place of R and rho apart; ``explained`` (side, surface, part), the
    share of the variance of ln(edge) that the first explains, and ``edges_found`` of the same;
    ``dependence`` as exponent; the variables of the surfaces, and ``reach`` (radius, rho), sqrt(2 R
    rho) in nm. Exponents are those of the combinations that have an edge.
    """
    reach = (2 * scaling["radius"] * scaling["rho"]) ** 0.5
    scaling = scaling.assign(reach=reach.assign_attrs(units="nm"))
    found = _edges(scaling, tolerance, sampling)
    unsampled, count = replace(sampling, samples=0), scaling.sizes["realization"]
    left_out = [
        _fits(scaling, _edges(scaling.drop_isel(realization=one), tolerance, unsampled)["edge"])
        for one in range(count if count > 2 else 0)
    ]
    fits, confidence = _fits(scaling, found["edge"]), sampling.confidence
    attributes = {"units": "1", "long_name": "exponent of the edge of the band"}
    for name in ("exponent", "reach_exponent"):
        dimensions, value = [str(dimension) for dimension in fits[name].dims], fits[name].values
        interval = exponent_interval(value, [one[name].values for one in left_out], confidence)
        bounded = with_interval(name, dimensions, value, interval, attributes, confidence)
        fits = fits.assign(bounded)
    low, high = bounds(fits, "exponent")
    fits = fits.assign(dependence=(low.dims, dependence(low, high)))
    kept = scaling[["rms_height", "roll_off", "reach", "contact_area", "label", "basis"]]
    return xr.merge([found, fits, kept]).assign_attrs(tolerance=tolerance, confidence=confidence)


def exponent_interval(exponent: Floats, left_out: Sequence[Floats], confidence: float) -> Floats:
    """Return the interval (..., 2) of exponents (...) from fits (n, ...) that leave one out.

    The jackknife of a positive number is Student's t of its logarithm, here the exponent.
    """
    return np.asarray(np.log(jackknife_interval(np.exp(exponent), np.exp(left_out), confidence)))


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
    cases = scaling[["ratio"]].assign(unfiltered_wavelength=ends)
    cases = cases.stack(case=["surface", *COMBINATION])
    names = [":".join(map(str, case)) for case in cases["case"].values]
    named = cases.drop_vars(["case", "surface", *COMBINATION]).rename(case="surface")
    band = critical_band(named.assign_coords(surface=names), tolerance, sampling)
    renamed = {f"critical_wavelength{end}": f"edge{end}" for end in ("", "_interval")}
    found = band[list(renamed)].drop_sel(group=POOLED).rename(renamed | {"group": "case"})
    unstacked = found.assign_coords(cases["case"].coords).unstack("case")
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
    edge: Floats, taken: Floats, radius: Floats, rho: Floats, contact: Floats
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


def _regression(values: Floats, predictors: list[Floats]) -> tuple[np.ndarray, float]:
    """Return slopes of values (n,) against predictors (n,), and the explained share of variance."""
    design = np.stack([np.ones(values.shape), *predictors], axis=-1)
    count = len(predictors) + 1
    if len(values) <= count or np.linalg.matrix_rank(design) < count:
        return np.full(count - 1, np.nan), np.nan
    solution = np.linalg.lstsq(design, values)[0]
    spread = values.var()
    share = 1 - (values - design @ solution).var() / spread if spread > 0 else np.nan
    return solution[1:], float(share)


def edge_regimes(spectra: Mapping[str, Spectrum], contact: Contact, tolerance: float) -> xr.Dataset:
    """Return the regime of every surface, and the lengths that decide it.

    The tolerance is the change of the force that counts. Over surface, lengths in nm:
    ``rough_height`` (sigma), ``approach`` (m), ``freezing``, (sigma/rho)/(m/sigma), ``regime`` of
    `closed_form`, ``predicted_edge`` (surface, side), NaN where there is none, ``short_edge_from``,
    empty there, and ``long_edge_from``, ROLL_OFF or REACH, the shorter of both. Of all:
    ``contact_diameter`` and ``attraction_reach``.
    """
    diameter = 2 * np.sqrt(contact.area / np.pi)
    reach = np.sqrt(2 * contact.radius * contact.rho)
    forms = [closed_form(one, contact) for one in spectra.values()]
    predicted = np.array([edges(one, contact, tolerance) for one in spectra.values()])
    short = np.select([np.isnan(predicted[:, 0]), predicted[:, 0] < diameter], ["", CONTACT], RANGE)
    ends = np.array([roll_off(one) for one in spectra.values()])
    nm, one = {"units": "nm"}, {"units": "1"}
    return xr.Dataset(
        {
            "rough_height": ("surface", [form.rms_height for form in forms], nm),
            "approach": ("surface", [form.closest_approach for form in forms], nm),
            "freezing": ("surface", [form.freezing for form in forms], one),
            "regime": ("surface", [form.regime for form in forms]),
            "predicted_edge": (("surface", "side"), predicted, nm),
            "short_edge_from": ("surface", short),
            "long_edge_from": ("surface", np.where(reach < ends, REACH, ROLL_OFF)),
            "contact_diameter": ((), diameter, nm),
            "attraction_reach": ((), reach, nm),
        },
        {"surface": list(spectra), "side": list(SIDES)},
    )


def cause_exponents(
    scaling: xr.Dataset, spectra: Mapping[str, Spectrum], contact: Contact, tolerance: float
) -> xr.Dataset:
    """Return how the short edge scales where the contact should set it, and where the range should.

    `scaling` is of `edge_scaling`. The closed form gives the short edge for the sphere and area of
    `contact` at every range of it; the tolerance is the relative change of the force that counts.

    By cause, CONTACT where its diameter exceeds that edge and RANGE where it does not:
    ``cause_exponent`` (cause, length) by least squares of ln(edge) against the logarithms of
    LENGTHS, with a constant for each surface and an interval by the jackknife over surfaces, and
    ``cause_edges`` (cause), their number. NaN where too few edges tell the lengths apart.
    """
    small = scaling[["edge", "contact_area"]].sel(side="small", drop=True)
    predicted = [
        [edges(one, replace(contact, rho=rho), tolerance)[0] for rho in small["rho"].values]
        for one in spectra.values()
    ]
    short = xr.DataArray(predicted, {"surface": list(spectra), "rho": small["rho"].values})
    diameter: xr.DataArray = 2 * (small["contact_area"] / np.pi) ** 0.5
    logarithms: xr.DataArray = xr.apply_ufunc(np.log, small["edge"])
    lengths = [small["radius"], small["rho"], small["contact_area"]]
    confidence, values, intervals, counts = scaling.attrs["confidence"], [], [], []
    for taken in (diameter > short, diameter <= short):
        known = logarithms.where(taken).dropna("surface", how="all")
        surfaces = known.sizes["surface"]
        left_out = [
            _exponents(known.drop_isel(surface=one), lengths)
            for one in range(surfaces if surfaces > 2 else 0)
        ]
        values.append(_exponents(known, lengths))
        intervals.append(exponent_interval(values[-1], left_out, confidence))
        counts.append(int(known.notnull().sum()))
    attributes = {"units": "1", "long_name": "exponent of the short edge"}
    axes = ["cause", "length"]
    return xr.Dataset(
        with_interval("cause_exponent", axes, values, intervals, attributes, confidence)
        | {"cause_edges": ("cause", counts)},
        {"cause": [CONTACT, RANGE], "length": LENGTHS},
    )


def _exponents(logarithms: xr.DataArray, lengths: list[xr.DataArray]) -> np.ndarray:
    """Return slopes (3,) of values (surface, ...) against ln(length)/2 within surfaces."""
    parts = []
    roots = [xr.apply_ufunc(np.log, length) / 2 for length in lengths]
    for one in (logarithms, *roots):
        known = one.broadcast_like(logarithms).where(logarithms.notnull())
        parts.append(known - known.mean([dim for dim in known.dims if dim != "surface"]))
    values, *design = (part.transpose(*logarithms.dims).values.ravel() for part in parts)
    kept = np.isfinite(values)
    matrix: np.ndarray = np.stack(design, axis=-1)[kept]
    if len(matrix) <= len(lengths) or np.linalg.matrix_rank(matrix) < len(lengths):
        return np.full(len(lengths), np.nan)
    return np.asarray(np.linalg.lstsq(matrix, values[kept])[0])
