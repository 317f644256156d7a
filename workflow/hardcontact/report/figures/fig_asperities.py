"""The asperities that carry the pull-off force: their shares, number and extent."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_share
from hardcontact.inference.edges import AVERAGED
from hardcontact.report.figures import drawing, panels, style

MICROMETRE = 1000  # nm
EDGE_INTERVAL: style.Look = {"fc": "0.94", "ec": "0.7", "hatch": r"\\\\", "lw": 0, "zorder": 0}
QUARTILES = {"low": 0.25, "value": 0.5, "high": 0.75}
QUANTITIES = {  # title, axis label, printed unit
    "largest_share": ("strongest asperity", "share of the force", 1),
    "two_largest_share": ("two strongest asperities", "share of the force", 1),
    "asperity_count": ("asperities with {share:g} % of the force", "number of asperities", 1),
    "extent": ("diameter that holds {share:g} % of the force", "length (µm)", MICROMETRE),
}


def draw(asperities: xr.Dataset, edges: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw shares of (a) the strongest and (b) the two strongest, (c) numbers, (d) extents."""
    figure = drawing.create_figure(5.2, asperities)
    grid = figure.subplots(2, 2, sharex=True)
    share = asperities.attrs["share"]
    for letter, axes, (name, (title, label, unit)) in zip(
        "abcd", grid.ravel(), QUANTITIES.items(), strict=True
    ):
        quartiles = asperities[name].quantile(list(QUARTILES.values()), ["scan", "contact"])
        curves = quartiles.assign_coords(quantile=list(QUARTILES)).to_dataset("quantile")
        curves = (curves / unit).assign(label=asperities["label"])
        for look, curve in style.iterate_surfaces(curves):
            panels.draw_band(axes, curve["rho"], curve, look["color"])
            axes.plot(curve["rho"], curve["value"], label=str(curve["label"].item()), **look)
        axes.set_ylabel(label)
        style.label_panel(axes, letter, title.format(share=100 * share))
    for axes in grid[0]:
        axes.axhline(0.5, color="0.4", lw=0.8, ls=":", label="half of the force (a, b)")
        axes.set_ylim(0, 1)
    _draw_smooth(grid[1, 1], asperities)
    _draw_long_edge(grid[1, 1], edges, published_constants)
    for axes in grid[1]:
        axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    entries = style.legend_entries((grid[0, 0], grid[1, 1]))
    spread = Patch(color="0.3", label="half of the contacts (bands)", **style.SPREAD_LOOK)
    style.legend_above(figure, [*entries.values(), spread])
    return figure


def _draw_smooth(axes: Axes, asperities: xr.Dataset) -> None:
    """Draw the extent of the force and the interaction radius (µm) of a smooth sphere."""
    # The attraction falls with the distance r from the apex as exp(-r²/(Dρ)); D is the diameter.
    radius = np.sqrt(2 * asperities.attrs["sphere_radius"] * asperities["rho"])
    extent = 2 * radius * np.sqrt(-np.log(1 - asperities.attrs["share"]))
    for lengths, label, dashes in (
        (extent, "smooth sphere (d)", "-"),
        (radius, r"interaction radius $(D\rho)^{1/2}$ (d)", "-."),
    ):
        look: style.Look = {"color": "black", "lw": 0.9, "ls": dashes, "label": label}
        axes.plot(lengths["rho"], lengths / MICROMETRE, **look)


def _draw_long_edge(axes: Axes, edges: xr.Dataset, published_constants: pd.DataFrame) -> None:
    """Draw the long edge (µm) of the averaged change, and the published edge."""
    averaged_edge = edges.sel(side="long", group=AVERAGED)
    edge = panels.scalar_and_interval(averaged_edge, "edge")
    value, low, high = np.array([edge["value"], edge["low"], edge["high"]]) / MICROMETRE
    _, published = panels.published_band(published_constants)
    confidence = format_share(edges.attrs["confidence"])
    axes.axhline(value, color="0.4", lw=1.0, label="long edge, averaged change (d)")
    if np.isfinite([low, high]).all():
        axes.axhspan(low, high, label=f"its {confidence} interval (d)", **EDGE_INTERVAL)
    label = "long edge, published (d)"
    axes.axhline(published / MICROMETRE, color="0.4", lw=1.0, ls="--", label=label)
