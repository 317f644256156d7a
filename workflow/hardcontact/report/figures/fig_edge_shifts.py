"""The effect of plasticity and of a long range of adhesion on the short edge of the band."""

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_share
from hardcontact.report.figures import drawing, panels, style


def draw(edge_shifts: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw force ratios and short edges, a column for each contact model and range of adhesion."""
    edges = edge_shifts.sel(side="short")
    cases = [(model, rho) for model in edges["contact_model"].values for rho in edges["rho"].values]
    figure = drawing.create_figure(4.4, edge_shifts)
    grid = figure.subplots(
        2, len(cases), sharex=True, sharey="row", height_ratios=(3, 1.5), squeeze=False
    )
    published, _ = panels.published_band(published_constants)
    for letter, (model, rho), (ratio_panel, edge_panel) in zip("abcd", cases, grid.T, strict=True):
        _draw_case(ratio_panel, edge_panel, edges.sel(contact_model=model, rho=rho))
        for axes in (ratio_panel, edge_panel):
            axes.axvline(published, **style.PUBLISHED_LOOK)
        style.label_panel(ratio_panel, letter, f"{model}, ρ = {rho:g} nm")
    # Intervals over two or three masters would stretch the axis over many decades.
    ratios = edges["filtered_force_ratio"]
    grid[0, 0].set_ylim(ratios.min() / 2, ratios.max() * 2)
    grid[0, 0].set_ylabel("force / unfiltered force")
    tolerance = format_share(edge_shifts.attrs["tolerance"])
    confidence = format_share(edge_shifts.attrs["confidence"])
    handles = [
        *style.surface_handles(edge_shifts),
        Line2D([], [], label="averaged change", **style.AVERAGED_LOOK),
        Line2D([], [], label=f"published short edge: {published:g} nm", **style.PUBLISHED_LOOK),
        Line2D([], [], lw=1.4, color="0.3", label=f"{confidence} interval (bars)"),
        Patch(label=f"change below {tolerance}", **panels.UNCHANGED_LOOK),
        Line2D([], [], ls="none", marker="<", ms=5, color="0.3", label="beyond the cutoffs"),
    ]
    style.legend_above(figure, handles)
    return figure


def _draw_case(ratio_panel: Axes, edge_panel: Axes, edges: xr.Dataset) -> None:
    """Draw the ratios and edges of one contact model at one range."""
    ratio = panels.value_and_interval(edges, "filtered_force_ratio")
    ratio = ratio.dropna("cutoff_wavelength", how="all")
    panels.draw_ratios(ratio_panel, ratio, edges.attrs["tolerance"])
    ratio_panel.set_yscale("log")
    style.label_logarithmic(ratio_panel.yaxis, digits=(1, 2, 5))
    first_cutoff, last_cutoff = ratio["cutoff_wavelength"].values[[0, -1]]
    edge_rows = panels.value_and_interval(edges, "edge").clip(first_cutoff, last_cutoff)
    # A missing edge lies beyond the last cutoff.
    edge_rows["value"] = edge_rows["value"].fillna(last_cutoff)
    panels.draw_edges(edge_panel, edge_rows, edges["label"], {"<": first_cutoff, ">": last_cutoff})
    edge_panel.set_xlabel("cutoff wavelength (nm)")
