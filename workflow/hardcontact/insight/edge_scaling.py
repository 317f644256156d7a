"""How both edges of the critical band scale with R, rho and the contact area, and what sets them.

An edge that belongs to the surface has the exponents 0 against sqrt(R), sqrt(rho) and sqrt(F/H).
The short edge has 1 against sqrt(F/H) if the contact sets it, and 2/H against sqrt(rho), H the
Hurst exponent, if the range does. One exponent for all combinations hides a crossover: local ones
are those between neighbours of the grid. They are those of computed edges and of the formulas
(`edge_formulas`), which say where the contact sets the short edge and where the range does: on
waves that the contact flattens, t < 0, or not. An open edge is a bound, the last cutoff, and so is
an exponent from or to it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.adhesion.all_surfaces import Described, Parts, stacked_forces, with_names
from hardcontact.insight.closed_form import Contact, closed_form
from hardcontact.insight.edge_formulas import formula_edges
from hardcontact.numbers.statistics import (
    Sampling,
    bounds,
    jackknife_interval,
    percentile_interval,
    with_interval,
)
from hardcontact.scales.critical_band import POOLED, critical_band, last_cutoff
from hardcontact.surfaces.spectrum import Floats, Spectrum, all_scales_moments, roll_off
from hardcontact.surfaces.synthesis import SIDES

#: What an edge may follow: sqrt(R), sqrt(rho) and sqrt(F/H), by the axis of the grid.
LENGTHS = {"radius": "radius", "rho": "rho", "contact": "area"}
#: What the interval of an exponent says of an edge and a length: see `dependence`.
PROPORTIONAL, INDEPENDENT, PARTLY = "proportional", "independent", "partly"
STEEPER, FALLING, UNDECIDED = "steeper", "falling", "undecided"
DEPENDENCE = [PROPORTIONAL, PARTLY, INDEPENDENT, STEEPER, FALLING, UNDECIDED]

#: What sets the short edge by the formulas.
CONTACT, RANGE = "contact", "range"
#: Where local exponents come from, and edges that designed surfaces are held to.
COMPUTED, FORMULA, CLOSED_FORM = "computed", "formula", "closed form"
#: Share of the local exponents between the ends of a `cause_exponent`.
MIDDLE = 0.5

COMBINATION = ["radius", "area", "rho"]


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
    area, rho) is in nm with its interval over realizations, NaN where it is open; ``edge_bound``
    (side) the last cutoff, beyond which such an edge lies; ``exponent`` (side, surface, length) by
    least squares of ln(edge) against the logarithms of LENGTHS, of the edges that are there, with
    intervals by the jackknife over realizations; ``dependence`` likewise; the variables of the
    surfaces, and ``reach`` (radius, rho), sqrt(2 R rho) in nm.
    """
    reach = (2 * scaling["radius"] * scaling["rho"]) ** 0.5
    found = _edges(scaling, tolerance, sampling)
    last = [last_cutoff(scaling["ratio"].sel(side=side), side) for side in found["side"].values]
    unsampled, count = replace(sampling, samples=0), scaling.sizes["realization"]
    left_out = [
        _fits(scaling, _edges(scaling.drop_isel(realization=one), tolerance, unsampled)["edge"])
        for one in range(count if count > 2 else 0)
    ]
    exponent, confidence = _fits(scaling, found["edge"]), sampling.confidence
    interval = exponent_interval(exponent.values, [one.values for one in left_out], confidence)
    attributes = {"units": "1", "long_name": "exponent of the edge of the band"}
    dims = [str(dim) for dim in exponent.dims]
    fits = xr.Dataset(
        with_interval("exponent", dims, exponent.values, interval, attributes, confidence)
    )
    low, high = bounds(fits, "exponent")
    fits = fits.assign_coords(length=list(LENGTHS)).assign(
        dependence=(low.dims, dependence(low, high)),
        edge_bound=("side", last, {"units": "nm"}),
        reach=reach.assign_attrs(units="nm"),
    )
    kept = scaling[["rms_height", "roll_off", "contact_area", "label", "basis"]]
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


def _fits(scaling: xr.Dataset, edge: xr.DataArray) -> xr.DataArray:
    """Return exponents (side, surface, length) of every side and surface."""
    logarithms = [np.log(scaling[name]) / 2 for name in ("radius", "rho", "contact_area")]
    exponent: xr.DataArray = xr.apply_ufunc(
        _fit,
        np.log(edge),
        *logarithms,
        input_core_dims=[COMBINATION, ["radius"], ["rho"], ["area"]],
        output_core_dims=[["length"]],
        vectorize=True,
    )
    return exponent.transpose("side", "surface", "length")


