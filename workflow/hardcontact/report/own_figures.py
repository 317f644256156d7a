"""Figures of own surfaces: force ratios, height maps, spectra, forces and fits, with their tables.

Each has a panel for every surface, or a curve.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path, PurePath
from typing import Any

import numpy as np
import pandas as pd
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
from hardcontact.report.datasets import Datasets, preferred_model
from hardcontact.report.figures import drawing, style, tables
from hardcontact.report.figures.listing import KINDS, OF_OWN_SURFACES

#: What is removed on each side of the band, and how its curve is drawn.
SIDES: dict[str, tuple[str, style.Look]] = {
    "small": ("without shorter wavelengths", {"ls": "-", "marker": "o"}),
    "large": ("without longer wavelengths", {"ls": "--", "marker": "s"}),
}
#: How curves of the contact model of the answer, and of others, are drawn.
MODELS: tuple[style.Look, ...] = ({"ls": "-"}, {"ls": "--"}, {"ls": ":"})
KIND_COLOURS = {"map": "#332288", "profile": "#882255", "description": "#999933"}
UNRELIABLE: style.Look = {"color": "#999999"}
JOINED: style.Look = {"color": "black", "ls": ":", "lw": 1.8, "zorder": 3}
FITS_ALL = "0.3"
#: Measurements up to which unreliable parts of spectra are drawn: more hide each other.
MAX_UNRELIABLE_CURVES = 3
MAX_MARKED_POINTS = 30  # on a line
RESOLUTION = 72  # dots per inch of height maps in the SVG, which are most of a page
WIDTH = 3.8  # inch: 360 pixels of a phone show 7 points as 9 pixels

Drawn = tuple[pd.DataFrame, Figure]


def write_figures(datasets: Datasets, outputs: Mapping[str, Sequence[str]]) -> dict[str, bytes]:
    """Write the figures of own surfaces and their tables, and return the SVG of each.

    Parameters
    ----------
    datasets : Datasets
        The datasets of the study.
    outputs : dict
        Paths by kind of file, of all figures in one order. A file has the name of its figure.

    Returns
    -------
    dict
        SVG by the name of the figure.
    """
    pictures = {}
    for paths in zip(*(outputs[kind] for kind in KINDS), strict=True):
        files = dict(zip(KINDS, paths, strict=True))
        name = PurePath(files["svg"]).stem
        with style.print_style():
            table, figure = FIGURES[name](datasets)
            drawing.save(figure, table, OF_OWN_SURFACES[name], files, RESOLUTION)
        pictures[name] = Path(files["svg"]).read_bytes()
    return pictures


def heights_shown(topography: xr.Dataset) -> np.ndarray:
    """Return the heights (row, column) in nm of one surface about their mean, without padding."""
    example = topography["example_heights"].dropna("row", how="all").dropna("column", how="all")
    heights: np.ndarray = example.values - example.values.mean()
    return heights


def draw_maps(datasets: Datasets) -> Drawn:
    """Draw the first levelled scan of each surface; the table has its heights in short."""
    figure, panels = _panels(datasets, 3.3)
    frames = []
    for axes, colour, data in panels:
        heights = heights_shown(data.topography)
        style.draw_map(axes, heights, data.topography["scan_size"].item())
        axes.spines[:].set(edgecolor=colour, linewidth=1.5)
        values = {"map_rms_height": heights.std(), "map_peak_to_valley": np.ptp(heights)}
        shown = xr.Dataset(values, data.topography["surface"].coords).expand_dims("surface")
        frames.append(_rows(shown, dict.fromkeys(values, "nm")))
    return pd.concat(frames), figure


def draw_cutoffs(datasets: Datasets) -> Drawn:
    """Draw the force relative to the unfiltered one against the cutoff, of each surface.

    The axis of the ratio is logarithmic where it reaches over more than a factor of ten.
    """
    figure, panels = _panels(datasets)
    tolerance = datasets.edges.attrs["tolerance"]
    for axes, colour, data in panels:
        cutoffs = computed_cutoffs(data.edges["scale_ratio"])
        at_cutoffs = data.edges.sel(cutoff_wavelength=cutoffs)
        for side, (label, look) in SIDES.items():
            side_data = at_cutoffs.sel(side=side)
            ends = bounds(side_data, "scale_ratio")
            look = look | {"color": colour, "label": label}
            _draw_curve(axes, cutoffs, side_data["scale_ratio"], ends, look)
        axes.axhspan(1 - tolerance, 1 + tolerance, color="0.82", lw=0, zorder=0.5)
        _mark(axes, data.edges["edge"].values)
        _scale(axes, "cutoff wavelength (nm)", "force / unfiltered force", cutoffs)
        style.end_near_values([axes])
        low, high = axes.get_ylim()
        if high > 10 * low:
            style.label_logarithmic(axes.yaxis)
        else:
            axes.set_yscale("linear")
        style.shade_artificial(axes, artificial_bands(data.spectra))
    _add_legend(figure)
    return _rows(datasets.edges, {"scale_ratio": "1", "edge": "nm"}), figure


def draw_spectra(datasets: Datasets) -> Drawn:
    """Draw the isotropic PSD of each measurement of each surface, the joined and the used one."""
    figure, panels = _panels(datasets, 3.6)
    frames = []
    for axes, colour, data in panels:
        used = _used_spectrum(data.spectra)
        known = measurements(data.spectra)
        wavelengths = 2 * np.pi / data.spectra["bin_wavevector"].values
        shown = np.isfinite(known["psd"].values).any(axis=0)
        few = known.sizes["measurement"] <= MAX_UNRELIABLE_CURVES
        for measurement in split_measurements(known):
            density, reliable = measurement["psd"].values, measurement["reliable"].values == 1
            name = PurePath(measurement_name(measurement)).name
            look: style.Look = {
                "color": KIND_COLOURS[str(measurement["kind"].item())],
                "label": name,
            }
            axes.plot(wavelengths, np.where(reliable, density, np.nan), **look)
            if few and np.isfinite(density[~reliable]).any():
                look = UNRELIABLE | {"label": f"{name}, not reliable"}
                axes.plot(wavelengths, np.where(reliable, np.nan, density), **look)
            rows = measurement[["reliable"]].assign(value=measurement["psd"])
            columns = {"quantity": "psd", "measurement": measurement_name(measurement)}
            frames.append(tables.computed_rows(rows, unit="nm4", **columns))
        joined = data.spectra["joined"].values
        axes.plot(wavelengths[shown], used.values[shown], color=colour, label="used")
        axes.plot(wavelengths[shown], joined[shown], **JOINED, label="joined")
        _scale(axes, "wavelength (nm)", "isotropic PSD (nm⁴)", wavelengths[shown])
        style.shade_artificial(axes, artificial_bands(data.spectra))
        axes.legend(loc="lower right")
        both = data.spectra[["joined"]].assign(used=used)
        frames.append(_rows(both, {"joined": "nm4", "used": "nm4"}))
    return pd.concat(frames), figure


def draw_forces(datasets: Datasets) -> Drawn:
    """Draw the mean force of all surfaces and contact models against the range of adhesion.

    Intervals are those of the model of the answer.
    """
    force, labels = datasets.force, datasets.labels()
    chosen = preferred_model(force)
    models = sorted(map(str, force["contact_model"].values), key=lambda model: model != chosen)
    figure = Figure(figsize=(WIDTH, 3.4), layout="constrained")
    axes = figure.subplots()
    for surface, colour in style.colours(labels).items():
        for model, look in zip(models, MODELS, strict=False):
            curve = force.sel(surface=surface, contact_model=model)
            ends = [end / style.MICRONEWTON for end in bounds(curve, "force")]
            look = look | {"color": colour, "label": f"{labels[surface]}, {model}"}
            values = curve["force"] / style.MICRONEWTON
            _draw_curve(axes, force["rho"].values, values, ends if model == chosen else [], look)
    _mark(axes, [force.attrs["range_of_adhesion"]])
    _scale(axes, "range of adhesion (nm)", "pull-off force (µN)", force["rho"].values)
    style.label_logarithmic(axes.yaxis)
    _add_legend(figure)
    return _rows(force, {"force": "N"}), figure


def draw_works(datasets: Datasets) -> Drawn:
    """Draw the work of adhesion that fits the force of each surface, against the range.

    The fit is of the contact model of the answer. Of several surfaces, the figure also shows the
    works that fit all of them.
    """
    assert datasets.fit is not None
    fit, labels = datasets.fit.sel(contact_model=preferred_model(datasets.fit)), datasets.labels()
    names, rho = [str(name) for name in fit["surface"].values], fit["rho"].values
    colours = style.colours(labels)
    figure = Figure(figsize=(WIDTH, 3.4), layout="constrained")
    axes = figure.subplots()
    for name in names:
        curve = fit.sel(surface=name)
        ends = [end / style.MILLIJOULE for end in bounds(curve, "work_of_adhesion")]
        look = {"color": colours[name], "label": labels[name]}
        _draw_curve(axes, rho, curve["work_of_adhesion"] / style.MILLIJOULE, ends, look)
    region = fit["region"].values / style.MILLIJOULE
    if len(names) > 1 and np.isfinite(region).any():
        middle = np.sqrt(region[:, 0] * region[:, 1])
        _draw_curve(axes, rho, middle, list(region.T), {"color": FITS_ALL, "label": "fits all"})
    _mark(axes, [fit.attrs["range_of_adhesion"]])
    _scale(axes, "range of adhesion (nm)", "work of adhesion (mJ/m²)", rho)
    style.label_logarithmic(axes.yaxis)
    _add_legend(figure)
    return _rows(fit, {"work_of_adhesion": "J/m2"}), figure


FIGURES: dict[str, Callable[[Datasets], Drawn]] = {
    "cutoffs": draw_cutoffs,
    "maps": draw_maps,
    "spectra": draw_spectra,
    "forces": draw_forces,
    "works": draw_works,
}


def _panels(
    datasets: Datasets, height: float = 3.0
) -> tuple[Figure, Iterator[tuple[Axes, str, Datasets]]]:
    """Return a figure, and for each surface its panel of this height (inch), colour and data."""
    labels = datasets.labels()
    figure = Figure(figsize=(WIDTH, height * len(labels) + 0.4), layout="constrained")
    panels = figure.subplots(len(labels), squeeze=False)[:, 0]
    for axes, label in zip(panels, labels.values(), strict=True):
        axes.set_title(label, loc="left")
    colours = style.colours(labels)
    data = map(datasets.select_surface, labels)
    return figure, zip(panels, colours.values(), data, strict=True)


def _rows(data: xr.Dataset, units: Mapping[str, str]) -> pd.DataFrame:
    """Return a row for each number of these variables, with its interval and its unit."""
    return pd.concat(
        tables.computed_rows(tables.bounded(data, name), quantity=name, unit=unit)
        for name, unit in units.items()
    )


def _used_spectrum(spectra: xr.Dataset) -> xr.DataArray:
    """Return the spectrum (nm⁴) of added roughness at the bins of the measurements, NaN beyond."""
    with np.errstate(divide="ignore"):
        logarithm = np.log(spectra["spectrum"].values)
    bins = np.log(spectra["bin_wavevector"])
    used = np.exp(np.interp(bins, np.log(spectra["wavevector"]), logarithm))
    return spectra["joined"].copy(data=np.where(used > 0, used, np.nan))


def _draw_curve(
    axes: Axes, x: np.ndarray, values: Any, ends: Sequence[Any], look: style.Look
) -> None:
    """Draw known values, with a band between the ends of their intervals if these bound them."""
    values = np.asarray(values, float)
    known = np.isfinite(values)
    marker = look.get("marker", "o") if known.sum() < MAX_MARKED_POINTS else ""
    marked: style.Look = look | {"marker": marker, "ms": 2.5}
    axes.plot(x[known], values[known], **marked)
    for low, high in [np.asarray(ends, float)[:, known]] if len(ends) else []:
        bounded = (low > 0) & (high < np.inf)
        band: style.Look = {"color": look["color"], "alpha": style.OPACITY, "lw": 0}
        axes.fill_between(x[known], low, high, where=bounded, **band)


def _mark(axes: Axes, places: Sequence[float] | np.ndarray) -> None:
    """Mark finite places on the x axis by dashed lines."""
    for place in np.asarray(places, float)[np.isfinite(places)]:
        axes.axvline(place, color="0.4", lw=1, ls="--", zorder=0.6)


def _scale(axes: Axes, x_label: str, y_label: str, x: np.ndarray) -> None:
    """Make both axes logarithmic, with their labels; the x axis ends with the values."""
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label, xlim=(x.min(), x.max()))
    style.label_logarithmic(axes.xaxis, at=(1, 3))


def _add_legend(figure: Figure) -> None:
    """Write each label above the panels once, in as many columns as fit."""
    handles = style.legend_entries(figure.axes).values()
    style.legend_above(figure, list(handles), most=2)
