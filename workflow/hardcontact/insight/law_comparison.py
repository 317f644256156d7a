"""What the law of attraction decides: work of adhesion, ratios of forces, the critical band.

Every law has one length, its range rho = W/|p(0)|, and is compared in three cases: with the length
and work that come nearest to the forces of Eq. 1 at the published pair, with those that come
nearest to the measured forces, and at an atomic spacing, with the work alone fitted to these. The
first case asks what the paper claims: whether another form would have given similar results.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.all_surfaces import Described, with_names
from hardcontact.adhesion.force_curves import means_over_scans
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
from hardcontact.scales.stacked_masters import stacked_forces

#: Lengths and works of adhesion at which laws are compared.
CASES = ["equivalent", "fitted", "atomic"]

#: Ranges (nm) of a law that are tried: from and to, and the step of their logarithm.
LENGTHS, LENGTH_STEP = (0.1, 40.0), 0.03

#: Gaps (nm) at which the mixtures on the grid of ranges are checked.
GAPS = np.append(0.0, np.geomspace(0.01, 300.0, 200))

NM, ENERGY, ONE, NEWTON = {"units": "nm"}, {"units": "J m-2"}, {"units": "1"}, {"units": "N"}

#: What is fitted to forces, with its units.
UNITS = {"range_of_law": NM, "work_of_adhesion": ENERGY, "fit_error": ONE}


def stacked_law_forces(
    scans: Mapping[tuple[Any, ...], xr.Dataset],
    sides: Mapping[str, Mapping[tuple[Any, ...], xr.Dataset]],
    described: Described,
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return the forces and the masters that `compare_laws` takes, from the files of single scans.

    The scans are of `law_forces.scan_range_forces`, by (surface, scan); the sides have
    `law_forces.filtered_range_forces` of their masters, by (surface, scan). Each scan is one
    realization of its masters.
    """
    forces = stack(scans, ["surface", "scan"])
    masters = {(*key, side): parts[key] for key in scans for side, parts in sides.items()}
    return with_names(forces, described), stacked_forces(masters)


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


