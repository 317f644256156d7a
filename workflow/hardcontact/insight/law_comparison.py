"""What the law of attraction decides: work of adhesion, ratios of forces, the critical band.

Every law has one length, its range rho = W/|p(0)|, and is compared in three cases: with the length
and work that come nearest to the forces of Eq. 1 at the published pair, with those that come
nearest to the measured forces, and at an atomic spacing, with the work alone fitted to these. The
first case asks what the paper claims: whether another form would have given similar results.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.all_surfaces import Described, Parts, stacked_forces, with_names
from hardcontact.adhesion.force_curves import mean_forces
from hardcontact.inference.error_map import fit, fit_work
from hardcontact.inference.inference import Pair
from hardcontact.insight.interaction_laws import (
    EXPONENTIAL,
    LAWS,
    Law,
    implied_over_known,
    law_forces,
    pressure,
    range_grid,
    work_shares,
)
from hardcontact.numbers.statistics import Sampling, jackknife_interval, with_interval
from hardcontact.records.dataset import stack
from hardcontact.scales.critical_band import critical_band, last_cutoff

#: Lengths and works of adhesion at which laws are compared.
CASES = ["equivalent", "fitted", "atomic"]
#: Ranges (nm) of a law that are tried: from and to, and the step of their logarithm.
LENGTHS, LENGTH_STEP = (0.1, 40.0), 0.03
#: Gaps (nm) at which the mixtures on the grid of ranges are checked.
GAPS = np.append(0.0, np.geomspace(0.01, 300.0, 200))

#: Numbers, and samples of them.
Sampled = Sequence[np.ndarray]

NM, ENERGY, ONE, NEWTON = {"units": "nm"}, {"units": "J m-2"}, {"units": "1"}, {"units": "N"}
NAMES = pd.Index([law.name for law in LAWS], name="law")
#: What is fitted to forces, with its units.
UNITS = {"range_of_law": NM, "work_of_adhesion": ENERGY, "fit_error": ONE}


def stacked_law_forces(
    scans: Parts, sides: Mapping[str, Parts], described: Described
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return the forces and the masters that `compare_laws` takes, from the files of single scans.

    The scans are of `law_forces.scan_range_forces`, by (surface, scan); the sides have
    `law_forces.filtered_range_forces` of their masters, by (surface, scan). Each scan is one
    realization of its masters.
    """
    forces = stack(scans, ["surface", "scan"])
    masters = {(*key, side): parts[key] for key in scans for side, parts in sides.items()}
    return with_names(forces, described), stacked_forces(masters)


@dataclass(frozen=True)
class LawChoices:
    """What laws are compared with."""

    reference_surface: str  #: The one that forces are divided by.
    published_pair: Pair  #: Range and work of adhesion of Eq. 1.
    spacing: float  #: Between atoms where flats touch, in nm, of the case "atomic".
    tolerance: float  #: Relative change of the force that ends the critical band.
    sampling: Sampling  #: Of all intervals.


