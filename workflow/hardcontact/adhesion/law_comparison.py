"""What the law of attraction decides: work of adhesion, ratios of forces, the critical band.

Every law has one length, its range rho = W/|p(0)|, and is compared in three cases: with the length
and work that come nearest to the forces of Eq. 1 at the published pair, with those that come
nearest to the measured forces, and at an atomic spacing, with the work alone fitted to these. The
first case asks what the paper claims: whether another form would have given similar results.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.all_surfaces import Described
from hardcontact.adhesion.critical_band import POOLED, critical_band
from hardcontact.adhesion.error_map import fit, fit_work
from hardcontact.adhesion.inference import Pair
from hardcontact.adhesion.interaction_laws import (
    EXPONENTIAL,
    LAWS,
    Law,
    implied_over_known,
    pressure,
    work_shares,
)
from hardcontact.adhesion.law_forces import law_forces
from hardcontact.adhesion.sampling import Sampling
from hardcontact.records.dataset import stack
from hardcontact.statistics import jackknife_interval, student_log_samples, with_interval

__all__ = ["CASES", "LENGTHS", "LawChoices", "compare_laws", "stacked_law_forces"]

#: Lengths and works of adhesion at which laws are compared.
CASES = ["equivalent", "fitted", "atomic"]

#: Ranges (nm) of a law that are tried.
LENGTHS = np.geomspace(0.1, 40.0, 201)

#: Gaps (nm) at which the mixtures on the grid of ranges are checked.
GAPS = np.append(0.0, np.geomspace(0.01, 300.0, 200))

NM, ENERGY, ONE, NEWTON = {"units": "nm"}, {"units": "J m-2"}, {"units": "1"}, {"units": "N"}


@dataclass(frozen=True)
class LawChoices:
    """What laws are compared with.

    Attributes
    ----------
    reference_surface : str
        The one that forces are divided by.
    published_pair : Pair
        Range and work of adhesion of Eq. 1.
    spacing : float
        Between atoms where flats touch, in nm, of the case "atomic".
    tolerance : float
        Relative change of the force that ends the critical band.
    sampling : Sampling
        Of all intervals.
    """

    reference_surface: str
    published_pair: Pair
    spacing: float
    tolerance: float
    sampling: Sampling


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
        and case, with intervals: `range_of_law`, `work_of_adhesion`, `fit_error`, `ratio` (surface),
        `scale_ratio` (side, surface, cutoff_wavelength) and `critical_wavelength` (side, group);
        `spacing` and `implied_over_known`. Of all laws but the first, the farthest one:
        `misfit_of_other_laws`, `work_factor_of_other_laws` and `edge_factor_of_other_laws` (side).
    """
    surfaces = forces.surface.values.tolist()
    target = published.mean_force.reindex(surfaces).to_numpy()
    forces_of_range = _means(forces.pull_off_force, choices.sampling)
    ranges = forces.rho.values
    of_laws = [_of_law(law, ranges, forces_of_range, target, surfaces, choices) for law in LAWS]
    bands = [
        _bands(law, fits.range_of_law.values, masters, choices)
        for law, fits in zip(LAWS, of_laws, strict=True)
    ]
    names = pd.Index([law.name for law in LAWS], name="law")
    compared = xr.merge([xr.concat(of_laws, names), xr.concat(bands, names)])
    compared = compared.assign(
        label=forces.label,
        basis=forces.basis,
        law_label=("law", [law.label for law in LAWS]),
        published_ratio=("surface", target / target[surfaces.index(choices.reference_surface)]),
        window_growth=_window_growth(forces, compared),
    )
    return (
        compared.assign(_other_laws(compared, masters, choices))
        .drop_vars(["sampled_error", "sampled_work"])
        .assign_attrs(
            published_range=choices.published_pair.range_of_adhesion,
            published_work=choices.published_pair.work_of_adhesion,
            atomic_spacing=choices.spacing,
            scale_tolerance=choices.tolerance,
            reference_surface=choices.reference_surface,
            confidence=choices.sampling.confidence,
        )
    )