def bands_of_law(
    law: Law, lengths: pd.Series, masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return ratio curves and critical wavelengths of one law, with intervals, by case.

    `lengths` are its ranges in nm by case; `masters` are as from `stacked_law_forces`. The
    variables are `scale_ratio` and `critical_wavelength` of `critical_band`.
    """
    bands = [
        critical_band(_scales(law, length, masters), tolerance, sampling) for length in lengths
    ]
    kept = ["scale_ratio", "critical_wavelength"]
    names = [name for one in kept for name in (one, f"{one}_interval")]
    return xr.concat([band[names] for band in bands], lengths.index)


def edge_factors(
    lengths: Mapping[str, float], masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> dict[str, Any]:
    """Return ``edge_factor`` (law, side, group), edges over those of Eq. 1, with its interval.

    `lengths` is the range in nm of each law, by its name; `masters` are as from
    `stacked_law_forces`. The interval is by the jackknife over realizations. A curve that never
    leaves counts as its last cutoff.
    """
    left_out = [masters.drop_isel(realization=n) for n in range(masters.sizes["realization"])]
    factors, *without = (
        _edge_factors(lengths, part, tolerance, sampling)
        for part in (masters, *(left_out if len(left_out) > 1 else []))
    )
    interval = jackknife_interval(
        factors, np.reshape(without, (-1, *factors.shape)), sampling.confidence
    )
    return with_interval(
        "edge_factor",
        [str(dimension) for dimension in factors.dims],
        factors.values,
        interval,
        {"units": "1", "long_name": "edge of the band over that of Eq. 1"},
        sampling.confidence,
    )


def _edge_factors(
    lengths: Mapping[str, float], masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.DataArray:
    """Return the factors (law, side, group) of some realizations."""
    edges = []
    for law in LAWS:
        scales = _scales(law, lengths[law.name], masters)
        band = critical_band(scales, tolerance, replace(sampling, samples=0))
        edges.append(band.critical_wavelength.fillna(_last_cutoffs(scales)))
    stacked = xr.concat(edges, pd.Index([law.name for law in LAWS], name="law"))
    ratio: xr.DataArray = stacked / edges[0]
    return ratio.transpose("law", "side", "group")


def _last_cutoffs(scales: xr.Dataset) -> xr.DataArray:
    """Return the cutoff (side,) farthest from no filter."""
    sides = scales.side.values.tolist()
    last = [last_cutoff(scales.ratio.sel(side=side), side) for side in sides]
    return xr.DataArray(last, {"side": sides})


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
    """Return fits, ratios and critical bands of every law.

    Parameters
    ----------
    forces : xarray.Dataset
        `pull_off_force` and `half_window_pull_off_force` (surface, scan, rho) in N at 1 J/m², of
        exponential laws, as from `law_forces.scan_range_forces`; `label` and `basis` (surface).
    masters : xarray.Dataset
        `pull_off_force` (surface, realization, side, cutoff_wavelength, rho), NaN at cutoffs of the
        other side, `unfiltered_pull_off_force` (surface, realization, side, rho) in N and
        `unfiltered_wavelength` (surface, side) in nm. Its ranges may be fewer.
    published : pandas.DataFrame
        Measured forces, as from `published.pull_off`.
    choices : LawChoices
        Reference, pair, spacing, tolerance, sampling.

    Returns
    -------
    xarray.Dataset
        Over law: `law_force` (surface, length) in N at 1 J/m², `error` (target, length) at the best
        work of adhesion, `mixture_error`, the error of the pressure on the grid of ranges, and
        `window_growth` (surface), by which the window of twice the edge raises the force. Over law
        and case, with intervals: `range_of_law`, `work_of_adhesion`, `fit_error`, `ratio`
        (surface), `scale_ratio` (side, surface, cutoff_wavelength) and `critical_wavelength` (side,
        group); `spacing` and `implied_over_known`. Over law, of the case "equivalent":
        `edge_factor` (side, group), the edges over those of Eq. 1. The attribute `scans` is their
        number on each surface.
    """
    surfaces = forces.surface.values.tolist()
    target = published.mean_force.reindex(surfaces)
    scans = forces.pull_off_force.transpose("surface", "scan", "rho")
    of_ranges = _Forces(forces.rho.values, *means_over_scans(scans, "laws", choices.sampling))
    of_laws = [_of_law(law, of_ranges, target, choices) for law in LAWS]
    bands = [
        bands_of_law(
            law, fits.range_of_law.to_series(), masters, choices.tolerance, choices.sampling
        )
        for law, fits in zip(LAWS, of_laws, strict=True)
    ]
    names = pd.Index([law.name for law in LAWS], name="law")
    compared = xr.merge([xr.concat(of_laws, names), xr.concat(bands, names)])
    compared = compared.assign(
        label=forces.label,
        basis=forces.basis,
        law_label=("law", [law.label for law in LAWS]),
        published_ratio=("surface", (target / target[choices.reference_surface]).to_numpy()),
        window_growth=_window_growth(forces, compared),
    )
    equivalent = compared.range_of_law.sel(case="equivalent").to_series().to_dict()
    return compared.assign(
        edge_factors(equivalent, masters, choices.tolerance, choices.sampling)
    ).assign_attrs(
        published_range=choices.published_pair.range_of_adhesion,
        published_work=choices.published_pair.work_of_adhesion,
        atomic_spacing=choices.spacing,
        scale_tolerance=choices.tolerance,
        reference_label=str(forces.label.sel(surface=choices.reference_surface).item()),
        confidence=choices.sampling.confidence,
        scans=forces.sizes["scan"],
    )


class _Forces(NamedTuple):
    """Ranges (k,) in nm, mean forces (surface, k) over scans and samples of them (..., k) in N."""

    ranges: np.ndarray
    means: np.ndarray
    sampled: np.ndarray


def _of_law(law: Law, forces: _Forces, target: pd.Series, choices: LawChoices) -> xr.Dataset:
    """Return forces, errors and the fits of all cases of one law."""
    rho, work = choices.published_pair
    lengths = range_grid(rho, LENGTH_STEP, *LENGTHS)
    atomic = np.array([law.range_of_spacing(choices.spacing)])
    measured = target.to_numpy()[:, None]
    # The forces of Eq. 1 are those of the same sample.
    of_paper, sampled_of_paper = (
        law_forces(EXPONENTIAL, [rho], forces.ranges, one) * work
        for one in (forces.means, forces.sampled)
    )
    cases = {
        "equivalent": (lengths, of_paper, sampled_of_paper),
        "fitted": (lengths, measured, measured),
        "atomic": (atomic, measured, measured),
    }
    base = target.index.to_list().index(choices.reference_surface)
    parts = [_fits(law, forces, case, base, choices.sampling) for case in cases.values()]
    fits = xr.concat(parts, pd.Index(CASES, name="case"))
    curves = law_forces(law, lengths, forces.ranges, forces.means)
    errors = [fit_work(curves / aim, np.ones(len(aim)))[1] for aim in (of_paper, measured)]
    found = fits.range_of_law.values, fits.work_of_adhesion.values
    return fits.assign(
        law_force=(("surface", "length"), curves, NEWTON),
        error=(("target", "length"), errors, ONE),
        spacing=("case", law.spacing(found[0]), NM),
        implied_over_known=("case", implied_over_known(law, *found), ONE),
        mixture_error=((), _mixture_error(law, lengths, forces.ranges), ONE),
    ).assign_coords(
        surface=target.index.to_list(),
        length=("length", lengths, NM),
        target=["Eq. 1", "published"],
    )


def _fits(
    law: Law,
    forces: _Forces,
    case: tuple[np.ndarray, np.ndarray, np.ndarray],
    base: int,
    sampling: Sampling,
) -> xr.Dataset:
    """Return length, work and error of the best fit of one case, and ratios at this length.

    case: the lengths (n,) tried in nm, forces (surface, 1) in N aimed at, and samples of them.
    """
    lengths, aim, sampled_aim = case
    curves, samples = (
        law_forces(law, lengths, forces.ranges, one) for one in (forces.means, forces.sampled)
    )
    at, value = _fitted(curves / aim, lengths)
    _, drawn = _fitted(samples / sampled_aim, lengths)
    ratio, ratios = (one[..., at] / one[..., [base], at] for one in (curves, samples))
    variables = sampling.with_interval("ratio", "surface", ratio, ratios, ONE)
    for name, attributes in UNITS.items():
        variables |= sampling.with_interval(name, (), value[name], drawn[name], attributes)
    return xr.Dataset(variables)


def _fitted(relative: np.ndarray, lengths: np.ndarray) -> tuple[Any, dict[str, np.ndarray]]:
    """Return the place of the best length of forces (..., surface, length) over aims, and fits."""
    at, work, error = fit(relative, np.ones(relative.shape[-2]))
    length = np.where(np.isfinite(error), lengths[at], np.nan)
    return at, {"range_of_law": length, "work_of_adhesion": work, "fit_error": error}


def _mixture_error(law: Law, lengths: np.ndarray, ranges: np.ndarray) -> float:
    """Return the largest relative error of the pressure, of all lengths and gaps."""
    if law.exponential:
        return 0.0
    terms = work_shares(law, lengths, ranges) * lengths[:, None] / ranges
    found = np.exp(-GAPS[:, None] / ranges) @ terms.T
    return float(np.abs(found / pressure(law, GAPS[:, None], lengths) - 1).max())


def _window_growth(forces: xr.Dataset, compared: xr.Dataset) -> xr.DataArray:
    """Return by how much the second half of the window raises the forces (law, surface)."""
    means = forces.mean("scan").transpose("surface", "rho")
    growth = []
    for law in LAWS:
        at = [compared.range_of_law.sel(law=law.name, case="equivalent").item()]
        whole, half = (
            law_forces(law, at, forces.rho.values, means[name].values)[:, 0]
            for name in ("pull_off_force", "half_window_pull_off_force")
        )
        growth.append(whole / half - 1)
    return xr.DataArray(growth, {"law": compared.law, "surface": forces.surface}, attrs=ONE)
