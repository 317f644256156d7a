"""The critical band: the wavelengths whose removal changes the pull-off force, and its edges."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.statistics import Sampling, student_log_samples

#: The group of all surfaces.
POOLED = "pooled"
AXES = ("side", "surface", "cutoff_wavelength")


def computed_cutoffs(values: xr.DataArray) -> np.ndarray:
    """Return the ascending cutoffs (nm) at which any value (..., cutoff_wavelength) is finite."""
    dimensions = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    cutoffs = values["cutoff_wavelength"].values[values.notnull().any(dimensions).values]
    return np.sort(cutoffs)


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) of a side that removes most of the roughness.

    values: any values (..., cutoff_wavelength) of this side, NaN at the cutoffs of the other side.
    side: ``"small"`` or ``"large"``.
    Returns the longest cutoff of the small side, the shortest cutoff of the large side.
    """
    return float(computed_cutoffs(values)[-1 if side == "small" else 0])


def edges_or_last_cutoffs(band: xr.Dataset) -> xr.DataArray:
    """Return the edges, with the last cutoff of a side in place of NaN.

    band: ``edge`` and ``filtered_force_change`` of `critical_band`.
    Returns edges (..., side, group) in nm.
    """
    cutoffs = band["cutoff_wavelength"].where(band["filtered_force_change"].notnull())
    last_cutoffs = cutoffs.max("cutoff_wavelength").where(
        band["side"] == "small", cutoffs.min("cutoff_wavelength")
    )
    return band["edge"].fillna(last_cutoffs)


