"""The effect of rare protrusions, on a coating or the sphere, on the fit of range and work."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.formatting import format_share
from hardcontact.report.figures import drawing, panels, style

HEIGHT_COLOURS = "viridis"
#: Panel and symbol by the body with protrusions.
PANELS = {"coating": "b", "sphere": "c"}
SYMBOLS = {"coating": "o", "sphere": "^"}


def draw(
    protruded: xr.Dataset,
    protruded_sphere: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> Figure:
    """Draw (a) forces of each draw of protrusions, (b, c) fits of all sets with each draw."""
    published_forces = published_pull_off.loc[protruded.attrs["surface"]]
    protruded_body = pd.Index(list(PANELS), name="protruded_body")
    fits = xr.concat(
        [protruded, protruded_sphere], protruded_body, join="outer", combine_attrs="override"
    )
    norm = Normalize(0, np.nanmax(fits["protrusion_height"].values, initial=1.0))
    figure = drawing.create(3.2, protruded)
    force_axes, *fit_axes = figure.subplots(1, 3, width_ratios=(1, 1, 1.2))
    _draw_forces(force_axes, fits, published_forces, norm)
    for axes, (name, letter) in zip(fit_axes, PANELS.items(), strict=True):
        share = _draw_fits(axes, fits.sel(protruded_body=name), norm)
        panels.draw_published_fit(axes, published_constants)
        style.label_panel(axes, letter, f"on the {name}; {format_share(share, '.0f')} agree")
    colour_scale = ScalarMappable(norm, HEIGHT_COLOURS)
    figure.colorbar(colour_scale, ax=fit_axes[-1], label="height of protrusions / rms height")
    handles = [
        *(Line2D([], [], ls="none", marker=symbol, color="0.4", label=f"on the {name} (a)")
          for name, symbol in SYMBOLS.items()),
        Line2D([], [], ls="none", marker="o", color="0.4", label="forces agree (b, c)"),
        Line2D([], [], ls="none", marker="o", mfc="none", color="0.4",
               label="forces differ (b, c)"),
        Line2D([], [], ls="none", marker="s", color="black", label="published"),
    ]  # fmt: skip
    style.legend_above(figure, handles, max_columns=5)
    return figure


def _draw_forces(
    axes: Axes, fits: xr.Dataset, published_forces: "pd.Series[float]", norm: Normalize
) -> None:
    """Draw median against mean force (µN) at the published pair."""
    published = [
        published_forces[name] / style.MICRONEWTON for name in ("mean_force", "median_force")
    ]
    forces = fits[["mean_force_at_published", "median_force_at_published"]] / style.MICRONEWTON
    for name, symbol in SYMBOLS.items():
        mean, median = forces.sel(protruded_body=name).values()
        colours = fits["protrusion_height"].sel(protruded_body=name)
        axes.scatter(mean, median, c=colours, cmap=HEIGHT_COLOURS, norm=norm, s=14, marker=symbol)
    axes.plot(*published, "s", color="black", ms=5)
    largest = np.nanmax(forces.to_array().values, initial=max(published))
    ends = np.array([0.7 * min(published), 1.5 * largest])
    axes.plot(ends, ends, color="0.7", lw=0.6, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="mean force (µN)", ylabel="median force (µN)")
    style.label_logarithmic(axes.xaxis, axes.yaxis, digits=(1, 2, 5))
    style.label_panel(axes, "a", "at the published ρ and $W$")


def _draw_fits(axes: Axes, fits: xr.Dataset, norm: Normalize) -> float:
    """Draw work (mJ/m²) against range of adhesion (nm); return the share of sets that agrees."""
    agrees = fits["agrees"].values == 1
    heights = fits["protrusion_height"].broadcast_like(fits["agrees"]).values
    ranges = fits["range_of_adhesion"].values
    works = fits["work_of_adhesion"].values / style.MILLIJOULE
    axes.plot(ranges[~agrees], works[~agrees], "o", mfc="none", mec="0.75", mew=0.4, ms=2.5)
    look: style.Look = {"cmap": HEIGHT_COLOURS, "norm": norm, "s": 8, "zorder": 3}
    axes.scatter(ranges[agrees], works[agrees], c=heights[agrees], **look)
    axes.set(xscale="log", yscale="log")
    axes.set(xlabel="range of adhesion ρ (nm)", ylabel="work of adhesion $W$ (mJ/m²)")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    return float(agrees.mean()) if agrees.size else 0.0
