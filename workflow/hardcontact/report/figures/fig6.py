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
from hardcontact.report.figures.values import published_edge, value_and_interval

PUBLISHED_LINE: style.Look = {"color": "0.25", "lw": 1.0, "ls": "--"}
TOLERANCE_LINE: style.Look = {"color": "0.25", "lw": 1.0, "zorder": 0}
#: Smallest change drawn, in per cent: a thousandth of the tolerance. Without waves above a cutoff
#: the change is zero but for rounding.
SMALLEST_CHANGE = 0.01


def draw(edges: xr.Dataset, scales: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw Fig. 6: ratios, changes and edges, in one column for each side of the band."""
    figure = drawing.create(6.2, edges)
    grid = figure.subplots(3, 2, sharex="col", sharey="row", height_ratios=(2.2, 2.6, 1.5))
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
    for row, digits in ((grid[0], (1, 2, 3, 5)), (grid[1], (1,))):
        style.end_near_values(row)
        for axes in row:
            style.label_logarithmic(axes.yaxis, digits=digits)
    grid[0, 0].set_ylabel(f"pull-off force / unfiltered\nat ρ = {scales.attrs['rho']:g} nm")
    style.legend_above(figure, _legend_handles(edges, *published_edges.values()))
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
    panels.draw_ratios(column[0], ratio, tolerance)
    _draw_changes(column[1], change / style.PERCENT, tolerance / style.PERCENT)
    side = edges["side"].item()
    end = last_cutoff(edges["filtered_force_ratio"], side)
    edge_rows = value_and_interval(edges, "edge")
    edge_rows["value"] = edge_rows["value"].fillna(end)
    arrows = {">" if side == "short" else "<": end}
    panels.draw_edges(column[2], edge_rows, edges["label"], arrows)
    column[2].set_xlabel("cutoff wavelength (nm)")


def _draw_changes(axes: Axes, change: xr.Dataset, tolerance: float) -> None:
    """Draw |ratio - 1| in percent against cutoff (nm), and its mean over the substrates."""
    cutoffs = change["cutoff_wavelength"]
    surfaces = [group for group in change["group"].values if group != MEAN_GROUP]
    for surface, look in style.looks(surfaces).items():
        axes.plot(cutoffs, change["value"].sel(group=surface), lw=0.8, ms=2.5, **look)
    mean_change = change.sel(group=MEAN_GROUP)
    panels.draw_bars(axes, cutoffs, mean_change, elinewidth=0.9, lw=1.8, **style.MEAN_LOOK)
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
        Line2D([], [], label=f"change of {tolerance}", **TOLERANCE_LINE),
        Line2D([], [], label=f"published: {short:g} and {long:g} nm", **PUBLISHED_LINE),
        Patch(label="artificial roughness", **style.ARTIFICIAL_LOOK),
        Line2D([], [], ls="none", marker=">", ms=5, color="0.3", label="beyond the last cutoff"),
    ]
