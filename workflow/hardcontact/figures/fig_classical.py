"""Classical models: their pull-off forces of rough spheres, and the effective work of adhesion."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator

from hardcontact.figures import drawing, style, tables

TITLE = "Classical models of rough adhesion, and the effective work of adhesion"
CHAPTER = "4. Classical models"
CAPTION = """\
(a) Mean pull-off forces, published, computed, and of classical models from the roughness of
Table 1, of AFM scans alone (filled) or all scales (open). (b) Least mean relative error of each
model, its work of adhesion fitted. (c) Effective work of adhesion of a smooth sphere over the
printed one. (d) Force over πRW against the Tabor parameter µ.

Computed forces are of plastic contact at the published range and work of adhesion, models at
the published work. Bars: of published forces their rounding, of computed ones the
{{ inference.confidence | percent }} interval over scans, of models the central
{{ inference.confidence | percent }} of forces that the printed uncertainties of Table 1 allow;
bars too long for a panel end at its frame. Horizontal lines repeat the published forces;
symbols in the grey strip of (a): the model has no force at all. (b) Fitted to the published
forces of all surfaces (black) or to the computed ones (grey); grey strip: below the paper's
threshold. (c) The printed work stands below; µ is what the pull-off force is converted with: as
printed, as it follows from the printed inputs, and that of the effective work itself; grey:
rounding of the printed value. (d) By the fit of Carpick and others (dashed) and by the exact
Maugis-Dugdale pair (solid). Vertical lines: µ as printed (dashed) and from the printed inputs
(dotted). Symbols: what the printed forces and works imply, within their rounding, side by side
at the printed µ; on polished UNCD, the one surface certain enough, it is less than the lines
give there. What each model calls roughness and what its formula was checked against stand in
the table beside the figure, with tests of power laws between roughness and effective work.
Drawn from classical.nc and resources/paper/parameters.csv.
"""

VANISHED = 1e-6  # µN; a model that predicts less predicts no force at all
LONGEST_BAR = 3  # panel c shows bars up to this many times the highest value
METRICS = {"afm": "AFM scans alone", "all_scales": "all scales"}
AGAINST = {"published": style.PUBLISHED, "computed": "0.55"}
EFFECTIVE_WORKS = {  # forces, Tabor parameter, marker
    "published force, printed µ": ("published", "printed", "s"),
    "published force, µ from inputs": ("published", "computed", "^"),
    "published force, µ of the result": ("published", "self_consistent", "v"),
    "computed force, printed µ": ("computed", "printed", "o"),
}
TRANSITIONS = {"fit": ("fit", "--"), "maugis_dugdale": ("Maugis–Dugdale", "-")}
COLUMNS = [
    *tables.ROW_COLUMNS, "model", "metrics", "against", "tabor", "transition", "rms_parameter", "x",
    *tables.VALUE_COLUMNS, "model_roughness", "model_verified",
]  # fmt: skip
QUANTITIES = {  # panel, origin; empty: not drawn
    "published_mean_force": ("a", "published"),
    "computed_mean_force": ("a", "computed"),
    "pull_off_force": ("a", "computed"),
    "mean_relative_error": ("b", "computed"),
    "fitted_work_of_adhesion": ("", "computed"),
    "adhesion_index": ("", "computed"),
    "published_effective_work_of_adhesion": ("c", "published"),
    "effective_work_of_adhesion": ("c", "computed"),
    "implied_pull_off_coefficient": ("d", "published"),
    "transition_coefficient": ("d", "computed"),
    "tabor_parameter": ("d", "computed"),
    "printed_tabor_parameter": ("d", "published"),
    "power_law_error": ("", "computed"),
}


def _table(classical: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Return the numbers of all panels, and further tests of the models.

    Forces in N, works of adhesion in J/m2, all else 1, with the ends of its interval where it has
    any; each model with its definition of roughness and what its formula was checked against. `x`
    is the Tabor parameter of `transition_coefficient`; `panel` is empty for what is not drawn.
    """
    rows = pd.concat(_rows(classical, name) for name in QUANTITIES)
    described = classical[["model_roughness", "model_verified"]].to_dataframe()
    rows = rows.dropna(subset=["value", "low", "high"], how="all")
    return tables.labelled([rows.join(described, on="model")], classical, COLUMNS)


