"""Figures of your surfaces: octaves, force ratios, height maps, spectra, forces and fits."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from itertools import cycle
from pathlib import Path, PurePath

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from hardcontact.inference.edges import computed_cutoffs
from hardcontact.report.figures import drawing, panels, style
from hardcontact.report.figures.listing import FIGURE_SUFFIXES, describe_figure
from hardcontact.report.own_surfaces.datasets import (
    Datasets,
    drop_padding,
    fails_hindcast,
    measurement_name,
    octave_sphere_share,
    preferred_model,
    select_preferred_model,
    shown_octaves,
    split_measurements,
    unreliable_wavelengths,
)

SIDE_LOOKS: dict[str, tuple[str, style.Look]] = {
    "short": ("without shorter wavelengths", {"ls": "-", "marker": "o"}),
    "long": ("without longer wavelengths", {"ls": "--", "marker": "s"}),
}
#: Looks of curves: the preferred contact model first, then other models.
MODEL_LOOKS: tuple[style.Look, ...] = ({"ls": "-"}, {"ls": "--", "mfc": "white"}, {"ls": ":"})
KIND_COLOURS = {"map": "#332288", "line scan": "#882255", "description": "#999933"}
UNRELIABLE_LOOK: style.Look = {"color": "#999999", "mfc": "white", "ls": "--"}
JOINED_LOOK: style.Look = {"color": "black", "ls": ":", "lw": 1.8, "zorder": 3}
FITS_ALL_LOOK: style.Look = {"color": "0.3", "ls": "--", "marker": "", "label": "fits all"}
#: With more measurements only reliable parts of spectra are drawn, because curves hide each other.
MAX_UNRELIABLE_CURVES = 3
#: Fewest symbols on a curve of more points.
MIN_SYMBOLS = 12
#: Dots per inch of height maps, which make up most of the size of a page.
MAP_DOTS_PER_INCH = 72
#: Width of figures in inches: 360 pixels of a phone show 7 points as 9 pixels.
FIGURE_WIDTH = 3.8


def write_figures(datasets: Datasets, outputs: Mapping[str, Sequence[str]]) -> dict[str, bytes]:
    """Write each figure to the files that have its name, by suffix; return the SVG by name."""
    pictures = {}
    for index, svg in enumerate(outputs["svg"]):
        files = {suffix: outputs[suffix][index] for suffix in FIGURE_SUFFIXES}
        name = PurePath(svg).stem
        with style.print_style():
            figure = OWN_DRAWINGS[name](datasets)
            drawing.save_figure(figure, describe_figure(name).title, files, MAP_DOTS_PER_INCH)
        pictures[name] = Path(svg).read_bytes()
    return pictures


def draw_octaves(datasets: Datasets) -> Figure:
    """Draw the change of the force with the amplitude of each octave, for all surfaces."""
    labels = datasets.labels()
    is_shown = [shown_octaves(datasets.select_surface(surface)) for surface in labels]
    sensitivity = datasets.sensitivity.sel(surface=list(labels))
    handles = style.surface_handles(sensitivity.assign(label=("surface", [*labels.values()])))
    if "sphere_share" in datasets.spectra:
        octaves = sensitivity["octave"].values
        spectra = [datasets.spectra.sel(surface=surface) for surface in labels]
        shares = [[octave_sphere_share(row, octave) for octave in octaves] for row in spectra]
        sensitivity = sensitivity.assign(sphere_share=(("surface", "octave"), shares))
        handles.append(Patch(**panels.SPHERE_SHARE_LOOK, label="the sphere's share of the power"))
    figure, axes = _single_panel(3.0)
    panels.draw_octaves(axes, sensitivity.assign(is_shown=(("surface", "octave"), is_shown)))
    panels.cut_long_intervals(axes, float(np.abs(sensitivity["octave_sensitivity"]).max()))
    style.legend_above(figure, handles, max_columns=2)
    return figure


def draw_maps(datasets: Datasets) -> Figure:
    """Draw the first levelled scan of each surface, and of the sphere if it is rough."""
    labels = datasets.labels()
    topography = datasets.topography
    spheres = topography.sel(surface=~topography["surface"].isin(list(labels)))
    names = labels | dict(zip(spheres["surface"].values, spheres["label"].values, strict=True))
    colours = style.surface_colours(labels)
    figure, column = _titled_panels(names.values(), 3.3)
    for axes, name in zip(column, names, strict=True):
        scan = topography.sel(surface=name)
        heights = panels.centred_heights(scan["example_heights"])
        colour = colours.get(name, style.SPHERE_COLOUR)
        panels.draw_map(axes, heights, scan["scan_size"].item(), colour)
    return figure


def draw_cutoffs(datasets: Datasets) -> Figure:
    """Draw the force relative to the unfiltered force against the cutoff, for each surface."""
    figure, surface_panels = _surface_panels(datasets)
    for axes, colour, surface_data in surface_panels:
        cutoffs = computed_cutoffs(surface_data.edges["filtered_force_ratio"])
        ratios = panels.value_and_interval(surface_data.edges, "filtered_force_ratio")
        for side, (label, look) in SIDE_LOOKS.items():
            curve = ratios.sel(side=side, cutoff_wavelength=cutoffs)
            _draw_curve(axes, cutoffs, curve, look | {"color": colour, "label": label})
        panels.draw_tolerance(axes, datasets.edges.attrs["tolerance"])
        # If the hindcast fails, the unfiltered force rests on wrong roughness, and so do edges.
        known_sides = [side for side in SIDE_LOOKS if not fails_hindcast(surface_data, side)]
        known_edges = surface_data.edges["edge"].sel(side=known_sides).values.tolist()
        _mark_positions(axes, known_edges, "edges of the band")
        _set_logarithmic_axes(axes, "cutoff wavelength (nm)", "force / unfiltered force", cutoffs)
        style.end_near_values(axes)
        low, high = axes.get_ylim()
        if high > 10 * low:
            style.label_logarithmic(axes.yaxis)
        else:
            axes.set_yscale("linear")
        panels.hatch_wavelengths(axes, unreliable_wavelengths(surface_data.spectra))
    _add_legend(figure)
    return figure


def draw_spectra(datasets: Datasets) -> Figure:
    """Draw the PSDs of each surface: of its measurements, joined, and as used for masters."""
    figure, surface_panels = _surface_panels(datasets, 3.6)
    for axes, colour, surface_data in surface_panels:
        wavelengths = 2 * np.pi / surface_data.spectra["bin_wavevector"].values
        all_measurements = drop_padding(surface_data.spectra)
        has_data = np.isfinite(all_measurements["psd"].values).any(axis=0)
        draws_all = all_measurements.sizes["measurement"] <= MAX_UNRELIABLE_CURVES
        measurements = split_measurements(all_measurements)
        for measurement, marker in zip(measurements, cycle(style.MARKERS), strict=False):
            _draw_measurement(axes, wavelengths, measurement, marker, draws_all)
        used_density = _used_density(surface_data.spectra)[has_data]
        joined_density = surface_data.spectra["joined_psd"].values[has_data]
        axes.plot(wavelengths[has_data], used_density, color=colour, label="used")
        axes.plot(wavelengths[has_data], joined_density, **JOINED_LOOK, label="joined")
        _set_logarithmic_axes(axes, "wavelength (nm)", "isotropic PSD (nm⁴)", wavelengths[has_data])
        panels.hatch_wavelengths(axes, unreliable_wavelengths(surface_data.spectra))
        axes.legend(loc="lower right")
    return figure


def draw_forces(datasets: Datasets) -> Figure:
    """Draw the mean force of all surfaces and contact models against the range of adhesion."""
    force = datasets.force
    labels = datasets.labels()
    preferred = preferred_model(force)
    models = sorted(force["contact_model"].values.tolist(), key=lambda name: name != preferred)
    figure, axes = _single_panel(3.4)
    ranges = force["rho"].values
    forces = panels.value_and_interval(force, "force") / style.MICRONEWTON
    for surface, surface_look in style.surface_looks(labels).items():
        for model, model_look in zip(models, MODEL_LOOKS, strict=False):
            curve = forces.sel(surface=surface, contact_model=model)
            drawn_curve = curve if model == preferred else curve[["value"]]
            look = surface_look | model_look | {"label": f"{labels[surface]}, {model}"}
            _draw_curve(axes, ranges, drawn_curve, look)
    _finish_range_axes(figure, ranges, force.attrs["rho"], "pull-off force (µN)")
    return figure


def draw_works(datasets: Datasets) -> Figure:
    """Draw the works of adhesion that fit each surface's force, and all forces, by range."""
    assert datasets.fit is not None
    fit = select_preferred_model(datasets.fit)
    labels = datasets.labels()
    names = fit["surface"].values.tolist()
    rho = fit["rho_fine"].values
    looks = style.surface_looks(labels)
    figure, axes = _single_panel(3.4)
    works = panels.value_and_interval(fit, "work_by_range") / style.MILLIJOULE
    for name in names:
        _draw_curve(axes, rho, works.sel(surface=name), looks[name] | {"label": labels[name]})
    # The works (rho_fine, end) that agree with all measured forces, NaN at ranges without any.
    low, high = fit["region"].values.T / style.MILLIJOULE
    if len(names) > 1 and np.isfinite([low, high]).any():
        curve = {"value": ("rho", np.sqrt(low * high)), "low": ("rho", low), "high": ("rho", high)}
        _draw_curve(axes, rho, xr.Dataset(curve), FITS_ALL_LOOK)
    _finish_range_axes(figure, rho, fit.attrs["rho"], "work of adhesion (mJ/m²)")
    return figure


