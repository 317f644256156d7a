"""Draw the figures of the paper's study, begin any figure, and write it as PDF, PNG and SVG."""

import importlib
import re
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.collections import Collection
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D

from hardcontact.base import published
from hardcontact.base.atomic_file import atomic_file
from hardcontact.base.dataset import read_dataset
from hardcontact.report.figures import style
from hardcontact.report.figures.listing import FIGURE_SUFFIXES

WIDTH = 7.0  # inch: two columns of a journal page
FOOTER = 0.2  # inch kept free below the axes for the line that names the substitutes
RESOLUTION = 300  # dots per inch of the PNG and of the images inside the PDF
SVG_RESOLUTION = 100  # dots per inch of the images inside the SVG
MAX_VECTOR_POINTS = 1000  # of a curve or of symbols in the SVG; an image of more is smaller
SVG_FONTS = b"'DejaVu Sans', Verdana, sans-serif"  # others about as wide as the first
Ratios = Sequence[float]  # sizes relative to each other
#: Readers of inputs that are not datasets.
READERS = {
    "published_constants": published.read_constants,
    "published_pull_off": published.read_published_forces,
}


def draw_figure(
    name: str, title: str, inputs: Mapping[str, str], outputs: Mapping[str, str]
) -> None:
    """Draw a figure by `draw` of its module; inputs are paths, by the arguments of `draw`."""
    module = importlib.import_module(f"hardcontact.report.figures.{name}")
    data = {key: READERS.get(key, read_dataset)(path) for key, path in inputs.items()}
    with style.print_style():
        save_figure(module.draw(**data), title, outputs)


def save_figure(
    figure: Figure, title: str, outputs: Mapping[str, str], svg_resolution: float = SVG_RESOLUTION
) -> None:
    """Write a figure to its outputs by suffix: the same bytes each time, all files or none."""
    style.freeze_layout(figure)
    with ExitStack() as stack:
        paths = {
            suffix: stack.enter_context(atomic_file(outputs[suffix])) for suffix in FIGURE_SUFFIXES
        }
        for suffix, left_out in (("png", {"Software": None}), ("pdf", {"CreationDate": None})):
            metadata = {"Title": title} | left_out
            figure.savefig(paths[suffix], format=suffix, dpi=RESOLUTION, metadata=metadata)
        Path(paths["svg"]).write_bytes(svg_bytes(figure, title, svg_resolution))


def svg_bytes(figure: Figure, title: str, resolution: float) -> bytes:
    """Return a figure as SVG for pages, and rasterize its artists of many points.

    The resolution of images is in dots per inch.
    """
    for artist in figure.findobj(lambda artist: not artist.get_rasterized()):
        artist.set_rasterized(_has_many_points(artist))
    buffer = BytesIO()
    metadata = {"Title": title, "Date": None}
    with mpl.rc_context({"svg.fonttype": "none"}):  # text, a third of the size of outlines
        figure.savefig(buffer, format="svg", dpi=resolution, metadata=metadata)
    svg = buffer.getvalue().replace(b"'DejaVu Sans'", SVG_FONTS)
    # Hundredths of a point are enough in tags, and indentation is a tenth of the file.
    svg = re.sub(rb"<[^>]+>", lambda tag: re.sub(rb"(\.\d\d)\d+", rb"\1", tag[0]), svg)
    return re.sub(rb"\s+", b" ", svg)


def _has_many_points(artist: Artist) -> bool:
    """Return whether a line or a collection has too many points for an SVG."""
    if isinstance(artist, Line2D):
        return bool(np.size(artist.get_xdata()) > MAX_VECTOR_POINTS)
    if isinstance(artist, Collection):
        points = sum(np.size(path.vertices) // 2 for path in artist.get_paths())
        marks = np.size(artist.get_offsets()) // 2
        return bool(max(points, marks) > MAX_VECTOR_POINTS)
    return False


def create_figure(height: float, surfaces: xr.Dataset) -> Figure:
    """Return an empty figure of print width and a height (inch) that names its substitutes.

    The dataset has `label(surface)` and `source(surface)`, or both as attributes for one surface.
    """
    footer = FOOTER / height
    layout = ConstrainedLayoutEngine(rect=(0, footer, 1, 1 - footer))
    figure = Figure(figsize=(WIDTH, height), layout=layout)
    texts: Any = surfaces if "label" in surfaces else surfaces.attrs
    labels = np.atleast_1d(texts["label"])
    substitutes = labels[np.atleast_1d(texts["source"]) == "substitute"]
    note = "all surfaces measured"
    if substitutes.size:
        names = ", ".join(map(str, substitutes))
        note = f"substitute surfaces: {names} (synthesised from published statistics)"
    figure.text(0.006, 0.05 / height, note, fontsize=7, style="italic", va="bottom")
    return figure


def create_rows(
    height: float, surfaces: xr.Dataset, *, row_heights: Ratios, panel_widths: Sequence[Ratios]
) -> tuple[Figure, list[np.ndarray]]:
    """Return a figure of `create_figure`, and the panels of each row."""
    figure = create_figure(height, surfaces)
    grid = figure.add_gridspec(len(row_heights), 1, height_ratios=row_heights)
    return figure, [
        grid[row].subgridspec(1, len(widths), width_ratios=widths).subplots(squeeze=False)[0]
        for row, widths in enumerate(panel_widths)
    ]
