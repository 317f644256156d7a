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
    """Return the cutoffs (nm), growing, where any value (..., cutoff_wavelength) is finite."""
    dimensions = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    cutoffs = values["cutoff_wavelength"].values[values.notnull().any(dimensions).values]
    return np.sort(cutoffs)


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) of a side that removes most."""
    return float(computed_cutoffs(values)[-1 if side == "small" else 0])


def edges_or_last_cutoffs(band: xr.Dataset) -> xr.DataArray:
    """Return the critical wavelengths (..., side, group) in nm, the last cutoff of a side for NaN.

    The band has the variables of `critical_band` without intervals.
    """
    cutoffs = band["cutoff_wavelength"].where(band["scale_change"].notnull())
    last = cutoffs.max("cutoff_wavelength").where(
        band["side"] == "small", cutoffs.min("cutoff_wavelength")
    )
    return band["critical_wavelength"].fillna(last)


def critical_band(scales: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return ratio curves, changes of the force and critical wavelengths, by side.

    `scales` has ``ratio`` (surface, realization, side, cutoff_wavelength), NaN at cutoffs of the
    other side, and ``unfiltered_wavelength`` (surface, side) in nm; the tolerance is a relative
    change of the force. Mean ratios over realizations are sampled, each surface by itself.

    With intervals: ``scale_ratio`` (side, surface, cutoff_wavelength); ``scale_change`` (side,
    group, cutoff_wavelength), |ratio - 1|, and its mean over surfaces for the group POOLED; and
    ``critical_wavelength`` (side, group) in nm. A surface leaves the tolerance where ln(ratio)
    does. A sampled change that never does gets the last cutoff of its side.
    """
    return with_intervals(sampled_band(scales, tolerance, sampling), scales, sampling)


class Sampled(NamedTuple):
    """A variable of all data, and of samples of them."""

    dimensions: tuple[str, ...]
    value: np.ndarray  #: Over the dimensions.
    samples: np.ndarray  #: The sample is the first axis.
    units: str
    long_name: str


def with_intervals(
    variables: Mapping[str, Sampled], scales: xr.Dataset, sampling: Sampling
) -> xr.Dataset:
    """Return the variables of `sampled_band`, with their intervals and the axes of the scales."""
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