def _fit(edge: Floats, radius: Floats, rho: Floats, contact: Floats) -> Floats:
    """Return exponents (3,), NaN where the edges do not tell the lengths apart.

    edge: logarithms (radius, area, rho), NaN where open; others are logarithms of square roots.
    """
    lengths = np.broadcast_arrays(radius[:, None, None], rho, contact[:, None])
    known = np.isfinite(edge)
    design = np.stack([np.ones(known.sum()), *(length[known] for length in lengths)], axis=-1)
    if len(design) <= len(LENGTHS) + 1 or np.linalg.matrix_rank(design) <= len(LENGTHS):
        return np.full(len(LENGTHS), np.nan)
    return np.asarray(np.linalg.lstsq(design, edge[known])[0][1:])


def formula_scaling(
    scaling: xr.Dataset, spectra: Mapping[str, Spectrum], contact: Contact
) -> xr.Dataset:
    """Return what the formulas say of every combination, beside `edge_scaling`.

    ``formula_edge`` as ``edge``, in nm; ``level`` (surface, radius, area, rho), t on the waves
    shorter than the short one; ``local_exponent`` (origin, length, side, surface, radius, area,
    rho), from the next lower value of the length to that of the combination, with ``local_bound``
    (length, side, ...) of computed ones: 1 where they are at least that, -1 where at most. Over
    (origin, cause, length) ``cause_exponent``, their median, with an interval that holds MIDDLE,
    of short edges between combinations of one cause; ``cause_steps`` and ``cause_bounds`` (cause,
    length), their number and that of bounds among them. Over surface, at the given contact,
    ``over_range``, ``approach_level`` and ``contact_over_rolloff`` place it among the regimes.
    """
    grid = xr.broadcast(scaling["radius"], scaling["area"], scaling["rho"])
    cases = list(zip(*(axis.values.ravel() for axis in grid), strict=True))
    found = [
        formula_edges(one, Contact(radius, rho, contact.work, area), scaling.attrs["tolerance"])
        for one in spectra.values()
        for radius, area, rho in cases
    ]
    shape = (len(spectra), *grid[0].shape, 3)
    short, long, level = np.moveaxis(np.reshape(found, shape), -1, 0)
    axes, coordinates = ["surface", *COMBINATION], {"surface": list(spectra), **grid[0].coords}
    formula = xr.DataArray([short, long], {"side": list(SIDES), **coordinates}, ["side", *axes])
    levels = xr.DataArray(level, coordinates, axes)
    exponents, bound = _local_exponents(scaling, formula)
    one = {"units": "1"}
    return (
        xr.Dataset(
            {
                "formula_edge": formula.assign_attrs(units="nm"),
                "level": levels.assign_attrs(one),
                "local_exponent": exponents.drop_attrs().assign_attrs(one),
                "local_bound": bound.drop_attrs().astype("int8"),
            }
            | _of_causes(exponents, bound, levels),
        )
        .merge(among_regimes(spectra, contact))
        .assign_coords(cause=[CONTACT, RANGE])
    )


def among_regimes(spectra: Mapping[str, Spectrum], contact: Contact) -> xr.Dataset:
    """Return where surfaces with these spectra lie on the map of the regimes, over surface.

    ``over_range`` is sigma/rho, ``approach_level`` m/sigma of the closed form, NaN where the sphere
    follows all waves, ``contact_over_rolloff`` the root of the contact area over the roll-off.
    """
    forms = [closed_form(one, contact) for one in spectra.values()]
    height = np.array([one.rms_height for one in forms])
    approach = np.array([one.closest_approach for one in forms])
    places = {
        "over_range": height / contact.rho,
        "approach_level": approach / np.where(height > 0, height, np.nan),
        "contact_over_rolloff": contact.area**0.5 / np.array([*map(roll_off, spectra.values())]),
    }
    return xr.Dataset(
        {name: ("surface", values, {"units": "1"}) for name, values in places.items()},
        {"surface": list(spectra)},
    )


