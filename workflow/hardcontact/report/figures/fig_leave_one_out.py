"""Fits of range and work of adhesion with one surface left out at a time."""

from typing import NamedTuple

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.leave_one_out import NONE_LEFT_OUT
from hardcontact.report.figures import drawing, style, tables

TITLE = "Which surface decides range and work of adhesion"
CHAPTER = "3. Adhesion"
CAPTION = """\
(a) Range of adhesion ρ and (b) work of adhesion W that fit the forces of all surfaces, or of all
but one, best. (c) Mean relative error of the fit. Stars: the study's own scans. Dots and bars:
median and 90 % of many equally good sets of substitute scans.

Contact is plastic. Dashed: the published range, work and bound of the error; grey: the published
uncertainty. A fit of two numbers to three forces has one force left to test it. A fit to four
forces has two. Drawn from leave_one_out.nc and resources/paper/parameters.csv.
"""


class Panel(NamedTuple):
    """A panel of the figure, which shows one fitted variable."""

    title: str
    printed_unit: str
    scale: float  #: Size of the printed unit in units of the table.
    table_unit: str
    constant: str  #: The published constant.


PANELS = {
    "range_of_adhesion": Panel("range ρ", "nm", 1.0, "nm", "range_of_adhesion"),
    "work_of_adhesion": Panel("work $W$", "mJ/m²", style.MILLIJOULE, "J/m2", "work_of_adhesion"),
    "best_error": Panel("mean relative error", "1", 1.0, "1", "error_threshold"),
}
COLUMNS = [
    "panel", "left_out", "label", "basis", "origin", "over", "quantity", *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(
    leave_one_out: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) range, (b) work and (c) error of the fits to all surfaces and to all but one.

    The table has the median `over` "sets" with the ends of the central `tables.SHARE_OF_SETS`, and
    the fit to the study's own "scans". `left_out` is "none" or a surface.
    """
    fits = leave_one_out.sel(contact_model=PLASTIC)
    figure = drawing.create(2.6, leave_one_out)
    panels = figure.subplots(1, len(PANELS), sharey=True)
    frames = []
    for letter, axes, name in zip("abc", panels, PANELS, strict=True):
        title, printed_unit, scale, table_unit, constant = PANELS[name]
        published = tables.published_rows(published_constants, {constant: table_unit}, letter)
        value, low, high = published[["value", "low", "high"]].iloc[0] / scale
        axes.axvspan(low, high, color="0.85", lw=0)
        axes.axvline(value, **style.PUBLISHED_RANGE)
        set_fits = tables.summarize_sets(fits[f"set_{name}"])
        _draw_rows(axes, set_fits / scale, fits[name] / scale)
        axes.set(xscale="log", xlabel=title if printed_unit == "1" else f"{title} ({printed_unit})")
        style.label_logarithmic(axes.xaxis, digits=(1, 3))
        style.label_panel(axes, letter, title)
        columns = {"panel": letter, "quantity": name, "unit": table_unit}
        frames += [
            published,
            tables.computed_rows(set_fits, over="sets", **columns),
            tables.computed_rows(fits[[name]].rename({name: "value"}), over="scans", **columns),
        ]
    labels = leave_one_out["label"].to_series()
    names = [
        "all surfaces" if left_out == NONE_LEFT_OUT else f"without {labels[left_out]}"
        for left_out in fits["left_out"].values
    ]
    panels[0].set_yticks(range(len(names)), names)
    panels[0].invert_yaxis()
    handles = [
        Line2D([], [], ls="none", marker="o", color="0.3", label="median of the sets"),
        Line2D([], [], color="0.3", label="90 % of the sets"),
        Line2D([], [], ls="none", label="the study's own scans", **style.FIT_STAR),
        Line2D([], [], label="published", **style.PUBLISHED_RANGE),
    ]
    style.legend_above(figure, handles)
    return tables.label_rows(frames, leave_one_out, COLUMNS, "left_out"), figure


def _draw_rows(axes: Axes, set_fits: xr.Dataset, study_fits: xr.DataArray) -> None:
    """Draw the sets and the study's fit, a row for each surface left out, in its colour."""
    substrates = [name for name in study_fits["left_out"].values if name != NONE_LEFT_OUT]
    colours = style.colours(substrates) | {NONE_LEFT_OUT: "0.3"}
    for row, name in enumerate(study_fits["left_out"].values):
        fits = set_fits.sel(left_out=name)
        axes.plot([fits["low"], fits["high"]], [row, row], color=colours[name])
        axes.plot(fits["value"], row, "o", color=colours[name])
        axes.plot(study_fits.sel(left_out=name), row, **style.FIT_STAR)
