"""The critical band: ratios of forces by cutoff and the edges where they change, for edges.nc.

The functions on cutoffs and the variables of edges serve every study. Edges with samples are those
of substitutes, whose realizations are independent and whose roughness ends at the unfiltered
wavelength; `edges_of_scans` finds those of the user's surfaces.
"""

from collections.abc import Hashable, Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import Sampling, student_log_samples
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.inference.curve_edges import (
    ChangeCurve,
    Edge,
    find_edge,
    interpolate_edge,
    logarithmic_limits,
    ordered_curve,
)

#: The group of all surfaces.
MEAN_GROUP = "mean"
RATIO_AXES = ("side", "surface", "cutoff_wavelength")


def computed_cutoffs(values: xr.DataArray) -> Floats:
    """Return the ascending cutoffs (nm) at which any value (..., cutoff_wavelength) is finite."""
    dimensions = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    cutoffs = values["cutoff_wavelength"].values[values.notnull().any(dimensions).values]
    return np.sort(cutoffs)


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) of a side, "short" or "long", that removes most of the roughness.

    The values (..., cutoff_wavelength) of this side are NaN at the cutoffs of the other side.
    """
    return float(computed_cutoffs(values)[-1 if side == "short" else 0])


def edges_or_bounds(edges: xr.Dataset) -> xr.DataArray:
    """Return the edges (..., side, group) in nm, with their bounds in place of open edges."""
    return edges["edge"].fillna(edges["edge_bound"])


def mean_band(edges: xr.Dataset) -> tuple[float, float]:
    """Return both edges (nm) of the mean change over all surfaces, or their bounds."""
    mean_edges = edges_or_bounds(edges).sel(group=MEAN_GROUP)
    return float(mean_edges.sel(side="short")), float(mean_edges.sel(side="long"))


def labelled_edges(
    edges: xr.Dataset, scales: xr.Dataset, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return edges.nc: edges with the names of the surfaces and the settings that they hold for."""
    return edges.assign(label=scales["label"], source=scales["source"]).assign_attrs(
        tolerance=tolerance,
        confidence=confidence,
        rho=scales.attrs["rho"],
        sphere_radius=scales.attrs["sphere_radius"],
    )


def edge_variables(
    edges: Sequence[Edge], dimensions: Sequence[Hashable], shape: Sequence[int]
) -> dict[str, Any]:
    """Return ``edge``, ``edge_bound`` and ``edge_status`` as variables of this shape."""
    columns: dict[str, tuple[list[Any], dict[str, str]]] = {
        "edge": ([edge.value for edge in edges], NM),
        "edge_bound": ([edge.bound for edge in edges], NM),
        "edge_status": ([edge.status for edge in edges], {}),
    }
    return {
        name: (dimensions, np.reshape(values, shape), attributes)
        for name, (values, attributes) in columns.items()
    }


def edges_with_samples(
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
