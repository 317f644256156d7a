"""The band of own surfaces: edges with intervals from few scans, and edges that are left open."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.numbers.statistics import with_interval
from hardcontact.own_surfaces.master_forces import (
    MasterForces,
    Masters,
    half_width_over_masters,
    over_masters,
)
from hardcontact.own_surfaces.scan_parts import logarithmic_interval
from hardcontact.scales.critical_band import Curve, described_edge, logarithmic_limits

#: What an edge is described by: further dimensions, and attributes.
EDGE: dict[str, tuple[tuple[str, ...], dict[str, Any]]] = {
    "edge": ((), {"units": "nm", "long_name": "cutoff where the force leaves its tolerance"}),
    "edge_bound": ((), {"units": "nm", "long_name": "limit of an open edge"}),
    "edge_at_least": ((), {"units": "1", "long_name": "1 where an open edge is above its limit"}),
    "edge_status": ((), {}),
    "edge_interval": (("bound",), {"units": "nm", "long_name": "interval of the edge"}),
    "interval_status": (("bound",), {}),
}


def band_edges(
    scales: xr.Dataset, masters: Masters, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return the edges of the band of every surface, with intervals from scans or their parts.

    `scales` has the forces of the filtered masters, as in scales.nc; the tolerance is the relative
    change of the force that counts.

    Over surface, side and cutoff_wavelength ``scale_ratio``, the mean over realizations, with its
    interval, from zero to infinity where it is not bounded; over surface and side what
    `described_edge` gives; over surface ``conditional`` (1 where the interval is conditional on one
    or two scans), ``interval_source`` and ``interval_scans`` (what the interval comes from, and how
    many scans), label and basis. Of several surfaces that have cutoffs in
    common, everything that begins with ``pooled_`` is over side: mean and edge of the change |ratio
    - 1| of all surfaces.
    """
    curves = over_masters(scales, masters, lambda given: _ratios(given, confidence))
    curves = curves.transpose("surface", "side", ...)
    parts = curves[["conditional", "interval_source", "interval_scans"]].isel(side=0, drop=True)
    found = curves[["scale_ratio", "scale_ratio_interval"]].merge(parts)
    found = found.assign(
        edges_of_curves(curves, "logarithm", logarithmic_limits(tolerance))
    ).assign(label=scales.label, basis=scales.basis)
    common = curves.change.notnull().all("surface").any("cutoff_wavelength").all()
    if curves.sizes["surface"] > 1 and common:
        found = found.assign(_pooled(curves, tolerance))
    attributes = {name: scales.attrs[name] for name in ("rho", "sphere_radius")}
    return found.assign_attrs(tolerance=tolerance, confidence=confidence, **attributes)


def _ratios(given: MasterForces, confidence: float) -> xr.Dataset:
    """Return the ratios of one surface and side with their interval, and where that comes from."""
    half = half_width_over_masters(
        given, lambda filtered, whole: filtered / whole, "ratio_shift", confidence
    )
    ratio = given.forces.ratio.mean("realization").values
    interval = logarithmic_interval(ratio, half)
    filled = interval
    if not np.isnan(interval).all():
        # A ratio without an interval among others that have one is the same in all parts: known.
        filled = np.where(np.isnan(interval), ratio[:, None], interval)
    # |ratio - 1|, its least and its greatest value within the interval: NaN where there is none.
    change, ends = np.abs(ratio - 1), np.abs(filled - 1)
    least = np.where((filled[:, 0] < 1) & (filled[:, 1] > 1), 0.0, ends.min(axis=-1))
    change_interval = np.stack([least, ends.max(axis=-1)], axis=-1)
    axis, one = "cutoff_wavelength", {"units": "1"}
    with np.errstate(divide="ignore"):  # the lower end of an interval without bounds is zero
        logarithms = np.log(ratio), np.log(filled)
    return xr.Dataset(
        with_interval("scale_ratio", axis, ratio, interval, one, confidence)
        | with_interval("change", axis, change, change_interval, one, confidence)
        | with_interval("logarithm", axis, *logarithms, one, confidence)
        | {
            "cell": given.cell,
            "conditional": int(given.parts.conditional),
            "interval_source": given.parts.source,
            "interval_scans": given.parts.scans,
        },
        {axis: given.forces[axis].variable},
    )


def edges_of_curves(
    curves: xr.Dataset, measure: str, limits: tuple[float, float]
) -> dict[str, Any]:
    """Return the edges of several curves with interval and status, as `described_edge` does.

    The curves have the measure, ln(ratio) or the change of several surfaces, and its interval
    (cutoff_wavelength, ...), NaN at cutoffs that a curve has not; ``cell`` (...), longest
    wavelength of the surface in nm; side as a coordinate. Within the limits, lower and upper, a
    change counts as none. Returned are the variables EDGE over the dimensions of ``cell``.
    """
    dimensions, shape = curves.cell.dims, curves.cell.shape
    edges = [
        described_edge(
            _curve(curves.isel(dict(zip(dimensions, place, strict=True))), measure, limits)
        )
        for place in np.ndindex(shape)
    ]
    return {
        name: (
            (*dimensions, *further),
            np.array([edge[name] for edge in edges]).reshape(*shape, *[2 for _ in further]),
            attributes,
        )
        for name, (further, attributes) in EDGE.items()
    }


def _curve(one: xr.Dataset, measure: str, limits: tuple[float, float]) -> Curve:
    """Return the curve of one surface or of all, at the cutoffs of its side."""
    side = str(one.side.values)
    known = one.dropna("cutoff_wavelength", subset=[measure])
    known = known.sortby("cutoff_wavelength", ascending=side == "small")
    values = np.concatenate([known[measure].values[None], known[f"{measure}_interval"].values.T])
    return Curve(side, float(one.cell), known.cutoff_wavelength.values, values, limits)


def _pooled(curves: xr.Dataset, tolerance: float) -> dict[str, Any]:
    """Return mean change and edge of all surfaces, at the cutoffs that all have.

    The ends of its interval are the means of the ends of the surfaces. As these are independent,
    that is wider than it need be.
    """
    mean = curves[["change", "change_interval"]].mean("surface", skipna=False, keep_attrs=True)
    mean = mean.assign(cell=curves.cell.min("surface"))
    found = edges_of_curves(mean, "change", (-np.inf, tolerance))
    edges = {f"pooled_{name}": edge for name, edge in found.items()}
    return edges | {f"pooled_{name}": mean[name] for name in ("change", "change_interval")}
