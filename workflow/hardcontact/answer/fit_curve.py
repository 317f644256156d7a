"""Range and work of adhesion that fit the user's own measured forces."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from hardcontact.answer import canvas
from hardcontact.figures import style
from hardcontact.figures.marks import FIT_STAR, MILLIJOULE, reach
from hardcontact.figures.tables import bounded

__all__ = ["draw", "is_curve"]

COLOUR = FIT_STAR["color"]


def is_curve(fit: xr.Dataset) -> bool:
    """Return whether one force fixes only the work of adhesion at each range, not the range."""
    return "range_of_adhesion" not in fit


@canvas.canvas_style()
def draw(fit: xr.Dataset) -> Figure:
    """Draw the work of adhesion over the range, or the pair that fits best with its region.

    Parameters
    ----------
    fit : xarray.Dataset
        Part of fit.nc of one contact model. Of one surface: `work_of_adhesion` (rho) in J/m² with
        its interval. Of several: `range_of_adhesion` in nm and `work_of_adhesion` in J/m² with
        their intervals, `region_range` and `region_work` (bound). Attribute `confidence`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = canvas.create(3.5)
    axes = figure.subplots()
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel("work of adhesion (mJ/m²)")
    if is_curve(fit):
        curve = bounded(fit, "work_of_adhesion") / MILLIJOULE
        style.draw_over_range(axes, curve, 0.25, color=COLOUR)
    else:
        _draw_pair(axes, fit)
    for axis in (axes.xaxis, axes.yaxis):
        canvas.label_numbers(axis)
    return figure


def _draw_pair(axes: Axes, fit: xr.Dataset) -> None:
    """Mark the pair that fits best, its intervals, and the region of pairs that fit."""
    rho, work = bounded(fit, "range_of_adhesion"), bounded(fit, "work_of_adhesion") / MILLIJOULE
    pair: dict[str, Any] = {"xerr": reach(rho)[:, None], "yerr": reach(work)[:, None]}
    axes.errorbar([rho["value"]], [work["value"]], ls="none", **pair, **FIT_STAR)
    (left, right), (bottom, top) = (
        np.asarray(fit[name], float) / size
        for name, size in (("region_range", 1.0), ("region_work", MILLIJOULE))
    )
    corner, width, height = (left, bottom), right - left, top - bottom
    axes.add_patch(Rectangle(corner, width, height, color=COLOUR, alpha=0.15, lw=0))
    axes.autoscale_view()
