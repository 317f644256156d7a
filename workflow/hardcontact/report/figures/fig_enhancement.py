"""The effect of plasticity and of a long range of adhesion on the short edge of the band."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_share
from hardcontact.inference.edges import POOLED
from hardcontact.report.figures import drawing, style, tables

TITLE = "The short edge with and without plasticity and a long range"
CHAPTER = "6. Scales"
CAPTION = """\
Force without roughness below a cutoff, relative to the force with all roughness. Contact is rigid
(a, b) or plastic (c, d), at a short (a, c) or the published (b, d) range of adhesion ρ. Below: the
short edge of the critical band, where the force has changed by {{ scales.tolerance | percent }}.

Dashed: 43 nm, published. The paper argues that a long range and plasticity enhance each other, so
that shorter wavelengths do not matter. A rigid sphere touches in one pixel. Bars:
{{ inference.confidence | percent }} interval over realizations. Arrows: no edge above the shortest
cutoff. Contacts and pixels are those of the sets of substitutes. Drawn from enhancement.nc and
resources/paper/parameters.csv.
"""

COLUMNS = [
    "panel", "group", "label", "basis", "origin", "quantity", "contact_model", "rho",
    "cutoff_wavelength", *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(enhancement: xr.Dataset, published_constants: pd.DataFrame) -> tuple[pd.DataFrame, Figure]:
    """Draw force ratios and short edges of every contact model and range of adhesion.

    The table has the force ratio (1) by surface and cutoff (nm), and the short edge (nm) by group.
    """
    bands = enhancement.sel(side="small")
    cases = [(model, rho) for model in bands["contact_model"].values for rho in bands["rho"].values]
    figure = drawing.create(4.4, enhancement)
    grid = figure.subplots(
        2, len(cases), sharex=True, sharey="row", height_ratios=(3, 1.5), squeeze=False
    )
    edge = tables.published_edge(published_constants, "small")
    frames = []
    for letter, (model, rho), (ratio_panel, edge_panel) in zip("abcd", cases, grid.T, strict=True):
        band = bands.sel(contact_model=model, rho=rho)
        ratio = tables.value_and_interval(band, "filtered_force_ratio").dropna(
            "cutoff_wavelength", how="all"
        )
        edges = tables.value_and_interval(band, "edge")
        _draw_ratios(ratio_panel, ratio, enhancement.attrs["tolerance"])
        _draw_edges(edge_panel, edges, ratio["cutoff_wavelength"].values, bands)
        for axes in (ratio_panel, edge_panel):
            axes.axvline(edge, **style.PUBLISHED_RANGE)
        edge_panel.set_xlabel("cutoff (nm)")
        style.label_panel(ratio_panel, letter, f"{model}, ρ = {rho:g} nm")
        columns = {"panel": letter, "contact_model": model, "rho": rho}
        rows = tables.computed_rows(ratio, quantity="filtered_force_ratio", unit="1", **columns)
        frames.append(rows.rename(columns={"surface": "group"}))
        frames.append(tables.computed_rows(edges, quantity="edge", unit="nm", **columns))
    grid[0, 0].set_ylabel("pull-off force / unfiltered")
    handles = [
        *style.surface_handles(enhancement),
        Line2D([], [], color="black", marker="h", label="mean change of all"),
        Line2D([], [], label=f"published: {edge:g} nm", **style.PUBLISHED_RANGE),
        Patch(color="0.88", label=f"change below {format_share(enhancement.attrs['tolerance'])}"),
    ]
    style.legend_above(figure, handles)
    return tables.label_rows(frames, enhancement, COLUMNS, "group"), figure


def _draw_ratios(axes: Axes, ratio: xr.Dataset, tolerance: float) -> None:
    """Draw the force ratio of each surface against cutoff (nm)."""
    axes.axhspan(1 - tolerance, 1 + tolerance, color="0.88", zorder=0, lw=0)
    for look, curve in style.iterate_surfaces(ratio):
        style.draw_bars(axes, curve["cutoff_wavelength"], curve, elinewidth=0.7, ms=3, **look)
    axes.set(xscale="log", yscale="log")
    style.label_logarithmic(axes.yaxis, digits=(1, 2, 5))


def _draw_edges(axes: Axes, edges: xr.Dataset, cutoffs: np.ndarray, bands: xr.Dataset) -> None:
    """Draw the short edge (nm) of each group, or an arrow if it lies below the first cutoff."""
    looks = style.looks(bands["surface"].values) | {POOLED: {"color": "black", "marker": "h"}}
    labels = bands["label"].to_series().to_dict() | {POOLED: "mean of all"}
    for row, (group, look) in enumerate(looks.items()):
        edge = edges.sel(group=group)
        axes.plot([edge["low"], edge["high"]], [row, row], color=look["color"], lw=1)
        value = edge["value"].item()
        if value < cutoffs[0]:
            axes.plot(cutoffs[0], row, marker="<", color=look["color"], ms=5)
        else:
            axes.plot(value, row, ms=4, **look)
    axes.set_yticks(range(len(looks)), [labels[group] for group in looks])
    axes.set_ylim(len(looks) - 0.5, -0.5)
    style.label_logarithmic(axes.xaxis, digits=(1, 2, 5))
