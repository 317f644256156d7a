"""Closed form of the pull-off force compared with computed forces, and the role of single peaks."""

import pandas as pd
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.report.figures import drawing, style, tables

TITLE = "The pull-off force in closed form"
CHAPTER = "8. What decides the band"
CAPTION = """\
The mean pull-off force of a random surface from its power spectrum alone. (a) Computed forces
(symbols), the closed form (solid) and its part from all points that do not touch (dotted). (b)
Closed form relative to computed force. (c) Freezing 1/k = σ²/(ρm): above one single peaks attract,
below one many points do.

σ is the rms height, ρ the range of adhesion, m the height of the apex. Heights are normally
distributed. All points that do not touch give exp(σ²/(2ρ²) − m/ρ) Φ(m/σ − σ/ρ) of the force on a
smooth surface. The closed form corrects this for rough summits, and adds the summits that
touch and the plastic contact area. Bars in (a): {{ inference.confidence | percent }} intervals
over the surfaces. In (b) the height of the apex is expected from the spectrum (solid) or computed
(dashed); grey: within a factor of two. Drawn from closed_form.nc.
"""

#: Where the height of the apex comes from: its line, and as it is printed.
SOURCES = {
    "spectrum": ("-", "closed form of the spectrum alone"),
    "contacts": ("--", "with computed heights of the apex"),
}


def draw(closed_form: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) forces on the largest maps, (b) errors of predicted forces, (c) the regime.

    Rows without a panel hold both edges of the band.
    """
    figure = drawing.create(3.3, closed_form)
    panels = figure.subplots(1, 3)
    forces, errors, regimes = panels
    largest = closed_form.isel(map_size=-1)
    for look, surface_data in style.iterate_surfaces(largest):
        rho = surface_data["rho"]
        force = tables.value_and_interval(surface_data, "computed_force") / style.MICRONEWTON
        style.draw_bars(forces, rho, force, ls="none", elinewidth=0.8, **look)
        for name, dashes in (("predicted_force", "-"), ("first_term_force", ":")):
            predicted = surface_data[name].sel(source="spectrum") / style.MICRONEWTON
            forces.plot(rho, predicted, color=look["color"], lw=0.9, ls=dashes)
        for source, (dashes, _) in SOURCES.items():
            errors.plot(
                rho, surface_data["predicted_over_computed"].sel(source=source), ls=dashes, **look
            )
        regimes.plot(rho, surface_data["all_scales_freezing"], **look)
    forces.set(ylabel="pull-off force (µN)", yscale="log", ylim=(1e-3, None))
    errors.set(ylabel="closed form / computed", yscale="log", ylim=(0.3, 3))
    regimes.set(ylabel="freezing 1/k", yscale="log")
    for axes in panels:
        axes.set(xscale="log", xlabel="range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(forces, "a", f"on maps of {largest['map_size'].item() / 1000:g} µm")
    style.label_panel(errors, "b", "error of the closed form")
    style.label_panel(regimes, "c", "what attracts")
    errors.axhspan(0.5, 2, color="0.93", zorder=0)
    for axes in (errors, regimes):
        axes.axhline(1, color="0.4", lw=0.8, ls=":")
    regimes.annotate("single peaks", (0.97, 0.95), xycoords="axes fraction", ha="right", va="top")
    regimes.annotate("many points", (0.03, 0.05), xycoords="axes fraction")
    handles = [
        *style.surface_handles(closed_form),
        Line2D([], [], color="0.3", ls="none", marker="o", label="computed"),
        *(Line2D([], [], color="0.3", ls=ls, label=label) for ls, label in SOURCES.values()),
        Line2D([], [], color="0.3", ls=":", label="points that do not touch"),
    ]
    style.legend_above(figure, handles)
    forces_drawn = (("a", f"{name}_force", "N") for name in ("computed", "predicted", "first_term"))
    columns = [
        *forces_drawn,
        ("b", "predicted_over_computed", "1"),
        ("c", "all_scales_freezing", "1"),
    ]
    edges = tables.computed_rows(closed_form["edge"], panel="", unit="nm")
    edges["quantity"] = "edge_" + edges.pop("side")
    frames = [tables.variable_rows(closed_form, *columns), edges]
    return tables.tidy_table(frames, closed_form, "map_size", "source", "rho"), figure
