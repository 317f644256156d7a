"""Range and work of adhesion that the user's own measured forces allow.

Forces F are measured, forces f are computed at 1 J/m²: at every range the work W = F/f(rho) makes
them agree. One surface gives a curve W(rho). Of several surfaces, the region holds the pairs of
range and work that lie within the intervals of all of them at once. Tests scatter log-normally.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.force_curves import on_fine_grid
from hardcontact.inference.error_map import fit
from hardcontact.numbers.statistics import (
    Sampling,
    lognormal_shape,
    percentile_interval,
    with_interval,
)
from hardcontact.own_surfaces.predicted_force import forces_of_scans
from hardcontact.own_surfaces.scan_parts import sampled_deviations
from hardcontact.records.dataset import stack

#: Logarithms of a sampled mean beyond this are as good as infinite.
ENDLESS = 50.0
#: Ranges of adhesion of the curves, from the least to the greatest one computed.
FINE_RANGES = 401

NM, NEWTON, ENERGY, ONE = ({"units": unit} for unit in ("nm", "N", "J m-2", "1"))


class MeasuredTests(NamedTuple):
    """Tests on one surface."""

    mean: float  #: Of the forces in N.
    shape: float  #: Standard deviation of the logarithm of a force; NaN of a single test.
    number: int  #: Of the tests.


def measured_tests(forces: pd.DataFrame) -> MeasuredTests:
    """Return the tests on one surface, from its rows of `config.tables.measured_forces`.

    Of a mean and median the shape of the log-normal that has both, sqrt(2 ln(mean/median)).
    """
    count = int(forces["count"].sum())
    mean = float(np.average(forces["mean"], weights=forces["count"]))
    if count < 2:
        return MeasuredTests(mean, np.nan, count)
    if len(forces) == 1:
        return MeasuredTests(mean, float(lognormal_shape(mean, forces["median"].iloc[0])), count)
    return MeasuredTests(mean, float(np.log(forces["mean"]).std(ddof=1)), count)


def sampled_means(rng: np.random.Generator, tests: MeasuredTests, samples: int) -> np.ndarray:
    """Draw mean forces (samples,) in N of a log-normal of which a few tests are known.

    The generalized pivot of the logarithm of the mean, mu + s²/2, is m - z s*/sqrt(n) + s*²/2 with
    s*² = (n - 1) s²/chi²(n - 1); z is normal, m and s are mean and deviation of the logarithms of n
    tests. Its deviation from m + s²/2 is added to the logarithm of the mean measured. NaN of a
    single test, whose scatter is unknown. Source: Krishnamoorthy and Mathew, J. Stat. Plan.
    Inference 115 (2003) 103.
    """
    if tests.number < 2:
        return np.full(samples, np.nan)
    freedom, variance = tests.number - 1, tests.shape**2
    drawn = variance * freedom / rng.chisquare(freedom, samples)
    normal = rng.standard_normal(samples)
    deviation = (drawn - variance) / 2 - normal * np.sqrt(drawn / tests.number)
    return np.asarray(tests.mean * np.exp(np.clip(deviation, -ENDLESS, ENDLESS)))


class _Curve(NamedTuple):
    """Mean forces of one surface at 1 J/m², and the works of adhesion that measured ones mean."""

    force: np.ndarray  #: (fine rho,) in N.
    works: np.ndarray  #: (sample, computed rho) in J/m², tests and scans resampled.
    tests: MeasuredTests  #: On the surface.
    source: str  #: What the interval comes from, as of `Parts`; "one_test" of a single test.


def fit_measured(
    adhesion: xr.Dataset, forces: pd.DataFrame, sizes: Mapping[str, float], sampling: Sampling
) -> xr.Dataset:
    """Fit range and work of adhesion to measured forces, with the roughness of the scans.

    Forces are at 1 J/m², as in adhesion.nc; those measured are of `config.tables.measured_forces`,
    the sizes of the scans in nm. Means of tests and of scans are sampled.

    Over surface (those with forces) are ``measured_force`` in N with its interval, ``tests``, label
    and ``interval_source``. Over contact_model, surface and rho (a fine grid) is
    ``work_of_adhesion`` in J/m² with its interval. Over contact_model and rho is ``region``, the
    least and greatest work in J/m² that all surfaces allow, NaN where they allow none; its extent
    ``region_range`` (nm) and ``region_work``, NaN where a range at an end of those computed is
    allowed, and ``region_status``, found, open or none. Of several surfaces there is the best fit
    ``best_range``, ``best_work`` and ``best_error``, NaN of one. Of two, ``exact_pairs`` counts the
    pairs that give both forces: where there are some, two unknowns fit two numbers by construction,
    and ``best_error`` is NaN.
    """
    surfaces = [name for name in adhesion.surface.values.tolist() if name in set(forces.surface)]
    tests = [measured_tests(forces[forces.surface == name]) for name in surfaces]
    # Tests and parts of scans, which intervals come from, are the same for all contact models.
    means = [
        sampled_means(sampling.generator("tests", name), of_surface, sampling.samples)
        for name, of_surface in zip(surfaces, tests, strict=True)
    ]
    curves = {
        model: [
            _curve(
                adhesion.sel(contact_model=model, surface=name), test, mean, sizes[name], sampling
            )
            for name, test, mean in zip(surfaces, tests, means, strict=True)
        ]
        for model in adhesion.contact_model.values.tolist()
    }
    models = {
        (model,): _fit(of_model, adhesion.rho.values, sampling.confidence)
        for model, of_model in curves.items()
    }
    of_any_model = next(iter(curves.values()))
    force = [of_surface.mean for of_surface in tests]
    of_tests = sampling.with_interval(
        "measured_force", "surface", force, np.stack(means, axis=1), NEWTON
    ) | {
        "tests": ("surface", [of_surface.number for of_surface in tests], ONE),
        "interval_source": ("surface", [curve.source for curve in of_any_model]),
        "label": adhesion.label.sel(surface=surfaces),
    }
    return (
        stack(models, ["contact_model"])
        .assign_coords(surface=surfaces)
        .assign(of_tests)
        .assign_attrs(
            basis="measured",
            confidence=sampling.confidence,
            sphere_radius=adhesion.attrs["sphere_radius"],
        )
    )


def _fine(rhos: np.ndarray) -> np.ndarray:
    """Return the ranges of the curves in nm, with those computed; a single one stays single."""
    return np.union1d(np.geomspace(rhos[0], rhos[-1], FINE_RANGES if len(rhos) > 1 else 1), rhos)


def _curve(
    adhesion: xr.Dataset, tests: MeasuredTests, means: np.ndarray, size: float, sampling: Sampling
) -> _Curve:
    """Return force and work of adhesion of one surface and contact model over range.

    The means (sample,) are of the tests, in N; the size of the scan is in nm.
    """
    surface, rhos = str(adhesion.surface.values), adhesion.rho.values
    scans = forces_of_scans(adhesion.pull_off_force, size, float(adhesion.attrs["sphere_radius"]))
    deviations = [
        sampled_deviations(sampling.generator("scans", surface), left_out, parts, sampling.samples)
        for left_out, parts in zip(scans.left_out.T, scans.parts, strict=True)
    ]
    sampled = scans.mean * np.exp(np.stack(deviations, axis=1))
    works = means[:, None] / sampled
    source = scans.parts[0].source if tests.number > 1 else "one_test"
    return _Curve(on_fine_grid(scans.mean, rhos, _fine(rhos)), works, tests, source)


def _intervals(works: np.ndarray, rhos: np.ndarray, confidence: float) -> np.ndarray:
    """Return intervals (surface, fine rho, 2) of works (sample, surface, computed rho)."""
    ends = np.moveaxis(percentile_interval(works, confidence), -1, 0)
    return np.moveaxis(on_fine_grid(ends, rhos, _fine(rhos)), 0, -1)


def _fit(curves: list[_Curve], rhos: np.ndarray, confidence: float) -> xr.Dataset:
    """Return what `fit_measured` returns of one contact model.

    The region takes the intervals of n surfaces, independent of each other, at the confidence
    c^(1/n), so that all of them together hold the true pair with the confidence c.
    """
    target = np.array([curve.tests.mean for curve in curves])
    force = np.array([curve.force for curve in curves])
    works = np.stack([curve.works for curve in curves], axis=1)
    fine, joint = _fine(rhos), _intervals(works, rhos, confidence ** (1 / len(curves)))
    region = np.stack([joint[..., 0].max(axis=0), joint[..., 1].min(axis=0)], axis=-1)
    region[~(region[:, 0] < region[:, 1])] = np.nan
    variables: dict[str, Any] = with_interval(
        "work_of_adhesion",
        ("surface", "rho"),
        target[:, None] / force,
        _intervals(works, rhos, confidence),
        ENERGY,
        confidence,
    )
    variables["region"] = (("rho", "bound"), region, ENERGY)
    best = dict.fromkeys(("best_range", "best_work", "best_error"), np.nan) | {"exact_pairs": 0}
    if len(curves) > 1:
        place, work, error = fit(force, target)
        best |= {"best_range": fine[place], "best_work": float(work), "best_error": float(error)}
    if len(curves) == 2:
        above = np.diff(np.log(target[:, None] / force), axis=0)[0] > 0
        best["exact_pairs"] = int(np.count_nonzero(np.diff(above)))
    if best["exact_pairs"]:
        best["best_error"] = np.nan  # of the grid of ranges alone
    attributes = {"best_range": NM, "best_work": ENERGY, "best_error": ONE, "exact_pairs": ONE}
    variables |= {name: ((), value, attributes[name]) for name, value in best.items()}
    return xr.Dataset(variables, {"rho": ("rho", fine, NM)}).assign(_extent(region, fine))


def _extent(region: np.ndarray, fine: np.ndarray) -> dict[str, Any]:
    """Return the extent of a region (rho, bound), and which of its ends are open.

    Where the region reaches a range at the end of those computed, it may go on beyond: the range
    has no limit there, nor has the work.
    """
    allowed = np.flatnonzero(np.isfinite(region).all(axis=-1))
    ranges, works, status = np.full(2, np.nan), np.full(2, np.nan), np.full(2, "none", "<U5")
    if len(allowed):
        ends = allowed[[0, -1]]
        open_ends = ends == [0, len(fine) - 1]
        ranges = np.where(open_ends, np.nan, fine[ends])
        status = np.where(open_ends, "open", "found")
        if not open_ends.any():
            works = np.array([np.nanmin(region[:, 0]), np.nanmax(region[:, 1])])
    return {
        "region_range": ("bound", ranges, NM),
        "region_work": ("bound", works, ENERGY),
        "region_status": ("bound", status),
    }
