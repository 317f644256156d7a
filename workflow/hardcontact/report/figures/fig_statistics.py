"""Scatter of pull-off forces: predicted, and on designed surfaces, in the study and the paper."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.report.figures import drawing, style, tables
from hardcontact.theory.force_scatter import CHANCE, MIN_TESTED_LEVEL, held_out_surfaces

TITLE = "How pull-off forces scatter"
CHAPTER = "8. What decides the band"
CAPTION = """\
How the logarithm of the pull-off force F scatters. (a) Its standard deviation over 400 independent
positions of the sphere on designed surfaces, computed and predicted. (b) Largest difference between
the probabilities of computed forces and of three distributions, by the Weibull modulus k = ρm/σ².
(c) The four coatings; black: published.

ρ is the range of adhesion, m the height of the apex, σ the rms height. The prediction
follows from them; only the mean force of each surface is fitted. The log-normal is fitted to each
surface. Contact in (a, b) is rigid and plastic, the sphere smooth. Held out: surfaces not looked
at while the prediction was made; only these are in (b). Crosses in (a): skewed heights (skewness
±0.6), on which the prediction fails. Grey in (a): contacts below two rms heights above the mean
plane, left out of (b). Dotted in (b): one in twenty samples of 400 from the predicted distribution
exceeds it. (c) is at a range of {{ scales.range }} in plastic contact. Rms heights of scans are
taken to differ by the uncertainties of Table 1. Black lines in (c): √(2 ln(mean/median)) of the
published forces, as only their mean and median are published. Crosses: the same for the
prediction. Bars: {{ inference.confidence | percent }} intervals over scans; an arrow where they
leave the frame. Drawn from statistics.nc.
"""

#: Look and label of each distribution, by its name in the dataset.
DISTANCES: dict[str, tuple[style.Look, str]] = {
    "law": ({"color": "black", "marker": "o"}, "predicted"),
    "lognormal_fitted": ({"color": style.FIT_COLOUR, "marker": "^"}, "log-normal, fitted"),
    "weibull": ({"color": "0.6", "marker": "s"}, "Weibull of modulus k"),
}
#: Look and label of each spread of a coating.
SPREADS: dict[str, tuple[style.Look, str]] = {
    "log_force_std": ({"mfc": "none"}, "predicted: positions"),
    "total_log_force_std": ({}, "predicted: positions and scans"),
    "total_lognormal_shape": ({"marker": "x"}, "predicted: √(2 ln(mean/median))"),
    "computed_log_force_std": ({"alpha": 0.5, "ms": 2.5}, "computed"),
}
#: Ratio of the top of the panel to the highest published or predicted spread.
MAX_RELATIVE_SPREAD = 1.6


def draw(statistics: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) spreads, (b) distances of designed surfaces, (c) the spreads of the coatings."""
    figure, ((spreads, distances), (coatings,)) = drawing.create_rows(
        5.2, statistics, (1.2, (1, 1)), (1, (1,))
    )
    held_out = held_out_surfaces(statistics)
    section = statistics.sel(rho=statistics.attrs["reference_rho"])
    _draw_spreads(spreads, statistics)
    _draw_distances(distances, held_out)
    _draw_coatings(coatings, section)
    spread_names = ("designed_log_force_std", "designed_predicted_log_force_std")
    frames = [
        tables.variable_rows(statistics, *(("a", name, "1") for name in spread_names)),
        tables.variable_rows(
            held_out, *(("b", f"designed_distance_{name}", "1") for name in DISTANCES)
        ),
        tables.variable_rows(section, *(("c", name, "1") for name in SPREADS)),
        tables.variable_rows(section, ("c", "published_log_force_std", "1")).assign(
            origin="published"
        ),
    ]
    return tables.tidy_table(frames, statistics, "case"), figure


