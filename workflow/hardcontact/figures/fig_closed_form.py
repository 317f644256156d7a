"""The closed form of the pull-off force beside computed forces, and where single peaks decide."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import marks, style, tables

FORCE = "pull-off force (µN)"
#: Where closest approach comes from, as it is printed.
SOURCES = {"spectrum": "of the spectrum alone", "contacts": "with computed approaches"}
COLUMNS = [*tables.ROW_COLUMNS, "map_size", "source", "rho", *tables.VALUE_COLUMNS]


def table(closed_form: xr.Dataset) -> pd.DataFrame:
    """Return forces, their errors and the freezing, one row a point.

    Panel a: `computed_force` with its interval, `predicted_force` and its first term alone in N; b:
    `error`, predicted over computed; c: `whole_freezing` of all scales. Against `rho` and by
    `map_size`, both in nm. Without a panel: both edges of the band in nm.
    """
    rows = tables.drawn_rows(
        ("a", "computed_force", "N", tables.bounded(closed_form, "computed_force")),
        ("a", "predicted_force", "N", closed_form["predicted_force"]),
        ("a", "first_term_force", "N", closed_form["first_term_force"]),
        ("b", "error", "1", closed_form["error"]),
        ("c", "whole_freezing", "1", closed_form["whole_freezing"]),
    )
    edges = tables.computed_rows(closed_form["edge"], panel="", unit="nm")
    edges["quantity"] = "edge_" + edges.pop("side")
    return tables.label_surfaces(pd.concat([rows, edges], ignore_index=True), closed_form)[COLUMNS]


@style.print_style()
def draw(closed_form: xr.Dataset) -> Figure:
    """Draw (a) forces on the largest maps, (b) predicted over computed, (c) the freezing."""
    figure = style.create(3.3)
    forces, errors, freezing = figure.subplots(1, 3)
    largest = closed_form.isel(map_size=-1)
    for surface, look in style.looks(closed_form["surface"].values).items():
        of_surface = largest.sel(surface=surface)
        _draw_forces(forces, of_surface, look)
        _draw_errors(errors, of_surface, look)
        freezing.plot(of_surface["rho"], of_surface["whole_freezing"], **look)
    size = largest["map_size"].item() / 1000
    _finish(forces, "a", f"on maps of {size:g} µm", FORCE)
    _finish(errors, "b", "its error", "closed form / computed")
    _finish(freezing, "c", "freezing, all scales", "(σ/ρ) / (m/σ)")
    errors.axhspan(0.5, 2, color="0.93", zorder=0)
    errors.axhline(1, color="0.4", lw=0.8, ls=":")
    freezing.axhline(1, color="0.4", lw=0.8, ls=":")
    freezing.annotate("single peaks", (0.97, 0.95), xycoords="axes fraction", ha="right", va="top")
    freezing.annotate("many points", (0.03, 0.05), xycoords="axes fraction")
    handles = [
        *style.surface_handles(closed_form),
        Line2D([], [], color="0.3", ls="none", marker="o", label="computed"),
        Line2D([], [], color="0.3", ls="-", label=f"closed form {SOURCES['spectrum']}"),
        Line2D([], [], color="0.3", ls="--", label=SOURCES["contacts"]),
        Line2D([], [], color="0.3", ls=":", label="its first term alone"),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=4)
    style.mark_basis(figure, closed_form)
    return figure


def _draw_forces(axes: Axes, of_surface: xr.Dataset, look: dict[str, Any]) -> None:
    """Draw computed forces (µN) with their intervals, and the closed form."""
    curve = tables.bounded(of_surface, "computed_force") / marks.MICRONEWTON
    reach = np.stack([curve["value"] - curve["low"], curve["high"] - curve["value"]])
    axes.errorbar(
        curve["rho"], curve["value"], yerr=np.maximum(reach, 0), ls="none", elinewidth=0.8, **look
    )
    predicted = of_surface.sel(source="spectrum")
    for name, dashes in (("predicted_force", "-"), ("first_term_force", ":")):
        forces = predicted[name] / marks.MICRONEWTON
        axes.plot(of_surface["rho"], forces, color=look["color"], lw=0.9, ls=dashes)


def _draw_errors(axes: Axes, of_surface: xr.Dataset, look: dict[str, Any]) -> None:
    """Draw the force of the closed form over that computed, for both sources of the approach."""
    for source, dashes in (("spectrum", "-"), ("contacts", "--")):
        axes.plot(of_surface["rho"], of_surface["error"].sel(source=source), ls=dashes, **look)


def _finish(axes: Axes, letter: str, title: str, quantity: str) -> None:
    """Scale and label a panel."""
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)", ylabel=quantity)
    if letter == "a":
        axes.set_ylim(1e-3)
    if letter == "b":
        axes.set_ylim(0.3, 3)
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, letter, title)
