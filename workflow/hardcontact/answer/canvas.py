"""Figures of the width of a phone: text that can be read there, pictures as bytes."""

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import Any

import matplotlib as mpl
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

from hardcontact.figures import style
from hardcontact.numbers.printing import print_length

WIDTH = 4.2  # inch: 360 pixels of a phone show 9 points as 11 pixels
RESOLUTION = 200  # dots per inch: sharp at twice the pixels of a phone
TEXT: dict[Any, Any] = {
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "legend.fontsize": 8.5,
}


@contextmanager
def canvas_style() -> Iterator[None]:
    """Set the style of print with larger text, for a block or, as a decorator, for a function."""
    with style.print_style(), mpl.rc_context(TEXT):
        yield


def create(height: float) -> Figure:
    """Return an empty figure of the page's width and the given height (inch)."""
    return Figure(figsize=(WIDTH, height), layout="constrained")


@canvas_style()
def png(figure: Figure) -> bytes:
    """Return the picture of a figure as PNG, the same bytes each time."""
    style.freeze_layout(figure)
    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=RESOLUTION, metadata={"Software": None})
    return buffer.getvalue()


def label_lengths(axis: Axis, at: tuple[int, ...] = (1,)) -> None:
    """Label a logarithmic axis in nm by lengths with their unit, at these digits of a decade."""
    axis.set_major_locator(LogLocator(subs=at, numticks=8))
    axis.set_major_formatter(FuncFormatter(lambda value, _: print_length(value)))
    axis.set_minor_formatter(NullFormatter())


def label_numbers(axis: Axis) -> None:
    """Label a logarithmic axis by plain numbers: fewer a decade, the more decades it shows."""
    low, high = axis.get_view_interval()
    if high / low < 6:
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(NullLocator())
    else:
        style.label_logarithmic(axis, at=(1, 2, 5) if high / low < 100 else (1,))
