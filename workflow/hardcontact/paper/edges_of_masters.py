"""Edges of the band of substitutes (edges.nc), and what shifts them (edge_shifts.nc).

Each master of a substitute has a scan of its own, so that samples of the mean over masters give the
scatter of an edge. The user's masters share scans (`own.edges_of_scans`). The group `mean` of edges
is the mean over coatings, because the paper has one band for all.
"""

from collections.abc import Iterator
from itertools import product

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_MODELS, PLASTIC, RIGID
from hardcontact.inference.edges import (
    MEAN_GROUP,
    ChangeCurve,
    edge_variables,
    find_edge,
    interpolate_edge,
    logarithmic_limits,
    ordered_curve,
)

RATIO_AXES = ("side", "surface", "cutoff_wavelength")


def edges_of_masters(
    scales: xr.Dataset, tolerance: float, sampling: Sampling
) -> tuple[xr.Dataset, Floats]:
    """Return force ratios, changes of the force and edges, and sampled edges (sample, side, group).

    `scales` has ``filtered_force_ratio`` (surface, realization, side, cutoff_wavelength), NaN at
    cutoffs of the other side, and ``unfiltered_wavelength`` (surface, side) in nm. An open edge is
    NaN; a sample has its bound instead. Random numbers depend on the surface alone.
    """
    ratio, ratio_samples = _mean_ratios(scales, sampling)
    edges = []
    samples = []
    for curve, sampled_values in _change_curves(scales, ratio, ratio_samples, tolerance):
        edges.append(find_edge(curve))
        samples.append(_sampled_edges(curve, sampled_values))
    shape = scales.sizes["side"], scales.sizes["surface"] + 1
    edge_samples = np.reshape(np.transpose(samples), (len(ratio_samples), *shape))
    axes = ("side", "group")
    variables = edge_variables(edges, axes, shape)
    _, edge, _ = variables["edge"]
    variables |= sampling.as_variables("edge", axes, edge, edge_samples, NM)
    changes = _absolute_changes(ratio), _absolute_changes(ratio_samples)
    variables |= sampling.as_variables(
        "filtered_force_change", (*axes, "cutoff_wavelength"), *changes, DIMENSIONLESS
    )
    variables |= sampling.as_variables(
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
    """Return mean ratios (side, surface, cutoff) over realizations, and samples (sample, ...)."""
    realizations = scales["filtered_force_ratio"].transpose("realization", *RATIO_AXES)
    values = {
        surface: realizations.sel(surface=surface).dropna("realization", how="all").values
        for surface in scales["surface"].values.tolist()
    }
    samples = sampling.sample_means("scales", values)
    return realizations.mean("realization").values, samples.swapaxes(1, 2)


def _absolute_changes(ratios: Floats) -> Floats:
    """Return |ratio - 1| (..., group, cutoff); the last group is the mean over surfaces."""
    changes = np.abs(ratios - 1)
    return np.concatenate([changes, changes.mean(axis=-2, keepdims=True)], axis=-2)


def _change_curves(
    scales: xr.Dataset, ratio: Floats, ratio_samples: Floats, tolerance: float
) -> Iterator[tuple[ChangeCurve, Floats]]:
    """Yield the curve of each side and group, and samples (sample, k) of its values.

    A surface has the curve ln(ratio) with two limits. The mean over surfaces has |ratio - 1| with
    an upper limit, because signs would cancel. A curve begins with zero at the unfiltered
    wavelength, where no roughness is removed.
    """
    ratios = np.concatenate([ratio[None], ratio_samples])
    curves = np.concatenate([np.log(ratios), _absolute_changes(ratios)[:, :, -1:]], axis=2)
    cutoffs = scales["cutoff_wavelength"].values
    spectrum_ends = scales["unfiltered_wavelength"].transpose("side", "surface").values
    spectrum_ends = np.column_stack([spectrum_ends, spectrum_ends.mean(axis=1)])
    limits = [logarithmic_limits(tolerance)] * ratio.shape[1] + [(-np.inf, tolerance)]
    for (index, side), group in product(enumerate(scales["side"].values), range(len(limits))):
        yield ordered_curve(
            str(side), cutoffs, curves[:, index, group], limits[group], spectrum_ends[index, group]
        )


def _sampled_edges(curve: ChangeCurve, sampled_values: Floats) -> Floats:
    """Return the edges (sample,) in nm of sampled values (sample, k), the last cutoff if open."""
    edges = np.array(
        [interpolate_edge(curve.cutoffs, values, curve.limits) for values in sampled_values]
    )
    never_leaves = np.isnan(edges) & np.isfinite(sampled_values).all(axis=1)
    return np.where(never_leaves, curve.cutoffs[-1], edges)


def compute_edge_shifts(forces: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return the edges of plastic and rigid contact at each range of adhesion, and their shifts.

    Forces come from `read_master_forces`, with one radius and two loadings. ``edge_shift`` (cause,
    side, group) is the edge of plastic contact at the longest range, relative to rigid contact
    (``"plasticity"``) or to the shortest range (``"range"``).
    """
    sorted_forces = forces.squeeze("radius", drop=True).sortby("contact_area")
    ranges = sorted_forces["rho"].values.tolist()
    edges = {}
    samples = {}
    for (loading, model), (column, rho) in product(enumerate(CONTACT_MODELS), enumerate(ranges)):
        model_forces = sorted_forces.isel(loading=loading, rho=column, drop=True)
        edges[model, rho], samples[model, rho] = edges_of_masters(model_forces, tolerance, sampling)
    complete = PLASTIC, max(ranges)
    keys_without_cause = {"plasticity": (RIGID, max(ranges)), "range": (PLASTIC, min(ranges))}
    ratios = [edges[complete]["edge"] / edges[key]["edge"] for key in keys_without_cause.values()]
    ratio_samples = [samples[complete] / samples[key] for key in keys_without_cause.values()]
    edge_shift = sampling.as_variables(
        "edge_shift", ("cause", "side", "group"), ratios, np.stack(ratio_samples, 1), DIMENSIONLESS
    )
    coordinates = {"rho": sorted_forces["rho"], "cause": list(keys_without_cause)}
    return stack(edges, ["contact_model", "rho"]).assign_coords(coordinates).assign(edge_shift)
