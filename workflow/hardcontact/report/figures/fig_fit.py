"""The fit of range and work of adhesion: its error, the minima, and the published pair."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from hardcontact.base.formatting import format_with_interval
from hardcontact.contact.contact import PLASTIC
from hardcontact.report.figures import drawing, style, tables

TITLE = "Fit of range and work of adhesion"
CHAPTER = "3. Adhesion"
CAPTION = """\
Mean relative error between computed and published mean forces of all substrates. (a) Against the
range of adhesion ρ, at the work of adhesion W that fits best. (b) Over ρ and W. Star: least error
of the study; rings: its other minima. Dashed: the published range. Black point: published ρ and W.

Contact is plastic, in (a) also rigid. Vertical line and brackets in (a):
{{ inference.confidence | percent }} interval of the least error over scans. Grey dots: best fit of
each of many sets of substitute scans; a set is as good as the study's scans. The verdicts take the
spread of these fits as interval. White dots in (b): fits to samples of the mean forces, from
the scatter of the scans. White line: around errors below the paper's threshold, if there are any.
Bars at the black point: published uncertainty. Drawn from fit.nc, sets.nc and
resources/paper/parameters.csv.
"""

MODEL_LOOKS: dict[str, style.Look] = {
    "plastic": {"color": "black", "ls": "-"},
    "rigid": {"color": "0.45", "ls": "--"},
}
MAX_MAPPED_ERROR = 0.7  # the map has the works of adhesion with a smaller error at some range
FITTED_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
ON_MAP: style.Look = {"frameon": True, "facecolor": "0.6", "framealpha": 0.9}
COLUMNS = ["panel", "origin", "quantity", "x", *tables.VALUE_COLUMNS]


def draw(
    fit: xr.Dataset, sets: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw the error of the fit (a) against the range and (b) over range and work of adhesion.

    The column `x` has the range of adhesion (nm).
    """
    plastic_fit = fit.sel(contact_model=PLASTIC)
    set_fits = sets.sel(contact_model=PLASTIC)
    figure = drawing.create(3.6, fit)
    curves, error_map = figure.subplots(1, 2)
    frames = [
        _draw_least_error(curves, fit, set_fits),
        _draw_error_map(error_map, plastic_fit, published_constants),
    ]
    for axes in (curves, error_map):
        style.draw_published_range(axes, published_constants)
        axes.set_xlim(plastic_fit["rho"].values[[0, -1]])
        axes.set_xlabel("range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, digits=(1, 3))
    return pd.concat(frames, ignore_index=True).reindex(columns=COLUMNS), figure


def _draw_least_error(axes: Axes, fit: xr.Dataset, set_fits: xr.Dataset) -> pd.DataFrame:
    """Draw the error, least over W, against rho (nm), and the best fit of each set."""
    plastic_fit = fit.sel(contact_model=PLASTIC)
    threshold = fit.attrs["error_threshold"]
    set_look: style.Look = {"color": "0.6", "ms": 4, "mew": 0, "alpha": 0.8}
    set_ranges = set_fits["range_of_adhesion"].values
    set_errors = set_fits["best_error"].values
    axes.plot(set_ranges, set_errors, ".", label="best fit of a set", **set_look)
    frames = [tables.quantity_rows("a", "best_error_of_set", "1", x=set_ranges, value=set_errors)]
    for model in [name for name in MODEL_LOOKS if name in fit["contact_model"]]:
        curve = fit["best_error_by_range"].sel(contact_model=model)
        ranges = curve["rho_fine"].values
        axes.plot(ranges, curve, lw=1.2, label=f"{model} contact", **MODEL_LOOKS[model])
        name = f"least_error_{model}"
        frames.append(tables.quantity_rows("a", name, "1", x=ranges, value=curve.values))
    best = tables.value_and_bounds(plastic_fit, "best_error")
    axes.plot(
        [plastic_fit["range_of_adhesion"]] * 2, [best["low"], best["high"]], color="black", lw=1.0
    )
    style.draw_fit(axes, plastic_fit, "error")
    axes.axhline(threshold, color="0.6", lw=0.8, zorder=0)
    position: Any = {"transform": axes.get_yaxis_transform(), "va": "bottom"}
    axes.text(0.02, threshold, f"paper: below {threshold:g}", **position, **style.NOTE_LOOK)
    axes.set(xscale="log", yscale="log", ylabel="mean relative error, least over $W$")
    errors = [*set_errors, best["low"], best["value"], threshold]
    axes.set_ylim(bottom=np.nanmin(errors) / 5)  # leaves room for the legend
    style.label_logarithmic(axes.yaxis, digits=(1, 2, 5))
    axes.legend(loc="lower left", ncols=2, frameon=True, framealpha=1, edgecolor="white")
    interval_note = " over scans" if np.isfinite(best["low"]) else ""
    style.label_panel(
        axes, "a", f"smallest error {format_with_interval(best, '.2g')}{interval_note}"
    )
    frames.append(tables.quantity_rows("a", "best_error", "1", **best))
    return pd.concat([*frames, _minimum_rows(plastic_fit, "a", "error", "1")])


def _draw_error_map(axes: Axes, fit: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Map the mean relative error over rho (nm) and W (mJ/m2), with fit and published values."""
    error = fit["mean_relative_error"].transpose("work", "rho_fine")
    rho, work = fit["rho_fine"].values, fit["work"].values / style.MILLIJOULE
    norm = LogNorm(vmax=max(1.0, 3 * error.min().item()))
    image = axes.pcolormesh(rho, work, error.values, norm=norm, cmap="cividis", **style.PIXEL_LOOK)
    threshold = fit.attrs["error_threshold"]
    if (error < threshold).any():
        axes.contour(rho, work, error.values, levels=[threshold], colors="white", linewidths=1.0)
        axes.plot([], [], color="white", lw=1.0, label=f"error < {threshold:g}")
    ranges, works = fit["sampled_range"].values, fit["sampled_work"].values
    axes.plot([], [], "o", color="white", ms=2.5, label="fit to a sample of the scans")
    look: style.Look = {"color": "white", "ms": 2, "alpha": 0.6, "mew": 0, "rasterized": True}
    axes.plot(ranges, works / style.MILLIJOULE, ".", **look)
    style.draw_published_fit(axes, published_constants)
    axes.legend(loc="lower left", **ON_MAP)  # panel a names the marks of the fit
    style.draw_fit(axes, fit, "work", style.MILLIJOULE)
    axes.set(xscale="log", yscale="log", ylabel="work of adhesion $W$ (mJ/m²)")
    published_work = published_constants["value"]["work_of_adhesion"] / style.MILLIJOULE
    mapped_works = [*work[error.min("rho_fine").values < MAX_MAPPED_ERROR], published_work]
    axes.set_ylim(max(work[0], min(mapped_works) / 1.5), min(work[-1], max(mapped_works) * 1.5))
    style.label_logarithmic(axes.yaxis, digits=(1,))
    bar = axes.figure.colorbar(image, ax=axes, label="mean relative error", pad=0.02, extend="max")
    style.label_logarithmic(bar.ax.yaxis)
    style.label_panel(axes, "b", "error over ρ and $W$, plastic contact")
    frames = [
        tables.quantity_rows("b", name, unit, **tables.value_and_bounds(fit, name))
        for name, unit in FITTED_UNITS.items()
    ]
    frames += [
        tables.quantity_rows("b", "sampled_work", "J/m2", x=ranges, value=works),
        _minimum_rows(fit, "b", "work", "J/m2"),
        tables.published_rows(published_constants, FITTED_UNITS, "b"),
    ]
    return pd.concat(frames)


def _minimum_rows(fit: xr.Dataset, panel: str, height: str, unit: str) -> pd.DataFrame:
    """Return work or error at each local minimum of the error along the range."""
    minima = fit.dropna("minimum", subset=["range_at_minimum"])
    name = f"{height}_at_minimum"
    return tables.quantity_rows(panel, name, unit, x=minima["range_at_minimum"], value=minima[name])