def sampled_band(scales: xr.Dataset, tolerance: float, sampling: Sampling) -> dict[str, Sampled]:
    """Return the variables of `critical_band`, to which the arguments belong, with their samples.

    Samples of other forces on the same masters are drawn with the same random numbers.
    """
    realizations = scales.ratio.transpose("realization", *AXES)
    ratio = realizations.mean("realization").values
    samples_of_ratio = np.stack(
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
    change, changes = _changes(ratio), _changes(samples_of_ratio)
    cutoffs = scales.cutoff_wavelength.values
    ends = scales.unfiltered_wavelength.transpose("side", "surface").values
    ends = np.concatenate([ends, ends.mean(axis=1, keepdims=True)], axis=1)
    critical = _critical_wavelengths(ends, cutoffs, ratio[None], tolerance)[0]
    finite = np.isfinite(change)
    last = np.where(
        ends < cutoffs[0],
        np.where(finite, cutoffs, -np.inf).max(axis=-1),
        np.where(finite, cutoffs, np.inf).min(axis=-1),
    )
    critical_samples = _critical_wavelengths(ends, cutoffs, samples_of_ratio, tolerance)
    stays = np.isnan(critical_samples) & np.isfinite(changes).any(axis=-1)
    critical_samples = np.where(stays, last, critical_samples)
    return {
        "scale_ratio": Sampled(
            AXES, ratio, samples_of_ratio, "1", "pull-off force over that unfiltered"
        ),
        "scale_change": Sampled(
            ("side", "group", "cutoff_wavelength"), change, changes,
            "1", "relative change of the pull-off force, up or down",
        ),
        "critical_wavelength": Sampled(
            ("side", "group"), critical, critical_samples,
            "nm", "cutoff where the force leaves its tolerance",
        ),
    }  # fmt: skip


def _changes(ratios: np.ndarray) -> np.ndarray:
    """Return |ratio - 1| (..., group, cutoff) of ratios (..., surface, cutoff), the mean last."""
    changes = np.abs(ratios - 1)
    return np.concatenate([changes, changes.mean(axis=-2, keepdims=True)], axis=-2)


def logarithmic_limits(tolerance: float) -> tuple[float, float]:
    """Return the limits of ln(ratio) between which the force counts as unchanged."""
    return float(np.log1p(-tolerance)), float(np.log1p(tolerance))


def critical_wavelength(
    cutoffs: np.ndarray, curve: np.ndarray, limits: tuple[float, float]
) -> float:
    """Return the cutoff (nm) where a curve leaves its limits, coming from no filter; NaN if never.

    Linear in the curve and in log wavelength; the cutoffs (k,) are in the order of growing effect.
    The curve (k,) begins within the limits. A single surface has ln(ratio), which passes through
    zero where the ratio crosses one, as |ratio - 1| does not; several have the mean of |ratio - 1|.
    """
    lower, upper = limits
    outside = np.flatnonzero((curve < lower) | (curve > upper))
    if not len(outside):
        return np.nan
    before, after = outside[0] - 1, outside[0]
    limit = upper if curve[after] > upper else lower
    share = (limit - curve[before]) / (curve[after] - curve[before])
    return float(np.exp(np.log(cutoffs[before]) + share * np.log(cutoffs[after] / cutoffs[before])))


def _critical_wavelengths(
    ends: np.ndarray, cutoffs: np.ndarray, ratios: np.ndarray, tolerance: float
) -> np.ndarray:
    """Return critical wavelengths (n, side, group) of ratios (n, side, surface, cutoff)."""
    curves = np.concatenate([np.log(ratios), _changes(ratios)[:, :, -1:]], axis=2)
    limits = [logarithmic_limits(tolerance)] * ratios.shape[2] + [(-np.inf, tolerance)]
    wavelengths = np.full(curves.shape[:3], np.nan)
    for n, s, g in np.ndindex(wavelengths.shape):
        finite = np.flatnonzero(np.isfinite(curves[n, s, g]))
        order = finite if ends[s, g] < cutoffs[0] else finite[::-1]
        # Without a filter the curve is zero.
        curve = np.append(0.0, curves[n, s, g, order])
        wavelengths_from_end = np.append(ends[s, g], cutoffs[order])
        wavelengths[n, s, g] = critical_wavelength(wavelengths_from_end, curve, limits[g])
    return wavelengths


class Curve(NamedTuple):
    """A measure of the change of the force on one side, zero without a filter."""

    side: str  #: small: wavelengths below the cutoff are removed; large: those above.
    cell: float  #: Longest wavelength of the filtered surfaces in nm.
    #: (k,) nm, in the order of growing effect: growing on the small side, falling on the large.
    cutoffs: np.ndarray
    #: (3, k): as computed, the least and the greatest within the interval; the latter NaN where
    #: there is no interval. Of one surface ln(ratio), of several the mean of |ratio - 1|.
    values: np.ndarray
    limits: tuple[float, float]  #: Lower and upper; within them a change counts as none.


def described_edge(curve: Curve) -> dict[str, Any]:
    """Return the edge of a curve with its interval, and status.

    An edge is a `critical_wavelength` between two computed cutoffs. Where the curve has left its
    limits before the first one, or does not leave them up to the last, the edge is open, and only a
    bound is known. The ends of its interval are cutoffs too: the last one before any value within
    the intervals leaves the limits, and the first one at which all have left. This assumes nothing
    but that the curve has no further crossing between two cutoffs.

    ``edge``, ``edge_bound`` and ``edge_interval`` (2,) are in nm, NaN where they are open;
    ``edge_at_least`` is 1 where the edge is longer than its bound; ``edge_status`` and
    ``interval_status`` (2,) are ``"found"``, or name the end that the edge lies beyond.
    """
    cutoffs, small = curve.cutoffs, curve.side == "small"
    value, low, high = curve.values
    edge, bound, at_least, status = np.nan, np.nan, False, "found"
    crossing = _first_outside(curve, value, value)
    if 0 < crossing < len(cutoffs):
        edge = critical_wavelength(cutoffs, value, curve.limits)
    else:
        bound = float(cutoffs[0] if crossing == 0 else cutoffs[-1])
        at_least = small == (crossing > 0)
        # Cutoffs between cell/sqrt(2) and the cell all act on its longest waves alone: beyond a
        # bound there, no other cutoff could tell more.
        at_end = at_least and bound > curve.cell / np.sqrt(2)
        status = "beyond the cell" if at_end else "beyond the cutoffs"
    # Before the first cutoff and after the last one an end is open.
    bounds = np.concatenate([[np.nan], cutoffs, [np.nan]])
    begins, ends = _first_outside(curve, high, low), _first_outside(curve, low, high)
    interval = np.array([bounds[begins], bounds[ends + 1] if ends else np.nan])
    if np.isnan(curve.values).any():
        interval = np.full(2, np.nan)
    interval = interval if small else interval[::-1]
    return {
        "edge": edge,
        "edge_bound": bound,
        "edge_at_least": int(at_least),
        "edge_status": status,
        "edge_interval": interval,
        "interval_status": np.where(np.isfinite(interval), "found", "open"),
    }


def _first_outside(curve: Curve, above: np.ndarray, below: np.ndarray) -> int:
    """Return the place of the first cutoff beyond the limits, the number of cutoffs if none is."""
    lower, upper = curve.limits
    outside = np.flatnonzero((above > upper) | (below < lower))
    return int(outside[0]) if len(outside) else len(curve.cutoffs)
