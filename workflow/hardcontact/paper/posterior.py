"""Posterior of range and work of adhesion: the probability of pairs, given published mean forces.

A pair is a range rho and a work W. The mean force on a surface s would be W f_s(rho), with the mean
force f_s computed at 1 J/m². The published mean F_s scatters about it, because it is a mean of few
forces. Its logarithm has the standard deviation e_s. The probability of a pair is proportional to

    exp(-1/2 sum over s of (ln F_s - ln W - ln f_s(rho))²/e_s²).

The computed means f_s are uncertain, too, because few scans stand for a surface. So they come from
many replicates. A replicate has one possible mean force on each surface: from a set of scans, or
sampled from the distribution of the means on whole surfaces. All replicates, all ln W and all
ln rho between the computed ends are equally probable before the forces are known.
"""

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import (
    Sampling,
    as_variables,
    log_std_of_lognormal,
    percentile_interval,
)
from hardcontact.base.units import JOULE_PER_M2, NM
from hardcontact.inference.fit import fine_ranges, interpolate_to_ranges

#: Number of independent forces in a published mean: the paper used at least six spheres, and tests
#: with the same sphere share its summits.
INDEPENDENT_FORCES = 6
#: Label of the posterior of all surfaces.
NONE_LEFT_OUT = "none"


def log_mean_error(log_std: ArrayLike, count: int) -> Floats:
    """Return the standard deviation of ln(mean) of `count` log-normal forces, from that of ln F."""
    return np.sqrt(np.log1p(np.expm1(np.square(log_std)) / count))


def sample_range_and_work(
    log_curves: Floats, log_targets: Floats, errors: Floats, rng: np.random.Generator, count: int
) -> tuple[NDArray[np.int_], Floats]:
    """Return samples of the index of the range, and of the logarithm of the work of adhesion.

    `log_curves` are ln f (replicate, surface, range), `log_targets` ln F (surface,), and `errors`
    their standard deviations. Ranges are evenly spaced in their logarithm. At each replicate and
    range the probability is a Gaussian of ln W. So a replicate and a range are sampled by
    its integral over ln W, and then ln W from this Gaussian.
    """
    precision = 1 / errors**2
    log_works = log_targets[:, None] - log_curves
    best_log_works = np.average(log_works, axis=1, weights=precision)
    residuals = log_works - best_log_works[:, None]
    misfit = (residuals**2 * precision[:, None]).sum(axis=1)
    # The width of the Gaussian is the same everywhere, so its integral is known but for a factor.
    weights = np.exp((misfit.min() - misfit) / 2).ravel()
    flat_index = rng.choice(weights.size, count, p=weights / weights.sum())
    work_deviation = 1 / np.sqrt(precision.sum())
    log_work = best_log_works.ravel()[flat_index] + work_deviation * rng.standard_normal(count)
    return flat_index % log_curves.shape[2], log_work


def posterior_of_forces(
    mean_forces: xr.DataArray, published_forces: pd.DataFrame, sampling: Sampling
) -> xr.Dataset:
    """Return `summarize_samples` of the posterior; surfaces without a published mean do not enter.

    The computed mean forces (replicate, surface, rho) are in N at 1 J/m².
    """
    targets = published_forces.reindex(mean_forces["surface"].values).dropna(subset="mean_force")
    forces = mean_forces.sel(surface=targets.index).transpose("replicate", "surface", "rho")
    ranges = fine_ranges(forces["rho"].values)
    curves = interpolate_to_ranges(forces.values, forces["rho"].values, ranges)
    log_stds = log_std_of_lognormal(targets["mean_force"], targets["median_force"])
    range_index, log_works = sample_range_and_work(
        np.log(curves),
        np.log(targets["mean_force"].to_numpy()),
        log_mean_error(log_stds, INDEPENDENT_FORCES),
        sampling.generator(*forces["surface"].values.tolist()),
        sampling.sample_count,
    )
    return summarize_samples(ranges[range_index], np.exp(log_works), sampling.confidence)


def posterior_dataset(
    sets: xr.Dataset,
    whole_surface_forces: xr.DataArray | None,
    published_forces: pd.DataFrame,
    sampling: Sampling,
) -> xr.Dataset:
    """Return posterior.nc: posteriors (forces_on, left_out) of all surfaces, and without each.

    `sets` is sets.nc in plastic contact. Mean forces on whole surfaces (surface, map, rho), if any,
    are those of a smooth sphere in N at 1 J/m²; ``map`` numbers the whole surfaces of a coating.
    """
    forces = {"scans": sets["mean_force"].rename(set="replicate")}
    if whole_surface_forces is not None:
        means = sampling.sample_means("whole surfaces", whole_surface_forces, "map")
        samples = means.isel(sample=slice(1, None)).rename(sample="replicate")
        forces["whole surfaces"] = samples * sets["sphere_factor"].sel(rho=samples["rho"])
    posteriors = {}
    for forces_on, mean_forces in forces.items():
        for left_out in (NONE_LEFT_OUT, *mean_forces["surface"].values.tolist()):
            other_forces = mean_forces.drop_sel(surface=left_out, errors="ignore")
            posterior = posterior_of_forces(other_forces, published_forces, sampling)
            posteriors[forces_on, left_out] = posterior
    # Claims about all surfaces take the names of surfaces from the coordinate.
    result = stack(posteriors, ["forces_on", "left_out"]).assign_coords(surface=sets["surface"])
    return result.assign_attrs(confidence=sampling.confidence)


def summarize_samples(ranges: Floats, works: Floats, confidence: float) -> xr.Dataset:
    """Return samples of range (nm) and work (J/m²), their medians and intervals."""
    variables = {}
    quantities = {"range_of_adhesion": (ranges, NM), "work_of_adhesion": (works, JOULE_PER_M2)}
    for name, (samples, units) in quantities.items():
        variables[f"sampled_{name}"] = ("sample", samples, units)
        interval = percentile_interval(samples, confidence)
        variables |= as_variables(name, (), np.median(samples), interval, units, confidence)
    return xr.Dataset(variables)