def draw(classical: xr.Dataset, published_constants: pd.DataFrame) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) forces at the published work, (b) errors, (c) effective works, (d) transition."""
    work = published_constants["value"]["work_of_adhesion"]
    figure = drawing.create(6.0, classical)
    rows = figure.add_gridspec(2, 1, height_ratios=(1.15, 1))
    above, below = rows[0], rows[1]
    forces = figure.add_subplot(above)
    columns = below.subgridspec(1, 3, width_ratios=(0.8, 1.35, 0.9))
    errors, works, transition = columns.subplots(squeeze=False)[0]
    _draw_forces(forces, classical)
    title = f"models at the published $W$ = {work / style.MILLIJOULE:g} mJ/m²"
    style.label_panel(forces, "a", title)
    _draw_errors(errors, classical)
    _draw_works(works, classical)
    _draw_transition(transition, classical)
    style.legend_above(figure, _legend_handles(classical), 6)
    return _table(classical, published_constants), figure


def _rows(classical: xr.Dataset, name: str) -> pd.DataFrame:
    """Return one row a number of a variable, with its interval where it has one."""
    panel, origin = QUANTITIES[name]
    data = tables.bounded(classical, name).reset_coords(drop=True)
    frame = data.expand_dims("row").to_dataframe().reset_index()
    unit = classical[name].attrs["units"].replace(" m-2", "/m2")
    described = {"panel": panel, "origin": origin, "quantity": name, "unit": unit}
    return frame.rename(columns={"tabor_axis": "x"}).assign(**described)


def _places(count: int, width: float) -> np.ndarray:
    """Return positions side by side, centred on zero."""
    return np.linspace(-width / 2, width / 2, count) if count > 1 else np.zeros(1)


def _draw_point(axes: Axes, x: float, point: xr.Dataset, **look: Any) -> None:
    """Draw a value with its interval as an error bar."""
    value, low, high = (point[name].item() for name in ("value", "low", "high"))
    if np.isfinite(low):  # drawn by itself, as the interval of a skewed distribution may miss it
        axes.plot([x, x], [low, high], color=look["color"], lw=0.8)
    axes.plot([x], [value], ls="none", mew=0.8, **look)


def _draw_forces(axes: Axes, classical: xr.Dataset) -> None:
    """Draw the forces (µN) on each surface: published, computed, and by each model."""
    names = ("published_mean_force", "computed_mean_force", "pull_off_force")
    values = np.concatenate([classical[name].values.ravel() for name in names]) / style.MICRONEWTON
    shown = values[values > VANISHED]
    bottom, top = shown.min() / 12, shown.max() * 6  # the strip above the bottom is for the rest
    beside = _places(classical.sizes["surface"], 0.6)
    for (look, of_surface), offset in zip(style.by_surface(classical), beside, strict=True):
        colour = look["color"]
        for x, variable in enumerate(("published_mean_force", "computed_mean_force")):
            force = tables.bounded(of_surface, variable) / style.MICRONEWTON
            _draw_point(axes, x + offset, force, **look)
        published = of_surface["published_mean_force"].item() / style.MICRONEWTON
        axes.axhline(published, color=colour, lw=0.5, alpha=0.6, zorder=0)
        forces = tables.bounded(of_surface, "pull_off_force") / style.MICRONEWTON
        for x, model in enumerate(classical["model"].values, start=2):
            for metrics, aside in zip(METRICS, (-0.04, 0.04), strict=True):
                force = forces.sel(model=model, metrics=metrics)
                drawn = force.where(~(force < VANISHED), 1.7 * bottom)
                face = colour if metrics == "afm" else "white"
                _draw_point(axes, x + offset + aside, drawn, mfc=face, **look)
    axes.axhspan(bottom, 3 * bottom, color="0.9", zorder=0)
    axes.text(-0.45, 1.7 * bottom, "no force: less than 1 pN", fontsize=7, va="center")
    axes.axvline(1.5, color="black", lw=0.6)
    labels = ["published", "computed", *classical["model_label"].values]
    axes.set_xticks(range(len(labels)), labels)
    axes.set(xlim=(-0.5, len(labels) - 0.5), yscale="log", ylim=(bottom, top))
    axes.set_ylabel("pull-off force (µN)")
    # The strip below has no scale.
    decades = 10.0 ** np.arange(np.floor(np.log10(3 * bottom)), np.ceil(np.log10(top)) + 1)
    minor = np.outer(decades, range(2, 10)).ravel()
    axes.yaxis.set_major_locator(FixedLocator(decades[decades >= 3 * bottom].tolist()))
    axes.yaxis.set_minor_locator(FixedLocator(minor[minor >= 3 * bottom].tolist()))


def _draw_errors(axes: Axes, classical: xr.Dataset) -> None:
    """Draw the least mean relative error of each model to the published and computed forces."""
    errors = tables.bounded(classical, "mean_relative_error")
    threshold = classical.attrs["error_threshold"]
    axes.axhspan(0, threshold, color="0.88", zorder=0)
    for against, side in (("published", -1), ("computed", 1)):
        colour = AGAINST[against]
        for metrics, aside in zip(METRICS, (-0.07, 0.07), strict=True):
            look = {"color": colour, "marker": "o", "mfc": colour if metrics == "afm" else "white"}
            for x, model in enumerate(classical["model"].values):
                point = errors.sel(model=model, metrics=metrics, against=against)
                _draw_point(axes, x + 0.17 * side + aside, point, **look)
        axes.plot([], [], "o", color=colour, label=f"to {against} forces")
    axes.text(-0.4, threshold / 2, f"below {threshold:g}", fontsize=7, va="center")
    labels = classical["model_label"].values
    axes.set_xticks(range(len(labels)), labels, **{**style.TILTED, "rotation": 40})
    axes.set(ylim=(0, 1.5), ylabel="least mean relative error")
    axes.legend(loc="upper left", borderaxespad=0.1)
    style.label_panel(axes, "b", "$W$ fitted")


def _draw_works(axes: Axes, classical: xr.Dataset) -> None:
    """Draw effective works of adhesion divided by the printed ones, which the axis names."""
    colours = style.colours(classical["surface"].values)
    works = tables.bounded(classical, "effective_work_of_adhesion")
    printed = tables.bounded(classical, "published_effective_work_of_adhesion")
    for x, (name, colour) in enumerate(colours.items()):
        value = printed["value"].sel(surface=name).item()
        rounding = printed.sel(surface=name) / value
        ends = rounding["low"], rounding["high"]
        axes.fill_between([x - 0.4, x + 0.4], *ends, color="0.85", lw=0, zorder=0)
        for offset, (against, tabor, marker) in zip(
            _places(len(EFFECTIVE_WORKS), 0.54), EFFECTIVE_WORKS.values(), strict=True
        ):
            point = works.sel(surface=name, against=against, tabor=tabor) / value
            _draw_point(axes, x + offset, point, color=colour, marker=marker)
    for label, (_, _, marker) in EFFECTIVE_WORKS.items():
        axes.plot([], [], marker, color="0.3", label=label)
    axes.axhline(1, color="0.4", lw=0.6)
    labels = [
        f"{label}\n{value / style.MILLIJOULE:.2f}" if np.isfinite(value) else f"{label}\n–"
        for label, value in zip(classical["label"].values, printed["value"].values, strict=True)
    ]
    axes.set_xticks(range(len(colours)), labels)
    high, value = ((works[name] / printed["value"]).max().item() for name in ("high", "value"))
    highest = max(min(high, LONGEST_BAR * value), 1.3)
    axes.set(ylim=(0, 1.7 * highest), ylabel="$W_{eff}$ / printed")
    axes.set_xlabel("printed $W_{eff}$ (mJ/m²)")
    framed = {"frameon": True, "framealpha": 1, "edgecolor": "white"}  # above bars that are long
    axes.legend(loc="upper right", borderaxespad=0.1, **framed)
    style.label_panel(axes, "c", "effective work of adhesion")


def _draw_transition(axes: Axes, classical: xr.Dataset) -> None:
    """Draw F/πRW against the Tabor parameter, and what the printed numbers imply."""
    for name, (label, dashes) in TRANSITIONS.items():
        curve = classical["transition_coefficient"].sel(transition=name)
        axes.plot(curve["tabor_axis"], curve, dashes, color="black", lw=1.0, label=label)
    implied = tables.bounded(classical, "implied_pull_off_coefficient")
    printed = classical["printed_tabor_parameter"].item()
    beside = 1.11 ** _places(classical.sizes["surface"], 3)
    for (look, of_surface), aside in zip(style.by_surface(implied), beside, strict=True):
        _draw_point(axes, printed * aside, of_surface, **look)
    inputs = classical["tabor_parameter"].item()
    for value, dashes, label in ((printed, "--", "printed"), (inputs, ":", "from inputs")):
        label = f"µ {label}: {value:.2f}"
        axes.plot([value, value], [1.3, 1.98], dashes, color="0.4", lw=0.8, label=label, zorder=0)
    axes.set(xscale="log", xlim=(0.25, 4), ylim=(1.3, 2.65))
    axes.set(xlabel="Tabor parameter µ", ylabel="$F/\\pi R W$")
    style.label_logarithmic(axes.xaxis, at=(1, 2, 5))
    axes.legend(loc="upper right", borderaxespad=0.1)
    style.label_panel(axes, "d", "symbols: as printed")


def _legend_handles(classical: xr.Dataset) -> list[Artist]:
    """Return one entry a surface, and the two sets of roughness metrics."""
    of_metrics = [
        Line2D([], [], color="0.3", marker="o", mfc=face, ls="none", label=f"from {label}")
        for face, label in zip(("0.3", "white"), METRICS.values(), strict=True)
    ]
    return [*style.surface_handles(classical, ls="none"), *of_metrics]
