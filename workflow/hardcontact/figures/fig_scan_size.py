"""How large a scan must be: force and long edge on windows and on surfaces, and the rule."""

from collections.abc import Iterator

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables

TITLE = "How large a scan must be"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) Mean force on mirrored windows over that on the random surfaces they were cut out of,
against the side of the window; lines: the rule. (b) The same by the rule and computed. (c) Side
of a scan on which the force is too large by a factor. (d) Long edge of the band, from mirrored
windows (filled) and from whole surfaces (hollow).

All of it was computed once, with the settings of the paper (resources/validation). Windows are
cut out of large random surfaces, levelled, mirrored and brought into contact as the paper does
with its scans. The rule is a power law of 2√(2Rσ) over the side of the scan, of the roll-off
over it, and of σ/ρ, σ the rms height, R the radius of the sphere and ρ the range of adhesion.
It was fitted to random self-affine surfaces, not to these; bars in (a): 95 % intervals over
realizations. (b) shows all ranges; grey: the random surfaces, each from a rule fitted without
it. The long edge is the wavelength above which removing roughness changes the mean force by 10
%; bars, 95 % intervals between the cutoffs that were computed, drawn to the shortest cutoff or
to the longest wave of the surface where they are open; an open edge stands at its bound, with
an arrow; grey, the longest wave of a mirrored window. In (a) and (d) the surfaces of one size
stand beside each other. Dashed: the scans of the paper. Drawn from scan_size.nc.
"""

BETWEEN = ("trial", "scan_size", "rho", "predicted", "mirrored", "status")  # columns
ARROW = 1.6  # length of an arrow, as a factor of the bound
OF_SCAN: style.Look = {"color": style.PUBLISHED, "lw": 0.8, "ls": "--", "zorder": 1}


def _table(scan_size: xr.Dataset) -> pd.DataFrame:
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
    of_sizes = {
        "long_edge": ("nm", _edges(scan_size)),
        "force_over_largest": ("1", on_largest.assign(mirrored=scan_size["mirrored"])),
    }
    frames = [
        tables.computed_rows(surfaces, panel="a", quantity="excess", unit="1"),
        tables.computed_rows(known, panel="b", quantity="excess", unit="1"),
        tables.drawn_rows(scan_size, ("c", "size_needed", "nm")),
        *(
            tables.computed_rows(values, panel="d", quantity=name, unit=unit)
            .rename(columns={"edge_size": "scan_size"})
            .assign(rho=scan_size.attrs["rho"])
            for name, (unit, values) in of_sizes.items()
        ),
    ]
    return tables.tidy(frames, scan_size, *BETWEEN)


def _edges(scan_size: xr.Dataset) -> xr.Dataset:
    """Return long edges as `value`, `low` and `high`, those that are open by their bound."""
    edges = tables.bounded(scan_size, "long_edge")
    return edges.assign(
        value=edges["value"].fillna(scan_size["long_edge_bound"]),
        mirrored=scan_size["mirrored"],
        status=scan_size["long_edge_status"],
        at_least=scan_size["long_edge_at_least"],
    )


def draw(scan_size: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) the excess against the scan, (b) the rule, (c) sizes needed, (d) long edges."""
    figure = drawing.create(5.4, scan_size)
    (sizes, rule), (needed, edges) = figure.subplots(2, 2)
    at_range = scan_size.sel(rho=scan_size.attrs["rho"], method="nearest")
    _draw_sizes(sizes, at_range)
    style.end_near_values([sizes])
    style.label_panel(sizes, "a", f"mirrored windows, ρ = {at_range['rho']:g} nm; lines: rule")
    _draw_rule(rule, scan_size)
    style.label_panel(rule, "b", "force over that on a large surface, all ranges")
    for look, of_surface in style.by_surface(scan_size):
        needed.plot(scan_size["rho"], of_surface["size_needed"] / 1e3, ms=3, lw=0.6, **look)
    needed.axhline(scan_size.attrs["scan_size"] / 1e3, **OF_SCAN)
    needed.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)",
               ylabel="scan needed (µm)")  # fmt: skip
    style.label_panel(
        needed,
        "c",
        f"scan on which the force is {scan_size.attrs['allowed_excess']:g} times as large",
    )
    _draw_edges(edges, scan_size)
    style.label_panel(edges, "d", f"long edge, ρ = {scan_size.attrs['rho']:g} nm")
    for axes in (sizes, rule, needed, edges):
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.legend_above(figure, style.surface_handles(scan_size, ls="none"))
    return _table(scan_size), figure


def _draw_sizes(axes: Axes, at_range: xr.Dataset) -> None:
    """Draw the excess of all surfaces, with intervals, and that of the rule as lines."""
    excess = tables.bounded(at_range, "excess").assign(predicted=at_range["predicted_excess"])
    sizes = at_range["scan_size"] / 1e3
    for look, one, factor in _beside(excess):
        style.draw_bars(axes, factor * sizes, one, ls="none", ms=3, elinewidth=0.6, **look)
        axes.plot(sizes, one["predicted"], color=look["color"], lw=0.7)
    axes.axvline(at_range.attrs["scan_size"] / 1e3, **OF_SCAN)
    axes.set(xscale="log", yscale="log", xlabel="side of the scan (µm)",
             ylabel="force over that on a large surface")  # fmt: skip


def _beside(data: xr.Dataset) -> Iterator[tuple[style.Look, xr.Dataset, float]]:
    """Yield each surface's look and data, and the factor that puts its places beside others'."""
    factors = np.geomspace(0.88, 1 / 0.88, data.sizes["surface"])
    for (look, of_surface), factor in zip(style.by_surface(data), factors, strict=True):
        yield look, of_surface, float(factor)


def _draw_rule(axes: Axes, scan_size: xr.Dataset) -> None:
    """Draw predicted against computed excess, of random surfaces in grey."""
    known, by_rule = (scan_size[name] for name in ("known_excess", "predicted_known_excess"))
    axes.plot(known.values.ravel(), by_rule.values.ravel(), ".", color="0.75", ms=2)
    for look, of_surface in style.by_surface(scan_size):
        measured, predicted = (
            of_surface[name].values.ravel() for name in ("excess", "predicted_excess")
        )
        axes.plot(measured, predicted, ls="none", ms=3, **look)
    ends = [1.0, float(known.max())]
    axes.plot(ends, ends, color="0.5", lw=0.7, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="computed", ylabel="by the rule")


def _draw_edges(axes: Axes, scan_size: xr.Dataset) -> None:
    """Draw long edges on windows and, hollow, on whole surfaces; open ends reach to the limits.

    The grey line is the longest wave of a mirrored window. Surfaces stand beside each other.
    """
    edges, period = _edges(scan_size), scan_size["period"]
    shortest = scan_size["cutoff_wavelength"].min()
    ends = edges.assign(low=edges["low"].fillna(shortest), high=edges["high"].fillna(period))
    in_micrometres = ends[["value", "low", "high"]] / 1e3
    edges, sizes = edges.assign(in_micrometres), edges["edge_size"] / 1e3
    for look, of_surface, factor in _beside(edges):
        for mirrored, fill in ((1, look["color"]), (0, "white")):
            one = of_surface.sel(edge_size=edges["mirrored"] == mirrored)
            one = one.assign(place=factor * (one["edge_size"] / 1e3))
            of_kind = {**look, "mfc": fill, "ls": "none", "ms": 3.5, "elinewidth": 0.7}
            style.draw_bars(axes, one["place"], one, **of_kind)
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
