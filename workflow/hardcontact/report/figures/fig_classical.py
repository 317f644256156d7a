"""Pull-off forces of rough spheres by classical models, and the errors of these forces."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.report.figures import drawing, panels, style

MIN_DRAWN_FORCE = 1e-6  # µN; a model that predicts less predicts no force at all
#: Roughness that enters a model, with its legend: rms values of scans, or of all wavelengths.
METRIC_LABELS = {"afm": "AFM scans alone", "all_scales": "all scales"}
#: By the forces with which a model is compared.
ERROR_LOOKS: dict[str, style.Look] = {
    "published": {"color": style.PUBLISHED_COLOUR, "marker": "o"},
    "computed": {"color": "0.55", "marker": "s"},
}
PUBLISHED_LINE: style.Look = {"lw": 0.5, "alpha": 0.6}


def draw(classical: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw (a) forces at the published work, (b) errors at the best work of each model."""
    work = published_constants["value"]["work_of_adhesion"]
    figure = drawing.create_figure(3.6, classical)
    force_axes, error_axes = figure.subplots(1, 2, width_ratios=(2.6, 1))
    _draw_forces(force_axes, classical)
    title = f"models at the published $W$ = {work / style.MILLIJOULE:g} mJ/m²"
    style.label_panel(force_axes, "a", title)
    _draw_errors(error_axes, classical)
    metric_handles = [
        Line2D([], [], color="0.3", marker="o", mfc=face, ls="none", label=f"from {label}")
        for face, label in zip(("0.3", "white"), METRIC_LABELS.values(), strict=True)
    ]
    line_handles = [
        Line2D([], [], color="0.3", label="published force", **PUBLISHED_LINE),
        Line2D([], [], color="0.3", lw=0.8, label="interval (bars)"),
    ]
    surface_handles = style.surface_handles(classical, ls="none")
    style.legend_above(figure, [*surface_handles, *metric_handles, *line_handles])
    return figure


def _draw_forces(axes: Axes, classical: xr.Dataset) -> None:
    """Draw the forces (µN) on each surface: published, computed, and by each model."""
    names = ("published_mean_force", "computed_mean_force", "model_force")
    values = np.concatenate([classical[name].values.ravel() for name in names]) / style.MICRONEWTON
    drawn_values = values[values > MIN_DRAWN_FORCE]
    bottom, top = drawn_values.min() / 12, drawn_values.max() * 6
    # The middle of a strip from `bottom` to three times `bottom`, for forces that are not drawn.
    no_force_height = 1.7 * bottom
    offsets = np.linspace(-0.3, 0.3, classical.sizes["surface"])
    for offset, (look, surface_data) in zip(
        offsets, style.iterate_surfaces(classical), strict=True
    ):
        for x, variable in enumerate(names[:2]):
            force = panels.value_and_interval(surface_data, variable) / style.MICRONEWTON
            panels.draw_bars(axes, x + offset, force, ls="none", **look)
        published = surface_data["published_mean_force"].item() / style.MICRONEWTON
        axes.axhline(published, color=look["color"], zorder=0, **PUBLISHED_LINE)
        _draw_model_forces(axes, surface_data, 2 + offset, no_force_height, look)
    axes.axhspan(bottom, 3 * bottom, color="0.9", zorder=0)
    axes.text(1.6, no_force_height, "no force", fontsize=7, va="center")
    axes.axvline(1.5, color="black", lw=0.6)
    labels = ["published", "computed", *classical["model_label"].values]
    axes.set_xticks(range(len(labels)), labels, **style.TILTED_LABELS)
    axes.set(xlim=(-0.5, len(labels) - 0.5), yscale="log", ylim=(bottom, top))
    axes.set_ylabel("pull-off force (µN)")
    style.label_logarithmic(axes.yaxis)


def _draw_model_forces(
    axes: Axes, surface_data: xr.Dataset, start: float, no_force_height: float, look: style.Look
) -> None:
    """Draw the forces (µN) of the models on one surface, the first at the position `start`."""
    forces = panels.value_and_interval(surface_data, "model_force") / style.MICRONEWTON
    drawn_forces = forces.where(~(forces < MIN_DRAWN_FORCE), no_force_height)
    positions = start + np.arange(surface_data.sizes["model"])
    for metrics, shift in zip(METRIC_LABELS, (-0.04, 0.04), strict=True):
        face = look["color"] if metrics == "afm" else "white"
        model_forces = drawn_forces.sel(metrics=metrics)
        panels.draw_bars(axes, positions + shift, model_forces, ls="none", mfc=face, **look)


def _draw_errors(axes: Axes, classical: xr.Dataset) -> None:
    """Draw the mean relative error of each model at its best work of adhesion."""
    errors = panels.value_and_interval(classical, "mean_relative_error")
    threshold = classical.attrs["error_threshold"]
    axes.axhspan(0, threshold, color="0.88", zorder=0)
    for side, (force_source, error_look) in zip((-1, 1), ERROR_LOOKS.items(), strict=True):
        for metrics, shift in zip(METRIC_LABELS, (-0.07, 0.07), strict=True):
            face = error_look["color"] if metrics == "afm" else "white"
            positions = np.arange(classical.sizes["model"]) + 0.17 * side + shift
            model_errors = errors.sel(metrics=metrics, force_source=force_source)
            panels.draw_bars(axes, positions, model_errors, ls="none", mfc=face, **error_look)
        axes.plot([], [], ls="none", label=f"to {force_source} forces", **error_look)
    axes.text(-0.4, threshold / 2, f"paper: below {threshold:g}", fontsize=7, va="center")
    labels = classical["model_label"].values
    axes.set_xticks(range(len(labels)), labels, **style.TILTED_LABELS)
    axes.set(ylim=(0, 1.5), ylabel="least mean relative error")
    axes.legend(loc="upper left", borderaxespad=0.1)
    style.label_panel(axes, "b", "$W$ fitted")