def compare_laws(
    forces: xr.Dataset, masters: xr.Dataset, published: pd.DataFrame, choices: LawChoices
) -> xr.Dataset:
    """Return fits, ratios and critical bands of every law, from datasets of `stacked_law_forces`.

    Forces are of exponential laws in N at 1 J/m²; the ranges of masters may be fewer than those of
    scans. The published forces are as from `published.pull_off`.

    Over law: ``law_force`` (surface, length) in N at 1 J/m², ``error`` (target, length) at the best
    work of adhesion, ``mixture_error``, the error of the pressure on the grid of ranges, and
    ``window_growth`` (surface), by which the window of twice the edge raises the force. Over law
    and case, with intervals: ``range_of_law``, ``work_of_adhesion``, ``fit_error``, ``ratio``
    (surface), ``scale_ratio`` (side, surface, cutoff_wavelength) and ``critical_wavelength`` (side,
    group); ``spacing`` and ``implied_over_known``. Over law, of the case "equivalent":
    ``edge_factor`` (side, group), the edges over those of Eq. 1. The attribute ``scans`` is their
    number on each surface.
    """
    sampling, tolerance = choices.sampling, choices.tolerance
    target = published.mean_force.reindex(forces.surface.values.tolist())
    means = mean_forces(forces.pull_off_force, sampling, purpose="laws")
    of_laws = [_of_law(law, forces.rho.values, means, target, choices) for law in LAWS]
    bands = [
        _bands(law, fits.range_of_law.to_series(), masters, tolerance, sampling)
        for law, fits in zip(LAWS, of_laws, strict=True)
    ]
    compared = xr.merge([xr.concat(of_laws, NAMES), xr.concat(bands, NAMES)])
    equivalent = compared.range_of_law.sel(case="equivalent").to_series()
    return compared.assign(
        label=forces.label,
        basis=forces.basis,
        law_label=("law", [law.label for law in LAWS]),
        published_ratio=("surface", (target / target[choices.reference_surface]).to_numpy()),
        window_growth=_window_growth(forces, equivalent),
        **_edge_factors(equivalent, masters, tolerance, sampling),
    ).assign_attrs(
        published_range=choices.published_pair.range_of_adhesion,
        published_work=choices.published_pair.work_of_adhesion,
        atomic_spacing=choices.spacing,
        scale_tolerance=tolerance,
        reference_label=str(forces.label.sel(surface=choices.reference_surface).item()),
        confidence=sampling.confidence,
        scans=forces.sizes["scan"],
    )


def _of_law(
    law: Law, ranges: np.ndarray, means: Sampled, target: pd.Series, choices: LawChoices
) -> xr.Dataset:
    """Return forces, errors and the fits of all cases of one law.

    The means (surface, k) over scans at ranges (k,) in nm, and samples of them, are in N.
    """
    rho, work = choices.published_pair
    grid = range_grid(rho, LENGTH_STEP, *LENGTHS)
    atomic = np.array([law.range_of_spacing(choices.spacing)])
    on_grid, at_spacing = (
        [law_forces(law, lengths, ranges, one) for one in means] for lengths in (grid, atomic)
    )
    # The forces of Eq. 1 are those of the same sample.
    of_paper = [law_forces(EXPONENTIAL, [rho], ranges, one) * work for one in means]
    measured = [target.to_numpy()[:, None]] * 2
    surfaces = target.index.to_list()
    base = surfaces.index(choices.reference_surface)
    cases = [(grid, on_grid, of_paper), (grid, on_grid, measured), (atomic, at_spacing, measured)]
    parts = [_fits(*case, base, choices.sampling) for case in cases]
    fits = xr.concat(parts, pd.Index(CASES, name="case"))
    curves, ones = on_grid[0], np.ones(len(surfaces))
    errors = [fit_work(curves / aim, ones)[1] for aim, _ in (of_paper, measured)]
    found = fits.range_of_law.values, fits.work_of_adhesion.values
    return fits.assign(
        law_force=(("surface", "length"), curves, NEWTON),
        error=(("target", "length"), errors, ONE),
        spacing=("case", law.spacing(found[0]), NM),
        implied_over_known=("case", implied_over_known(law, *found), ONE),
        mixture_error=((), _mixture_error(law, grid, ranges), ONE),
    ).assign_coords(surface=surfaces, length=("length", grid, NM), target=["Eq. 1", "published"])


def _fits(
    lengths: np.ndarray, forces: Sampled, aims: Sampled, base: int, sampling: Sampling
) -> xr.Dataset:
    """Return length, work and error of the best fit of one case, and ratios at this length.

    Of forces (..., surface, n) in N at the lengths (n,) in nm, and of samples of them, those
    (..., surface, 1) are the aims; the base is the place of the reference surface.
    """
    (at, value), (_, drawn) = (
        _fitted(force / aim, lengths) for force, aim in zip(forces, aims, strict=True)
    )
    ratio, ratios = (one[..., at] / one[..., [base], at] for one in forces)
    variables = sampling.with_interval("ratio", "surface", ratio, ratios, ONE)
    for (name, attributes), one, sampled in zip(UNITS.items(), value, drawn, strict=True):
        variables |= sampling.with_interval(name, (), one, sampled, attributes)
    return xr.Dataset(variables)