def _draw_spreads(axes: Axes, statistics: xr.Dataset) -> None:
    """Draw computed against predicted spreads of ln F, by kind of surface."""
    is_skewed = statistics["designed_skew_parameter"] != 0
    is_low = (statistics["designed_level"] < MIN_TESTED_LEVEL) & ~is_skewed
    is_fair = ~is_skewed & ~is_low
    is_held_out = statistics["designed_held_out"] == 1
    black = {"marker": "o", "color": "black", "ms": 3}
    groups: list[tuple[xr.DataArray, str, style.Look]] = [
        (is_skewed, "skewed heights", {"marker": "x", "color": "0.55", "ms": 3}),
        (is_low, f"below {MIN_TESTED_LEVEL:g} rms heights", {"marker": ".", "color": "0.75"}),
        (is_fair & ~is_held_out, "used for the prediction", black | {"mfc": "none"}),
        (is_fair & is_held_out, "held out", black),
    ]
    for group, label, look in groups:
        cases = statistics.isel(case=np.flatnonzero(group))
        x, y = cases["designed_predicted_log_force_std"], cases["designed_log_force_std"]
        axes.plot(x, y, ls="none", mew=0.7, label=label, **look)
    ends = [0.05, 1.5]
    axes.plot(ends, ends, color="0.4", lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
    axes.set(
        xlabel="standard deviation of ln F, predicted",
        ylabel="standard deviation of ln F, computed",
    )
    axes.legend(loc="upper left")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, "a", "scatter over positions")


def _draw_distances(axes: Axes, held_out: xr.Dataset) -> None:
    """Draw the distance of the forces on surfaces held out from each distribution."""
    for name, (look, label) in reversed(DISTANCES.items()):
        distance = held_out[f"designed_distance_{name}"]
        modulus = held_out["designed_weibull_modulus"]
        axes.plot(modulus, distance, ls="none", ms=3, label=label, **look)
    axes.axhline(CHANCE, color="0.4", lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", ylim=(0.004, 1.2))
    axes.set(xlabel="modulus k = ρm/σ²", ylabel="largest difference of probabilities")
    axes.legend(loc="lower left")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, "b", "distance of distributions")


def _draw_coatings(axes: Axes, section: xr.Dataset) -> None:
    """Draw the spreads of the coatings: predicted, computed and published."""
    # Intervals of two scans may reach far beyond all values: an arrow marks a longer interval.
    highest = (
        MAX_RELATIVE_SPREAD * section[["published_log_force_std", *SPREADS]].to_array().max().item()
    )
    for position, (look, surface_data) in enumerate(style.iterate_surfaces(section)):
        for step, (name, (marker, _)) in enumerate(SPREADS.items()):
            curve = tables.value_and_interval(surface_data, name).expand_dims("position")
            curve = (
                curve if "low" in curve else curve.assign(low=curve["value"], high=curve["value"])
            )
            x = position + 0.15 * (step - 1.5)
            style.draw_bars(axes, [x], curve, ls="none", **look | marker)
            if curve["high"].item() > highest:
                axes.plot(x, 0.98 * highest, "^", color=look["color"], ms=3)
        published = surface_data["published_log_force_std"].item()
        axes.plot(
            [position - 0.3, position + 0.3], [published] * 2, color=style.PUBLISHED_COLOUR, lw=1.6
        )
    axes.set(ylim=(0, highest), ylabel="standard deviation of ln F")
    axes.set_xticks(range(section.sizes["surface"]), section["label"].values)
    handles = [Line2D([], [], color=style.PUBLISHED_COLOUR, lw=1.6, label="published")]
    marks: style.Look = {"color": "0.3", "marker": "o", "ls": "none"}
    handles += [Line2D([], [], **marks | marker, label=label) for marker, label in SPREADS.values()]
    axes.legend(handles=handles, loc="center left", bbox_to_anchor=(1, 0.5))
    style.label_panel(axes, "c", f"coatings at ρ = {section['rho'].item():g} nm")
