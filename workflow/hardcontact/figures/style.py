"""Style of all figures: fonts, looks of surfaces, axes, legends, maps, note on substitutes."""

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import cycle
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from matplotlib.transforms import Bbox

WIDTH = 7.0  # inch: two columns of a journal page
FOOTER = 0.2  # inch kept free below the axes for the line that names the substitutes

# The palette of Okabe & Ito (2008), readable with every common colour blindness. Its grey is kept
# for the sphere, its black for published and pooled values; its yellow is too pale for thin lines.
SUBSTRATES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
SPHERE = "#7F7F7F"
PUBLISHED = "#000000"
MARKERS = ("o", "s", "^", "D", "v", "P")

BEYOND = 10.0  # how many times farther than all values a logarithmic axis may reach
MOST_COLUMNS = 4  # of a legend above a figure

#: How artificial wavelengths are shaded in every figure.
ARTIFICIAL: dict[str, Any] = {
    "facecolor": "#F7E9CF",
    "edgecolor": "#D9B97C",
    "hatch": "///",
    "lw": 0.0,
}

RC: dict[Any, Any] = {
    "font.family": "DejaVu Sans",  # ships with matplotlib: the same bytes on every machine
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "image.interpolation": "nearest",  # every pixel of a height map is shown as it is
    "pdf.fonttype": 42,  # text in the PDF can be searched and copied
}


@contextmanager
def print_style() -> Iterator[None]:
    """Set the style of print for a block or, as a decorator, for a function."""
    with mpl.rc_context(RC):
        yield


def colours(surfaces: Iterable[str], sphere: str | None = None) -> dict[str, str]:
    """Return the colour of each surface: by its place among the substrates, grey for the sphere."""
    substrates = [str(name) for name in surfaces if str(name) != sphere]
    chosen = dict(zip(substrates, cycle(SUBSTRATES), strict=False))
    return chosen if sphere is None else {**chosen, sphere: SPHERE}


def looks(substrates: Iterable[str]) -> dict[str, dict[str, Any]]:
    """Return colour and marker of each substrate, as plots take them: told also without colour."""
    chosen = zip(colours(substrates).items(), cycle(MARKERS), strict=False)
    return {name: {"color": colour, "marker": marker} for (name, colour), marker in chosen}


def create(height: float) -> Figure:
    """Return an empty figure of print width and the given height (inch), with room for a footer."""
    footer = FOOTER / height
    layout = ConstrainedLayoutEngine(rect=(0, footer, 1, 1 - footer))
    return Figure(figsize=(WIDTH, height), layout=layout)


def three_above_two(height: float, below: float) -> tuple[Figure, np.ndarray, np.ndarray]:
    """Return a figure of this height (inch) and its panels, three above two.

    `below` is the height of the lower panels over that of the upper ones.
    """
    figure = create(height)
    rows = figure.add_gridspec(2, 1, height_ratios=(1, below))
    upper = rows[0].subgridspec(1, 3).subplots(squeeze=False)[0]
    lower = rows[1].subgridspec(1, 2).subplots(squeeze=False)[0]
    return figure, upper, lower


def freeze_layout(figure: Figure) -> None:
    """Lay the figure out once and keep the positions to a millionth of its size.

    Beyond that the solver's digits differ from run to run, and with them the bytes of the file.
    """
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axes in figure.axes:
        bounds = axes.get_position(original=True).bounds
        axes.set_position(Bbox.from_bounds(*(round(bound, 6) for bound in bounds)))


def label_panel(axes: Axes, letter: str, title: str = "") -> None:
    """Write the panel's letter, bold, and its title above the axes, flush left."""
    axes.set_title(rf"$\mathbf{{{letter}}}$  {title}", loc="left")


def label_logarithmic(*axes: Axis, at: tuple[int, ...] = (1, 2, 3, 5)) -> None:
    """Label logarithmic axes by plain numbers: at these digits of each decade, or at decades.

    Over more than three decades there is room for one label a decade at most.
    """
    for axis in axes:
        low, high = axis.get_view_interval()
        digits = (1,) if high > 1e3 * low else at
        others = [digit for digit in range(2, 10) if digit not in digits]
        axis.set_major_locator(LogLocator(subs=digits))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(LogLocator(subs=others))
        axis.set_minor_formatter(NullFormatter())