def critical_band(scales: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ratio curves, changes of the force and edges, by side.

    Mean ratios over realizations are sampled independently for each surface. The force on a surface
    leaves the tolerance where ln(ratio) does. A sample whose force never leaves the tolerance gets
    the last cutoff of its side.

    scales: ``filtered_force_ratio`` (surface, realization, side, cutoff_wavelength), the filtered
        force relative to the unfiltered force, NaN at cutoffs of the other side;
        ``unfiltered_wavelength`` (surface, side) in nm.
    tolerance: relative change of the force that counts.
    sampling: random numbers and confidence of the intervals.
    Returns with intervals: ``filtered_force_ratio`` (side, surface, cutoff_wavelength);
        ``filtered_force_change`` (side, group, cutoff_wavelength), |ratio - 1|, and its mean over
        surfaces for the group POOLED; and ``edge`` (side, group) in nm.
    """
    return add_intervals(sampled_band(scales, tolerance, sampling), scales, sampling)


class SampledVariable(NamedTuple):
    """A variable computed from all data, and from samples of the data."""

    dimensions: tuple[str, ...]
    value: np.ndarray  #: Has these dimensions.
    samples: np.ndarray  #: Has the sample as first axis, then these dimensions.
    units: str
    long_name: str


def add_intervals(
    variables: Mapping[str, SampledVariable], scales: xr.Dataset, sampling: Sampling
) -> xr.Dataset:
    """Return a dataset of the variables of `sampled_band` with their intervals.

    variables: variables of `sampled_band`.
    scales: the scales from which they were computed; their coordinates become those of the dataset.
    sampling: its confidence is the confidence of the intervals.
    Returns as from `critical_band`.
    """
    bands: dict[str, Any] = {}
    for name, variable in variables.items():
        attributes = {"units": variable.units, "long_name": variable.long_name}
        bands |= sampling.with_interval(
            name, variable.dimensions, variable.value, variable.samples, attributes
        )
    coordinates = {
        "side": scales.side.values,
        "surface": scales.surface.values,
        "group": [*scales.surface.values.tolist(), POOLED],
        "cutoff_wavelength": scales.cutoff_wavelength,
    }
    return xr.Dataset(bands, coordinates)


def sampled_band(
    scales: xr.Dataset, tolerance: float, sampling: Sampling
) -> dict[str, SampledVariable]:
    """Return the variables of `critical_band` with their samples; the arguments are the same.

    Other forces on the same masters are sampled with the same random numbers.
    """
    realizations = scales.filtered_force_ratio.transpose("realization", *AXES)
    ratio = realizations.mean("realization").values
    ratio_samples = np.stack(
        [
            student_log_samples(
                sampling.generator("scales", str(surface)),
                realizations.sel(surface=surface).dropna("realization", how="all").values,
                sampling.samples,
            )
            for surface in scales.surface.values
        ],
        axis=2,
    )
    change = _changes(ratio)
    change_samples = _changes(ratio_samples)
    cutoffs = scales.cutoff_wavelength.values
    unfiltered = scales.unfiltered_wavelength.transpose("side", "surface").values
    unfiltered = np.concatenate([unfiltered, unfiltered.mean(axis=1, keepdims=True)], axis=1)
    edges = _interpolate_edges(unfiltered, cutoffs, ratio[None], tolerance)[0]
    finite = np.isfinite(change)
    last_cutoffs = np.where(
        unfiltered < cutoffs[0],
        np.where(finite, cutoffs, -np.inf).max(axis=-1),
        np.where(finite, cutoffs, np.inf).min(axis=-1),
    )
    edge_samples = _interpolate_edges(unfiltered, cutoffs, ratio_samples, tolerance)
    never_leaves = np.isnan(edge_samples) & np.isfinite(change_samples).any(axis=-1)
    edge_samples = np.where(never_leaves, last_cutoffs, edge_samples)
    return {
        "filtered_force_ratio": SampledVariable(
            AXES, ratio, ratio_samples, "1",
            "mean pull-off force with roughness beyond the cutoff removed, relative to the force "
            "with all roughness",
        ),
        "filtered_force_change": SampledVariable(
            ("side", "group", "cutoff_wavelength"), change, change_samples,
            "1",
            "magnitude of the relative change of the force without roughness beyond the cutoff",
        ),
        "edge": SampledVariable(
            ("side", "group"), edges, edge_samples,
            "nm", "cutoff at which the change of the force exceeds the tolerance",
        ),
    }  # fmt: skip


def _changes(ratios: np.ndarray) -> np.ndarray:
    """Return |ratio - 1| (..., group, cutoff) of ratios (..., surface, cutoff).

    The last group is the mean over surfaces.
    """
    changes = np.abs(ratios - 1)
    return np.concatenate([changes, changes.mean(axis=-2, keepdims=True)], axis=-2)


def logarithmic_limits(tolerance: float) -> tuple[float, float]:
    """Return the limits of ln(ratio) between which the force counts as unchanged.

    The tolerance is a relative change of the force.
    """
    return float(np.log1p(-tolerance)), float(np.log1p(tolerance))


def interpolate_edge(cutoffs: np.ndarray, curve: np.ndarray, limits: tuple[float, float]) -> float:
    """Return the cutoff at which a curve first leaves its limits.

    The curve is interpolated linearly in the logarithm of the wavelength. The curve of a single
    surface is ln(ratio), which passes through zero where the ratio crosses one; |ratio - 1| does
    not. The curve of several surfaces is the mean of |ratio - 1|.

    cutoffs: cutoffs (k,) in nm, in the order of growing effect.
    curve: change (k,) of the force; the first value is within the limits.
    limits: lower and upper limit of the curve.
    Returns the cutoff in nm, NaN if the curve never leaves its limits.
    """
    lower, upper = limits
    is_outside = (curve < lower) | (curve > upper)
    if not is_outside.any():
        return np.nan
    crossing = is_outside.argmax()
    limit = upper if curve[crossing] > upper else lower
    share = (limit - curve[crossing - 1]) / (curve[crossing] - curve[crossing - 1])
    step = np.log(cutoffs[crossing] / cutoffs[crossing - 1])
    return float(np.exp(np.log(cutoffs[crossing - 1]) + share * step))


def _interpolate_edges(
    unfiltered: np.ndarray, cutoffs: np.ndarray, ratios: np.ndarray, tolerance: float
) -> np.ndarray:
    """Return edges (n, side, group) of ratios (n, side, surface, cutoff)."""
    curves = np.concatenate([np.log(ratios), _changes(ratios)[:, :, -1:]], axis=2)
    limits = [logarithmic_limits(tolerance)] * ratios.shape[2] + [(-np.inf, tolerance)]
    wavelengths = np.full(curves.shape[:3], np.nan)
    for sample, side, group in np.ndindex(wavelengths.shape):
        finite = np.flatnonzero(np.isfinite(curves[sample, side, group]))
        order = finite if unfiltered[side, group] < cutoffs[0] else finite[::-1]
        # Without a filter the curve is zero.
        curve = np.append(0.0, curves[sample, side, group, order])
        wavelengths_from_end = np.append(unfiltered[side, group], cutoffs[order])
        wavelengths[sample, side, group] = interpolate_edge(
            wavelengths_from_end, curve, limits[group]
        )
    return wavelengths


class RatioCurve(NamedTuple):
    """A measure of the change of the force on one side, zero without a filter."""

    side: str  #: small: wavelengths below the cutoff are removed; large: wavelengths above it.
    cell: float  #: Longest wavelength of the filtered surfaces in nm.
    #: (k,) in nm, in the order of growing effect: ascending on the small side, descending on the
    #: large side.
    cutoffs: np.ndarray
    #: (3, k): the computed value, and both ends of its interval, NaN if there is no interval.
    #: ln(ratio) for a single surface, the mean of |ratio - 1| for several.
    values: np.ndarray
    limits: tuple[float, float]  #: Lower and upper limit; a change within them does not count.


def describe_edge(curve: RatioCurve) -> dict[str, Any]:
    """Return the edge of a curve with its interval and status.

    `interpolate_edge` gives an edge between two computed cutoffs. The edge is open if the curve
    is outside its limits at the first cutoff already, or within them up to the last cutoff. Only a
    bound of an open edge is known. The ends of the interval are cutoffs, too. One end is the last
    cutoff before any value within the intervals leaves the limits. The other end is the first
    cutoff at which all values have left the limits. The only assumption is that the curve does not
    cross its limits twice between two cutoffs.

    curve: the change of the force by cutoff, with its interval.
    Returns ``edge``, ``edge_bound`` and ``edge_interval`` (2,) in nm, NaN where they are open;
        ``edge_bound_is_lower``, 1 if the edge is longer than its bound, else 0; ``edge_status`` and
        ``edge_interval_status`` (2,), ``"found"`` or the end of the cutoffs that the edge lies
        beyond.
    """
    cutoffs = curve.cutoffs
    small = curve.side == "small"
    value, low, high = curve.values
    edge = bound = np.nan
    is_lower_bound = False
    status = "found"
    crossing = _index_of_first_outside(curve, value, value)
    if 0 < crossing < len(cutoffs):
        edge = interpolate_edge(cutoffs, value, curve.limits)
    else:
        bound = float(cutoffs[0] if crossing == 0 else cutoffs[-1])
        is_lower_bound = small == (crossing > 0)
        # Cutoffs between cell/sqrt(2) and the cell act only on its longest waves: no cutoff could
        # resolve an edge beyond such a bound.
        is_beyond_cell = is_lower_bound and bound > curve.cell / np.sqrt(2)
        status = "beyond the cell" if is_beyond_cell else "beyond the cutoffs"
    # An end of the interval before the first or after the last cutoff is open.
    bounds = np.concatenate([[np.nan], cutoffs, [np.nan]])
    first_possible = _index_of_first_outside(curve, high, low)
    last_possible = _index_of_first_outside(curve, low, high)
    interval = np.array(
        [bounds[first_possible], bounds[last_possible + 1] if last_possible else np.nan]
    )
    if np.isnan(curve.values).any():
        interval = np.full(2, np.nan)
    interval = interval if small else interval[::-1]
    return {
        "edge": edge,
        "edge_bound": bound,
        "edge_bound_is_lower": int(is_lower_bound),
        "edge_status": status,
        "edge_interval": interval,
        "edge_interval_status": np.where(np.isfinite(interval), "found", "open"),
    }


def _index_of_first_outside(curve: RatioCurve, highest: np.ndarray, lowest: np.ndarray) -> int:
    """Return the index of the first cutoff at which the curve is outside its limits.

    The number of cutoffs if the curve is never outside. The highest values are compared with the
    upper limit, the lowest values with the lower limit.
    """
    lower, upper = curve.limits
    is_outside = (highest > upper) | (lowest < lower)
    return int(is_outside.argmax()) if is_outside.any() else len(curve.cutoffs)
