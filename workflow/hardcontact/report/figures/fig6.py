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
from hardcontact.inference.edges import POOLED, last_cutoff
from hardcontact.report.figures import drawing, style, tables

TITLE = "Fig. 6: the length scales that matter"
CHAPTER = "6. Scales"
CAPTION = """\
Mean pull-off force after all roughness (a) below a short or (b) above a long cutoff is removed,
relative to that with all roughness. Middle: its change; black: mean over all substrates. Lower: the
cutoff at which the change exceeds {{ scales.tolerance | percent }}. Dashed: published, 43 nm and
1.8 µm. Hatched: artificial roughness.

Lines and symbols: mean over realizations, each a scan with artificial roughness added.
Bars: its {{ inference.confidence | percent }} interval; the axis ends a decade beyond the symbols.
Intervals show how realizations on one set of scans differ. The figure of the sets has intervals
over many sets. Grey: changes up to the tolerance. An edge lies between two computed cutoffs, or
between the first of them and the end of the unfiltered spectrum. An arrow shows that it lies
beyond the last computed cutoff. Hatched: wavelengths below {{ scales.small.transition }} and above
{{ scales.large.transition }}, where roughness made from the spectrum replaces that of the scan, as
in the paper. Long edges above {{ scales.large.transition }} come from this artificial roughness
alone. Drawn from scales.nc, edges.nc and resources/paper/parameters.csv.
"""

PUBLISHED_LINE: style.Look = {"color": "0.25", "lw": 1.0, "ls": "--"}
COLUMNS = [
    "side", "group", "label", "basis", "origin", "quantity", "cutoff_wavelength",
    *tables.VALUE_COLUMNS, "beyond",
]  # fmt: skip
NUMBER_COLUMNS = ["value", "low", "high"]


