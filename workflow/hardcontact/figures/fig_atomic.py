"""One master on finer and finer pixels: its force without the shortest waves."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables

# Of no surface: from coarse pixels, pale, to the finest, black.
PALEST = 0.65
MARKERS = ("s", "^", "D", "o")
DRAWN = (  # panel, quantity, unit
    ("a", "ratio", "1"),
    ("a", "edge", "nm"),
    ("b", "filtered_over_finest", "1"),
    ("b", "force_over_finest", "1"),
)
COLUMNS = [
    "panel", "origin", "quantity", "pixels", "pixel_size", "cutoff_wavelength",
    *tables.VALUE_COLUMNS,
]  # fmt: skip


def table(atomic: xr.Dataset) -> pd.DataFrame:
    """Return what the figure is drawn from, one row a number.

    `ratio` against `cutoff_wavelength` and its short `edge` (panel a), the forces over those of the
    finest pixels at each cutoff and without one (panel b), lengths in nm. An open edge has no row.
    """
    rows = tables.drawn_rows(atomic, *DRAWN)
    sizes = atomic["pixel_size"].to_series().rename("pixel_size")
    return rows.join(sizes, on="pixels").reindex(columns=COLUMNS).reset_index(drop=True)


def draw(atomic: xr.Dataset) -> Figure:
    """Draw (a) ratio curves on each number of pixels, (b) their forces over the finest."""
    figure = drawing.create(3.3, atomic)
    curves, changes = figure.subplots(1, 2, sharex=True)
    _draw_ratios(curves, atomic)
    _draw_over_finest(changes, atomic)
    for axes in (curves, changes):
        axes.set(xscale="log", xlabel="cutoff wavelength (nm)")
        style.label_logarithmic(axes.xaxis, at=(1, 2, 5))
        style.shade_artificial(axes, [(0.0, float(atomic.attrs["transition"]))])
    style.label_panel(curves, "a", style.REMOVED["small"])
    style.label_panel(changes, "b", "what coarser pixels miss")
    return figure


def _looks(atomic: xr.Dataset) -> dict[Any, style.Look]:
    """Return colour, marker and label by the number of pixels."""
    sizes = atomic["pixel_size"].to_series()
    looks = zip(
        sizes.items(), np.linspace(PALEST, 0, len(sizes)), MARKERS[-len(sizes) :], strict=True
    )
    return {
        pixels: {
            "color": str(shade),
            "marker": marker,
            "label": f"{pixels}² pixels of {size:.2g} nm",
        }
        for (pixels, size), shade, marker in looks
    }


def _draw_ratios(axes: Axes, atomic: xr.Dataset) -> None:
    """Draw force over unfiltered force against cutoff (nm), and where it leaves its tolerance."""
    tolerance = atomic.attrs["scale_tolerance"]
    axes.axhspan(1 - tolerance, 1 + tolerance, color="0.9", zorder=0, lw=0)
    curves, edges = tables.bounded(atomic, "ratio"), atomic["edge"]
    for pixels, look in _looks(atomic).items():
        common = {**look, "elinewidth": 0.7, "ms": 4, "lw": 1}
        style.draw_bars(axes, curves["cutoff_wavelength"], curves.sel(pixels=pixels), **common)
        axes.axvline(edges.sel(pixels=pixels).item(), color=look["color"], lw=0.8, ls=":")
    axes.set(ylabel=f"pull-off force / unfiltered, at ρ = {atomic.attrs['rho']:g} nm")
    axes.legend(loc="upper left", fontsize=6)


def _draw_over_finest(axes: Axes, atomic: xr.Dataset) -> None:
    """Draw by how many percent forces differ from those on the finest pixels.

    Without a cutoff they stand at two pixels, where the roughness of the surface ends, as open
    marks.
    """
    changes = (tables.bounded(atomic, "filtered_over_finest") - 1) / style.PERCENT
    unfiltered = (tables.bounded(atomic, "force_over_finest") - 1) / style.PERCENT
    axes.axhline(0, color="0.6", lw=0.8, zorder=0)
    for pixels, look in list(_looks(atomic).items())[:-1]:
        common = {**look, "elinewidth": 0.7, "ms": 4}
        of_pixels = changes.sel(pixels=pixels)
        style.draw_bars(axes, of_pixels["cutoff_wavelength"], of_pixels, lw=1, **common)
        end = [2 * atomic["pixel_size"].sel(pixels=pixels).item()]
        style.draw_bars(axes, end, unfiltered.sel(pixels=pixels), mfc="white", **common)
    axes.set(ylabel="force over that on the finest − 1 (%)")