OWN_DRAWINGS: dict[str, Callable[[Datasets], Figure]] = {
    "octaves": draw_octaves, "cutoffs": draw_cutoffs, "maps": draw_maps,
    "spectra": draw_spectra, "forces": draw_forces, "works": draw_works,
}  # fmt: skip


def _surface_panels(
    datasets: Datasets, height: float = 3.0
) -> tuple[Figure, Iterator[tuple[Axes, str, Datasets]]]:
    """Return a figure, and the panel (height in inches), colour and data of each surface."""
    labels = datasets.labels()
    figure, column = _titled_panels(labels.values(), height)
    colours = style.surface_colours(labels)
    surface_datasets = [datasets.select_surface(surface) for surface in labels]
    return figure, zip(column, colours.values(), surface_datasets, strict=True)


def _single_panel(height: float) -> tuple[Figure, Axes]:
    """Return a figure with one panel of a height (inch)."""
    figure = Figure(figsize=(FIGURE_WIDTH, height), layout="constrained")
    return figure, figure.subplots()


def _titled_panels(titles: Collection[str], height: float) -> tuple[Figure, np.ndarray]:
    """Return a figure with a column of panels of a height (inch), each with its title."""
    figure = Figure(figsize=(FIGURE_WIDTH, height * len(titles) + 0.4), layout="constrained")
    column = figure.subplots(len(titles), squeeze=False)[:, 0]
    for axes, title in zip(column, titles, strict=True):
        axes.set_title(title, loc="left")
    return figure, column


