"""Asperities: the number of patches that carry the pull-off force, and their extent."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_share
from hardcontact.inference.edges import POOLED
from hardcontact.report.figures import drawing, style, tables

TITLE = "The asperities that carry the force"
CHAPTER = "5. Asperities"
CAPTION = """\
The pixels that carry most of the pull-off force form patches. (a) Share of the force on the
largest patch, (b) on the two largest. (c) Number of patches, (d) diameter of the circle that holds
as much of the force. Symbols: median over contacts; bands: between quartiles. Dashed in (d):
published, 1.8 µm.

Contact is plastic; contacts are a sample on all scans. Pixels that touch at a side or a corner
belong to one patch. Dotted: half of the force; the paper says that on MCD and NCD most of it comes
from one or two asperities. The circle of (d) is about the centre of force. Black lines in (d): the
same diameter for a smooth sphere on a plane (solid), and √(2Rρ) (dash-dotted). The paper compares
√(2Rρ), the interaction radius, with the long edge of the critical band. Grey line and band: this
edge as computed for all substrates at the range of Fig. 6, with its
{{ inference.confidence | percent }} interval. Drawn from asperities.nc, edges.nc and
resources/paper/parameters.csv.
"""

MICROMETRE = 1000  # nm
QUARTILES = {"low": 0.25, "value": 0.5, "high": 0.75}
QUANTITIES = {  # title, axis, unit, printed unit
    "largest_share": ("largest patch", "share of the force", "1", 1),
    "two_largest_share": ("two largest patches", "share of the force", "1", 1),
    "patch_count": ("patches with {share:g} % of the force", "number of patches", "1", 1),
    "extent": ("diameter that holds {share:g} % of the force", "length (µm)", "nm", MICROMETRE),
}


def draw(
    asperities: xr.Dataset, edges: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw the force on (a) the largest patch and (b) two, (c) their number, (d) their extent.

    The table has the median over contacts with its quartiles `low` and `high`.
    """
    figure = drawing.create(5.2, asperities)
    grid = figure.subplots(2, 2, sharex=True)
    share = asperities.attrs["share"]
    frames = []
    for letter, axes, (name, (title, label, unit, printed)) in zip(
        "abcd", grid.ravel(), QUANTITIES.items(), strict=True
    ):
        quartiles = asperities[name].quantile(list(QUARTILES.values()), ["scan", "contact"])
        curves = quartiles.assign_coords(quantile=list(QUARTILES)).to_dataset("quantile")
        frames.append(tables.computed_rows(curves, panel=letter, quantity=name, unit=unit))
        for look, curve in style.iterate_surfaces(
            (curves / printed).assign(label=asperities["label"])
        ):
            style.fill_interval(axes, curve, "rho", look["color"])
            axes.plot(curve["rho"], curve["value"], label=str(curve["label"].item()), **look)
        axes.set_ylabel(label)
        style.label_panel(axes, letter, title.format(share=100 * share))
    for axes in grid[0]:
        axes.axhline(0.5, color="0.4", lw=0.8, ls=":", label="half of the force (a, b)")
        axes.set_ylim(0, 1)
    frames.append(_draw_smooth(grid[1, 1], asperities))
    frames.append(_draw_critical(grid[1, 1], edges, published_constants))
    for axes in grid[1]:
        axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    entries = style.legend_entries((grid[0, 0], grid[1, 1]))
    entries["bands: middle half of contacts"] = Patch(color="0.3", alpha=style.OPACITY, lw=0)
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=4)
    return tables.tidy_table(frames, asperities, "rho"), figure


def _draw_smooth(axes: Axes, asperities: xr.Dataset) -> pd.DataFrame:
    """Draw lengths (µm) against rho for a smooth sphere on a plane.

    The attraction there falls with the distance r from the apex as exp(-r²/(2Rρ)).
    """
    radius = np.sqrt(2 * asperities.attrs["sphere_radius"] * asperities["rho"])
    extent = 2 * radius * np.sqrt(-np.log(1 - asperities.attrs["share"]))
    frames = []
    for name, lengths, label, dashes in (
        ("smooth_extent", extent, "smooth sphere on a plane (d)", "-"),
        ("interaction_radius", radius, "interaction radius √(2Rρ) (d)", "-."),
    ):
        look: style.Look = {"color": "black", "lw": 0.9, "ls": dashes, "label": label}
        axes.plot(lengths["rho"], lengths / MICROMETRE, **look)
        frames.append(tables.computed_rows(lengths, panel="d", quantity=name, unit="nm"))
    return pd.concat(frames)


def _draw_critical(
    axes: Axes, edges: xr.Dataset, published_constants: pd.DataFrame
) -> pd.DataFrame:
    """Draw the long edge (µm) of the mean force, computed and published."""
    pooled_band = edges.sel(side="large", group=POOLED)
    edge = tables.value_and_bounds(pooled_band, "edge")
    value, low, high = np.array([edge["value"], edge["low"], edge["high"]]) / MICROMETRE
    published = tables.published_edge(published_constants, "large")
    confidence = format_share(edges.attrs["confidence"])
    axes.axhline(value, color="0.4", lw=1.0, label="long edge $λ_L$ (d)")
    if np.isfinite([low, high]).all():
        axes.axhspan(low, high, color="0.85", zorder=0, label=f"its {confidence} interval (d)")
    look: style.Look = {"color": "0.4", "lw": 1.0, "ls": "--", "label": "published $λ_L$ (d)"}
    axes.axhline(published / MICROMETRE, **look)
    name = "edge"
    published_row = tables.quantity_rows("d", name, "nm", "published", value=published)
    return pd.concat([tables.quantity_rows("d", name, "nm", **edge), published_row])