def stacked_law_forces(
    scans: Mapping[tuple[Any, ...], xr.Dataset],
    sides: Mapping[str, Mapping[tuple[Any, ...], xr.Dataset]],
    described: Described,
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return what `compare_laws` takes from the files of single scans.

    Parameters
    ----------
    scans : mapping of tuple to xarray.Dataset
        (surface, scan) -> `law_forces.scan_range_forces`.
    sides : mapping of str to such a mapping
        Side -> (surface, scan) -> `law_forces.filtered_range_forces` of its master.
    described : Described
        Labels and bases.

    Returns
    -------
    forces, masters : xarray.Dataset
        Each scan is one realization of its masters.
    """
    forces = stack(scans, ["surface", "scan"])
    surfaces = [str(surface) for surface in forces.surface.values]
    names = {
        "label": ("surface", [described["labels"][surface] for surface in surfaces]),
        "basis": ("surface", [described["basis"][surface] for surface in surfaces]),
    }
    by_side = {(*key, side): part for side, parts in sides.items() for key, part in parts.items()}
    masters = stack(
        dict(sorted(by_side.items(), key=lambda one: surfaces.index(str(one[0][0])))),
        ["surface", "realization", "side"],
    )
    ends = masters.unfiltered_wavelength.mean("realization")
    return forces.assign(names), masters.assign(unfiltered_wavelength=ends)


def _means(forces: xr.DataArray, sampling: Sampling) -> tuple[np.ndarray, np.ndarray]:
    """Return mean forces (surface, rho) over scans, and samples of them (sample, surface, rho)."""
    scans = forces.transpose("surface", "scan", "rho")
    sampled = [
        student_log_samples(
            sampling.generator("laws", str(surface)),
            scans.sel(surface=surface).dropna("scan").values,
            sampling.samples,
        )
        for surface in scans.surface.values
    ]
    return scans.mean("scan").values, np.stack(sampled, axis=1)


def _of_law(
    law: Law,
    ranges: np.ndarray,
    forces: tuple[np.ndarray, np.ndarray],
    target: np.ndarray,
    surfaces: list[str],
    choices: LawChoices,
) -> xr.Dataset:
    """Return forces, errors and the fits of all cases of one law."""
    rho, work = choices.published_pair
    sampling, base = choices.sampling, surfaces.index(choices.reference_surface)
    fixed = int(np.abs(np.log(LENGTHS / law.range_of_spacing(choices.spacing))).argmin())
    curves, samples = (law_forces(law, LENGTHS, ranges, one) for one in forces)
    of_paper, samples_of_paper = (
        law_forces(EXPONENTIAL, [rho], ranges, one) * work for one in forces
    )
    # The forces of Eq. 1 are those of the same sample.
    cases = {
        "equivalent": (curves / of_paper, samples / samples_of_paper, None),
        "fitted": (curves / target[:, None], samples / target[:, None], None),
        "atomic": (curves / target[:, None], samples / target[:, None], fixed),
    }
    parts = []
    for relative, sampled_relative, place in cases.values():
        at, value = _fitted(relative, place)
        _, drawn = _fitted(sampled_relative, place)
        ratio, ratios = (one[..., at] / one[..., [base], at] for one in (curves, samples))
        variables = sampling.with_interval("ratio", "surface", ratio, ratios, ONE)
        for name, attributes in UNITS.items():
            variables |= sampling.with_interval(name, (), value[name], drawn[name], attributes)
        variables["sampled_error"] = ("sample", drawn["fit_error"], ONE)
        variables["sampled_work"] = ("sample", drawn["work_of_adhesion"], ENERGY)
        parts.append(xr.Dataset(variables))
    errors = [
        fit_work(cases[case][0], np.ones(len(surfaces)))[1] for case in ("equivalent", "fitted")
    ]
    fits = xr.concat(parts, pd.Index(CASES, name="case"))
    length, energy = fits.range_of_law.values, fits.work_of_adhesion.values
    return fits.assign(
        law_force=(("surface", "length"), curves, NEWTON),
        error=(("target", "length"), errors, ONE),
        spacing=("case", law.spacing(length), NM),
        implied_over_known=("case", implied_over_known(law, length, energy), ONE),
        mixture_error=((), _mixture_error(law, ranges), ONE),
    ).assign_coords(surface=surfaces, length=("length", LENGTHS, NM), target=["Eq. 1", "published"])


#: What is fitted to forces, with its units.
UNITS = {"range_of_law": NM, "work_of_adhesion": ENERGY, "fit_error": ONE}


def _fitted(relative: np.ndarray, place: int | None) -> tuple[Any, dict[str, np.ndarray]]:
    """Return the place of the best length of forces over their targets, and what is fitted.

    relative: (..., surface, length). place: that of a given length; None to fit it.
    """
    aim = np.ones(relative.shape[-2])
    if place is None:
        at, work, error = fit(relative, aim)
    else:
        work, error = (one[..., 0] for one in fit_work(relative[..., [place]], aim))
        at = np.full(np.shape(work), place)
    length = np.where(np.isfinite(error), LENGTHS[at], np.nan)
    fitted = {"range_of_law": length, "work_of_adhesion": work, "fit_error": error}
    return at, fitted


def _mixture_error(law: Law, ranges: np.ndarray) -> float:
    """Return the largest relative error of the pressure, of all lengths and gaps."""
    if law.exponential:
        return 0.0
    terms = work_shares(law, LENGTHS, ranges) * LENGTHS[:, None] / ranges
    found = np.exp(-GAPS[:, None] / ranges) @ terms.T
    return float(np.abs(found / pressure(law, GAPS[:, None], LENGTHS) - 1).max())


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


def _bands(law: Law, lengths: np.ndarray, masters: xr.Dataset, choices: LawChoices) -> xr.Dataset:
    """Return ratio curves and critical wavelengths of one law in every case."""
    bands = [
        critical_band(_scales(law, length, masters), choices.tolerance, choices.sampling)
        for length in lengths
    ]
    kept = ["scale_ratio", "critical_wavelength"]
    names = [name for one in kept for name in (one, f"{one}_interval")]
    return xr.concat([band[names] for band in bands], pd.Index(CASES, name="case"))


def _other_laws(compared: xr.Dataset, masters: xr.Dataset, choices: LawChoices) -> dict[str, Any]:
    """Return by how much the farthest of the other laws differs from Eq. 1, where equivalent."""
    case = compared.sel(case="equivalent", law=[law.name for law in LAWS if not law.exponential])
    work = choices.published_pair.work_of_adhesion
    factors = [
        _factor(one / work).max("law").values for one in (case.work_of_adhesion, case.sampled_work)
    ]
    sampling = choices.sampling
    edges = _edge_factors(compared, masters, choices)
    left_out = [
        _edge_factors(compared, masters.drop_isel(realization=n), choices)
        for n in range(masters.sizes["realization"])
    ]
    return {
        **sampling.with_interval(
            "misfit_of_other_laws",
            (),
            case.fit_error.max("law").values,
            case.sampled_error.max("law").values,
            ONE,
        ),
        **sampling.with_interval("work_factor_of_other_laws", (), *factors, ONE),
        **with_interval(
            "edge_factor_of_other_laws",
            "side",
            edges,
            jackknife_interval(edges, left_out, sampling.confidence),
            ONE,
            sampling.confidence,
        ),
    }


def _edge_factors(compared: xr.Dataset, masters: xr.Dataset, choices: LawChoices) -> np.ndarray:
    """Return the largest factor (side,) between pooled edges of other laws and that of Eq. 1."""
    without = replace(choices.sampling, samples=0)
    edges = []
    for law in LAWS:
        length = compared.range_of_law.sel(law=law.name, case="equivalent").item()
        band = critical_band(_scales(law, length, masters), choices.tolerance, without)
        edges.append(band.critical_wavelength.sel(group=POOLED).sel(side=compared.side).values)
    factors: np.ndarray = _factor(np.array(edges[1:]) / edges[0]).max(axis=0)
    return factors


def _factor(ratio: Any) -> Any:
    """Return ratios as factors of at least one."""
    return np.exp(np.abs(np.log(ratio)))
