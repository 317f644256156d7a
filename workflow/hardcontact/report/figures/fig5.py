"""Fig. 5: the indents that plastic contact leaves in the sphere."""

import matplotlib as mpl
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, style, tables

TITLE = "Fig. 5: indents in the sphere"
CHAPTER = "2. Contact"
CAPTION = """\
(a) Depth of the indents of one plastic contact. (b, c) Height of the sphere along the red and the
blue line before and after; indents point downwards. (d-f) Share of contacts whose deepest point,
root of the largest indent's area, and longer side of that indent do not exceed a length. Dashed:
published, 2 nm and 50 nm.

The preload of (a) is the published 20 µN, or the nearest one computed. The contact of (a) has the
median depth of all contacts. Distributions (d-f) are over all contacts, one curve for each preload
computed. The paper does not say which of (e) and (f) its edge length is. Preload and hardness
alone fix the whole area in contact, so that (e) cannot exceed its square root. The paper's images
of a sphere show the sum of 400 contacts, which is not computed here. Drawn from indent.nc and
resources/paper/parameters.csv.
"""

LINE_COLOURS = {"x": "#B2182B", "y": "#053061"}  # red and blue as in the paper; no surface has them
BEFORE = "0.5"
DEPTH_COLOURS = mpl.colormaps[
    "Purples"
]  # preloads have its colours too, as black is for published values
SIZES = {  # title, axis, published constant
    "depth": ("deepest point", "depth (nm)", "indent_depth"),
    "equal_area_side": ("largest indent: √area", "edge length (nm)", "indent_edge_length"),
    "longer_side": ("largest indent: longer side", "lateral size (nm)", "indent_edge_length"),
}
PRELOAD = "preload_indentation"  # the published constant
SHARES = np.linspace(0, 1, 101)  # steps of the distributions
COLUMNS = [*tables.ROW_COLUMNS, "preload", "position", "share", "value", "unit"]


def draw(indent: xr.Dataset, published_constants: pd.DataFrame) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 5: (a) a contact, (b, c) lines through its deepest point, (d-f) all contacts.

    The table has the height of the sphere before and after against `position` (b, c), and the size
    that a `share` of all contacts does not exceed (d to f).
    """
    published = published_constants["value"]
    contact = indent.sel(preload=published[PRELOAD], method="nearest")
    figure, ((indents, *lines), sizes) = drawing.create_rows(
        5.3, indent, (1.2, (1.35, 1, 1)), (1, (1, 1, 1))
    )
    _draw_map(indents, contact)
    depths = contact["indentation"]
    reach = min(2 * style.mask_half_width(depths > 0), depths["x"].values.max())
    view = -reach, reach
    indents.set(xlim=view, ylim=view)
    frames = []
    for axes, letter, axis in zip(lines, "bc", LINE_COLOURS, strict=True):
        rows = _draw_line(axes, contact, axis)
        axes.set_xlim(view)
        style.label_panel(axes, letter, f"sphere along {axis}")
        frames.append(
            rows.assign(panel=letter, origin="computed", preload=contact["preload"].item())
        )
    lines[0].set_ylabel("height (nm)")
    for axes, letter, name in zip(sizes, "def", SIZES, strict=True):
        rows = _draw_sizes(axes, indent, name, published)
        style.label_panel(axes, letter, SIZES[name][0])
        frames.append(rows.assign(panel=letter, quantity=name))
    sizes[0].set_ylabel("cumulative share of contacts")
    entries = style.legend_entries(sizes[:1])
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=len(entries))
    constant_columns = {name: indent.attrs[name] for name in ("surface", "label", "basis")} | {
        "unit": "nm"
    }
    return pd.concat(frames, ignore_index=True).assign(**constant_columns)[COLUMNS], figure


def _draw_map(axes: Axes, contact: xr.Dataset) -> None:
    """Map the depth (nm) of one contact in the sphere, with the two lines of panels b and c."""
    depths = contact["indentation"].transpose("y", "x")
    image = axes.pcolormesh(
        depths["x"], depths["y"], depths, cmap=DEPTH_COLOURS, **style.PIXEL_LOOK
    )
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="indentation (nm)")
    axes.axhline(0, color=LINE_COLOURS["x"], lw=0.8)
    axes.axvline(0, color=LINE_COLOURS["y"], lw=0.8)
    axes.set(aspect="equal", xlabel="x (nm)", ylabel="y (nm)")
    axes.locator_params(nbins=5)
    label = contact.attrs["label"]
    preload = _print_preload(contact["preload"])
    style.label_panel(axes, "a", f"one contact on {label}, {preload}")


def _draw_line(axes: Axes, contact: xr.Dataset, axis: str) -> pd.DataFrame:
    """Draw the sphere's height (nm) before and after, along x or y through the deepest point.

    Heights point out of the sphere, as under a microscope: indents point downwards.
    """
    other_axis = "y" if axis == "x" else "x"
    line = contact.sel({other_axis: 0})
    height_before = -line["sphere_height"]
    height_after = height_before - line["indentation"]
    axes.fill_between(
        line[axis], height_after, height_before, color=LINE_COLOURS[axis], alpha=0.25, lw=0
    )
    axes.plot(line[axis], height_before, color=BEFORE, lw=0.8, label="before")
    axes.plot(line[axis], height_after, color=LINE_COLOURS[axis], label="after")
    axes.set_xlabel(f"{axis} (nm)")
    axes.locator_params(nbins=5)
    axes.legend(loc="lower left")
    heights = {"height_before": height_before.values, "height_after": height_after.values}
    rows = pd.DataFrame(heights | {"position": line[axis].values})
    return rows.melt("position", var_name="quantity")


def _draw_sizes(axes: Axes, indent: xr.Dataset, name: str, published: pd.Series) -> pd.DataFrame:
    """Draw the distribution over all contacts of a size (nm), and its published value."""
    _, quantity, constant = SIZES[name]
    contacts = [dim for dim in indent[name].dims if dim != "preload"]
    sizes = indent[name].quantile(SHARES, contacts, method="inverted_cdf")
    sizes = sizes.transpose("preload", "quantile").rename(quantile="share")
    shades = DEPTH_COLOURS(np.linspace(0.5, 0.95, sizes.sizes["preload"]))
    for values, colour in zip(sizes, shades, strict=True):
        label = f"computed, {_print_preload(values['preload'])}"
        axes.plot(values, SHARES, color=colour, drawstyle="steps-post", label=label)
    label = f"published, {_print_preload(published[PRELOAD])}"
    axes.axvline(published[constant], color=style.PUBLISHED_COLOUR, lw=1.0, ls="--", label=label)
    axes.set(xlabel=quantity, ylim=(0, 1))
    axes.set_xlim(left=0)
    published_size = {"preload": published[PRELOAD], "value": published[constant]}
    return pd.concat(
        [tables.computed_rows(sizes), pd.DataFrame([published_size | {"origin": "published"}])]
    )


def _print_preload(preload: float | xr.DataArray) -> str:
    return f"{float(preload) / style.MICRONEWTON:g} µN"
