"""The force of a surface with roughness removed below or above a cutoff, and the band's edges."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.answer import canvas
from hardcontact.answer.artificial import artificial_bands
from hardcontact.figures import style
from hardcontact.figures.marks import REMOVED, reach
from hardcontact.figures.tables import bounded
from hardcontact.numbers.printing import print_share
from hardcontact.scales.critical_band import computed_cutoffs

CURVE: dict[str, Any] = {"color": "#0072B2", "marker": "o"}
EDGE: dict[str, Any] = {"color": "#D55E00", "lw": 1.4}
EDGE_INTERVAL: dict[str, Any] = {"color": "#D55E00", "alpha": 0.25, "lw": 0}
TOLERANCE: dict[str, Any] = {"color": "0.82", "lw": 0}
FAR = 10.0  # factor beyond the ratios, where a panel ends if bars do not end before
EDGE_ROOM = 1.3  # factor by which a panel goes beyond what it shows
MARGIN = 2.0  # factor by which the wavelengths shown go beyond the cutoffs


@canvas.canvas_style()
def draw(edges: xr.Dataset, spectra: xr.Dataset) -> Figure:
    """Draw the force over the unfiltered one against the cutoff, with the edge at each side.

    Parameters
    ----------
    edges : xarray.Dataset
        Part of edges.nc of one surface: `scale_ratio` (side, cutoff_wavelength), `edge`,
        `edge_bound`, `edge_at_least` and `edge_text` (side), their intervals, and the attribute
        `tolerance`.
    spectra : xarray.Dataset
        Part of spectra.nc of the surface, as `artificial_bands` takes it.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = canvas.create(5.2)
    panels = figure.subplots(2, 1, sharex=True)
    for axes, (side, title) in zip(panels, REMOVED.items(), strict=True):
        of_side = edges.sel(side=side)
        _draw_ratio(axes, of_side, edges.attrs["tolerance"])
        _draw_edge(axes, of_side)
        axes.set_title(title, loc="left")
        axes.set_ylabel("force / unfiltered")
    cutoffs = np.concatenate(
        [computed_cutoffs(edges["scale_ratio"].sel(side=side)) for side in REMOVED]
    )
    panels[1].set(xlim=(cutoffs.min() / MARGIN, cutoffs.max() * MARGIN), xlabel="cutoff wavelength")
    canvas.label_lengths(panels[1].xaxis)
    for axes in panels:
        style.shade_artificial(axes, artificial_bands(spectra))
    figure.legend(handles=_legend_handles(edges), loc="outside upper center", ncols=2)
    return figure


def _draw_ratio(axes: Axes, of_side: xr.Dataset, tolerance: float) -> None:
    """Draw ratio and interval against cutoff (nm), and the change that counts as none."""
    axes.axhspan(1 - tolerance, 1 + tolerance, zorder=0.5, **TOLERANCE)
    curve = bounded(of_side, "scale_ratio").sel(
        cutoff_wavelength=computed_cutoffs(of_side["scale_ratio"])
    )
    value = curve["value"]
    far = curve.assign(  # an interval without bounds leaves the panel
        low=np.maximum(curve["low"], value / FAR**2), high=np.minimum(curve["high"], value * FAR**2)
    )
    axes.errorbar(curve["cutoff_wavelength"], value, reach(far), elinewidth=0.8, **CURVE)
    low, high = (far[end].fillna(value) for end in ("low", "high"))
    shown = (
        max(float(low.min()), float(value.min()) / FAR),
        min(float(high.max()), float(value.max()) * FAR),
    )
    shown = min(shown[0], 1 - tolerance), max(shown[1], 1 + tolerance)
    axes.set(xscale="log", yscale="log", ylim=(shown[0] / EDGE_ROOM, shown[1] * EDGE_ROOM))
    canvas.label_numbers(axes.yaxis)


def _draw_edge(axes: Axes, of_side: xr.Dataset) -> None:
    """Mark the edge and its interval, or by an arrow from its bound that it lies beyond."""
    if np.isfinite(of_side["edge"]):
        axes.axvline(of_side["edge"].item(), zorder=1, **EDGE)
        _draw_interval(axes, of_side)
        return
    bound = of_side["edge_bound"].item()
    further = bound * (MARGIN**0.8 if of_side["edge_at_least"] else MARGIN**-0.8)
    axes.annotate(
        "",
        xy=(further, 0.1),
        xytext=(bound, 0.1),
        xycoords=axes.get_xaxis_transform(),
        arrowprops={"arrowstyle": "-|>", "color": EDGE["color"], "lw": 1.6, "shrinkA": 0},
    )
    axes.axvline(bound, ls=":", zorder=1, **EDGE)


def _draw_interval(axes: Axes, of_side: xr.Dataset) -> None:
    """Draw the interval of an edge; an open end runs to the last cutoff on its side."""
    ends = of_side["edge_interval"].values
    if np.isfinite(ends).any():
        cutoffs = computed_cutoffs(of_side["scale_ratio"])
        low, high = np.where(np.isfinite(ends), ends, (cutoffs.min(), cutoffs.max()))
        axes.axvspan(low, high, zorder=0.8, **EDGE_INTERVAL)


def _legend_handles(edges: xr.Dataset) -> list[Any]:
    """Return one entry for each kind of mark."""
    confidence = print_share(edges.attrs["confidence"])
    open_edges = not np.isfinite(edges["edge"]).all()
    arrow = Line2D([], [], ls=":", marker=">", ms=5, label="open edge", **EDGE)
    known = np.isfinite(edges["scale_ratio_interval"]).any()
    return [
        Line2D([], [], label=f"mean and {confidence} interval" if known else "mean", **CURVE),
        Patch(label=f"±{print_share(edges.attrs['tolerance'])}", **TOLERANCE),
        Line2D([], [], label="edge of the band", **EDGE),
        *([Patch(label="interval of the edge", **EDGE_INTERVAL)] if known else []),
        Patch(label="no reliable scan", **style.ARTIFICIAL),
        *([arrow] if open_edges else []),
    ]