def end_near_values(panels: Sequence[Axes]) -> None:
    """End the logarithmic y axes of panels a decade beyond the values drawn as lines, at most.

    The panels share their y axis. Error bars and bands do not count: an interval of two scans may
    span twenty decades, and all values would lie in one line. What is longer leaves the frame.
    """
    heights = [
        np.asarray(line.get_ydata(), float)
        for axes in panels
        for line in axes.lines
        if line.get_transform().contains_branch_seperately(axes.transData)[1]
    ]
    values = np.concatenate(heights)
    values = values[np.isfinite(values) & (values > 0)]
    low, high = panels[0].get_ylim()
    panels[0].set_ylim(max(low, values.min() / BEYOND), min(high, values.max() * BEYOND))


def draw_over_range(axes: Axes, curve: xr.Dataset, band: float, **look: Any) -> None:
    """Draw `value` against `rho`, and the band from `low` to `high` with the opacity `band`."""
    axes.fill_between(
        curve["rho"], curve["low"], curve["high"], color=look["color"], alpha=band, lw=0
    )
    axes.plot(curve["rho"], curve["value"], **look)


def shade_artificial(axes: Axes, bands: Iterable[tuple[float, float]]) -> None:
    """Shade bands of wavelengths (nm) of logarithmic axes as far as their limits reach."""
    left, right = axes.get_xlim()
    for first, last in bands:
        if last > left and first < right:
            axes.axvspan(max(first, left), min(last, right), zorder=-1, **ARTIFICIAL)
    axes.set_xlim(left, right)


def surface_handles(dataset: xr.Dataset, **look: Any) -> list[Line2D]:
    """Return one entry of a legend for each substrate of a dataset with `label(surface)`."""
    labelled = zip(looks(dataset["surface"].values).values(), dataset["label"].values, strict=True)
    return [
        Line2D([], [], **of_surface, **look, label=str(label)) for of_surface, label in labelled
    ]


def legend_above(figure: Figure, handles: Sequence[Artist]) -> None:
    """Write a legend above all axes, in as many columns as fit the width of the figure."""
    for columns in range(MOST_COLUMNS, 0, -1):
        legend = figure.legend(handles=handles, loc="outside upper center", ncols=columns)
        if columns == 1 or legend.get_window_extent().width <= figure.bbox.width:
            return
        legend.remove()


def legend_entries(panels: Iterable[Axes]) -> dict[str, Artist]:
    """Return the handle of each label in the panels, each label once."""
    entries: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    return entries


def mark_basis(figure: Figure, dataset: xr.Dataset) -> None:
    """Write at the foot of the figure which surfaces are substitutes, or that all are measured.

    The dataset has `label(surface)` and `basis(surface)`, "substitute" or "measured".
    """
    substitutes = dataset["label"].values[dataset["basis"].values == "substitute"]
    note = "all surfaces measured"
    if substitutes.size:
        names = ", ".join(map(str, substitutes))
        note = f"substitute surfaces: {names} (synthesised from published statistics)"
    figure.text(0.006, 0.05 / figure.get_figheight(), note, fontsize=7, style="italic", va="bottom")


def draw_map(axes: Axes, heights: np.ndarray, size: float) -> None:
    """Draw heights (nm) of a square scan of the given size (nm), with colour bar and scale bar."""
    small = rcParams["xtick.labelsize"]
    image = axes.imshow(heights - heights.mean(), cmap="viridis", extent=(0, size, 0, size))
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.9, pad=0.02)
    bar.ax.set_title("nm", fontsize=small, loc="left", pad=3)
    axes.set(xticks=[], yticks=[])
    length = _round_length(size / 4)
    printed = f"{length:g} nm" if length < 1000 else f"{length / 1000:g} µm"
    start = 0.06 * size
    # A white bar with a dark edge is visible on every colour of the map.
    axes.plot([start, start + length], [start, start], color="black", lw=4, solid_capstyle="butt")
    axes.plot([start, start + length], [start, start], color="white", lw=2, solid_capstyle="butt")
    axes.text(
        start + length / 2,
        start + 0.03 * size,
        printed,
        fontsize=small,
        ha="center",
        va="bottom",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 1},
    )


def _round_length(length: float) -> float:
    """Return the largest 1, 2 or 5 times a power of ten that is not longer than `length`."""
    decade = 10.0 ** math.floor(math.log10(length))
    return max(step * decade for step in (1, 2, 5) if step * decade <= length)
