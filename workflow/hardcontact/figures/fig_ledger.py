"""Numbers that others measured, beside what the closed form says of their experiments."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.claims.weighed_experiments import NOT_TRIED
from hardcontact.figures import drawing, style, tables
from hardcontact.insight.experiments import DISTANCE, EXPONENT, FALL, RATIO

#: Titles and axes of the statements, in the order of the panels; whether they are logarithmic.
STATEMENTS = {
    FALL: ("two surfaces", "force on the smoother over that on the rougher surface", True),
    RATIO: ("rough beside smooth", "force over that of a smooth sphere", True),
    EXPONENT: ("two radii", "exponent of the force in the radius, d ln F / d ln R", False),
    DISTANCE: ("distance", "distance of the mean planes in contact (nm)", True),
}
PREDICTED: style.Look = {"lw": 5.0, "solid_capstyle": "butt"}
TRIED, UNTRIED = 0.45, 0.18  # opacity
#: Colours of hard contacts and of negative controls, which are no surface's.
COLOURS = {"hard": style.FIT, "soft": "0.6", "wet": "0.6"}
MEASURED: style.Look = {"color": style.PUBLISHED, "marker": "D", "ms": 4}
#: Decades of a logarithmic axis at most below the smallest number measured.
DECADES = 4


def table(ledger: xr.Dataset) -> pd.DataFrame:
    """Return measured and predicted numbers with their intervals, one row a number.

    Rows are by `experiment`, with its verdict. Predicted is the median of the draws; measured has
    the limits of its rule; `agreement` and `tried` are shares of the draws.
    """
    parts = _parts(ledger)
    rows = []
    for letter, (statement, part) in zip("abcd", parts.items(), strict=False):
        drawn = part.rename(accepted_interval="measured_interval")
        about = drawn[["label", "contact", "verdict"]].to_dataframe()
        for name in ("measured", "predicted", "agreement", "tried"):
            of_name = tables.as_rows(tables.bounded(drawn, name)).join(about, on="experiment")
            length = statement == DISTANCE and name in ("measured", "predicted")
            origin = "published" if name == "measured" else "computed"
            unit = "nm" if length else "1"
            rows.append(of_name.assign(panel=letter, quantity=name, origin=origin, unit=unit))
    columns = ["panel", "experiment", "label", "contact", "verdict", "origin", "quantity"]
    return pd.concat(rows).reindex(columns=[*columns, *tables.VALUE_COLUMNS])


def draw(ledger: xr.Dataset) -> Figure:
    """Draw a panel a statement: an experiment a line, its measured number over the predicted."""
    parts = _parts(ledger)
    rows = [1.2 + one.sizes["experiment"] for one in parts.values()]
    figure = drawing.blank(0.9 + 0.27 * sum(rows) + 0.3 * len(rows))
    panels = figure.subplots(len(rows), 1, squeeze=False, height_ratios=rows)[:, 0]
    for axes, letter, (name, part) in zip(panels, "abcd", parts.items(), strict=False):
        title, quantity, logarithmic = STATEMENTS[name]
        _draw_statement(axes, part, logarithmic)
        axes.set_xlabel(quantity)
        style.label_panel(axes, letter, title)
    handles = [
        Line2D([], [], ls="-", lw=1, label="measured, and what agrees with it", **MEASURED),
        Line2D([], [], color=COLOURS["hard"], alpha=TRIED, label="predicted", **PREDICTED),
        Line2D([], [], color=COLOURS["hard"], alpha=UNTRIED, label="law not tried", **PREDICTED),
    ]
    style.legend_above(figure, handles)
    return figure


def _parts(ledger: xr.Dataset) -> dict[str, xr.Dataset]:
    """Return the experiments that test each statement, if any does, in the order of the panels."""
    known = {name: np.isfinite(ledger["predicted"]) & (ledger["statement"] == name)
             for name in STATEMENTS}  # fmt: skip
    return {name: ledger.sel(experiment=one) for name, one in known.items() if one.any()}


def _draw_statement(axes: Axes, part: xr.Dataset, logarithmic: bool) -> None:
    """Draw the experiments of one statement from the top, one-sided limits to the frame."""
    measured = part["measured"].values
    ends = part["predicted_interval"].values
    if logarithmic:
        least = measured.min() / 10**DECADES
        axes.set_xscale("log")
        axes.set_xlim(max(np.nanmin(ends), least) / 1.5, max(np.nanmax(ends), measured.max()) * 2)
    else:
        limits = part["accepted_interval"].values
        reach = [*ends.ravel(), *limits[np.isfinite(limits)]]
        axes.set_xlim(min(reach) - 0.15, max(reach) + 0.15)
    least, most = axes.get_xlim()
    for place, name in enumerate(part["experiment"].values):
        one = part.sel(experiment=name)
        colour = COLOURS[one["contact"].item()]
        opacity = UNTRIED if one["verdict"] == NOT_TRIED else TRIED
        look: style.Look = PREDICTED | {"color": colour, "alpha": opacity}
        axes.plot(one["predicted_interval"], [place] * 2, **look)
        axes.plot(one["predicted"], place, "|", color=colour, alpha=2 * opacity, ms=9, mew=1.6)
        axes.plot(np.clip(one["accepted_interval"], least, most), [place] * 2, color="black", lw=1)
        axes.plot(one["measured"], place, **MEASURED)
    assumed = np.where(part["height_basis"] == "assumed", "*", "")
    axes.set_yticks(range(part.sizes["experiment"]), part["label"].values + assumed)
    axes.set_ylim(part.sizes["experiment"] - 0.5, -0.5)
    if logarithmic:
        style.label_logarithmic(axes.xaxis, at=(1,))
