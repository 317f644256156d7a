"""Fig. 5: the indents that plastic contact leaves in the sphere."""

import matplotlib as mpl
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables

TITLE = "Fig. 5: indents in the sphere"
CHAPTER = "2. Contact"
CAPTION = """\
(a) How far one plastic contact presses the sphere in; (b, c) height of the sphere along its red
and blue lines before and after: indents point downwards. (d-f) Share of contacts whose deepest
point, root of the largest indent's area, and longer side of that indent do not exceed a length.
Dashed: published, 2 nm and 50 nm.

The contact of (a) is that whose depth at the largest preload is the median of all, at the
published preload of 20 µN or the nearest one computed, around its deepest point. Distributions
(d-f) are over all contacts, for every computed preload. The paper does not say which of (e) and
(f) its edge length is, so it stands in both. Preload and hardness alone fix the whole area in
contact, up to whole pixels, so (e) cannot exceed its square root. The paper's images of a
sphere, with indents 2 to 10 nm deep and 150 to 300 nm wide, show the sum of 400 contacts and
are not computed here. Drawn from indent.nc and resources/paper/parameters.csv.
"""

ALONG = {"x": "#B2182B", "y": "#053061"}  # red and blue as in the paper; no surface has them
BEFORE = "0.5"
DEPTHS = mpl.colormaps["Purples"]  # preloads have its colours too, as black is for published values
SIZES = {  # title, axis, published constant
    "depth": ("deepest point", "depth (nm)", "indent_depth"),
    "edge_length": ("largest indent: √area", "edge length (nm)", "indent_edge_length"),
    "lateral_size": ("largest indent: longer side", "lateral size (nm)", "indent_edge_length"),
}
PRELOAD = "preload_indentation"  # the published constant
SHARES = np.linspace(0, 1, 101)  # steps of the distributions
COLUMNS = [*tables.ROW_COLUMNS, "preload", "position", "share", "value", "unit"]