def _local_exponents(
    scaling: xr.Dataset, formula: xr.DataArray
) -> tuple[xr.DataArray, xr.DataArray]:
    """Return local exponents of computed edges and of the formula, and which of them are bounds."""
    opened, side = scaling["edge"].isnull(), scaling["side"]
    edges = xr.concat([scaling["edge"].fillna(scaling["edge_bound"]), formula], "origin")
    logarithms: xr.DataArray = xr.apply_ufunc(np.log, edges)
    # An open short edge lies above the last cutoff, an open long one below it.
    beyond = opened * side.copy(data=np.where(side == "small", 1, -1))
    steps, bound = [], []
    for axis, name in zip(LENGTHS.values(), ("radius", "rho", "contact_area"), strict=True):
        length: xr.DataArray = xr.apply_ufunc(np.log, scaling[name])
        step = 2 * logarithms.diff(axis) / length.diff(axis)
        nothing = opened & opened.shift({axis: 1}, fill_value=False)
        steps.append(xr.concat([step[0].where(~nothing), step[1]], "origin"))
        bound.append(beyond.diff(axis))
    names = pd.Index(list(LENGTHS), name="length")
    exponents: xr.DataArray = xr.concat(steps, names, join="outer")
    exponents = exponents.assign_coords(origin=[COMPUTED, FORMULA])
    bounded: xr.DataArray = xr.concat(bound, names, join="outer", fill_value=0)
    return exponents.reindex_like(formula), bounded.reindex_like(formula, fill_value=0)


def _of_causes(exponents: xr.DataArray, bound: xr.DataArray, level: xr.DataArray) -> dict[str, Any]:
    """Return medians of local exponents of the short edge where one cause sets both its ends."""
    before: xr.DataArray = xr.concat(
        [level.shift({axis: 1}) for axis in LENGTHS.values()], exponents["length"]
    )
    causes = xr.concat([(level < 0) & (before < 0), (level > 0) & (before > 0)], "cause")
    short = exponents.sel(side="small", drop=True).where(causes)
    axes, dims = ["surface", *COMBINATION], ("origin", "cause", "length")
    samples = short.transpose(*axes, *dims).values
    samples = samples.reshape(-1, *samples.shape[len(axes) :])
    middle, interval = (percentile_interval(samples, share) for share in (0.0, MIDDLE))
    known = short.sel(origin=COMPUTED).notnull()
    bounded = known & (bound.sel(side="small", drop=True) != 0)
    attributes = {"units": "1", "long_name": "local exponents of the short edge"}
    return with_interval("cause_exponent", dims, middle[..., 0], interval, attributes, MIDDLE) | {
        "cause_steps": known.sum(axes).drop_attrs().assign_attrs(units="1"),
        "cause_bounds": bounded.sum(axes).drop_attrs().assign_attrs(units="1"),
    }


def designed_edges(computed: pd.DataFrame, formulas: pd.DataFrame) -> xr.Dataset:
    """Return how far edges of designed surfaces are off, and where all lie among the regimes.

    The tables are prediction.csv and edges.csv of resources/validation. Over designed (surfaces):
    ``designed_over_range``, ``designed_level``, ``designed_contact_over_rolloff``, and
    ``held_back``, 0 of published spectra, which have no computed edge; ``designed_error`` (origin,
    side, designed), computed edges over FORMULA and CLOSED_FORM; ``designed_bound`` (side,
    designed), 1 or -1 where that is at least or at most it.
    """
    table = formulas.astype({"surface": str}).set_index("surface").rename_axis("designed")
    known = computed.astype({"surface": str}).set_index("surface").reindex(table.index)
    edges, signs = ["short_edge", "long_edge"], {"at least": 1, "at most": -1}
    errors = [
        [known[name] / others[column] for name, column in zip(edges, columns, strict=True)]
        for others, columns in ((table, edges), (known, [f"predicted_{name}" for name in edges]))
    ]
    bound = [known[f"{name}_is"].map(signs).fillna(0) for name in edges]
    placed = table.drop(columns=edges).add_prefix("designed_").to_xarray()
    one = {"units": "1"}
    return placed.map(lambda values: values.assign_attrs(one)).assign(
        held_back=("designed", known["held_back"].fillna(0).astype("int8")),
        designed_error=(("prediction", "side", "designed"), errors, one),
        designed_bound=(("side", "designed"), np.array(bound, "int8")),
        prediction=[FORMULA, CLOSED_FORM],
        side=list(SIDES),
    )
