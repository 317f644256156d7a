"""The fit of range and work of adhesion: its error, the minima, and the published pair."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.formatting import format_estimate, format_share
from hardcontact.contact.contact import PLASTIC, RIGID
from hardcontact.report.figures import drawing, panels, style

MODEL_LOOKS: dict[str, style.Look] = {
    PLASTIC: {"color": "black", "ls": "-"},
    RIGID: {"color": "0.45", "ls": "--"},
}
MAX_MAPPED_ERROR = 0.7  # the map has the works of adhesion with a smaller error at some range
ON_MAP: style.Look = {"frameon": True, "facecolor": "0.6", "framealpha": 0.9}
PUBLISHED_FIT: style.Look = {
    "fmt": "o", "color": "black", "mec": "white", "mew": 0.5, "ms": 5, "lw": 1.4,
    "label": "published fit",
}  # fmt: skip
FIT_COLOUR = "#6A3D9A"  # no surface has this colour
FIT_STAR: style.Look = {"marker": "*", "color": FIT_COLOUR, "mec": "white", "mew": 0.6, "ms": 11}
FIT_RING: style.Look = {"marker": "o", "mfc": "white", "mec": FIT_COLOUR, "mew": 1.4, "ms": 5}


def draw(fit: xr.Dataset, sets: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw the error of the fit (a) against the range and (b) over range and work of adhesion."""
    plastic_fit = fit.sel(contact_model=PLASTIC)
    figure = drawing.create_figure(3.6, fit)
    curves, error_map = figure.subplots(1, 2)
    _draw_smallest_error(curves, fit, sets.sel(contact_model=PLASTIC))
    _draw_error_map(error_map, plastic_fit, published_constants)
    published = published_constants["value"]["range_of_adhesion"]
    interval = f"{format_share(fit.attrs['confidence'])} interval"
    handles = [
        *style.legend_entries([curves]).values(),
        Line2D([], [], marker="|", ms=9, ls="none", label=interval, color="black"),
        Line2D([], [], label=f"published range, ρ = {published:g} nm", **style.PUBLISHED_LOOK),
    ]
    style.legend_above(figure, handles)
    for axes in (curves, error_map):
        panels.finish_range_axis(axes, plastic_fit["rho"].values, published_constants)
    return figure


def _draw_smallest_error(axes: Axes, fit: xr.Dataset, set_fits: xr.Dataset) -> None:
    """Draw the error at the best W against rho (nm), and the best fit of each set."""
    plastic_fit = fit.sel(contact_model=PLASTIC)
    threshold = fit.attrs["error_threshold"]
    set_look: style.Look = {"color": "0.6", "ms": 4, "mew": 0, "alpha": 0.8}
    set_errors = set_fits["best_error"].values
    axes.plot(set_fits["range_of_adhesion"], set_errors, ".", label="best fit of a set", **set_look)
    for model in [name for name in MODEL_LOOKS if name in fit["contact_model"]]:
        curve = fit["best_error_by_range"].sel(contact_model=model)
        axes.plot(curve["rho_fine"], curve, lw=1.2, label=f"{model} contact", **MODEL_LOOKS[model])
    best = panels.scalar_and_interval(plastic_fit, "best_error")
    ends = [best["low"], best["high"]]
    axes.plot([plastic_fit["range_of_adhesion"]] * 2, ends, color="black", lw=1.0)
    _mark_minima(axes, plastic_fit, plastic_fit["best_error"], plastic_fit["error_at_minimum"])
    label = f"published: error below {threshold:g}"
    axes.axhline(threshold, color="0.6", lw=0.8, ls=":", zorder=0, label=label)
    axes.set(xscale="log", yscale="log", ylabel="mean relative error, least over $W$")
    style.label_logarithmic(axes.yaxis, digits=(1, 2, 5))
    interval_note = " over scans" if np.isfinite(best["low"]) else ""
    title = f"smallest error {format_estimate(best, '.2g')}{interval_note}"
    style.label_panel(axes, "a", title)


def _draw_error_map(axes: Axes, fit: xr.Dataset, published_constants: pd.DataFrame) -> None:
    """Map the mean relative error over rho (nm) and W (mJ/m2), with fit and published values."""
    error = fit["mean_relative_error"].transpose("work", "rho_fine")
    rho, work = fit["rho_fine"].values, fit["work"].values / style.MILLIJOULE
    norm = LogNorm(vmax=max(1.0, 3 * error.min().item()))
    image = axes.pcolormesh(rho, work, error.values, norm=norm, cmap="cividis", **style.PIXEL_LOOK)
    threshold = fit.attrs["error_threshold"]
    if (error < threshold).any():
        axes.contour(rho, work, error.values, levels=[threshold], colors="white", linewidths=1.0)
        axes.plot([], [], color="white", lw=1.0, label=f"error < {threshold:g}")
    axes.plot([], [], "o", color="white", ms=2.5, label="fit to sampled mean forces")
    look: style.Look = {"color": "white", "ms": 2, "alpha": 0.6, "mew": 0, "rasterized": True}
    axes.plot(fit["sampled_range"], fit["sampled_work"] / style.MILLIJOULE, ".", **look)
    _mark_published_fit(axes, published_constants)
    # The legend is made before the minima are marked, because panel a names these marks.
    axes.legend(loc="lower left", **ON_MAP)
    works = fit[["work_of_adhesion", "work_at_minimum"]] / style.MILLIJOULE
    _mark_minima(axes, fit, works["work_of_adhesion"], works["work_at_minimum"])
    axes.set(xscale="log", yscale="log", ylabel="work of adhesion $W$ (mJ/m²)")
    published_work = published_constants["value"]["work_of_adhesion"] / style.MILLIJOULE
    mapped_works = [*work[error.min("rho_fine").values < MAX_MAPPED_ERROR], published_work]
    axes.set_ylim(max(work[0], min(mapped_works) / 1.5), min(work[-1], max(mapped_works) * 1.5))
    style.label_logarithmic(axes.yaxis, digits=(1,))
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, "b", "error over ρ and $W$, plastic contact")


def _mark_published_fit(axes: Axes, published_constants: pd.DataFrame) -> None:
    """Mark the published range (nm) and work of adhesion (mJ/m2) with their uncertainties."""
    rho = published_constants.loc["range_of_adhesion"]
    work = published_constants.loc["work_of_adhesion"]
    values = rho["value"], work["value"] / style.MILLIJOULE
    x_error, y_error = rho["uncertainty"], work["uncertainty"] / style.MILLIJOULE
    axes.errorbar(*values, xerr=x_error, yerr=y_error, zorder=5, **PUBLISHED_FIT)


def _mark_minima(
    axes: Axes, fit: xr.Dataset, y_of_best: xr.DataArray, y_of_minima: xr.DataArray
) -> None:
    """Mark the range of the best fit with a star, ranges of other minima of the error with rings.

    `y_of_best` () and `y_of_minima` (minimum) are on the y axis. The minima include the best fit.
    """
    is_other = fit["range_at_minimum"].values != fit["range_of_adhesion"].item()
    best_look: style.Look = {"ls": "none", "zorder": 6, "label": "best fit of the study"}
    other_look: style.Look = best_look | {"label": "other minimum of the error"}
    axes.plot(fit["range_of_adhesion"], y_of_best, **FIT_STAR, **best_look)
    axes.plot(fit["range_at_minimum"][is_other], y_of_minima[is_other], **FIT_RING, **other_look)
