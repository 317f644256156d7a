"""What every figure shares: print style, the surfaces' colours, the mark of substitutes, saving."""

from collections.abc import Iterable
from contextlib import ExitStack
from typing import Any, Protocol

import matplotlib as mpl
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from hardcontact.dataset import atomic_path, record

__all__ = [
    "FOOTER",
    "PUBLISHED",
    "SPHERE",
    "WIDTH",
    "Files",
    "colours",
    "create",
    "label_logarithmic",
    "label_panel",
    "mark_basis",
    "markers",
    "print_style",
    "save",
]

WIDTH = 7.0  # inch: two columns of a journal page
FOOTER = 0.2  # inch kept free below the axes for the line that names the substitutes
RESOLUTION = 300  # dots per inch of the PNG and of the maps inside the PDF

# Okabe & Ito (2008), readable with every common colour blindness; their grey is the sphere's,
# their black the published values' and the pooled line's, their yellow too pale for a thin line.
SUBSTRATES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
SPHERE = "#7F7F7F"
PUBLISHED = "#000000"
MARKERS = ("o", "s", "^", "D", "v", "P")

RC = {
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
    "image.interpolation": "nearest",  # a pixel is a datum
    "pdf.fonttype": 42,  # text stays text
}


def print_style():
    """Return the context, or decorator, under which figures are drawn and saved at print size."""
    return mpl.rc_context(RC)


def colours(surfaces: Iterable[str], sphere: str | None = None) -> dict[str, str]:
    """Return the colour of each surface: by its place among the substrates, grey for the sphere."""
    return _by_order(surfaces, SUBSTRATES, sphere, SPHERE)


def markers(surfaces: Iterable[str], sphere: str | None = None) -> dict[str, str]:
    """Return the marker of each surface, so that it is also told without colour."""
    return _by_order(surfaces, MARKERS, sphere, "x")


def _by_order(
    surfaces: Iterable[str], choices: tuple[str, ...], sphere: str | None, of_sphere: str
) -> dict[str, str]:
    substrates = [str(name) for name in surfaces if str(name) != sphere]
    chosen = {name: choices[i % len(choices)] for i, name in enumerate(substrates)}
    return chosen if sphere is None else {**chosen, sphere: of_sphere}


def create(height: float) -> Figure:
    """Return an empty figure of print width and the given height (inch), with room for a footer."""
    footer = FOOTER / height
    layout = ConstrainedLayoutEngine(rect=(0, footer, 1, 1 - footer))
    return Figure(figsize=(WIDTH, height), layout=layout)


def label_panel(axes: Axes, letter: str, title: str = "") -> None:
    """Write the panel's letter, bold, and its title above the axes, flush left."""
    axes.set_title(rf"$\mathbf{{{letter}}}$  {title}", loc="left")


def label_logarithmic(axis: Axis, at: tuple[int, ...] = (1, 2, 3, 5)) -> None:
    """Label a logarithmic axis of few decades by plain numbers, at these digits of each decade."""
    axis.set_major_locator(LogLocator(subs=at))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(LogLocator(subs=[digit for digit in range(2, 10) if digit not in at]))
    axis.set_minor_formatter(NullFormatter())


def mark_basis(figure: Figure, dataset: xr.Dataset) -> None:
    """Write at the foot of the figure which surfaces are substitutes, or that all are measured.

    `dataset` holds `label(surface)` and `basis(surface)`, the latter "substitute" or "measured".
    """
    substitutes = dataset["label"].values[dataset["basis"].values == "substitute"]
    note = "all surfaces measured"
    if substitutes.size:
        names = ", ".join(map(str, substitutes))
        note = f"substitute surfaces: {names} (synthesised from published statistics)"
    figure.text(0.006, 0.05 / figure.get_figheight(), note, fontsize=7, style="italic", va="bottom")


class Files(Protocol):
    """The files of a figure: two pictures, the table they are drawn from, and what made them."""

    pdf: str
    png: str
    csv: str
    record: str


@print_style()
def save(
    figure: Figure, table: pd.DataFrame, files: Files, *, title: str, **made_from: Any
) -> None:
    """Write a figure as PDF and PNG and its table as CSV, the same bytes each time, all or none.

    `made_from` are the parameters, inputs and code that `dataset.record` writes beside them.
    """
    _freeze_layout(figure)
    with ExitStack() as stack:
        pdf, png, csv = (
            stack.enter_context(atomic_path(path)) for path in (files.pdf, files.png, files.csv)
        )
        table.to_csv(csv, index=False, float_format="%.8g", lineterminator="\n")
        figure.savefig(
            png, format="png", dpi=RESOLUTION, metadata={"Title": title, "Software": None}
        )
        figure.savefig(
            pdf, format="pdf", dpi=RESOLUTION, metadata={"Title": title, "CreationDate": None}
        )
    record(files.record, (files.pdf, files.png, files.csv), **made_from)


def _freeze_layout(figure: Figure) -> None:
    """Lay the figure out once and keep the positions to a millionth of its size.

    Beyond that the solver's digits differ from run to run, and with them the bytes of the PDF.
    """
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axes in figure.axes:
        bounds = axes.get_position(original=True).bounds
        axes.set_position([round(bound, 6) for bound in bounds])
