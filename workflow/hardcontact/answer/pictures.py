"""Pictures of the page of own surfaces: its curves where no script runs, and height maps."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from io import BytesIO
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from hardcontact.answer.captions import web_png
from hardcontact.figures import style

WIDTH = 4.2  # inch: 360 pixels of a phone show 9 points as 11 pixels
RESOLUTION = 150  # dots per inch
MANY = 30  # points from which on a line needs no marks


@contextmanager
def _larger_text() -> Iterator[None]:
    """Set the style of print with text that can be read on a phone."""
    sizes: dict[Any, Any] = {
        f"{part}size": 9.0
        for part in ("font.", "axes.title", "axes.label", "xtick.label", "ytick.label",
                     "legend.font")
    }  # fmt: skip
    with style.print_style(), mpl.rc_context(sizes):
        yield


def heights_shown(of_surface: xr.Dataset) -> np.ndarray:
    """Return the heights (row, column) in nm about their mean, without rows that only pad them."""
    example = of_surface["example_heights"].dropna("row", how="all").dropna("column", how="all")
    heights: np.ndarray = example.values - example.values.mean()
    return heights


@_larger_text()
def map_figure(of_surface: xr.Dataset) -> Figure:
    """Draw the first levelled scan of a surface: part of topography.nc."""
    figure = Figure(figsize=(WIDTH, 3.7), layout="constrained")
    style.draw_map(figure.subplots(), heights_shown(of_surface), of_surface["scan_size"].item())
    return figure


@_larger_text()
def curve_figure(curve: Mapping[str, Any]) -> Figure:
    """Draw curves, as from `hardcontact.answer.curves`, as a page does."""
    figure = Figure(figsize=(WIDTH, 3.4 + 0.16 * len(curve["series"])), layout="constrained")
    axes = figure.subplots()
    x = np.array(curve["x"]["values"], float)
    for one in curve["series"]:
        value = np.array(one["values"], float)
        there = np.isfinite(value) | one.get("gaps", False)
        marks = "." if there.sum() < MANY else ""
        axes.plot(x[there], value[there], marks + "-", color=one["colour"], label=one["label"])
        if one["low"]:
            ends = (np.array(one[end], float)[there] for end in ("low", "high"))
            axes.fill_between(x[there], *ends, color=one["colour"], alpha=0.2, lw=0)
    for name, set_scale in (("x", axes.set_xscale), ("y", axes.set_yscale)):
        set_scale("log" if curve[name]["log"] else "linear")
    axes.set(xlabel=curve["x"]["label"], ylabel=curve["y"]["label"], xlim=(x.min(), x.max()))
    axes.set_ylim(curve["y"].get("range"))
    style.shade_artificial(axes, curve.get("shaded", []))
    if "alike" in curve:
        axes.axhspan(*curve["alike"], color="0.82", lw=0, zorder=0.5)
    for mark in curve.get("marks", []):
        axes.axvline(mark, color="0.4", lw=1, ls="--", zorder=0.6)
    figure.legend(loc="outside upper center", ncols=1)
    return figure


@_larger_text()
def png(figure: Figure) -> bytes:
    """Return the picture of a figure as PNG in few colours, the same bytes each time."""
    style.freeze_layout(figure)
    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=RESOLUTION, metadata={"Software": None})
    return web_png(buffer.getvalue(), round(WIDTH * RESOLUTION))