def _fitted(relative: np.ndarray, lengths: np.ndarray) -> tuple[Any, list[np.ndarray]]:
    """Return the place of the best length of forces (..., surface, length) over aims, and UNITS."""
    at, work, error = fit(relative, np.ones(relative.shape[-2]))
    return at, [np.where(np.isfinite(error), lengths[at], np.nan), work, error]


def _mixture_error(law: Law, lengths: np.ndarray, ranges: np.ndarray) -> float:
    """Return the largest relative error of the pressure, of all lengths and gaps."""
    if law.exponential:
        return 0.0
    terms = work_shares(law, lengths, ranges) * lengths[:, None] / ranges
    found = np.exp(-GAPS[:, None] / ranges) @ terms.T
    return float(np.abs(found / pressure(law, GAPS[:, None], lengths) - 1).max())


def _window_growth(forces: xr.Dataset, lengths: pd.Series) -> xr.DataArray:
    """Return by how much the second half of the window raises the forces (law, surface)."""
    means = forces.mean("scan").transpose("surface", "rho")
    growth = []
    for law in LAWS:
        whole, half = (
            law_forces(law, [lengths[law.name]], forces.rho.values, means[name].values)[:, 0]
            for name in ("pull_off_force", "half_window_pull_off_force")
        )
        growth.append(whole / half - 1)
    return xr.DataArray(growth, {"law": NAMES, "surface": forces.surface}, attrs=ONE)


def _bands(
    law: Law, lengths: pd.Series, masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return ratios and edges of `critical_band` with their intervals, at lengths (nm) by case."""
    names = ("scale_ratio", "critical_wavelength")
    kept = [name + end for name in names for end in ("", "_interval")]
    bands = [critical_band(_scales(law, one, masters), tolerance, sampling) for one in lengths]
    return xr.concat([band[kept] for band in bands], lengths.index)


def _scales(law: Law, length: float, masters: xr.Dataset) -> xr.Dataset:
    """Return what `critical_band` takes, of one law at one length."""
    filtered, unfiltered = (
        xr.apply_ufunc(
            lambda one: law_forces(law, [length], masters.rho.values, one)[..., 0],
            masters[name],
            input_core_dims=[["rho"]],
        )
        for name in ("pull_off_force", "unfiltered_pull_off_force")
    )
    return xr.Dataset(
        {"ratio": filtered / unfiltered, "unfiltered_wavelength": masters.unfiltered_wavelength}
    )


def _edge_factors(
    lengths: pd.Series, masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> dict[str, Any]:
    """Return ``edge_factor`` (law, side, group), edges over those of Eq. 1, with its interval.

    The lengths are the ranges in nm by law. The interval is by the jackknife over realizations. A
    curve that never leaves counts as its last cutoff.
    """

    def factors(part: xr.Dataset) -> np.ndarray:
        edges = []
        for law in LAWS:
            scales = _scales(law, lengths[law.name], part)
            band = critical_band(scales, tolerance, replace(sampling, samples=0))
            sides = scales.side.values.tolist()
            last = [last_cutoff(scales.ratio.sel(side=side), side) for side in sides]
            edges.append(band.critical_wavelength.fillna(xr.DataArray(last, {"side": sides})))
        ratio: xr.DataArray = xr.concat(edges, NAMES) / edges[0]
        return ratio.transpose("law", "side", "group").values

    count = masters.sizes["realization"]
    left_out = [masters.drop_isel(realization=n) for n in range(count if count > 1 else 0)]
    value, confidence = factors(masters), sampling.confidence
    interval = jackknife_interval(value, list(map(factors, left_out)), confidence)
    attributes = {"units": "1", "long_name": "edge of the band over that of Eq. 1"}
    dimensions = ["law", "side", "group"]
    return with_interval("edge_factor", dimensions, value, interval, attributes, confidence)
