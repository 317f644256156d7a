"""Figures of the page of own surfaces: force ratios, spectra, forces, fits and height maps."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import cycle
from pathlib import PurePath
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.band.critical_band import computed_cutoffs
from hardcontact.base.statistics import bounds
from hardcontact.report.artificial import (
    artificial_bands,
    measurement_name,
    measurements,
    split_measurements,
)
from hardcontact.report.datasets import preferred_model
from hardcontact.report.figures import drawing, style

REMOVED = {"small": "without shorter wavelengths", "large": "without longer wavelengths"}
SIDE_COLOURS = {"small": "#0072b2", "large": "#d55e00"}
KIND_COLOURS = {"map": "#0072b2", "profile": "#009e73", "description": "#d55e00"}
UNRELIABLE, JOINED, USED, FITS_ALL = "#999999", "#e69f00", "#cc79a7", "#555555"
#: Measurements up to which unreliable parts of spectra are drawn: more hide each other.
MAX_UNRELIABLE_CURVES = 3
MAX_MARKED_POINTS = 30  # on a line
#: A cutoff whose force ratio is larger lies above the panel.
MAX_RATIO = 10.0
RESOLUTION = 72  # dots per inch of height maps, which are most of a page
WIDTH = 4.2  # inch: 360 pixels of a phone show 9 points as 11 pixels


@contextmanager
def page_style() -> Iterator[None]:
    """Set the style of print with text that can be read on a phone."""
    names = ("font.size", "axes.titlesize", "axes.labelsize", "xtick.labelsize", "ytick.labelsize",
             "legend.fontsize")  # fmt: skip
    sizes: dict[Any, Any] = dict.fromkeys(names, 9.0)
    with style.print_style(), mpl.rc_context(sizes):
        yield


def svg(figure: Figure, title: str) -> bytes:
    """Return a figure as SVG, the same bytes each time."""
    with page_style():
        style.freeze_layout(figure)
        return drawing.svg_bytes(figure, title, RESOLUTION)


def heights_shown(topography: xr.Dataset) -> np.ndarray:
    """Return the heights (row, column) in nm of one surface about their mean, without padding."""
    example = topography["example_heights"].dropna("row", how="all").dropna("column", how="all")
    heights: np.ndarray = example.values - example.values.mean()
    return heights


@page_style()
def map_figure(topography: xr.Dataset) -> Figure:
    """Draw the first levelled scan of one surface."""
    figure = Figure(figsize=(WIDTH, 3.7), layout="constrained")
    style.draw_map(figure.subplots(), heights_shown(topography), topography["scan_size"].item())
    return figure


@page_style()
def ratio_figure(edges: xr.Dataset, spectra: xr.Dataset) -> Figure:
    """Draw the force relative to the unfiltered one against the cutoff, of one surface."""
    cutoffs = computed_cutoffs(edges["scale_ratio"])
    at_cutoffs = edges.sel(cutoff_wavelength=cutoffs)
    figure, axes = _sheet(len(REMOVED))
    for side, label in REMOVED.items():
        of_side = at_cutoffs.sel(side=side)
        ends = bounds(of_side, "scale_ratio")
        _draw_curve(axes, cutoffs, of_side["scale_ratio"], ends, label, SIDE_COLOURS[side])
    ratios, tolerance = at_cutoffs["scale_ratio"], edges.attrs["tolerance"]
    low = min(float(ratios.min()), 1 - 2 * tolerance) / 1.1
    high = min(MAX_RATIO, max(float(ratios.max()), 1 + 2 * tolerance) * 1.1)
    axes.axhspan(1 - tolerance, 1 + tolerance, color="0.82", lw=0, zorder=0.5)
    _mark(axes, edges["edge"].values)
    _scale(axes, "cutoff wavelength (nm)", "force / unfiltered force", cutoffs)
    axes.set_ylim(low, high)
    style.label_logarithmic(axes.yaxis)
    style.shade_artificial(axes, artificial_bands(spectra))
    return _with_legend(figure)


@page_style()
def spectrum_figure(spectra: xr.Dataset) -> Figure:
    """Draw the isotropic PSD of each measurement of one surface, the joined and the used one."""
    wavelengths = 2 * np.pi / spectra["bin_wavevector"].values
    measured = measurements(spectra)
    shown = np.isfinite(measured["psd"].values).any(axis=0)
    few = measured.sizes["measurement"] <= MAX_UNRELIABLE_CURVES
    figure, axes = _sheet(measured.sizes["measurement"] * (1 + few) + 2)
    for measurement in split_measurements(measured):
        density, reliable = measurement["psd"].values, measurement["reliable"].values == 1
        name = PurePath(measurement_name(measurement)).name
        colour = KIND_COLOURS[str(measurement["kind"].item())]
        axes.plot(wavelengths, np.where(reliable, density, np.nan), color=colour, label=name)
        if few and np.isfinite(density[~reliable]).any():
            unreliable = np.where(reliable, np.nan, density)
            axes.plot(wavelengths, unreliable, color=UNRELIABLE, label=f"{name}, not reliable")
    with np.errstate(divide="ignore"):
        logarithm = np.log(spectra["spectrum"].values)
    used = np.exp(np.interp(np.log(spectra["bin_wavevector"]), np.log(spectra["wavevector"]),
                            logarithm))  # fmt: skip
    known = np.where(used > 0, used, np.nan)
    axes.plot(wavelengths[shown], spectra["joined"].values[shown], color=JOINED, label="joined")
    axes.plot(wavelengths[shown], known[shown], color=USED, label="used")
    _scale(axes, "wavelength (nm)", "isotropic PSD (nm⁴)", wavelengths[shown])
    style.shade_artificial(axes, artificial_bands(spectra))
    return _with_legend(figure)


@page_style()
def force_figure(force: xr.Dataset, labels: Mapping[str, str]) -> Figure:
    """Draw the mean force of all surfaces and contact models against the range of adhesion.

    Labels are the names of the surfaces in print; intervals are those of the model of the answer.
    """
    chosen = preferred_model(force)
    models = sorted(map(str, force["contact_model"].values), key=lambda model: model != chosen)
    curves = [(surface, model) for surface in labels for model in models]
    figure, axes = _sheet(len(curves))
    for (surface, model), colour in zip(curves, cycle(style.SUBSTRATES), strict=False):
        curve = force.sel(surface=surface, contact_model=model)
        ends = [1e6 * end for end in bounds(curve, "force")] if model == chosen else []
        label = f"{labels[surface]}, {model}"
        _draw_curve(axes, force["rho"].values, 1e6 * curve["force"], ends, label, colour)
    _mark(axes, [force.attrs["range_of_adhesion"]])
    _scale(axes, "range of adhesion (nm)", "pull-off force (µN)", force["rho"].values)
    return _with_legend(figure)


@page_style()
def work_figure(fit: xr.Dataset, labels: Mapping[str, str]) -> Figure:
    """Draw the work of adhesion that fits the force of each surface, against the range.

    The fit is of one contact model; of several surfaces also what fits all of them is drawn.
    """
    names, rho = [str(name) for name in fit["surface"].values], fit["rho"].values
    figure, axes = _sheet(len(names) + 1)
    for name, colour in zip(names, cycle(style.SUBSTRATES), strict=False):
        curve = fit.sel(surface=name)
        ends = [1e3 * end for end in bounds(curve, "work_of_adhesion")]
        _draw_curve(axes, rho, 1e3 * curve["work_of_adhesion"], ends, labels[name], colour)
    region = 1e3 * fit["region"].values
    if len(names) > 1 and np.isfinite(region).any():
        middle = np.sqrt(region[:, 0] * region[:, 1])
        _draw_curve(axes, rho, middle, list(region.T), "fits all", FITS_ALL)
    _mark(axes, [fit.attrs["range_of_adhesion"]])
    _scale(axes, "range of adhesion (nm)", "work of adhesion (mJ/m²)", rho)
    return _with_legend(figure)


def _sheet(curves: int) -> tuple[Figure, Axes]:
    """Return an empty figure with room for the legend of so many curves."""
    figure = Figure(figsize=(WIDTH, 3.4 + 0.16 * curves), layout="constrained")
    return figure, figure.subplots()


def _draw_curve(
    axes: Axes, x: np.ndarray, values: Any, ends: Sequence[Any], label: str, colour: str
) -> None:
    """Draw known values, with a band between the ends of their intervals if these bound them."""
    values = np.asarray(values, float)
    known = np.isfinite(values)
    mark = "." if known.sum() < MAX_MARKED_POINTS else ""
    axes.plot(x[known], values[known], mark + "-", color=colour, label=label)
    for low, high in [np.asarray(ends, float)[:, known]] if len(ends) else []:
        bounded = (low > 0) & (high < np.inf)
        axes.fill_between(x[known], low, high, where=bounded, color=colour, alpha=0.2, lw=0)


def _mark(axes: Axes, places: Sequence[float] | np.ndarray) -> None:
    """Mark finite places on the x axis by dashed lines."""
    for place in np.asarray(places, float)[np.isfinite(places)]:
        axes.axvline(place, color="0.4", lw=1, ls="--", zorder=0.6)


def _scale(axes: Axes, x_label: str, y_label: str, x: np.ndarray) -> None:
    """Make both axes logarithmic, with their labels; the x axis ends with the values."""
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label, xlim=(x.min(), x.max()))


def _with_legend(figure: Figure) -> Figure:
    figure.legend(loc="outside upper center", ncols=1)
    return figure
