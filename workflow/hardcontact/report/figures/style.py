"""Style of all figures: fonts, looks of surfaces, axes, legends, marks."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from itertools import cycle
from typing import Any, TypeVar

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from matplotlib.transforms import Bbox

# The palette of Okabe & Ito (2008), readable with every common colour blindness, without its black,
# which published and mean values have, and its yellow, which is too pale for thin lines.
SUBSTRATE_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
SPHERE_COLOUR = "#7F7F7F"
PUBLISHED_COLOUR = "#000000"
MARKERS = ("o", "s", "^", "D", "v", "P")

MAX_AXIS_MARGIN = 10.0  # factor between values and an end of a logarithmic axis
#: Factor between the positions of the error bars of surfaces at the same abscissa. Four surfaces
#: just fill the space between the closest cutoffs of the study, which differ by a factor of 1.11.
DODGE = 1.026
PERCENT = 1e-2
MICRONEWTON = 1e-6
MILLIJOULE = 1e-3

Look = dict[str, Any]  # of an artist, as matplotlib takes it
Data = TypeVar("Data", xr.Dataset, xr.DataArray)

SPHERE_LOOK: Look = {"color": SPHERE_COLOUR, "marker": "X"}

#: Look of artificial or unreliable wavelengths: above grey areas, which show through.
HATCHED_LOOK: Look = {"fc": "#F5E3C066", "ec": "#CFB57A", "hatch": "//", "lw": 0, "zorder": 0.5}
SPREAD_LOOK: Look = {"alpha": 0.2, "lw": 0}  # of bands around curves
AVERAGED_LOOK: Look = {"color": "black", "marker": "h"}  # of the averaged change
#: Of a line at a published range of adhesion or edge.
PUBLISHED_LOOK: Look = {"color": "0.25", "lw": 1.0, "ls": (0, (4, 2))}
TILTED_LABELS: Look = {"rotation": 25, "ha": "right", "rotation_mode": "anchor"}  # on an axis
#: Maps of pixels become images, in the PDF too.
PIXEL_LOOK: Look = {"shading": "nearest", "rasterized": True}

#: Settings of Matplotlib for print; all others are those that Matplotlib ships with.
PRINT_SETTINGS: dict[Any, Any] = {
    "font.family": "DejaVu Sans",  # ships with matplotlib: the same bytes on every machine
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "legend.handlelength": 2.2,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "hatch.linewidth": 0.9,
    "image.interpolation": "nearest",  # every pixel of a height map is shown as it is
    "pdf.fonttype": 3,  # text can be searched, as with type 42, which takes three times as long
    "svg.hashsalt": "figure",  # the same names of parts in the SVG each time
}


def print_style() -> AbstractContextManager[None]:
    """Set the style of print for a block, whatever the user's matplotlibrc has."""
    names = [name for name in mpl.rcParams if "backend" not in name]
    return mpl.rc_context({name: mpl.rcParamsDefault[name] for name in names} | PRINT_SETTINGS)


def surface_looks(surfaces: Iterable[str], sphere_surface: str | None = None) -> dict[str, Look]:
    """Return colour and marker of each substrate, in their order, then those of the sphere."""
    substrates = [str(name) for name in surfaces if str(name) != sphere_surface]
    triples = zip(substrates, cycle(SUBSTRATE_COLOURS), cycle(MARKERS), strict=False)
    looks = {name: {"color": colour, "marker": marker} for name, colour, marker in triples}
    return looks | {str(name): SPHERE_LOOK for name in surfaces if str(name) == sphere_surface}


def surface_colours(surfaces: Iterable[str], sphere_surface: str | None = None) -> dict[str, str]:
    """Return the colours of `surface_looks`."""
    return {name: look["color"] for name, look in surface_looks(surfaces, sphere_surface).items()}


def iterate_surfaces(data: Data) -> Iterator[tuple[Look, Data]]:
    """Yield colour and marker of each surface of a dataset, and its selection of the dataset."""
    sphere_surface = data.attrs.get("sphere_surface")
    for surface, look in surface_looks(data["surface"].values, sphere_surface).items():
        yield look, data.sel(surface=surface)


def iterate_dodged(data: xr.Dataset) -> Iterator[tuple[float, Look, xr.Dataset]]:
    """Yield a factor of positions on a logarithmic axis, look and selection for each surface."""
    middle = (data.sizes["surface"] - 1) / 2
    for index, (look, curve) in enumerate(iterate_surfaces(data)):
        yield DODGE ** (index - middle), look, curve


def freeze_layout(figure: Figure) -> None:
    """Lay the figure out once, and round positions, whose last digits differ from run to run."""
    if engine := figure.get_layout_engine():
        engine.execute(figure)
    # None, because the layout engine "none" would make saving draw the figure once more.
    figure.set_layout_engine(None)
    for axes in figure.axes:
        bounds = axes.get_position(original=True).bounds
        axes.set_position(Bbox.from_bounds(*(round(bound, 6) for bound in bounds)))


def label_panel(axes: Axes, letter: str, title: str = "") -> None:
    """Write the panel's letter, bold, and its title above the axes, flush left."""
    axes.set_title(rf"$\mathbf{{{letter}}}$  {title}", loc="left")


def label_logarithmic(*axes: Axis, digits: tuple[int, ...] = (1, 2, 3, 5)) -> None:
    """Label logarithmic axes by plain numbers, at these digits or, beyond 3 decades, at decades."""
    for axis in axes:
        low, high = axis.get_view_interval()
        labelled_digits = (1,) if high > 1e3 * low else digits
        other_digits = [digit for digit in range(2, 10) if digit not in labelled_digits]
        axis.set_major_locator(LogLocator(subs=labelled_digits))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(LogLocator(subs=other_digits))
        axis.set_minor_formatter(NullFormatter())


def end_near_values(axes: Axes) -> None:
    """End the logarithmic y axis near the values drawn as lines, also if error bars are endless."""
    # The y values of lines in coordinates of the axes are no data.
    values_of_lines = [
        np.asarray(line.get_ydata(), float)
        for line in axes.lines
        if line.get_transform().contains_branch_seperately(axes.transData)[1]
    ]
    values = np.concatenate(values_of_lines)
    values = values[np.isfinite(values) & (values > 0)]
    low, high = axes.get_ylim()
    lowest, highest = values.min() / MAX_AXIS_MARGIN, values.max() * MAX_AXIS_MARGIN
    axes.set_ylim(max(low, lowest), min(high, highest))


def surface_handles(dataset: xr.Dataset, **look: Any) -> list[Line2D | Patch]:
    """Return one entry of a legend for each surface of a dataset with `label(surface)`."""
    return [
        Line2D([], [], **surface_look | look, label=str(data["label"].item()))
        for surface_look, data in iterate_surfaces(dataset)
    ]


def legend_above(figure: Figure, handles: Sequence[Artist], max_columns: int = 4) -> None:
    """Write a legend above all axes, in as many columns as fit the figure, up to a maximum."""
    for columns in range(max_columns, 0, -1):
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