def _table(indent: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Return the line scans and the distributions of Fig. 5, one row a point, values in nm.

    Line scans (panels b, c): height of the sphere before and after against `position` in nm.
    Distributions (d to f): the `value` that a `share` of all contacts does not exceed, for each
    `preload` in N. The map stays in indent.nc.
    """
    published = published_constants["value"]
    shown = indent.sel(preload=published[PRELOAD], method="nearest")
    lines = (_line_rows(shown, *of_line) for of_line in zip("bc", ALONG, strict=True))
    sizes = (_size_rows(indent, published, *of_size) for of_size in zip("def", SIZES, strict=True))
    of_all = {name: indent.attrs[name] for name in ("surface", "label", "basis")} | {"unit": "nm"}
    return pd.concat([*lines, *sizes], ignore_index=True).assign(**of_all)[COLUMNS]


def draw(indent: xr.Dataset, published_constants: pd.DataFrame) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 5: (a) a contact, (b, c) lines through its deepest point, (d-f) all contacts."""
    published = published_constants["value"]
    shown = indent.sel(preload=published[PRELOAD], method="nearest")
    figure = drawing.create(5.3, indent)
    rows = figure.add_gridspec(2, 1, height_ratios=(1.5, 1))
    above, below = rows[0], rows[1]
    columns = above.subgridspec(1, 2, width_ratios=(1, 1.3))
    _draw_map(figure.add_subplot(columns[0]), shown)
    lines = columns[1].subgridspec(2, 1).subplots(sharey=True, squeeze=False)
    _draw_lines(lines[:, 0], shown)
    sizes = below.subgridspec(1, 3).subplots(sharey=True, squeeze=False)
    _draw_sizes(sizes[0], indent, published)
    handles, labels = figure.axes[-1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=len(labels))
    return _table(indent, published_constants), figure


def _deepest(shown: xr.Dataset) -> dict[str, float]:
    """Return where the sphere is pressed in deepest, x and y in nm."""
    depths = shown["indentation"]
    return {str(along): place.item() for along, place in depths[depths.argmax(...)].coords.items()}


def _line(shown: xr.Dataset, along: str) -> dict[str, xr.DataArray]:
    """Return the sphere's height (nm) before and after, along x or y through the deepest point.

    Heights point out of the sphere, as under a microscope: indents point downwards.
    """
    across = "y" if along == "x" else "x"
    line = shown.sel({across: _deepest(shown)[across]})
    before = -line["sphere_height"]
    return {"height_before": before, "height_after": before - line["indentation"]}


def _line_rows(shown: xr.Dataset, panel: str, along: str) -> pd.DataFrame:
    rows = pd.concat(
        heights.rename({along: "position"}).to_dataframe("value").assign(quantity=quantity)
        for quantity, heights in _line(shown, along).items()
    )
    return rows.reset_index().assign(panel=panel, origin="computed")


def _distribution(indent: xr.Dataset, name: str) -> xr.DataArray:
    """Return the value (preload, quantile) that a share of all contacts does not exceed."""
    over = [dim for dim in indent[name].dims if dim != "preload"]
    values = indent[name].quantile(SHARES, over, method="inverted_cdf")
    return values.transpose("preload", "quantile")


def _size_rows(indent: xr.Dataset, published: pd.Series, panel: str, name: str) -> pd.DataFrame:
    computed = _distribution(indent, name).to_dataframe("value").reset_index()
    size = published[SIZES[name][-1]]
    rows = [
        computed.rename(columns={"quantile": "share"}).assign(origin="computed"),
        pd.DataFrame([{"preload": published[PRELOAD], "value": size, "origin": "published"}]),
    ]
    return pd.concat(rows).assign(panel=panel, quantity=name)


def draw_indents(axes: Axes, depths: xr.DataArray) -> None:
    """Map how deep (nm) the sphere is pressed in, with a colour bar."""
    depths = depths.transpose("y", "x")
    image = axes.pcolormesh(depths["x"], depths["y"], depths, cmap=DEPTHS, **style.PIXELS)
    axes.set(aspect="equal", xlabel="x (nm)", ylabel="y (nm)")
    axes.figure.colorbar(image, ax=axes, pad=0.02, shrink=0.8, label="indentation (nm)")


def _draw_map(axes: Axes, shown: xr.Dataset) -> None:
    """Map the indents of one contact, with the two lines drawn beside."""
    draw_indents(axes, shown["indentation"])
    deepest = _deepest(shown)
    axes.axhline(deepest["y"], color=ALONG["x"], lw=0.8)
    axes.axvline(deepest["x"], color=ALONG["y"], lw=0.8)
    axes.set(xlim=_view(shown, "x"), ylim=_view(shown, "y"))
    axes.locator_params(nbins=5)
    label, preload = shown.attrs["label"], print_preload(shown["preload"])
    style.label_panel(axes, "a", f"one contact on {label}, {preload}")


def _view(shown: xr.Dataset, along: str) -> tuple[float, float]:
    """Return limits (nm) about the deepest point, twice as far as the farthest indent."""
    depths, deepest = shown["indentation"], _deepest(shown)
    farthest = (abs(depths[name] - deepest[name]).where(depths > 0).max().item() for name in ALONG)
    reach, places = 2 * max(farthest), depths[along].values
    return max(deepest[along] - reach, places.min()), min(deepest[along] + reach, places.max())


def _draw_lines(column: np.ndarray, shown: xr.Dataset) -> None:
    """Draw the sphere before and after (nm), along x above and along y below."""
    for axes, letter, (along, colour) in zip(column, "bc", ALONG.items(), strict=True):
        line = _line(shown, along)
        before, after = line["height_before"], line["height_after"]
        place = before[along]
        axes.fill_between(place, after, before, color=colour, alpha=0.25, lw=0)
        axes.plot(place, before, color=BEFORE, lw=0.8, label="before")
        axes.plot(place, after, color=colour, label="after")
        axes.set(xlim=_view(shown, along), xlabel=f"{along} (nm)", ylabel="height (nm)")
        axes.locator_params(axis="y", nbins=5)
        axes.legend(loc="lower left")
        style.label_panel(axes, letter, f"sphere along {along}")


def _draw_sizes(row: np.ndarray, indent: xr.Dataset, published: pd.Series) -> None:
    """Draw the distribution over all contacts of each size (nm), and its published value."""
    for axes, letter, name in zip(row, "def", SIZES, strict=True):
        title, quantity, constant = SIZES[name]
        sizes = _distribution(indent, name)
        shades = DEPTHS(np.linspace(0.5, 0.95, sizes.sizes["preload"]))
        for values, colour in zip(sizes, shades, strict=True):
            label = f"computed, {print_preload(values['preload'])}"
            axes.plot(values, SHARES, color=colour, drawstyle="steps-post", label=label)
        label = f"published, {print_preload(published[PRELOAD])}"
        axes.axvline(published[constant], color=style.PUBLISHED, lw=1.0, ls="--", label=label)
        axes.set(xlabel=quantity, ylim=(0, 1))
        axes.set_xlim(left=0)
        style.label_panel(axes, letter, title)
    row[0].set_ylabel("cumulative share of contacts")


def print_preload(preload: float | xr.DataArray) -> str:
    """Return a preload (N) as it is printed."""
    return f"{float(preload) / style.MICRONEWTON:g} µN"
