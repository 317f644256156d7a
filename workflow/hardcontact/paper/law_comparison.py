"""Laws of attraction compared: work of adhesion, ratios of forces, the critical band.

Every law has one length, its range rho = W/|p(0)|. It is compared in three cases. In the first
case length and work are fitted to the forces of Eq. 1 at the published pair, in the second case to
the measured forces. In the third case the length follows from an atomic spacing, and only the work
is fitted to the measured forces. The first case tests a claim of the paper: another law would have
given similar results.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NM
from hardcontact.contact.force_curves import mean_forces
from hardcontact.inference.edges import edges_of_realizations
from hardcontact.inference.error_map import fit_range_and_work, fit_work
from hardcontact.inference.published_fit import Pair
from hardcontact.theory.interaction_laws import (
    EXPONENTIAL,
    LAWS,
    Law,
    law_forces,
    range_grid,
    strength_over_known,
)

#: Lengths and works of adhesion at which laws are compared.
CASES = ["equivalent", "fitted", "atomic"]
#: Smallest and largest range (nm) of a law in fits, and the step of their logarithm.
LENGTH_LIMITS = (0.1, 40.0)
LENGTH_STEP = 0.03

#: Means over all scans, and samples of these means.
MeanAndSamples = Sequence[np.ndarray]


class _Targets(NamedTuple):
    """Forces to which laws are fitted, for all scans and for samples of them."""

    lengths: np.ndarray  #: (n,) ranges of a law in fits, in nm.
    exponential: MeanAndSamples  #: (..., surface, 1) forces of Eq. 1 at the published pair, in N.
    measured: MeanAndSamples  #: (surface, 1) measured forces, in N.
    exponential_errors: MeanAndSamples  #: (...) of the best fits of Eq. 1 to the measured forces.


class _Fit(NamedTuple):
    """The best fit (...) of a law."""

    position: np.ndarray  #: Index of the best length.
    length: np.ndarray  #: Best length in nm.
    work: np.ndarray  #: Work of adhesion in J/m².
    error: np.ndarray  #: Mean relative error.


def compare_laws(
    forces: xr.Dataset,
    masters: xr.Dataset,
    published: pd.DataFrame,
    *,
    pair: Pair,
    spacing: float,
    reference_surface: str,
    tolerance: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Return fits, ratios of forces and critical bands of every law.

    forces: ``pull_off_force`` (surface, scan, rho) of exponential laws, in N at 1 J/m², and the
        labels of the surfaces.
    masters: `stacked_forces` of filtered masters at the same or fewer ranges.
    published: from `published.pull_off`.
    pair: published range and work of adhesion of Eq. 1.
    spacing: distance in nm between atoms of flats that touch, in the case "atomic".
    reference_surface: surface to which force ratios are taken.
    tolerance: relative change of the force that defines an edge.
    sampling: random numbers and confidence of all intervals.
    Returns by law: ``best_error_by_range`` (target, rho) at the best work of adhesion. By law and
        range choice, with intervals: ``range_of_law`` (nm), ``work_of_adhesion`` (J/m²),
        ``fit_error``, ``force_ratio`` (surface) and ``edge`` (side, group; nm);
        ``strength_over_known`` from the function of this name. By law: ``error_over_exponential``,
        the error of the best fit to the published forces relative to the best fit of Eq. 1, with an
        interval from common samples.
    """
    target = published.mean_force.reindex(forces.surface.values.tolist())
    ratio = target / target[reference_surface]
    means = mean_forces(forces.pull_off_force, sampling, purpose="laws")
    reference_index = target.index.to_list().index(reference_surface)
    targets = _law_targets(forces.rho.values, means, target.to_numpy(), pair)
    law_datasets = []
    for law in LAWS:
        fits = _fit_law(
            law,
            forces.rho.values,
            means,
            targets,
            spacing=spacing,
            reference_index=reference_index,
            sampling=sampling,
        ).assign_coords(surface=target.index.to_list())
        lengths = fits.range_of_law.to_series()
        bands = [_band(law, length, masters, tolerance, sampling) for length in lengths]
        law_datasets.append(fits.merge(xr.concat(bands, lengths.index)))
    laws: xr.Dataset = xr.concat(law_datasets, pd.Index([law.name for law in LAWS], name="law"))
    return laws.assign(
        label=forces.label,
        basis=forces.basis,
        law_label=("law", [law.label for law in LAWS]),
        published_ratio=("surface", ratio.to_numpy(), DIMENSIONLESS),
    ).assign_attrs(
        atomic_spacing=spacing,
        scale_tolerance=tolerance,
        reference_label=str(forces.label.sel(surface=reference_surface).item()),
        confidence=sampling.confidence,
        scans=forces.sizes["scan"],
    )


