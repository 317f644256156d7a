"""Range and work of adhesion that fit the user's own measured forces."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.answer import canvas
from hardcontact.answer.datasets import model_of
from hardcontact.figures import style
from hardcontact.figures.marks import FIT_STAR, MILLIJOULE
from hardcontact.figures.tables import bounded

REGION = {"color": FIT_STAR["color"], "alpha": 0.3, "lw": 0.0}


def of_answer(fit: xr.Dataset) -> xr.Dataset:
    """Return the fit of the contact model of the answer."""
    return fit.sel(contact_model=model_of(fit))


@canvas.canvas_style()
def draw(fit: xr.Dataset) -> Figure:
    """Draw the work of adhesion that fits each surface over the range, and what fits all of them.

    Parameters
    ----------
    fit : xarray.Dataset
        Part of fit.nc of one contact model: `work_of_adhesion` (surface, rho) in J/m² with its
        interval, `region` (rho, bound) in J/m² and, of several surfaces, `best_range` in nm and
        `best_work` in J/m².

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = canvas.create(3.7)
    axes = figure.subplots()
    for surface, colour in style.colours(fit["surface"].values).items():
        curve = bounded(fit.sel(surface=surface), "work_of_adhesion") / MILLIJOULE
        style.draw_over_range(axes, curve, 0.2, color=colour)
    several = fit.sizes["surface"] > 1
    if several:
        low, high = (fit["region"].sel(bound=end) / MILLIJOULE for end in ("low", "high"))
        axes.fill_between(fit["rho"], low, high, zorder=3, **REGION)
        axes.plot(fit["best_range"], fit["best_work"] / MILLIJOULE, ls="none", **FIT_STAR, zorder=4)
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel("work of adhesion (mJ/m²)")
    for axis in (axes.xaxis, axes.yaxis):
        canvas.label_numbers(axis)
    handles = _legend_handles(fit, several and bool(np.isfinite(fit["region"]).any()))
    figure.legend(handles=handles, loc="outside upper center", ncols=2)
    return figure


def _legend_handles(fit: xr.Dataset, has_region: bool) -> list[Line2D | Patch]:
    """Return one entry a surface, and those of the best fit and the region if there are any."""
    labels = zip(style.colours(fit["surface"].values).values(), fit["label"].values, strict=True)
    return [
        *(Line2D([], [], color=colour, label=f"{label}, measured") for colour, label in labels),
        *([Line2D([], [], ls="none", **FIT_STAR, label="best fit")] * (fit.sizes["surface"] > 1)),
        *([Patch(label="fits all", **REGION)] * has_region),
    ]
