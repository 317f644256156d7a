"""Fig. 3: distributions of the pull-off forces, published and computed."""

from collections.abc import Mapping, Sequence
from string import ascii_lowercase
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from scipy.stats import lognorm

from hardcontact.base.formatting import format_estimate
from hardcontact.base.statistics import log_std_of_lognormal
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.fit import interpolate_forces
from hardcontact.report.figures import drawing, panels, style

LINEAR_BINS = 24
BINS_PER_DECADE = 8
#: Histograms at the published and at the fitted pair; each panel has the colour of its surface.
AT_PUBLISHED: style.Look = {"color": "0.4", "alpha": 0.55}
AT_FIT: style.Look = {"edgecolor": "0.2", "linewidth": 1.2}
PUBLISHED_LINE: style.Look = {"color": style.PUBLISHED_COLOUR, "lw": 1.0}
COMPUTED_LINE: style.Look = {"color": style.PUBLISHED_COLOUR, "lw": 1.0, "ls": "--"}

FitPair = pd.Series | xr.Dataset  # range (nm) and work of adhesion (J/m²)
ForcesByPair = dict[str, np.ndarray]  # forces (N) of one surface by pair, "published" and "fitted"


def draw(
    adhesion: xr.Dataset,
    fit: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> Figure:
    """Draw Fig. 3: one column per substrate, linear axes above and logarithmic axes below."""
    plastic_fit = fit.sel(contact_model=PLASTIC)
    floor = published_constants["value"]["force_floor"]
    pairs: dict[str, FitPair] = {"published": published_constants["value"], "fitted": plastic_fit}
    forces_at_pairs = {name: _forces_at(adhesion, pair) for name, pair in pairs.items()}
    published_forces = published_pull_off.to_dict("index")
    colours = style.surface_colours(fit["surface"].values)
    figure = drawing.create_figure(5.2, fit)
    grid = figure.subplots(2, len(colours), squeeze=False)
    for letter, surface, column in zip(ascii_lowercase, colours, grid.T, strict=False):
        surface_forces = {  # surfaces with fewer scans than others are padded by NaN
            name: values.sel(surface=surface).stack(force=[...]).dropna("force").values
            for name, values in forces_at_pairs.items()
        }
        surface_fit = plastic_fit.sel(surface=surface, pair="published")
        lognormals = _lognormals(published_forces[surface], surface_fit)
        _draw_linear(column[0], surface_forces, lognormals[0], colours[surface])
        _draw_logarithmic(column[1], surface_forces, lognormals, floor, colours[surface])
        _label_column(column, letter, surface_fit, lognormals[0])
        for axes in column:
            axes.axvspan(axes.get_xlim()[0], floor / style.MICRONEWTON, color="0.85", zorder=0)
            axes.set_xlabel("pull-off force (µN)")
    for axes in grid[:, 0]:
        axes.set_ylabel("probability density (1/µN)")
    figure.align_ylabels(grid[:, 0])
    style.legend_above(figure, _legend_handles(pairs, floor), max_columns=3)
    return figure


def _forces_at(adhesion: xr.Dataset, pair: FitPair) -> xr.DataArray:
    """Return the forces (N) of all plastic contacts at a pair."""
    forces = adhesion["pull_off_force"].sel(contact_model=PLASTIC)
    work_ratio: float = float(pair["work_of_adhesion"]) / adhesion.attrs["work_of_adhesion"]
    return interpolate_forces(forces, float(pair["range_of_adhesion"])) * work_ratio


def _lognormals(published_row: Mapping[Any, float], fit: xr.Dataset) -> tuple[Any, Any]:
    """Return the log-normals (N) of one surface: published, and fitted to the computed forces."""
    median = published_row["median_force"]
    published_log_std = log_std_of_lognormal(published_row["mean_force"], median)
    computed_lognormal = lognorm(fit["log_force_std"].item(), scale=fit["lognormal_median"].item())
    return lognorm(published_log_std, scale=median), computed_lognormal


def _label_column(column: np.ndarray, letter: str, fit: xr.Dataset, lognormal: Any) -> None:
    """Write the surface above its linear panel, and the std of ln F above the logarithmic panel.

    `lognormal` is the published one.
    """
    style.label_panel(column[0], f"{letter}_1", str(fit["label"].item()))
    (published_log_std,) = lognormal.args
    log_std = format_estimate(panels.scalar_and_interval(fit, "log_force_std"), ".2f")
    title = f"std of ln $F$\npublished {published_log_std:.2f}\nhere {log_std}"
    style.label_panel(column[1], f"{letter}_2", title)


def _draw_linear(axes: Axes, forces_by_pair: ForcesByPair, lognormal: Any, colour: str) -> None:
    """Draw the computed histograms and the published log-normal over the same bins, in µN."""
    # The axis leaves out at most 3 % of the forces at a pair and 10 % of the log-normal.
    ends = [np.quantile(forces, 0.97) for forces in forces_by_pair.values()]
    bin_edges = np.linspace(0, np.nanmax([*ends, lognormal.ppf(0.9)]), LINEAR_BINS + 1)
    _draw_histograms(axes, forces_by_pair, bin_edges, colour)
    density = np.diff(lognormal.cdf(bin_edges)) / np.diff(bin_edges)
    axes.stairs(density * style.MICRONEWTON, bin_edges / style.MICRONEWTON, **PUBLISHED_LINE)
    axes.set_xlim(0, bin_edges[-1] / style.MICRONEWTON)
    axes.set_ylim(bottom=0)
    axes.locator_params(nbins=4)


def _draw_logarithmic(
    axes: Axes, forces_by_pair: ForcesByPair, lognormals: Sequence[Any], floor: float, colour: str
) -> None:
    """Draw histograms and log-normals, published and computed, on logarithmic axes, in µN."""
    all_forces = np.concatenate(list(forces_by_pair.values()))
    lowest, highest = BINS_PER_DECADE * np.log10([all_forces.min(), all_forces.max()])
    steps = np.arange(np.floor(lowest), np.ceil(highest) + 2)
    bin_edges = 10 ** (steps / BINS_PER_DECADE)
    densities = _draw_histograms(axes, forces_by_pair, bin_edges, colour)
    high_quantiles = [lognormal.ppf(0.999) for lognormal in lognormals]
    ends = np.nanmin([bin_edges[0], floor / 3]), np.nanmax([bin_edges[-1], *high_quantiles])
    forces = np.geomspace(*ends, 200)
    for lognormal, look in zip(lognormals, (PUBLISHED_LINE, COMPUTED_LINE), strict=True):
        curve = lognormal.pdf(forces) * style.MICRONEWTON
        axes.plot(forces / style.MICRONEWTON, curve, **look)
    bar_heights = densities[densities > 0] * style.MICRONEWTON
    axes.set(xscale="log", yscale="log", xlim=np.divide(ends, style.MICRONEWTON))
    # The bars set the scale, because a log-normal has no smallest density and may have a high peak.
    axes.set_ylim(bar_heights.min() / 3, bar_heights.max() * 10)
    style.label_logarithmic(axes.xaxis, axes.yaxis, digits=(1,))


def _draw_histograms(
    axes: Axes, forces_by_pair: ForcesByPair, bin_edges: np.ndarray, colour: str
) -> np.ndarray:
    """Draw a histogram (1/µN) of the forces at each pair; return densities (pair, bin) in 1/N."""
    looks: dict[str, style.Look] = {
        "published": {**AT_PUBLISHED, "color": colour, "fill": True},
        "fitted": {**AT_FIT, "edgecolor": colour},
    }
    densities = []
    for pair, look in looks.items():
        forces = forces_by_pair[pair]
        density = np.histogram(forces, bin_edges)[0] / (forces.size * np.diff(bin_edges))
        axes.stairs(density * style.MICRONEWTON, bin_edges / style.MICRONEWTON, **look)
        densities.append(density)
    return np.array(densities)


def _legend_handles(pairs: dict[str, FitPair], floor: float) -> list[Artist]:
    """Return one entry for each kind of histogram, line and area."""
    published_text, fitted_text = (panels.format_pair(pair) for pair in pairs.values())
    return [
        Patch(label=f"computed, published {published_text}", lw=0, **AT_PUBLISHED),
        Patch(label=f"computed, fitted {fitted_text}", fill=False, **AT_FIT),
        Line2D([], [], label="published log-normal", **PUBLISHED_LINE),
        Line2D([], [], label="log-normal of the forces at the published pair", **COMPUTED_LINE),
        Patch(color="0.85", label=f"not resolved: below {floor * 1e9:.0f} nN"),
    ]