def _draw_measurement(
    axes: Axes, wavelengths: np.ndarray, measurement: xr.Dataset, marker: str, draws_all: bool
) -> None:
    """Draw the PSD (nm⁴) of one measurement where it is reliable; grey elsewhere, if asked for."""
    density = measurement["psd"].values
    is_reliable = measurement["reliable"].values == 1
    name = PurePath(measurement_name(measurement)).name
    reliable_look: style.Look = {"marker": marker, "ms": 2.5, "lw": 0.8}
    colour = KIND_COLOURS[str(measurement["kind"].item())]
    reliable_density = np.where(is_reliable, density, np.nan)
    axes.plot(wavelengths, reliable_density, color=colour, label=name, **reliable_look)
    if draws_all and np.isfinite(density[~is_reliable]).any():
        look: style.Look = reliable_look | UNRELIABLE_LOOK | {"label": f"{name}, not reliable"}
        axes.plot(wavelengths, np.where(is_reliable, np.nan, density), **look)


def _used_density(spectra: xr.Dataset) -> np.ndarray:
    """Return C_iso (nm⁴) of the masters at the measured bins, NaN where it is zero."""
    with np.errstate(divide="ignore"):
        logarithm = np.log(spectra["spectrum"].values)
    bins = np.log(spectra["bin_wavevector"])
    density = np.exp(np.interp(bins, np.log(spectra["wavevector"]), logarithm))
    return np.where(density > 0, density, np.nan)


def _draw_curve(axes: Axes, x: np.ndarray, curve: xr.Dataset, look: style.Look) -> None:
    """Draw the finite values of a curve, and the band between the ends of its intervals, if any."""
    is_finite = np.isfinite(curve["value"].values)
    finite_curve = curve.isel({curve["value"].dims[0]: is_finite})
    marker_step = max(1, is_finite.sum() // MIN_SYMBOLS)
    marked_look: style.Look = look | {"ms": 2.5, "markevery": marker_step}
    axes.plot(x[is_finite], finite_curve["value"], **marked_look)
    if "low" in curve:
        panels.draw_band(axes, x[is_finite], finite_curve, look["color"])


def _mark_positions(axes: Axes, positions: Sequence[float], label: str) -> None:
    """Mark finite positions on the x axis by dashed lines, and name them."""
    for position in filter(np.isfinite, positions):
        axes.axvline(position, color="0.4", lw=1, ls="--", zorder=0.6, label=label)


def _set_logarithmic_axes(axes: Axes, x_label: str, y_label: str, x: np.ndarray) -> None:
    """Make both axes logarithmic, label them, and limit the x axis to the values of x."""
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label, xlim=(x.min(), x.max()))
    style.label_logarithmic(axes.xaxis, digits=(1, 3))


def _finish_range_axes(figure: Figure, ranges: np.ndarray, rho: float, y_label: str) -> None:
    """Mark the range of adhesion rho (nm) of the study, scale the axes and add the legend."""
    (axes,) = figure.axes
    _mark_positions(axes, [rho], "range of the study")
    _set_logarithmic_axes(axes, "range of adhesion (nm)", y_label, ranges)
    style.label_logarithmic(axes.yaxis)
    _add_legend(figure)


def _add_legend(figure: Figure) -> None:
    """Write each label above the panels once, in at most two columns."""
    style.legend_above(figure, list(style.legend_entries(figure.axes).values()), max_columns=2)
