"""Figures of own surfaces: force ratios, height maps, spectra, forces and fits, with their tables.

Each figure has a panel or a curve for every surface.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path, PurePath
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.base.statistics import bounds
from hardcontact.inference.edges import computed_cutoffs
from hardcontact.report.artificial import (
    artificial_bands,
    measurement_name,
    measurements,
    split_measurements,
)
from hardcontact.report.datasets import Datasets, preferred_model
from hardcontact.report.figures import drawing, style, tables
from hardcontact.report.figures.listing import FILE_KINDS, OWN_FIGURES

#: Label and look of the curve for each side of the band.
SIDE_LOOKS: dict[str, tuple[str, style.Look]] = {
    "small": ("without shorter wavelengths", {"ls": "-", "marker": "o"}),
    "large": ("without longer wavelengths", {"ls": "--", "marker": "s"}),
}
#: Looks of curves: the contact model of the answer first, then other models.
MODEL_LINES: tuple[style.Look, ...] = ({"ls": "-"}, {"ls": "--"}, {"ls": ":"})
KIND_COLOURS = {"map": "#332288", "line scan": "#882255", "description": "#999933"}
UNRELIABLE_LOOK: style.Look = {"color": "#999999"}
JOINED_LOOK: style.Look = {"color": "black", "ls": ":", "lw": 1.8, "zorder": 3}
FITS_ALL_COLOUR = "0.3"
#: Most measurements with unreliable parts of spectra drawn: more curves hide each other.
MAX_UNRELIABLE_CURVES = 3
MAX_MARKED_POINTS = 30  # on a line
MAP_RESOLUTION = 72  # dots per inch of height maps in the SVG, which are most of a page
PAGE_WIDTH = 3.8  # inch: 360 pixels of a phone show 7 points as 9 pixels

TableAndFigure = tuple[pd.DataFrame, Figure]


def write_figures(datasets: Datasets, outputs: Mapping[str, Sequence[str]]) -> dict[str, bytes]:
    """Write the figures of own surfaces and their tables, and return the SVG of each figure.

    outputs: paths of all figures, in one order, by kind of file. A file has the name of its figure.
    Returns SVG by the name of the figure.
    """
    pictures = {}
    for paths in zip(*(outputs[kind] for kind in FILE_KINDS), strict=True):
        files = dict(zip(FILE_KINDS, paths, strict=True))
        name = PurePath(files["svg"]).stem
        with style.print_style():
            table, figure = OWN_DRAWINGS[name](datasets)
            drawing.save(figure, table, OWN_FIGURES[name], files, MAP_RESOLUTION)
        pictures[name] = Path(files["svg"]).read_bytes()
    return pictures


def mean_free_heights(topography: xr.Dataset) -> np.ndarray:
    """Return the heights (row, column) in nm of one surface minus their mean, without padding."""
    example = topography["example_heights"].dropna("row", how="all").dropna("column", how="all")
    heights: np.ndarray = example.values - example.values.mean()
    return heights


def draw_maps(datasets: Datasets) -> TableAndFigure:
    """Draw the first levelled scan of each surface; the table has its rms height and range."""
    figure, panels = _panels(datasets, 3.3)
    frames = []
    for axes, colour, data in panels:
        heights = mean_free_heights(data.topography)
        style.draw_map(axes, heights, data.topography["scan_size"].item())
        axes.spines[:].set(edgecolor=colour, linewidth=1.5)
        values = {"map_rms_height": heights.std(), "map_peak_to_valley": np.ptp(heights)}
        map_statistics = xr.Dataset(values, data.topography["surface"].coords).expand_dims(
            "surface"
        )
        frames.append(_table_rows(map_statistics, dict.fromkeys(values, "nm")))
    return pd.concat(frames), figure


def draw_cutoffs(datasets: Datasets) -> TableAndFigure:
    """Draw the force relative to the unfiltered surface against the cutoff, for each surface.

    The axis of the ratio is logarithmic if it spans more than a factor of ten.
    """
    figure, panels = _panels(datasets)
    tolerance = datasets.edges.attrs["tolerance"]
    for axes, colour, data in panels:
        cutoffs = computed_cutoffs(data.edges["filtered_force_ratio"])
        computed_ratios = data.edges.sel(cutoff_wavelength=cutoffs)
        for side, (label, look) in SIDE_LOOKS.items():
            side_data = computed_ratios.sel(side=side)
            ends = bounds(side_data, "filtered_force_ratio")
            look = look | {"color": colour, "label": label}
            _draw_curve(axes, cutoffs, side_data["filtered_force_ratio"], ends, look)
        axes.axhspan(1 - tolerance, 1 + tolerance, color="0.82", lw=0, zorder=0.5)
        _mark_positions(axes, data.edges["edge"].values)
        _scale(axes, "cutoff wavelength (nm)", "force / unfiltered force", cutoffs)
        style.end_near_values([axes])
        low, high = axes.get_ylim()
        if high > 10 * low:
            style.label_logarithmic(axes.yaxis)
        else:
            axes.set_yscale("linear")
        style.shade_artificial(axes, artificial_bands(data.spectra))
    _add_legend(figure)
    return _table_rows(datasets.edges, {"filtered_force_ratio": "1", "edge": "nm"}), figure


def draw_spectra(datasets: Datasets) -> TableAndFigure:
    """Draw the isotropic PSDs of each surface: its measurements, the joined and the used PSD."""
    figure, panels = _panels(datasets, 3.6)
    frames = []
    for axes, colour, data in panels:
        used_density = _used_spectrum(data.spectra)
        all_measurements = measurements(data.spectra)
        wavelengths = 2 * np.pi / data.spectra["bin_wavevector"].values
        has_data = np.isfinite(all_measurements["psd"].values).any(axis=0)
        shows_unreliable = all_measurements.sizes["measurement"] <= MAX_UNRELIABLE_CURVES
        for measurement in split_measurements(all_measurements):
            density = measurement["psd"].values
            reliable = measurement["reliable"].values == 1
            name = PurePath(measurement_name(measurement)).name
            look: style.Look = {
                "color": KIND_COLOURS[str(measurement["kind"].item())],
                "label": name,
            }
            axes.plot(wavelengths, np.where(reliable, density, np.nan), **look)
            if shows_unreliable and np.isfinite(density[~reliable]).any():
                look = UNRELIABLE_LOOK | {"label": f"{name}, not reliable"}
                axes.plot(wavelengths, np.where(reliable, np.nan, density), **look)
            measurement_rows = measurement[["reliable"]].assign(value=measurement["psd"])
            columns = {"quantity": "psd", "measurement": measurement_name(measurement)}
            frames.append(tables.computed_rows(measurement_rows, unit="nm4", **columns))
        joined_density = data.spectra["joined_psd"].values
        axes.plot(wavelengths[has_data], used_density.values[has_data], color=colour, label="used")
        axes.plot(wavelengths[has_data], joined_density[has_data], **JOINED_LOOK, label="joined")
        _scale(axes, "wavelength (nm)", "isotropic PSD (nm⁴)", wavelengths[has_data])
        style.shade_artificial(axes, artificial_bands(data.spectra))
        axes.legend(loc="lower right")
        densities = data.spectra[["joined_psd"]].assign(used=used_density)
        frames.append(_table_rows(densities, {"joined_psd": "nm4", "used": "nm4"}))
    return pd.concat(frames), figure


def draw_forces(datasets: Datasets) -> TableAndFigure:
    """Draw the mean force of all surfaces and contact models against the range of adhesion.

    Intervals are drawn for the contact model of the answer.
    """
    force = datasets.force
    labels = datasets.labels()
    answer_model = preferred_model(force)
    models = sorted(
        map(str, force["contact_model"].values), key=lambda model: model != answer_model
    )
    figure = Figure(figsize=(PAGE_WIDTH, 3.4), layout="constrained")
    axes = figure.subplots()
    for surface, colour in style.colours(labels).items():
        for model, look in zip(models, MODEL_LINES, strict=False):
            curve = force.sel(surface=surface, contact_model=model)
            ends = [end / style.MICRONEWTON for end in bounds(curve, "force")]
            look = look | {"color": colour, "label": f"{labels[surface]}, {model}"}
            values = curve["force"] / style.MICRONEWTON
            _draw_curve(
                axes, force["rho"].values, values, ends if model == answer_model else [], look
            )
    _mark_positions(axes, [force.attrs["range_of_adhesion"]])
    _scale(axes, "range of adhesion (nm)", "pull-off force (µN)", force["rho"].values)
    style.label_logarithmic(axes.yaxis)
    _add_legend(figure)
    return _table_rows(force, {"force": "N"}), figure


def draw_works(datasets: Datasets) -> TableAndFigure:
    """Draw the work of adhesion that fits the force of each surface, against the range.

    Forces are from the contact model of the answer. If there are several surfaces, the figure also
    shows the works that fit all of them.
    """
    assert datasets.fit is not None
    fit = datasets.fit.sel(contact_model=preferred_model(datasets.fit))
    labels = datasets.labels()
    names = [str(name) for name in fit["surface"].values]
    rho = fit["rho_fine"].values
    colours = style.colours(labels)
    figure = Figure(figsize=(PAGE_WIDTH, 3.4), layout="constrained")
    axes = figure.subplots()
    for name in names:
        curve = fit.sel(surface=name)
        ends = [end / style.MILLIJOULE for end in bounds(curve, "work_by_range")]
        look = {"color": colours[name], "label": labels[name]}
        _draw_curve(axes, rho, curve["work_by_range"] / style.MILLIJOULE, ends, look)
    region = fit["region"].values / style.MILLIJOULE
    if len(names) > 1 and np.isfinite(region).any():
        middle = np.sqrt(region[:, 0] * region[:, 1])
        _draw_curve(
            axes, rho, middle, list(region.T), {"color": FITS_ALL_COLOUR, "label": "fits all"}
        )
    _mark_positions(axes, [fit.attrs["assumed_range"]])
    _scale(axes, "range of adhesion (nm)", "work of adhesion (mJ/m²)", rho)
    style.label_logarithmic(axes.yaxis)
    _add_legend(figure)
    return _table_rows(fit, {"work_by_range": "J/m2"}), figure


OWN_DRAWINGS: dict[str, Callable[[Datasets], TableAndFigure]] = {
    "cutoffs": draw_cutoffs,
    "maps": draw_maps,
    "spectra": draw_spectra,
    "forces": draw_forces,
    "works": draw_works,
}


def _panels(
    datasets: Datasets, height: float = 3.0
) -> tuple[Figure, Iterator[tuple[Axes, str, Datasets]]]:
    """Return a figure, and the panel (height in inches), colour and data of each surface."""
    labels = datasets.labels()
    figure = Figure(figsize=(PAGE_WIDTH, height * len(labels) + 0.4), layout="constrained")
    panels = figure.subplots(len(labels), squeeze=False)[:, 0]
    for axes, label in zip(panels, labels.values(), strict=True):
        axes.set_title(label, loc="left")
    colours = style.colours(labels)
    surface_datasets = [datasets.select_surface(surface) for surface in labels]
    return figure, zip(panels, colours.values(), surface_datasets, strict=True)


def _table_rows(data: xr.Dataset, units: Mapping[str, str]) -> pd.DataFrame:
    """Return a row for each number of the variables in `units`, with its interval and unit."""
    return pd.concat(
        tables.computed_rows(tables.value_and_interval(data, name), quantity=name, unit=unit)
        for name, unit in units.items()
    )


def _used_spectrum(spectra: xr.Dataset) -> xr.DataArray:
    """Return the spectrum (nm⁴) of added roughness at the measured bins, NaN where it is zero."""
    with np.errstate(divide="ignore"):
        logarithm = np.log(spectra["spectrum"].values)
    bins = np.log(spectra["bin_wavevector"])
    density = np.exp(np.interp(bins, np.log(spectra["wavevector"]), logarithm))
    return spectra["joined_psd"].copy(data=np.where(density > 0, density, np.nan))


def _draw_curve(
    axes: Axes, x: np.ndarray, values: Any, ends: Sequence[Any], look: style.Look
) -> None:
    """Draw finite values, with a band between the ends of their intervals where both are finite."""
    values = np.asarray(values, float)
    is_finite = np.isfinite(values)
    marker = look.get("marker", "o") if is_finite.sum() < MAX_MARKED_POINTS else ""
    marked: style.Look = look | {"marker": marker, "ms": 2.5}
    axes.plot(x[is_finite], values[is_finite], **marked)
    if len(ends):
        low, high = np.asarray(ends, float)[:, is_finite]
        is_bounded = (low > 0) & (high < np.inf)
        band: style.Look = {"color": look["color"], "alpha": style.OPACITY, "lw": 0}
        axes.fill_between(x[is_finite], low, high, where=is_bounded, **band)


def _mark_positions(axes: Axes, positions: Sequence[float] | np.ndarray) -> None:
    """Mark finite positions on the x axis by dashed lines."""
    for position in np.asarray(positions, float)[np.isfinite(positions)]:
        axes.axvline(position, color="0.4", lw=1, ls="--", zorder=0.6)


def _scale(axes: Axes, x_label: str, y_label: str, x: np.ndarray) -> None:
    """Make both axes logarithmic, label them, and limit the x axis to the values."""
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label, xlim=(x.min(), x.max()))
    style.label_logarithmic(axes.xaxis, digits=(1, 3))


def _add_legend(figure: Figure) -> None:
    """Write each label above the panels once, in as many columns as fit."""
    handles = style.legend_entries(figure.axes).values()
    style.legend_above(figure, list(handles), max_columns=2)
