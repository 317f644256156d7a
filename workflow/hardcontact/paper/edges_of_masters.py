"""The critical band of substitutes, with intervals from independent masters.

Each master has other scans and ends at the unfiltered wavelength, where no roughness is removed.
So samples of the mean over masters give the scatter of each edge.
"""

from collections.abc import Iterator
from itertools import product

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import Sampling, student_log_samples
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.inference.curve_edges import (
    ChangeCurve,
    find_edge,
    interpolate_edge,
    logarithmic_limits,
    ordered_curve,
)
from hardcontact.inference.edges import MEAN_GROUP, edge_variables

RATIO_AXES = ("side", "surface", "cutoff_wavelength")


def edges_of_masters(
    scales: xr.Dataset, tolerance: float, sampling: Sampling
) -> tuple[xr.Dataset, Floats]:
    """Return ratio curves, changes of the force and edges, and sampled edges (sample, side, group).

    `scales` has ``filtered_force_ratio`` (surface, realization, side, cutoff_wavelength), NaN at
    cutoffs of the other side, and ``unfiltered_wavelength`` (surface, side) in nm. MEAN_GROUP of
    ``filtered_force_change``, |ratio - 1|, is the mean over surfaces. An open edge is NaN; in a
    sample its bound replaces it. Random numbers depend on the surface alone.
    """
    ratio, ratio_samples = _mean_ratios(scales, sampling)
    edges = []
    samples = []
    for curve, sampled_values in _curves(scales, ratio, ratio_samples, tolerance):
        edges.append(find_edge(curve))
        samples.append(_sampled_edges(curve, sampled_values))
    shape = scales.sizes["side"], scales.sizes["surface"] + 1
    edge_samples = np.reshape(np.transpose(samples), (len(ratio_samples), *shape))
    axes = ("side", "group")
    change, change_samples = _changes(ratio), _changes(ratio_samples)
    variables = edge_variables(edges, axes, shape)
    _, edge, _ = variables["edge"]
    variables |= sampling.with_interval("edge", axes, edge, edge_samples, NM)
    variables |= sampling.with_interval(
        "filtered_force_change", (*axes, RATIO_AXES[-1]), change, change_samples, DIMENSIONLESS
    )
    variables |= sampling.with_interval(
        "filtered_force_ratio", RATIO_AXES, ratio, ratio_samples, DIMENSIONLESS
    )
    coordinates = {
        "side": scales["side"].values,
        "surface": scales["surface"].values,
        "group": [*scales["surface"].values.tolist(), MEAN_GROUP],
        "cutoff_wavelength": scales["cutoff_wavelength"],
    }
    return xr.Dataset(variables, coordinates), edge_samples


def _mean_ratios(scales: xr.Dataset, sampling: Sampling) -> tuple[Floats, Floats]:
    """Return means over realizations (side, surface, cutoff), and their samples (sample, ...)."""
    realizations = scales["filtered_force_ratio"].transpose("realization", *RATIO_AXES)
    samples = [
        student_log_samples(
            sampling.generator("scales", str(surface)),
            realizations.sel(surface=surface).dropna("realization", how="all").values,
            sampling.sample_count,
        )
        for surface in scales["surface"].values
    ]
    return realizations.mean("realization").values, np.stack(samples, axis=2)


def _changes(ratios: Floats) -> Floats:
    """Return |ratio - 1| (..., group, cutoff) of ratios (..., surface, cutoff).

    The last group is the mean over surfaces.
    """
    changes = np.abs(ratios - 1)
    return np.concatenate([changes, changes.mean(axis=-2, keepdims=True)], axis=-2)


def _curves(
    scales: xr.Dataset, ratio: Floats, ratio_samples: Floats, tolerance: float
) -> Iterator[tuple[ChangeCurve, Floats]]:
    """Yield the curve of each side and group, and samples (sample, k) of its values.

    Mean ratios and their samples come from `_mean_ratios`. The curve of a surface is ln(ratio)
    with two limits, the mean curve is that of |ratio - 1| with an upper limit. Each curve begins at
    the unfiltered wavelength, where it is zero.
    """
    ratios = np.concatenate([ratio[None], ratio_samples])
    curves = np.concatenate([np.log(ratios), _changes(ratios)[:, :, -1:]], axis=2)
    cutoffs = scales["cutoff_wavelength"].values
    spectrum_ends = scales["unfiltered_wavelength"].transpose("side", "surface").values
    spectrum_ends = np.column_stack([spectrum_ends, spectrum_ends.mean(axis=1)])
    limits = [logarithmic_limits(tolerance)] * ratio.shape[1] + [(-np.inf, tolerance)]
    for (index, side), group in product(enumerate(scales["side"].values), range(len(limits))):
        yield ordered_curve(
            str(side), cutoffs, curves[:, index, group], limits[group], spectrum_ends[index, group]
        )


def _sampled_edges(curve: ChangeCurve, sampled_values: Floats) -> Floats:
    """Return the edges (sample,) in nm of a curve with sampled values (sample, k).

    The last cutoff stands for an open edge. NaN if the values are NaN.
    """
    edges = np.array(
        [interpolate_edge(curve.cutoffs, values, curve.limits) for values in sampled_values]
    )
    never_leaves = np.isnan(edges) & np.isfinite(sampled_values).all(axis=1)
    return np.where(never_leaves, curve.cutoffs[-1], edges)
