"""The band of own surfaces: edges with intervals from few scans, and edges that are left open."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.adhesion.edge_of_curve import Curve, described_edge
from hardcontact.adhesion.scan_parts import (
    Parts,
    half_width_of_logarithm,
    parts_of_scans,
    quarters_of_contacts,
)
from hardcontact.records.dataset import stack
from hardcontact.statistics import with_interval

__all__ = ["Masters", "band_edges"]

SIDES = ["small", "large"]
CONTACTS = ("contact_y", "contact_x")

#: What an edge is described by: further dimensions, and attributes.
EDGE: dict[str, tuple[tuple[str, ...], dict[str, Any]]] = {
    "edge": ((), {"units": "nm", "long_name": "cutoff where the force leaves its tolerance"}),
    "edge_bound": ((), {"units": "nm", "long_name": "limit of an open edge"}),
    "edge_status": ((), {}),
    "edge_interval": (("bound",), {"units": "nm"}),
    "interval_status": (("bound",), {}),
    "edge_text": ((), {}),
}


class Masters(NamedTuple):
    """What the masters are made of.

    Attributes
    ----------
    scans : mapping of str to int
        Scans of each surface; realization r is made of scan (r - 1) modulo their number.
    tiles : int
        Mirrored scans along an edge of a large-scale master.
    """

    scans: Mapping[str, int]
    tiles: int


def band_edges(
    scales: xr.Dataset, masters: Masters, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return the edges of the band of every surface, with intervals from scans or their parts.

    Parameters
    ----------
    scales : xarray.Dataset
        Forces of the filtered masters, as in scales.nc.
    masters : Masters
        Scans and tiles.
    tolerance : float
        Relative change of the force that counts.
    confidence : float
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        Over surface, side and cutoff_wavelength ``scale_ratio``, the mean over realizations, with
        its interval; over surface and side what `described_edge` gives, and ``unfiltered_force``,
        the mean force in N at 1 J/m² with all roughness; over surface
        ``conditional`` (1 where the interval is conditional on one or two scans),
        ``interval_note``, label and basis. Of several surfaces that
        have cutoffs in common, everything that begins with ``pooled_`` is over side: mean and edge
        of the change |ratio - 1| of all surfaces.
    """
    sides = {
        (str(surface), side): _side(scales, str(surface), side, masters, confidence)
        for surface in scales.surface.values
        for side in SIDES
    }
    curves = stack(sides, ["surface", "side"]).transpose("surface", "side", ...)
    notes = curves[["conditional", "interval_note"]].isel(side=0, drop=True)
    found = curves[["scale_ratio", "scale_ratio_interval", "unfiltered_force"]].merge(notes)
    found = found.assign(_edges(curves, tolerance)).assign(label=scales.label, basis=scales.basis)
    common = curves.change.notnull().all("surface").any("cutoff_wavelength").all()
    if curves.sizes["surface"] > 1 and common:
        found = found.assign(_pooled(curves, tolerance))
    attributes = {name: scales.attrs[name] for name in ("rho", "sphere_radius")}
    return found.assign_attrs(tolerance=tolerance, confidence=confidence, **attributes)


def _side(
    scales: xr.Dataset, surface: str, side: str, masters: Masters, confidence: float
) -> xr.Dataset:
    """Return the ratios of one surface and side with their interval, and where that comes from."""
    cell = float(scales.unfiltered_wavelength.sel(surface=surface, side="large"))
    tiles = masters.tiles if side == "large" else 1
    cell *= tiles / masters.tiles
    forces = scales.sel(surface=surface, side=side).dropna(
        "realization", how="all", subset=["ratio"]
    )
    parts = parts_of_scans(
        (forces.realization.values - 1) % masters.scans[surface],
        quarters_of_contacts(forces.sizes["contact_y"], tiles),
        cell / tiles / 2,
        float(np.sqrt(scales.attrs["sphere_radius"] * scales.attrs["rho"])),
    )
    half = half_width_of_logarithm(_left_out(forces, parts), parts, confidence)
    ratio = forces.ratio.mean("realization").values
    interval = ratio[:, None] * np.exp(np.stack([-half, half], axis=-1))
    change, change_interval = _changes(ratio, interval)
    axis = "cutoff_wavelength"
    unfiltered = float(forces.unfiltered_pull_off_force.mean())
    newton = {"units": "N", "long_name": "mean force at 1 J/m² with all roughness"}
    return xr.Dataset(
        with_interval("scale_ratio", axis, ratio, interval, {"units": "1"}, confidence)
        | with_interval("change", axis, change, change_interval, {"units": "1"}, confidence)
        | {"unfiltered_force": ((), unfiltered, newton)}
        | {"cell": cell, "conditional": int(parts.conditional), "interval_note": parts.note()},
        {axis: scales[axis]},
    )


def _left_out(forces: xr.Dataset, parts: Parts) -> np.ndarray:
    """Return logarithms (part, cutoff_wavelength) of the ratio of all parts but one.

    It is the mean over realizations of the ratio of forces of the contacts that are left.
    """
    dimensions = ("realization", *CONTACTS)
    left_out = []
    for part in range(len(parts.correlation)):
        kept = xr.DataArray(parts.of_contact != part, dims=dimensions)
        filtered, unfiltered = (
            forces[name].where(kept).mean(CONTACTS)
            for name in ("pull_off_force", "unfiltered_pull_off_force")
        )
        left_out.append(np.log((filtered / unfiltered).mean("realization").values))
    return np.array(left_out)


def _changes(ratio: np.ndarray, interval: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return |ratio - 1| (cutoff,), and the least and the greatest within an interval (cutoff, 2).

    A ratio without an interval among others that have one is the same in all parts, and the change
    known; without any the interval of the change is NaN.
    """
    if not np.isnan(interval).all():
        interval = np.where(np.isnan(interval), ratio[:, None], interval)
    ends = np.abs(interval - 1)
    least = np.where((interval[:, 0] < 1) & (interval[:, 1] > 1), 0.0, ends.min(axis=-1))
    return np.abs(ratio - 1), np.stack([least, ends.max(axis=-1)], axis=-1)


def _edges(curves: xr.Dataset, tolerance: float) -> dict[str, Any]:
    """Return the variables EDGE of all curves, over the dimensions of their cells."""
    dimensions, shape = curves.cell.dims, curves.cell.shape
    edges = [
        described_edge(_curve(curves.isel(dict(zip(dimensions, place, strict=True)))), tolerance)
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


def _curve(one: xr.Dataset) -> Curve:
    """Return the curve of one surface or of all, at the cutoffs of its side."""
    side = str(one.side.values)
    known = one.dropna("cutoff_wavelength", subset=["change"])
    known = known.sortby("cutoff_wavelength", ascending=side == "small")
    changes = np.concatenate([known.change.values[None], known.change_interval.values.T])
    return Curve(side, float(one.cell), known.cutoff_wavelength.values, changes)


def _pooled(curves: xr.Dataset, tolerance: float) -> dict[str, Any]:
    """Return mean change and edge of all surfaces, at the cutoffs that all have.

    The ends of its interval are the means of the ends of the surfaces. As these are independent,
    that is wider than it need be.
    """
    mean = curves[["change", "change_interval"]].mean("surface", skipna=False, keep_attrs=True)
    mean = mean.assign(cell=curves.cell.min("surface"))
    edges = {f"pooled_{name}": edge for name, edge in _edges(mean, tolerance).items()}
    return edges | {f"pooled_{name}": mean[name] for name in ("change", "change_interval")}
