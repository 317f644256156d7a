"""How large a scan must be: force and long edge on windows and on surfaces, and the rule."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import marks, style, tables

COLUMNS = [
    *tables.ROW_COLUMNS, "trial", "scan_size", "rho", "predicted", "mirrored", "status",
    *tables.VALUE_COLUMNS
]  # fmt: skip
ARROW = 1.6  # length of an arrow, as a factor of the bound
OF_SCAN: dict[str, Any] = {"color": style.PUBLISHED, "lw": 0.8, "ls": "--", "zorder": 1}


def table(scan_size: xr.Dataset) -> pd.DataFrame:
    """Return what the figure is drawn from, one row a number.

    Measured and predicted excess on surfaces (panel a, again in b) and on random surfaces (b), and
    the sizes needed (c, nm); long edges (nm) on windows and whole surfaces, and the forces there
    over that on the largest (d). The value of an edge that is open is its bound.
    """
    surfaces = tables.bounded(scan_size, "excess").assign(predicted=scan_size["predicted_excess"])
    known = scan_size[["known_excess", "predicted_known_excess"]].rename(
        known_excess="value", predicted_known_excess="predicted"
    )
    on_largest = tables.bounded(scan_size, "force_over_largest")
    on_largest = on_largest.assign(mirrored=scan_size["mirrored"])
    of_sizes = tables.drawn_rows(
        ("d", "long_edge", "nm", _edges(scan_size)), ("d", "force_over_largest", "1", on_largest)
    ).rename(columns={"edge_size": "scan_size"})
    rows = tables.drawn_rows(
        ("a", "excess", "1", surfaces),
        ("b", "excess", "1", known),
        ("c", "size_needed", "nm", scan_size["size_needed"]),
    )
    rows = pd.concat([rows, of_sizes.assign(rho=scan_size.attrs["rho"])])
    return tables.label_surfaces(rows, scan_size).reindex(columns=COLUMNS).reset_index(drop=True)


def _edges(scan_size: xr.Dataset) -> xr.Dataset:
    """Return long edges as `value`, `low` and `high`, those that are open by their bound."""
    edges = tables.bounded(scan_size, "long_edge")
    return edges.assign(
        value=edges["value"].fillna(scan_size["long_edge_bound"]),
        mirrored=scan_size["mirrored"],
        status=scan_size["long_edge_status"],
        at_least=scan_size["long_edge_at_least"],
    )


@style.print_style()
def draw(scan_size: xr.Dataset) -> Figure:
    """Draw (a) the excess against the scan, (b) the rule, (c) sizes needed, (d) long edges."""
    figure = style.create(5.4)
    (sizes, rule), (needed, edges) = figure.subplots(2, 2)
    at_range = scan_size.sel(rho=scan_size.attrs["rho"], method="nearest")
    _draw_sizes(sizes, at_range)
    style.end_near_values([sizes])
    style.label_panel(sizes, "a", f"ρ = {at_range['rho']:g} nm")
    _draw_rule(rule, scan_size)
    style.label_panel(rule, "b", "rule and computed")
    for surface, look in style.looks(scan_size["surface"].values).items():
        of_surface = scan_size["size_needed"].sel(surface=surface) / 1e3
        needed.plot(scan_size["rho"], of_surface, ms=3, lw=0.6, **look)
    needed.axhline(scan_size.attrs["scan_size"] / 1e3, **OF_SCAN)
    needed.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)",
               ylabel="scan needed (µm)")  # fmt: skip
    style.label_panel(needed, "c", f"for {scan_size.attrs['allowed_excess']:g} times the force")
    _draw_edges(edges, scan_size)
    style.label_panel(edges, "d", f"ρ = {scan_size.attrs['rho']:g} nm")
    for axes in (sizes, rule, needed, edges):
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.legend_above(figure, style.surface_handles(scan_size, ls="none"))
    style.mark_basis(figure, scan_size)
    return figure


def _draw_sizes(axes: Axes, at_range: xr.Dataset) -> None:
    """Draw the excess of all surfaces, with intervals, and that of the rule as lines."""
    excess = tables.bounded(at_range, "excess")
    sizes = at_range["scan_size"] / 1e3
    for surface, look, factor in _beside(at_range):
        one = excess.sel(surface=surface)
        axes.errorbar(
            factor * sizes, one["value"], np.nan_to_num(marks.reach(one)),
            ls="none", ms=3, elinewidth=0.6, **look,
        )  # fmt: skip
        axes.plot(
            sizes, at_range["predicted_excess"].sel(surface=surface), color=look["color"], lw=0.7
        )
    axes.axvline(at_range.attrs["scan_size"] / 1e3, **OF_SCAN)
    axes.set(xscale="log", yscale="log", xlabel="side of the scan (µm)",
             ylabel="force over that on a large surface")  # fmt: skip


def _beside(dataset: xr.Dataset) -> Iterator[tuple[str, dict[str, Any], float]]:
    """Yield each surface, its look, and by what its places are multiplied to be beside others."""
    looks = style.looks(dataset["surface"].values)
    factors = np.geomspace(0.88, 1 / 0.88, len(looks))
    for (surface, look), factor in zip(looks.items(), factors, strict=True):
        yield surface, look, float(factor)


def _draw_rule(axes: Axes, scan_size: xr.Dataset) -> None:
    """Draw predicted against computed excess, of random surfaces in grey."""
    axes.plot(
        scan_size["known_excess"].values.ravel(),
        scan_size["predicted_known_excess"].values.ravel(),
        ".", color="0.75", ms=2,
    )  # fmt: skip
    for surface, look in style.looks(scan_size["surface"].values).items():
        of_surface = scan_size.sel(surface=surface)
        measured, predicted = (
            of_surface[name].values.ravel() for name in ("excess", "predicted_excess")
        )
        axes.plot(measured, predicted, ls="none", ms=3, **look)
    ends = [1.0, float(scan_size["known_excess"].max())]
    axes.plot(ends, ends, color="0.5", lw=0.7, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="computed", ylabel="rule")


def _draw_edges(axes: Axes, scan_size: xr.Dataset) -> None:
    """Draw long edges on windows and, hollow, on whole surfaces; open ends reach to the limits.

    The grey line is the longest wave of a mirrored window. Surfaces stand beside each other.
    """
    edges, period = _edges(scan_size), scan_size["period"]
    shortest = scan_size["cutoff_wavelength"].min()
    ends = edges.assign(low=edges["low"].fillna(shortest), high=edges["high"].fillna(period))
    in_micrometres = ends[["value", "low", "high"]] / 1e3
    edges, sizes = edges.assign(in_micrometres), edges["edge_size"] / 1e3
    for surface, look, factor in _beside(scan_size):
        for mirrored, fill in ((1, look["color"]), (0, "white")):
            of_kind = edges["mirrored"] == mirrored
            one = edges.assign(place=factor * sizes).sel(surface=surface, edge_size=of_kind)
            axes.errorbar(
                one["place"], one["value"], marks.reach(one),
                ls="none", ms=3.5, elinewidth=0.7, mfc=fill, **look,
            )  # fmt: skip
            _draw_open(axes, one.sel(edge_size=one["status"] != "found"), look["color"])
    of_windows = {"edge_size": scan_size["mirrored"] == 1}
    axes.plot(sizes.sel(of_windows), period.sel(of_windows) / 1e3, color="0.7", lw=0.8, zorder=0)
    axes.axvline(scan_size.attrs["scan_size"] / 1e3, **OF_SCAN)
    axes.set(xscale="log", yscale="log", xlabel="side of the scan (µm)",
             ylabel="long edge of the band (µm)")  # fmt: skip


def _draw_open(axes: Axes, edges: xr.Dataset, color: str) -> None:
    """Draw arrows from the bounds of open edges to where the edges lie."""
    lengths = np.where(edges["at_least"], ARROW, 1 / ARROW)
    for place, bound, length in zip(
        edges["place"].values, edges["value"].values, lengths, strict=True
    ):
        axes.annotate(
            "", (place, bound * length), (place, bound),
            arrowprops={"arrowstyle": "-|>", "color": color, "shrinkA": 0},
        )  # fmt: skip
