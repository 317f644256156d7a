"""What the law of attraction decides: work of adhesion, ratios of forces, the critical band.

Every law has one length, its range rho = W/|p(0)|, and is compared in three cases: with the length
and work that come nearest to the forces of Eq. 1 at the published pair, with those that come
nearest to the measured forces, and at an atomic spacing, with the work alone fitted to these. The
first case asks what the paper claims: whether another form would have given similar results.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import critical_band
from hardcontact.base.statistics import Sampling
from hardcontact.contact.force_curves import mean_forces
from hardcontact.paper.error_map import fit, fit_work
from hardcontact.paper.inference import Pair
from hardcontact.theory.interaction_laws import (
    EXPONENTIAL,
    LAWS,
    Law,
    implied_over_known,
    law_forces,
    range_grid,
)

#: Lengths and works of adhesion at which laws are compared.
CASES = ["equivalent", "fitted", "atomic"]
#: Ranges (nm) of a law that are tried: from and to, and the step of their logarithm.
LENGTHS, LENGTH_STEP = (0.1, 40.0), 0.03

#: Forces of all scans, and samples of them.
Sampled = Sequence[np.ndarray]

NM, ENERGY, ONE = {"units": "nm"}, {"units": "J m-2"}, {"units": "1"}


class _Aims(NamedTuple):
    """What the forces of a law are fitted to, over all scans and over samples of them."""

    lengths: np.ndarray  #: (n,) ranges of a law that are tried, in nm.
    exponential: Sampled  #: (..., surface, 1) forces of Eq. 1 at the published pair, in N.
    measured: Sampled  #: (surface, 1) measured forces, in N.
    exponential_errors: Sampled  #: (...) of the best fits of Eq. 1 to the measured forces.


class _Fit(NamedTuple):
    """The best length of a law (...), its position, and the work of adhesion and error there."""

    position: np.ndarray
    length: np.ndarray  #: In nm.
    work: np.ndarray  #: In J/m².
    error: np.ndarray


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

    Parameters
    ----------
    forces : xarray.Dataset
        ``pull_off_force`` (surface, scan, rho) of exponential laws, in N at 1 J/m², and the names
        of the surfaces.
    masters : xarray.Dataset
        `stacked_forces` of filtered masters over such ranges, which may be fewer.
    published : pandas.DataFrame
        As from `published.pull_off`.
    pair : Pair
        Published range and work of adhesion of Eq. 1.
    spacing : float
        Between atoms where flats touch, in nm, in the case "atomic".
    reference_surface : str
        The surface whose force divides the others.
    tolerance : float
        Relative change of the force that ends the critical band.
    sampling : Sampling
        Of all intervals.

    Returns
    -------
    xarray.Dataset
        Over law ``error`` (target, length) at the best work of adhesion. Over law and case, with
        intervals: ``range_of_law`` (nm), ``work_of_adhesion`` (J/m²), ``fit_error``, ``ratio``
        (surface) and ``critical_wavelength`` (side, group; nm); ``implied_over_known`` as of the
        function of this name. Over law ``error_over_exponential``, that of the best fit to the
        published forces over that of Eq. 1, with an interval of both from the same samples.
    """
    target = published.mean_force.reindex(forces.surface.values.tolist())
    ratio = target / target[reference_surface]
    means = mean_forces(forces.pull_off_force, sampling, purpose="laws")
    base = target.index.to_list().index(reference_surface)
    aims = _aims(forces.rho.values, means, target.to_numpy(), pair)
    parts = []
    for law in LAWS:
        fits = _fit_law(
            law, forces.rho.values, means, aims, spacing=spacing, base=base, sampling=sampling
        ).assign_coords(surface=target.index.to_list())
        lengths = fits.range_of_law.to_series()
        bands = [_band(law, length, masters, tolerance, sampling) for length in lengths]
        parts.append(fits.merge(xr.concat(bands, lengths.index)))
    laws: xr.Dataset = xr.concat(parts, pd.Index([law.name for law in LAWS], name="law"))
    return laws.assign(
        label=forces.label,
        basis=forces.basis,
        law_label=("law", [law.label for law in LAWS]),
        published_ratio=("surface", ratio.to_numpy(), ONE),
    ).assign_attrs(
        atomic_spacing=spacing,
        scale_tolerance=tolerance,
        reference_label=str(forces.label.sel(surface=reference_surface).item()),
        confidence=sampling.confidence,
        scans=forces.sizes["scan"],
    )


