"""Fig. 6: length scales of roughness that change the pull-off force."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_length, format_share
from hardcontact.report.figures import drawing, panels, style

TITLES = {
    "short": "roughness below the cutoff removed",
    "long": "roughness above the cutoff removed",
}
EDGE_LOOK: style.Look = {"ls": "none", "marker": "o", "mfc": "white", "mew": 1.3, "ms": 5.5}
#: Ends of the y axis, as changes in tolerances: the strip of the tolerance is equally wide in every
#: study.
SHOWN_TOLERANCES = (-3, 7)


def draw(
    edges: xr.Dataset, filtered_forces: xr.Dataset, published_constants: pd.DataFrame
) -> Figure:
    """Draw Fig. 6: the force by cutoff, a panel for each side of the band."""
    figure = drawing.create_figure(3.6, edges)
    both_axes = figure.subplots(1, 2, sharey=True)
    both_axes[0].set_ylim(1 + edges.attrs["tolerance"] * np.array(SHOWN_TOLERANCES))
    published_edges = panels.published_band(published_constants)
    for letter, side, published, axes in zip("ab", TITLES, published_edges, both_axes, strict=True):
        _draw_side(axes, edges.sel(side=side))
        axes.axvline(published, zorder=1, **style.PUBLISHED_LOOK)
        transition = float(filtered_forces["transition"].sel(side=side))
        artificial_wavelengths = (0.0, transition) if side == "short" else (transition, np.inf)
        panels.hatch_wavelengths(axes, [artificial_wavelengths])
        axes.set_xlabel("cutoff wavelength (nm)")
        style.label_panel(axes, letter, TITLES[side])
    rho = filtered_forces.attrs["rho"]
    both_axes[0].set_ylabel(f"force / unfiltered force\n(range of adhesion {rho:g} nm)")
    confidence = format_share(edges.attrs["confidence"])
    tolerance = format_share(edges.attrs["tolerance"])
    edge_words = " and ".join(format_length(edge) for edge in published_edges)
    handles = [
        *style.surface_handles(edges),
        Line2D([], [], color="0.6", lw=0.7, label=f"{confidence} interval (bars)"),
        Patch(label=f"change below {tolerance}", **panels.UNCHANGED_LOOK),
        Line2D([], [], label=f"edge: first change by {tolerance} from 1", mec="0.3", **EDGE_LOOK),
        Line2D([], [], label=f"published edges: {edge_words}", **style.PUBLISHED_LOOK),
        Patch(label="artificial roughness", **style.HATCHED_LOOK),
    ]
    style.legend_above(figure, handles)
    return figure


def _draw_side(axes: Axes, edges: xr.Dataset) -> None:
    """Draw the ratios of one side of the band within the y axis, and a ring at each edge."""
    tolerance = edges.attrs["tolerance"]
    ratio = panels.value_and_interval(edges, "filtered_force_ratio")
    ratio = ratio.dropna("cutoff_wavelength", how="all")
    low, high = axes.get_ylim()
    is_shown = (low < ratio["value"]) & (ratio["value"] < high)
    # Ratios beyond the y axis have no bars. Those next to shown ones are kept without bars, so that
    # curves leave the frame.
    ratio = ratio.assign(ratio[["low", "high"]].where(is_shown))
    windows = is_shown.any("surface").rolling(cutoff_wavelength=3, center=True, min_periods=1)
    ratio = ratio.where(windows.max() > 0, drop=True)
    panels.draw_ratios(axes, ratio, tolerance)
    for look, curve in style.iterate_surfaces(ratio["value"]):
        edge = edges["edge"].sel(group=curve["surface"].item()).item()
        if np.isfinite(edge):  # A surface has no edge if its force stays within the tolerance.
            change = np.interp(edge, curve["cutoff_wavelength"], curve) - 1
            height = 1 + np.copysign(tolerance, change)
            axes.plot(edge, height, mec=look["color"], zorder=5, **EDGE_LOOK)
