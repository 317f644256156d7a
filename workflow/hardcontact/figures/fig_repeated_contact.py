"""Repeated contact: force and indents against the number of contacts, the last indents."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables
from hardcontact.figures.fig5 import draw_indents, print_preload

CURVES = {  # panel, unit, label
    "force_ratio": ("a", "1", "force / single contacts"),
    "depth": ("b", "nm", "deepest indent (nm)"),
    "lateral_size": ("c", "nm", "widest indent (nm)"),
}
IMAGE = {  # published constants of an image after 400 contacts
    "depth": "measured_indent_depth",
    "lateral_size": "measured_indent_size",
}
SIZES = {"indent_size": "lateral size (nm)", "indent_depth": "depth (nm)"}


def table(repeated_contact: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Return what the figure is drawn from, one row a number.

    Force ratio, depth (nm) and size (nm) by surface, preload (N) and number of contacts (`stage`),
    and depth and size of every indent after the last. Published: the ranges of depths and sizes in
    an image. Of the map its deepest pixel; the rest stays in the dataset.
    """
    curves = ((panel, name, unit) for name, (panel, unit, _) in CURVES.items())
    image = _of_image(repeated_contact)
    deepest = image.assign(indentation=image["indentation"].max(["y", "x"]))
    of_image = ("d", "indentation", "nm"), *(("e", name, "nm") for name in SIZES)
    published = pd.DataFrame(
        {"panel": CURVES[name][0], "quantity": name, "low": low, "high": high}
        for name in IMAGE
        for low, high in [_published(published_constants, name)]
    )
    frames = [
        tables.drawn_rows(repeated_contact, *curves),
        tables.drawn_rows(deepest, *of_image),
        published.assign(origin="published", unit="nm"),
    ]
    return tables.tidy(frames, repeated_contact, "preload", "scan", "indent", "stage")


def draw(repeated_contact: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw (a-c) force, depth and size against contacts, (d) a map, (e) all indents of its kind."""
    figure, (curves, (view, sizes)) = drawing.create_rows(
        5.2, repeated_contact, (1, (1, 1, 1)), (1.15, (1, 1))
    )
    for axes, (name, (panel, _, label)) in zip(curves, CURVES.items(), strict=True):
        _draw_curves(axes, repeated_contact, name)
        if name in IMAGE:
            axes.axhspan(*_published(published_constants, name), color="0.88", zorder=0)
            axes.set_yscale("log")
            style.label_logarithmic(axes.yaxis)
        axes.set(xscale="log", xlabel="contacts")
        style.label_logarithmic(axes.xaxis, at=(1,))
        style.label_panel(axes, panel, label)
    curves[0].axhline(1, color="0.7", lw=0.6, zorder=0)
    curves[0].legend(handles=style.surface_handles(repeated_contact, ms=3), loc="best")
    image = _of_image(repeated_contact)
    _draw_map(view, image)
    colour = style.colours(repeated_contact["surface"].values)[str(image["surface"].values[0])]
    _draw_sizes(sizes, image, published_constants, colour)
    return figure


def _published(constants: pd.DataFrame, name: str) -> tuple[float, float]:
    """Return the published range (nm) of a size of the indents in an image."""
    low, high = (constants["value"][f"{IMAGE[name]}_{end}_bound"] for end in ("lower", "upper"))
    return low, high


def _of_image(repeated: xr.Dataset) -> xr.Dataset:
    """Return the surface and the preload of the image: those at the largest preload."""
    largest = repeated.sel(preload=repeated["preload"].max())
    (there,) = np.nonzero(largest["mean_ratio"].notnull().values)
    return largest.isel(surface=there[:1])


def _draw_curves(axes: Axes, repeated: xr.Dataset, name: str) -> None:
    """Draw a quantity with its interval against contacts; dashed at the largest preload."""
    values = tables.bounded(repeated, name)
    dashes = dict(zip(np.sort(repeated["preload"]), ("-", "--"), strict=False))
    for look, of_surface in style.by_surface(values):
        for preload, line in dashes.items():
            one = of_surface.sel(preload=preload)
            style.draw_with_band(axes, one, "stage", ls=line, ms=3, **look)


def _draw_map(axes: Axes, image: xr.Dataset) -> None:
    """Map how deep (nm) the sphere is pressed in after the last contact."""
    depths = image["indentation"].isel(surface=0)
    draw_indents(axes, depths.dropna("y", how="all").dropna("x", how="all"))
    contacts, label = int(image["stage"].max()), str(image["label"].values[0])
    preload = print_preload(image["preload"])
    style.label_panel(axes, "d", f"after {contacts} contacts on {label}, {preload}")


def _draw_sizes(
    axes: Axes, image: xr.Dataset, published_constants: pd.DataFrame, colour: str
) -> None:
    """Draw depth against size of every indent after the last contact, beside the image."""
    size, depth = (image[name].values.ravel() for name in SIZES)
    axes.plot(size, depth, "o", color=colour, ms=2, alpha=0.3, label="computed")
    (left, right), (low, high) = (
        _published(published_constants, name) for name in ("lateral_size", "depth")
    )
    corners = [left, right, right, left], [low, low, high, high]
    axes.fill(*corners, color=style.PUBLISHED, alpha=0.15, lw=0, label="published image")
    axes.set(xscale="log", yscale="log", xlabel=SIZES["indent_size"], ylabel=SIZES["indent_depth"])
    axes.set_ylim(bottom=0.01)
    axes.legend(loc="lower right")
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1,))
    style.label_panel(axes, "e", "all indents")
