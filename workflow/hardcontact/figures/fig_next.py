"""How far a second sphere separates the fits of the forces: a panel a preload."""

import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import drawing, style, tables
from hardcontact.insight.next_sphere import RIGHT

LETTERS = "abcdef"  # of the panels, a preload each
SCATTER = "scatter between spheres (thick) or tests"


def table(next: xr.Dataset) -> pd.DataFrame:
    """Return `separation` in standard errors and `tried`, one row a number.

    They are by preload (N), radius (nm), surface, and where the scatter of the forces lies.
    """
    rows = tables.drawn_rows(next, ("", "separation", "1"), ("", "tried", "1"))
    rows["panel"] = rows["preload"].map(dict(zip(next["preload"].values, LETTERS, strict=False)))
    return tables.tidy([rows], next, "preload", "radius", "scatter")


def draw(next: xr.Dataset) -> Figure:
    """Draw the separation against the radius of the next sphere, a panel a preload."""
    figure = drawing.create(3.1, next)
    panels = figure.subplots(1, next.sizes["preload"], sharey=True, squeeze=False)[0]
    for axes, letter, preload in zip(panels, LETTERS, next["preload"].values, strict=False):
        of_preload = next.sel(preload=preload)
        for look, of_surface in style.by_surface(of_preload):
            _draw_surface(axes, of_surface, look["color"])
        axes.axhline(RIGHT, color="0.6", lw=0.8, zorder=0)
        axes.axvline(next.attrs["sphere_radius"] / 1000, **style.PUBLISHED_RANGE)
        axes.set(xscale="log", xlabel="radius of the sphere (µm)")
        style.label_logarithmic(axes.xaxis)
        style.label_panel(axes, letter, f"preload {preload / style.MICRONEWTON:g} µN")
    place = panels[0].get_yaxis_transform()
    text = f"95 of 100 right: {RIGHT:.3g}"
    panels[0].text(0.02, RIGHT, text, transform=place, va="bottom", **style.NOTE)
    panels[0].set_ylim(0)
    panels[0].set_ylabel("separation (standard errors)")
    handles = [
        *style.surface_handles(next, marker=""),
        Patch(
            color="0.3",
            alpha=style.BAND_OF_SETS,
            lw=0,
            label=SCATTER,
        ),
        Line2D([], [], color="0.3", ls=":", lw=1.0, label="error of the closed form not known"),
        Line2D([], [], **style.PUBLISHED_RANGE, label="the sphere of the paper"),
    ]
    style.legend_above(figure, handles)
    return figure


def _draw_surface(axes: Axes, of_surface: xr.Dataset, colour: str) -> None:
    """Draw the lower end of the separation of a surface, and both where an error is known."""
    radius = of_surface["radius"] / 1000
    ends = of_surface["separation"].transpose("scatter", "radius")
    known = ends.where(of_surface["tried"] == 1)
    axes.fill_between(radius, *known.values, color=colour, alpha=style.BAND_OF_SETS, lw=0)
    axes.plot(radius, ends.min("scatter"), color=colour, lw=0.8, ls=":")
    axes.plot(radius, known.min("scatter", skipna=False), color=colour)
    axes.plot(radius, known.max("scatter", skipna=False), color=colour, lw=0.5)