def _law_targets(
    ranges: np.ndarray, means: MeanAndSamples, measured: np.ndarray, pair: Pair
) -> _Targets:
    """Return the forces to which laws are fitted: measured forces (surface,) and those of Eq. 1.

    The means (..., surface, k) over scans at ranges (k,) in nm are in N. The forces of Eq. 1 come
    from the same samples.
    """
    rho, work = pair
    lengths = range_grid(rho, LENGTH_STEP, *LENGTH_LIMITS)
    column = measured[:, None]
    errors = [
        _best_fit(law_forces(EXPONENTIAL, lengths, ranges, mean) / column, lengths).error
        for mean in means
    ]
    exponential = [law_forces(EXPONENTIAL, [rho], ranges, mean) * work for mean in means]
    return _Targets(lengths, exponential, [column] * len(means), errors)


def _fit_law(
    law: Law,
    ranges: np.ndarray,
    means: MeanAndSamples,
    targets: _Targets,
    *,
    spacing: float,
    reference_index: int,
    sampling: Sampling,
) -> xr.Dataset:
    """Return the fits of all cases of one law, and its error at every length.

    The means (..., surface, k) over scans at ranges (k,) in nm are in N. `reference_index` is the
    index of the reference surface.
    """
    lengths = targets.lengths
    measured = targets.measured
    atomic = np.array([spacing / float(law.spacing(1.0))])
    curves = [law_forces(law, lengths, ranges, mean) for mean in means]
    atomic_forces = [law_forces(law, atomic, ranges, mean) for mean in means]
    error_ratios = [
        _best_fit(curve / forces, lengths).error / error
        for curve, forces, error in zip(curves, measured, targets.exponential_errors, strict=True)
    ]
    fits = xr.concat(
        [
            _fit_case(lengths, curves, targets.exponential, reference_index, sampling),
            _fit_case(lengths, curves, measured, reference_index, sampling),
            _fit_case(atomic, atomic_forces, measured, reference_index, sampling),
        ],
        pd.Index(CASES, name="range_choice"),
    )
    forces_by_target = {"Eq. 1": targets.exponential[0], "published": measured[0]}
    errors = [
        fit_work(curves[0] / forces, np.ones(len(forces)))[1]
        for forces in forces_by_target.values()
    ]
    implied = strength_over_known(law, fits.range_of_law.values, fits.work_of_adhesion.values)
    return fits.assign(
        sampling.with_interval(
            "error_over_exponential", (), error_ratios[0], error_ratios[1], DIMENSIONLESS
        )
        | {
            "best_error_by_range": (("target", "rho"), errors, DIMENSIONLESS),
            "strength_over_known": ("range_choice", implied, DIMENSIONLESS),
        }
    ).assign_coords(rho=("rho", lengths, NM), target=list(forces_by_target))


def _fit_case(
    lengths: np.ndarray,
    forces: MeanAndSamples,
    targets: MeanAndSamples,
    reference_index: int,
    sampling: Sampling,
) -> xr.Dataset:
    """Return length, work and error of the best fit of one case, and ratios at this length.

    Forces (..., surface, n) in N at the lengths (n,) in nm are fitted to targets (..., surface, 1).
    `reference_index` is the index of the reference surface.
    """
    fits = [
        _best_fit(force / target, lengths) for force, target in zip(forces, targets, strict=True)
    ]
    value, samples = fits
    ratios = [
        force[..., value.position] / force[..., [reference_index], value.position]
        for force in forces
    ]
    return xr.Dataset(
        sampling.with_interval("range_of_law", (), value.length, samples.length, NM)
        | sampling.with_interval("work_of_adhesion", (), value.work, samples.work, JOULE_PER_M2)
        | sampling.with_interval("fit_error", (), value.error, samples.error, DIMENSIONLESS)
        | sampling.with_interval("force_ratio", "surface", ratios[0], ratios[1], DIMENSIONLESS)
    )


def _best_fit(relative: np.ndarray, lengths: np.ndarray) -> _Fit:
    """Return the best fit of forces (..., surface, length) relative to their targets."""
    best, work, error = fit_range_and_work(relative, np.ones(relative.shape[-2]))
    return _Fit(best, np.where(np.isfinite(error), lengths[best], np.nan), work, error)


def _band(
    law: Law, length: float, masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return the edges of a law at one length (nm), with their intervals."""

    def law_force(name: str) -> xr.DataArray:
        forces: xr.DataArray = xr.apply_ufunc(
            lambda values: law_forces(law, [length], masters.rho.values, values)[..., 0],
            masters[name],
            input_core_dims=[["rho"]],
        )
        return forces

    ratio = law_force("pull_off_force") / law_force("unfiltered_pull_off_force")
    scales = masters[["unfiltered_wavelength"]].assign(filtered_force_ratio=ratio)
    band = edges_of_realizations(scales, tolerance, sampling)
    return band[["edge", "edge_interval"]]
