"""The height of the sphere's apex that follows from measured forces, and from computed ones."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.paper.standoff import STATISTICS
from hardcontact.report.figures import drawing, style, tables

TITLE = "How high measured forces put the sphere"
CHAPTER = "3. Adhesion"
CAPTION = """\
How much higher the published forces put the apex of the sphere than the computed forces do, in rms
heights. (a) At the published work of adhesion W; (b) at the W that fits the four mean forces best
at each range ρ. Solid: from mean forces; dashed: from median forces. Vertical line: the published
range.

Heights of the apex are above the mean planes. The rms height combines sphere and substrate. At
zero, substitute and measured surface keep the sphere at the same height. Above zero, the measured
surface keeps it higher, as rare high protrusions would. Both heights follow from Eq. 2 for a
Gaussian surface, so that the formula's error cancels in part. Contact is plastic. Drawn from
standoff.nc and resources/paper/parameters.csv.
"""

TITLES = {"published": "published $W$", "fitted": "$W$ that fits best at each ρ"}
LINES = {"mean": "-", "median": "--"}
RANGE_LIMITS = (0.5, 15)  # nm, around both ranges that fit
HEIGHT_LIMITS = (-2.5, 8)  # rms heights
COLUMNS = [
    "panel", "surface", "label", "basis", "origin", "quantity", "statistic", "work_source",
    "rho", *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(standoff: xr.Dataset, published_constants: pd.DataFrame) -> tuple[pd.DataFrame, Figure]:
    """Draw the missing height over the range of adhesion at (a) the published and (b) fitted work.

    The table has the missing height relative to the rms height (1), and both heights (nm).
    """
    difference = standoff["height_from_published"] - standoff["height_from_computed"]
    missing_height = (difference / standoff["combined_rms_height"]).rename("missing_height")
    figure = drawing.create(3.2, standoff)
    panels = figure.subplots(1, len(TITLES), sharey=True)
    frames = []
    for letter, axes, (work, title) in zip("ab", panels, TITLES.items(), strict=True):
        _draw_curves(axes, missing_height.sel(work_source=work), standoff)
        style.draw_published_range(axes, published_constants)
        style.label_panel(axes, letter, title)
        for name, unit in (("missing_height", "1"), ("height_from_published", "nm")):
            values = missing_height if name == "missing_height" else standoff[name]
            rows = values.sel(work_source=work)
            frames.append(tables.computed_rows(rows, panel=letter, quantity=name, unit=unit))
    height_from_computed = standoff["height_from_computed"]
    frames.append(
        tables.computed_rows(
            height_from_computed, panel="", quantity="height_from_computed", unit="nm"
        )
    )
    panels[0].set_ylabel("missing height / rms height")
    handles = [
        *style.surface_handles(standoff, marker=""),
        *(
            Line2D([], [], color="0.3", ls=LINES[name], label=f"{name} force")
            for name in STATISTICS
        ),
        Line2D([], [], label="published range", **style.PUBLISHED_RANGE),
    ]
    style.legend_above(figure, handles)
    return tables.label_rows(frames, standoff, COLUMNS), figure


def _draw_curves(axes: Axes, missing_height: xr.DataArray, standoff: xr.Dataset) -> None:
    """Draw the missing height (surface, statistic, rho) of each surface and statistic."""
    colours = style.colours(standoff["surface"].values)
    axes.axhline(0, color="0.6", lw=0.6)
    for surface, colour in colours.items():
        for statistic, line in LINES.items():
            curve = missing_height.sel(surface=surface, statistic=statistic)
            axes.plot(curve["rho"], np.asarray(curve), color=colour, ls=line)
    axes.set(xscale="log", xlabel="range of adhesion ρ (nm)", xlim=RANGE_LIMITS, ylim=HEIGHT_LIMITS)
    style.label_logarithmic(axes.xaxis, digits=(1, 3))
