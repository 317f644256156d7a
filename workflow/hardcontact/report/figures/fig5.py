"""Fig. 5: the indents that plastic contact leaves in the sphere."""

from itertools import cycle

import matplotlib as mpl
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, panels, style

LINE_COLOURS = {"x": "#B2182B", "y": "#053061"}  # as in the paper; colours of no surface
COLOUR_BEFORE = "0.5"  # grey: the sphere before contact
#: Shades of depths in (a) and of preloads in (d-f), where published sizes are black.
DEPTH_COLOURS = mpl.colormaps["Purples"]
PRELOAD_STYLES = ("-", "-.", ":")  # dashed lines are published
SIZES = {  # by variable: title, axis label, name of the published constant
    "depth": ("deepest point", "depth (nm)", "indent_depth"),
    "equal_area_side": ("largest indent", "side of an equal square (nm)", "indent_edge_length"),
    "longer_side": ("largest indent", "longer side (nm)", "indent_edge_length"),
}
PUBLISHED_PRELOAD = "preload_indentation"  # name of the published constant
SHARES = np.linspace(0, 1, 101)  # steps of the distributions


def draw(indent: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw Fig. 5: (a) a contact, (b, c) lines through its deepest point, (d-f) all contacts."""
    published = published_constants["value"]
    indent_at_preload = indent.sel(preload=published[PUBLISHED_PRELOAD], method="nearest")
    figure, ((indents, *lines), sizes) = drawing.create_rows(
        5.3, indent, row_heights=(1.2, 1), panel_widths=((1.35, 1, 1), (1, 1, 1))
    )
    _draw_map(indents, indent_at_preload)
    depths = indent_at_preload["indentation"]
    reach = min(2 * panels.mask_half_width(depths > 0), depths["x"].values.max())
    view = -reach, reach
    indents.set(xlim=view, ylim=view)
    for axes, letter, axis in zip(lines, "bc", LINE_COLOURS, strict=True):
        _draw_line(axes, indent_at_preload, axis)
        axes.set_xlim(view)
        style.label_panel(axes, letter, f"sphere along {axis}")
    lines[0].set_ylabel("height (nm)")
    for axes, letter, name in zip(sizes, "def", SIZES, strict=True):
        title, label, constant = SIZES[name]
        _draw_sizes(axes, indent[name], published[constant], published[PUBLISHED_PRELOAD])
        axes.set_xlabel(label)
        style.label_panel(axes, letter, title)
    sizes[0].set_ylabel("cumulative share of contacts")
    entries = style.legend_entries(sizes[:1])
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=len(entries))
    return figure


def _draw_map(axes: Axes, indent_at_preload: xr.Dataset) -> None:
    """Map the depth (nm) of one contact in the sphere, with the two lines of panels b and c."""
    depths = indent_at_preload["indentation"].transpose("y", "x")
    image = axes.pcolormesh(
        depths["x"], depths["y"], depths, cmap=DEPTH_COLOURS, **style.PIXEL_LOOK
    )
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="indentation (nm)")
    axes.axhline(0, color=LINE_COLOURS["x"], lw=0.8)
    axes.axvline(0, color=LINE_COLOURS["y"], lw=0.8)
    axes.set(aspect="equal", xlabel="x (nm)", ylabel="y (nm)")
    axes.locator_params(nbins=5)
    label = indent_at_preload.attrs["label"]
    preload = _format_preload(indent_at_preload["preload"])
    style.label_panel(axes, "a", f"one contact on {label}, {preload}")


def _draw_line(axes: Axes, indent_at_preload: xr.Dataset, axis: str) -> None:
    """Draw the sphere, its indents down, along x or y (nm) through the deepest point."""
    other_axis = "y" if axis == "x" else "x"
    line = indent_at_preload.sel({other_axis: 0})  # x and y are relative to the deepest point
    height_before = -line["sphere_height"]
    height_after = height_before - line["indentation"]
    axes.fill_between(
        line[axis], height_after, height_before, color=LINE_COLOURS[axis], alpha=0.25, lw=0
    )
    axes.plot(line[axis], height_before, color=COLOUR_BEFORE, ls=":", label="before")
    axes.plot(line[axis], height_after, color=LINE_COLOURS[axis], label="after")
    axes.set_xlabel(f"{axis} (nm)")
    axes.locator_params(nbins=5)
    axes.legend(loc="lower left")


def _draw_sizes(
    axes: Axes, sizes: xr.DataArray, published: float, published_preload: float
) -> None:
    """Draw the distribution of a size (nm) over all contacts by preload, and the published size."""
    other_dims = [dim for dim in sizes.dims if dim != "preload"]
    quantiles = sizes.quantile(SHARES, other_dims, method="inverted_cdf").transpose("preload", ...)
    shades = DEPTH_COLOURS(np.linspace(0.5, 0.95, quantiles.sizes["preload"]))
    for curve, colour, dashes in zip(quantiles, shades, cycle(PRELOAD_STYLES), strict=False):
        label = f"computed, {_format_preload(curve['preload'])}"
        look: style.Look = {"color": colour, "ls": dashes, "drawstyle": "steps-post"}
        axes.plot(curve, SHARES, label=label, **look)
    label = f"published, {_format_preload(published_preload)}"
    axes.axvline(published, color=style.PUBLISHED_COLOUR, lw=1.0, ls="--", label=label)
    axes.set_ylim(0, 1)
    axes.set_xlim(left=0)


def _format_preload(preload: float | xr.DataArray) -> str:
    return f"{float(preload) / style.MICRONEWTON:g} µN"
