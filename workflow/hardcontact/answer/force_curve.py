"""The predicted pull-off force against the range of adhesion."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.answer import canvas
from hardcontact.answer.datasets import at_range, model_of
from hardcontact.figures import style
from hardcontact.figures.tables import bounded
from hardcontact.numbers.printing import best_unit, print_length, print_quantity, print_share

LINES = ("-", "--", "-.")
BESIDE = 1.04  # factor by which the marks of one surface stand beside those of the one before
ASKED: dict[str, Any] = {"color": "0.25", "lw": 1.0, "ls": ":"}


@canvas.canvas_style()
def draw(force: xr.Dataset) -> Figure:
    """Draw the mean force of all surfaces and models over the range, and its spread at that asked.

    Parameters
    ----------
    force : xarray.Dataset
        As force.nc: `force` (surface, contact_model, rho) in N with its interval, `force_quantile`
        (surface, contact_model, rho, quantile), `label` (surface), attributes `range_of_adhesion`
        (nm) and `work_of_adhesion` (J/m²).

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = canvas.create(3.9)
    axes = figure.subplots()
    asked, here = force.attrs["range_of_adhesion"], at_range(force)
    unit, size = best_unit(float(here["force"].max()), "N")
    chosen = model_of(force)
    models = [chosen, *(str(m) for m in force["contact_model"].values if m != chosen)]
    for place, (surface, look) in enumerate(style.looks(force["surface"].values).items()):
        for model, line in zip(models, LINES, strict=False):
            curve = bounded(force.sel(surface=surface, contact_model=model), "force")
            scaled = curve.assign({name: curve[name] / size for name in ("value", "low", "high")})
            band = 0.2 if model == chosen else 0.0
            style.draw_over_range(axes, scaled, band, color=look["color"], ls=line)
        single, beside = here.sel(surface=surface), asked * BESIDE**place
        quantiles = single["force_quantile"] / size
        axes.vlines(beside, quantiles.min(), quantiles.max(), color=look["color"], lw=1.4)
        axes.plot(beside, single["force"] / size, ms=6, mec="white", **look)
    axes.axvline(asked, zorder=0, **ASKED)
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set_ylabel(f"pull-off force ({unit})")
    for axis in (axes.xaxis, axes.yaxis):
        canvas.label_numbers(axis)
    work = print_quantity(force.attrs["work_of_adhesion"], "J m-2")
    axes.set_title(f"work of adhesion {work}", loc="left")
    figure.legend(handles=_legend_handles(force, models), loc="outside upper center", ncols=2)
    return figure


def _legend_handles(force: xr.Dataset, models: list[str]) -> list[Line2D]:
    """Return one entry a surface, a contact model and a mark."""
    share = np.ptp(force["quantile"].values)
    return [
        *style.surface_handles(force, ls="none"),
        *(
            Line2D([], [], color="0.3", ls=line, label=f"{model} contact")
            for model, line in zip(models, LINES, strict=False)
        ),
        Line2D([], [], color="0.3", lw=1.4, label=f"{print_share(share)} of contacts"),
        Line2D([], [], label=f"ρ = {print_length(force.attrs['range_of_adhesion'])}", **ASKED),
    ]