def draw(
    edges: xr.Dataset, scales: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 6: pull-off force of filtered relative to unfiltered surfaces.

    The table has `filtered_force_ratio` and `filtered_force_change`, the magnitude of this ratio
    minus one, against `cutoff_wavelength` (nm), and the edges. Numbers beyond the last computed
    cutoff are empty; the column `beyond` lists which of value, low and high these are.
    """
    figure = drawing.create(6.2, edges)
    grid = figure.subplots(3, 2, sharex="col", sharey="row", height_ratios=(3, 1.8, 1.5))
    frames = []
    published_edges = {
        side: tables.published_edge(published_constants, side) for side in style.REMOVED_TITLES
    }
    for letter, side, column in zip("ab", published_edges, grid.T, strict=True):
        published_edge = published_edges[side]
        side_band = edges.sel(side=side)
        curves = {
            name: tables.value_and_interval(side_band, name).dropna("cutoff_wavelength", how="all")
            for name in ("filtered_force_ratio", "filtered_force_change")
        }
        end_cutoff = last_cutoff(side_band["filtered_force_ratio"], side)
        edge_rows = tables.number_rows(tables.value_and_interval(side_band, "edge"))
        # A missing edge is drawn at the last cutoff, and empty in the table.
        edge_rows["value"] = edge_rows["value"].fillna(end_cutoff)
        _draw_ratios(column[0], curves["filtered_force_ratio"], edges.attrs["tolerance"])
        _draw_changes(column[1], curves["filtered_force_change"], edges)
        _draw_edges(column[2], edge_rows, side_band, end_cutoff)
        transition = float(scales["transition"].sel(side=side))
        artificial = (0.0, transition) if side == "small" else (transition, np.inf)
        for axes in column:
            axes.axvline(published_edge, zorder=1, **PUBLISHED_LINE)
            axes.label_outer()
            style.shade_artificial(axes, [artificial])
        style.label_panel(column[0], letter, style.REMOVED_TITLES[side])
        for name, curve in curves.items():
            rows = tables.computed_rows(curve, quantity=name, unit="1", side=side)
            frames.append(rows.rename(columns={"surface": "group"}))
        published = pd.DataFrame(
            [{"group": POOLED, "origin": "published", "value": published_edge}]
        )
        rows = pd.concat([_edge_rows(edge_rows, end_cutoff), published])
        frames.append(rows.assign(quantity="edge", unit="nm", side=side))
    for row, digits in ((grid[0], (1, 2, 3, 5)), (grid[1], (1,))):
        style.end_near_values(row)
        for axes in row:
            style.label_logarithmic(axes.yaxis, digits=digits)
    grid[0, 0].set_ylabel(f"pull-off force / unfiltered, at ρ = {scales.attrs['rho']:g} nm")
    style.legend_above(figure, _legend_handles(edges, *published_edges.values()))
    figure.align_ylabels(grid[:2, 0])
    return tables.label_rows(frames, edges, COLUMNS, "group"), figure


def _edge_rows(edges: pd.DataFrame, end_cutoff: float) -> pd.DataFrame:
    """Return the rows with empty numbers at the last cutoff, and their names in `beyond`."""
    is_beyond = np.isclose(edges[NUMBER_COLUMNS], end_cutoff)
    names = [", ".join(np.array(NUMBER_COLUMNS)[row]) for row in is_beyond]
    numbers = edges[NUMBER_COLUMNS].mask(is_beyond)
    return edges.assign(**numbers, beyond=names, origin="computed")


def _looks(edges: xr.Dataset) -> dict[str, style.Look]:
    """Return colour and marker of each group: a surface, or all surfaces pooled (black)."""
    return {**style.looks(edges["surface"].values), POOLED: {"color": "black", "marker": "h"}}


def _draw_ratios(axes: Axes, ratio: xr.Dataset, tolerance: float) -> None:
    """Draw ratio against cutoff (nm), and the tolerance in grey."""
    axes.axhspan(1 - tolerance, 1 + tolerance, color="0.88", zorder=0, lw=0)
    for look, curve in style.iterate_surfaces(ratio):
        style.draw_bars(axes, curve["cutoff_wavelength"], curve, elinewidth=0.7, **look)
    axes.set(xscale="log", yscale="log")
    style.label_logarithmic(axes.xaxis, digits=(1, 2, 5))


def _draw_changes(axes: Axes, change: xr.Dataset, edges: xr.Dataset) -> None:
    """Draw |ratio - 1| in percent against cutoff (nm), and its mean over the substrates."""
    percent = change / style.PERCENT
    cutoffs = percent["cutoff_wavelength"]
    looks = _looks(edges)
    pooled_look = looks.pop(POOLED)
    for surface, look in looks.items():
        axes.plot(cutoffs, percent["value"].sel(group=surface), color=look["color"], lw=0.8)
    style.draw_bars(axes, cutoffs, percent.sel(group=POOLED), elinewidth=0.9, lw=1.8, **pooled_look)
    axes.axhline(edges.attrs["tolerance"] / style.PERCENT, color="0.6", lw=0.8, zorder=0)
    axes.set(yscale="log", ylabel="change (%)")


def _draw_edges(axes: Axes, edges: pd.DataFrame, side_band: xr.Dataset, end_cutoff: float) -> None:
    """Mark the edge (nm) of each group with its interval, arrows beyond the last."""
    looks = _looks(side_band)
    labels = side_band["label"].to_series().to_dict() | {POOLED: "mean of all"}
    arrow = ">" if side_band["side"].item() == "small" else "<"
    numbers = edges.set_index("group")[NUMBER_COLUMNS]
    for row_number, (group, look) in enumerate(looks.items()):
        value, low, high = numbers.loc[[group]].to_numpy()[0]
        axes.plot([low, high], [row_number] * 2, color=look["color"], lw=1.4)
        if np.isclose([value, low, high], end_cutoff).any():
            axes.plot(
                end_cutoff, row_number, arrow, color=look["color"], ms=5, mew=0, clip_on=False
            )
        if not np.isclose(value, end_cutoff):
            axes.plot(value, row_number, **look)
    axes.set_yticks(range(len(looks)), [labels[group] for group in looks])
    axes.set(ylim=(len(looks) - 0.4, -0.6), xlabel="cutoff wavelength (nm)")


def _legend_handles(edges: xr.Dataset, short: float, long: float) -> list[Artist]:
    """Return one entry a group and one for each kind of line."""
    confidence = format_share(edges.attrs["confidence"])
    tolerance = format_share(edges.attrs["tolerance"])
    return [
        *style.surface_handles(edges),
        Line2D([], [], lw=1.8, label="mean change of all", **_looks(edges)[POOLED]),
        Line2D([], [], lw=1.4, color="0.3", label=f"{confidence} interval (bars)"),
        Patch(color="0.88", lw=0, label=f"change below {tolerance}"),
        Line2D([], [], label=f"published: {short:g} and {long:g} nm", **PUBLISHED_LINE),
        Patch(label="artificial roughness", **style.ARTIFICIAL_LOOK),
        Line2D([], [], ls="none", marker=">", ms=5, color="0.3", label="beyond the last cutoff"),
    ]