def _aims(ranges: np.ndarray, means: Sampled, measured: np.ndarray, pair: Pair) -> _Aims:
    """Return what laws are fitted to: measured forces (surface,) and those of Eq. 1.

    The means (..., surface, k) over scans at ranges (k,) in nm are in N. The forces of Eq. 1 are
    those of the same sample.
    """
    rho, work = pair
    lengths = range_grid(rho, LENGTH_STEP, *LENGTHS)
    column = measured[:, None]
    errors = [
        _best_fit(law_forces(EXPONENTIAL, lengths, ranges, mean) / column, lengths).error
        for mean in means
    ]
    exponential = [law_forces(EXPONENTIAL, [rho], ranges, mean) * work for mean in means]
    return _Aims(lengths, exponential, [column] * len(means), errors)


def _fit_law(
    law: Law,
    ranges: np.ndarray,
    means: Sampled,
    aims: _Aims,
    *,
    spacing: float,
    base: int,
    sampling: Sampling,
) -> xr.Dataset:
    """Return the fits of all cases of one law, and its error at every length.

    The means (..., surface, k) over scans at ranges (k,) in nm are in N; base is the index of the
    reference surface.
    """
    lengths, measured = aims.lengths, aims.measured
    atomic = np.array([spacing / float(law.spacing(1.0))])
    curves = [law_forces(law, lengths, ranges, mean) for mean in means]
    atomic_forces = [law_forces(law, atomic, ranges, mean) for mean in means]
    error_ratio, drawn_ratios = (
        _best_fit(curve / aim, lengths).error / error
        for curve, aim, error in zip(curves, measured, aims.exponential_errors, strict=True)
    )
    fits = xr.concat(
        [
            _fit_case(lengths, curves, aims.exponential, base, sampling),
            _fit_case(lengths, curves, measured, base, sampling),
            _fit_case(atomic, atomic_forces, measured, base, sampling),
        ],
        pd.Index(CASES, name="case"),
    )
    targets = {"Eq. 1": aims.exponential[0], "published": measured[0]}
    errors = [fit_work(curves[0] / aim, np.ones(len(aim)))[1] for aim in targets.values()]
    implied = implied_over_known(law, fits.range_of_law.values, fits.work_of_adhesion.values)
    return fits.assign(
        sampling.with_interval("error_over_exponential", (), error_ratio, drawn_ratios, ONE)
        | {
            "error": (("target", "length"), errors, ONE),
            "implied_over_known": ("case", implied, ONE),
        }
    ).assign_coords(length=("length", lengths, NM), target=list(targets))


def _fit_case(
    lengths: np.ndarray, forces: Sampled, aims: Sampled, base: int, sampling: Sampling
) -> xr.Dataset:
    """Return length, work and error of the best fit of one case, and ratios at this length.

    Forces (..., surface, n) in N at the lengths (n,) in nm are fitted to the aims (..., surface,
    1); base is the index of the reference surface.
    """
    value, drawn = (
        _best_fit(force / aim, lengths) for force, aim in zip(forces, aims, strict=True)
    )
    ratio, ratios = (
        force[..., value.position] / force[..., [base], value.position] for force in forces
    )
    return xr.Dataset(
        sampling.with_interval("range_of_law", (), value.length, drawn.length, NM)
        | sampling.with_interval("work_of_adhesion", (), value.work, drawn.work, ENERGY)
        | sampling.with_interval("fit_error", (), value.error, drawn.error, ONE)
        | sampling.with_interval("ratio", "surface", ratio, ratios, ONE)
    )


def _best_fit(relative: np.ndarray, lengths: np.ndarray) -> _Fit:
    """Return the best fit of forces (..., surface, length) relative to what they are fitted to."""
    best, work, error = fit(relative, np.ones(relative.shape[-2]))
    return _Fit(best, np.where(np.isfinite(error), lengths[best], np.nan), work, error)


def _band(
    law: Law, length: float, masters: xr.Dataset, tolerance: float, sampling: Sampling
) -> xr.Dataset:
    """Return the edges of `critical_band` of a law at one length (nm), with their intervals."""

    def law_force(name: str) -> xr.DataArray:
        forces: xr.DataArray = xr.apply_ufunc(
            lambda values: law_forces(law, [length], masters.rho.values, values)[..., 0],
            masters[name],
            input_core_dims=[["rho"]],
        )
        return forces

    ratio = law_force("pull_off_force") / law_force("unfiltered_pull_off_force")
    scales = masters[["unfiltered_wavelength"]].assign(ratio=ratio)
    band = critical_band(scales, tolerance, sampling)
    return band[["critical_wavelength", "critical_wavelength_interval"]]
