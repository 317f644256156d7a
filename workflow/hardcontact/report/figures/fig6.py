"""Fig. 6: length scales of roughness that change the pull-off force."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_share
from hardcontact.inference.edges import MEAN_GROUP, last_cutoff
from hardcontact.report.figures import drawing, panels, style
from hardcontact.report.figures.panels import published_edge, value_and_interval

PUBLISHED_LINE: style.Look = {"color": "0.25", "lw": 1.0, "ls": "--"}
TOLERANCE_LINE: style.Look = {"color": "0.25", "lw": 1.0, "zorder": 0}
CROSSING: style.Look = {"ls": "none", "marker": "o", "mfc": "white", "mew": 1.3, "ms": 5.5}
#: Lowest and highest change of the ratio drawn, relative to the tolerance, whose band stays wide.
SHOWN_TOLERANCES = (-3, 7)
#: Smallest change drawn, in per cent: a thousandth of the tolerance. Without waves above a cutoff
#: the change is zero but for rounding.
SMALLEST_CHANGE = 0.01


def draw(edges: xr.Dataset, scales: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw Fig. 6: ratios, changes and edges, in one column for each side of the band."""
    figure = drawing.create(6.2, edges)
    grid = figure.subplots(3, 2, sharex="col", sharey="row", height_ratios=(2.4, 2.4, 1.5))
    published_edges = {
        side: published_edge(published_constants, side) for side in style.REMOVED_TITLES
    }
    for letter, side, column in zip("ab", published_edges, grid.T, strict=True):
        _draw_side(column, edges.sel(side=side))
        transition = float(scales["transition"].sel(side=side))
        artificial = (0.0, transition) if side == "short" else (transition, np.inf)
        for axes in column:
            axes.axvline(published_edges[side], zorder=1, **PUBLISHED_LINE)
            axes.label_outer()
            panels.shade_artificial(axes, [artificial])
        style.label_panel(column[0], letter, style.REMOVED_TITLES[side])
    style.end_near_values(grid[1])
    for axes in grid[1]:
        style.label_logarithmic(axes.yaxis, digits=(1,))
    low, high = edges.attrs["tolerance"] * np.array(SHOWN_TOLERANCES)
    grid[0, 0].set(yscale="linear", ylim=(1 + low, 1 + high))
    grid[0, 0].set_ylabel(f"pull-off force / unfiltered\nat ρ = {scales.attrs['rho']:g} nm")
    handles = _legend_handles(edges, *published_edges.values())
    if not any(line.get_marker() in ("<", ">") for axes in grid[2] for line in axes.lines):
        handles.pop()  # No edge and no interval reaches beyond the last cutoff.
    style.legend_above(figure, handles)
    figure.align_ylabels(grid[:2, 0])
    return figure


def _draw_side(column: np.ndarray, edges: xr.Dataset) -> None:
    """Draw ratios, changes and edges of one side of the band.

    An edge beyond the last cutoff is missing in the dataset, and drawn at this cutoff.
    """
    ratio, change = (
        value_and_interval(edges, name).dropna("cutoff_wavelength", how="all")
        for name in ("filtered_force_ratio", "filtered_force_change")
    )
    tolerance = edges.attrs["tolerance"]
    is_shown = ratio["value"] < 1 + SHOWN_TOLERANCES[1] * tolerance
    panels.draw_ratios(column[0], ratio.assign(ratio[["low", "high"]].where(is_shown)), tolerance)
    _draw_changes(column[1], change / style.PERCENT, tolerance / style.PERCENT)
    side = edges["side"].item()
    end = last_cutoff(edges["filtered_force_ratio"], side)
    edge_rows = value_and_interval(edges, "edge")
    edge_rows["value"] = edge_rows["value"].fillna(end)
    arrows = {">" if side == "short" else "<": end}
    panels.draw_edges(column[2], edge_rows, edges["label"], arrows)
    column[2].set_xlabel("cutoff wavelength (nm)")
    _mark_crossings(column, edges, ratio["value"])


def _mark_crossings(column: np.ndarray, edges: xr.Dataset, ratio: xr.DataArray) -> None:
    """Mark where each curve crosses the tolerance, and lead from there to the row of the edge."""
    tolerance = edges.attrs["tolerance"]
    looks = style.looks(ratio["surface"].values) | {MEAN_GROUP: style.MEAN_LOOK}
    for group, edge in edges["edge"].dropna("group").to_series().items():
        colour = looks[str(group)]["color"]
        crossings = {column[1]: tolerance / style.PERCENT}
        if group != MEAN_GROUP:
            curve = ratio.sel(surface=group)
            change = np.interp(edge, curve["cutoff_wavelength"], curve) - 1
            crossings[column[0]] = 1 + np.copysign(tolerance, change)
        for axes, height in crossings.items():
            axes.plot(edge, height, mec=colour, zorder=5, **CROSSING)
        for axes in (*crossings, column[2]):
            axes.axvline(edge, color=colour, lw=0.9, ls=":")


def _draw_changes(axes: Axes, change: xr.Dataset, tolerance: float) -> None:
    """Draw |ratio - 1| in percent against cutoff (nm), and its mean over the substrates."""
    cutoffs = change["cutoff_wavelength"]
    surfaces = [group for group in change["group"].values if group != MEAN_GROUP]
    for surface, look in style.looks(surfaces).items():
        axes.plot(cutoffs, change["value"].sel(group=surface), lw=0.8, ms=2.5, **look)
    mean_change = change.sel(group=MEAN_GROUP)
    panels.draw_bars(axes, cutoffs, mean_change, width=0.9, lw=1.8, **style.MEAN_LOOK)
    axes.set(yscale="log", ylabel="change (%)")
    axes.set_ylim(bottom=max(SMALLEST_CHANGE, axes.get_ylim()[0]))
    axes.axhline(tolerance, **TOLERANCE_LINE)


def _legend_handles(edges: xr.Dataset, short: float, long: float) -> list[Artist]:
    """Return one entry per group and one for each kind of line."""
    confidence = format_share(edges.attrs["confidence"])
    tolerance = format_share(edges.attrs["tolerance"])
    return [
        *style.surface_handles(edges),
        Line2D([], [], lw=1.8, label="mean change of all", **style.MEAN_LOOK),
        Line2D([], [], lw=1.4, color="0.3", label=f"{confidence} interval (bars)"),
        Patch(label=f"change below {tolerance}", **panels.UNCHANGED_LOOK),
        Line2D([], [], label=f"edge: crossing of {tolerance}", mec="0.3", **CROSSING),
        Line2D([], [], label=f"published: {short:g} and {long:g} nm", **PUBLISHED_LINE),
        Patch(label="artificial roughness", **style.ARTIFICIAL_LOOK),
        Line2D([], [], ls="none", marker=">", ms=5, color="0.3", label="beyond the last cutoff"),
    ]
