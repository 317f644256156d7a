"""The band of own surfaces: edges with intervals from few scans, and open edges."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.band.critical_band import RatioCurve, describe_edge, logarithmic_limits
from hardcontact.base.statistics import with_interval
from hardcontact.own.master_forces import (
    MasterForces,
    Masters,
    half_width_over_masters,
    summarize_masters,
)
from hardcontact.own.scan_parts import logarithmic_interval

#: The variables that describe an edge: their additional dimensions and their attributes.
EDGE: dict[str, tuple[tuple[str, ...], dict[str, Any]]] = {
    "edge": (
        (),
        {
            "units": "nm",
            "long_name": "cutoff at which the change of the force exceeds the tolerance",
        },
    ),
    "edge_bound": ((), {"units": "nm", "long_name": "cutoff beyond which an open edge lies"}),
    "edge_bound_is_lower": (
        (),
        {"units": "1", "long_name": "1 if the edge is longer than its bound, else 0"},
    ),
    "edge_status": ((), {}),
    "edge_interval": (("bound",), {"units": "nm", "long_name": "interval of the edge"}),
    "edge_interval_status": (("bound",), {}),
}


def band_edges(
    scales: xr.Dataset, masters: Masters, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return the edges of the band of every surface, with intervals from scans or their parts.

    scales: the forces on the filtered masters, as in scales.nc.
    tolerance: the smallest relative change of the force that counts.
    Returns ``filtered_force_ratio`` (surface, side, cutoff_wavelength), the mean over realizations,
        with its interval, which runs from zero to infinity if it is not bounded; the variables of
        EDGE (surface, side); ``interval_is_conditional`` (surface), 1 if the interval is
        conditional on one or two scans; ``interval_source``, ``interval_scans``, label and basis
        (surface).
    """
    curves = summarize_masters(scales, masters, lambda forces: _ratios(forces, confidence))
    curves = curves.transpose("surface", "side", ...)
    sources = curves[["interval_is_conditional", "interval_source", "interval_scans"]].isel(
        side=0, drop=True
    )
    band = curves[["filtered_force_ratio", "filtered_force_ratio_interval"]].merge(sources)
    band = band.assign(edges_of_curves(curves, logarithmic_limits(tolerance)))
    band = band.assign(label=scales.label, basis=scales.basis)
    attributes = {name: scales.attrs[name] for name in ("rho", "sphere_radius")}
    return band.assign_attrs(tolerance=tolerance, confidence=confidence, **attributes)


def _ratios(masters: MasterForces, confidence: float) -> xr.Dataset:
    """Return the ratios of one surface and side, their intervals, and the source of these."""
    half = half_width_over_masters(
        masters, lambda filtered, unfiltered: filtered / unfiltered, "log_ratio_shift", confidence
    )
    ratio = masters.forces.filtered_force_ratio.mean("realization").values
    interval = logarithmic_interval(ratio, half)
    bounds = interval
    if not np.isnan(interval).all():
        # Where the other ratios have intervals, a ratio without one is the same in all parts.
        bounds = np.where(np.isnan(interval), ratio[:, None], interval)
    axis = "cutoff_wavelength"
    unit = {"units": "1"}
    with np.errstate(divide="ignore"):  # the lower end of an interval without bounds is zero
        logarithms = np.log(ratio), np.log(bounds)
    return xr.Dataset(
        with_interval("filtered_force_ratio", axis, ratio, interval, unit, confidence)
        | with_interval("logarithm", axis, *logarithms, unit, confidence)
        | {
            "cell": masters.cell,
            "interval_is_conditional": int(masters.scan_parts.are_quarters),
            "interval_source": masters.scan_parts.source,
            "interval_scans": masters.scan_parts.scans,
        },
        {axis: masters.forces[axis].variable},
    )


def edges_of_curves(curves: xr.Dataset, limits: tuple[float, float]) -> dict[str, Any]:
    """Return the variables of EDGE for several curves.

    curves: ``logarithm``, ln(ratio) of several surfaces, and its interval (cutoff_wavelength, ...),
        NaN at cutoffs that a curve does not have; ``cell`` (...), the longest wavelength of the
        surface in nm; side as a coordinate.
    limits: lower and upper limit of ln(ratio), between which the force counts as unchanged.
    Returns the variables of EDGE, over the dimensions of ``cell``.
    """
    dimensions = curves.cell.dims
    shape = curves.cell.shape
    edges = []
    for index in np.ndindex(shape):
        curve = curves.isel(dict(zip(dimensions, index, strict=True)))
        side = str(curve.side.values)
        curve = curve.dropna("cutoff_wavelength", subset=["logarithm"])
        curve = curve.sortby("cutoff_wavelength", ascending=side == "small")
        values = np.vstack([curve.logarithm.values, curve.logarithm_interval.values.T])
        cutoffs = curve.cutoff_wavelength.values
        edges.append(describe_edge(RatioCurve(side, float(curve.cell), cutoffs, values, limits)))
    return {
        name: (
            (*dimensions, *dimensions_added),
            np.array([edge[name] for edge in edges]).reshape(
                *shape, *[2 for _ in dimensions_added]
            ),
            attributes,
        )
        for name, (dimensions_added, attributes) in EDGE.items()
    }
