"""The closed form of the pull-off force beside computed forces, and where single peaks decide."""

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import drawing, style, tables

TITLE = "The pull-off force in closed form"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) Forces computed on the largest random surfaces (symbols), the closed form (solid) and its
first term alone (dotted). (b) Closed form over computed force. (c) (σ/ρ)/(m/σ): above one
single peaks decide, below one many points do.

For a random surface whose heights are normally distributed the mean pull-off force follows from
the power spectrum alone: exp(σ²/2ρ² − m/ρ) Φ(m/σ − σ/ρ) of the force on a smooth surface for
all points that do not touch, where σ is the rms height, ρ the range of adhesion and m the
height of closest approach, and the forces of the summits that touch and of the plastic contact
area. Bars in (a): {{ inference.confidence | percent }} intervals over the surfaces. In (b) the
closest approach is that which the spectrum lets expect (solid) or that computed (dashed); grey:
within a factor of two. Where (σ/ρ)/(m/σ) exceeds one, the attraction comes from heights that
only single peaks reach. Drawn from closed_form.nc.
"""

FORCE = "pull-off force (µN)"
#: Where closest approach comes from, as it is printed.
SOURCES = {"spectrum": "of the spectrum alone", "contacts": "with computed approaches"}


def _table(closed_form: xr.Dataset) -> pd.DataFrame:
    """Return forces, their errors and the freezing, one row a point.

    Panel a: `computed_force` with its interval, `predicted_force` and its first term alone in N; b:
    `error`, predicted over computed; c: `whole_freezing` of all scales. Against `rho` and by
    `map_size`, both in nm. Without a panel: both edges of the band in nm.
    """
    rows = tables.drawn_rows(
        closed_form,
        ("a", "computed_force", "N"),
        ("a", "predicted_force", "N"),
        ("a", "first_term_force", "N"),
        ("b", "error", "1"),
        ("c", "whole_freezing", "1"),
    )
    edges = tables.computed_rows(closed_form["edge"], panel="", unit="nm")
    edges["quantity"] = "edge_" + edges.pop("side")
    return tables.tidy([rows, edges], closed_form, "map_size", "source", "rho")


def draw(closed_form: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) forces on the largest maps, (b) predicted over computed, (c) the freezing."""
    figure = drawing.create(3.3, closed_form)
    forces, errors, freezing = figure.subplots(1, 3)
    largest = closed_form.isel(map_size=-1)
    for look, of_surface in style.by_surface(largest):
        _draw_forces(forces, of_surface, look)
        _draw_errors(errors, of_surface, look)
        freezing.plot(of_surface["rho"], of_surface["whole_freezing"], **look)
    size = largest["map_size"].item() / 1000
    _finish(forces, "a", f"on maps of {size:g} µm", FORCE)
    _finish(errors, "b", "its error", "closed form / computed")
    _finish(freezing, "c", "freezing, all scales", "(σ/ρ) / (m/σ)")
    errors.axhspan(0.5, 2, color="0.93", zorder=0)
    for axes in (errors, freezing):
        axes.axhline(1, color="0.4", lw=0.8, ls=":")
    freezing.annotate("single peaks", (0.97, 0.95), xycoords="axes fraction", ha="right", va="top")
    freezing.annotate("many points", (0.03, 0.05), xycoords="axes fraction")
    handles = [
        *style.surface_handles(closed_form),
        Line2D([], [], color="0.3", ls="none", marker="o", label="computed"),
        Line2D([], [], color="0.3", ls="-", label=f"closed form {SOURCES['spectrum']}"),
        Line2D([], [], color="0.3", ls="--", label=SOURCES["contacts"]),
        Line2D([], [], color="0.3", ls=":", label="its first term alone"),
    ]
    style.legend_above(figure, handles)
    return _table(closed_form), figure


def _draw_forces(axes: Axes, of_surface: xr.Dataset, look: style.Look) -> None:
    """Draw computed forces (µN) with their intervals, and the closed form."""
    curve = tables.bounded(of_surface, "computed_force") / style.MICRONEWTON
    style.draw_bars(axes, curve["rho"], curve, ls="none", elinewidth=0.8, **look)
    predicted = of_surface.sel(source="spectrum")
    for name, dashes in (("predicted_force", "-"), ("first_term_force", ":")):
        forces = predicted[name] / style.MICRONEWTON
        axes.plot(of_surface["rho"], forces, color=look["color"], lw=0.9, ls=dashes)


def _draw_errors(axes: Axes, of_surface: xr.Dataset, look: style.Look) -> None:
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
