"""Fig. 3: distributions of the pull-off forces, published and computed."""

from collections.abc import Sequence
from string import ascii_lowercase
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from scipy.stats import lognorm

from hardcontact.base.formatting import format_with_interval
from hardcontact.base.statistics import lognormal_shape
from hardcontact.contact.contact import PLASTIC
from hardcontact.contact.force_curves import interpolate_to_range
from hardcontact.report.figures import drawing, style, tables

TITLE = "Fig. 3: distribution of the pull-off forces"
CHAPTER = "3. Adhesion"
CAPTION = """\
Distribution of the pull-off forces computed with plastic contact, all scans and positions. Filled:
at the published range ρ and work of adhesion W; outlined: at the fitted ones. Solid: the
log-normal distribution of the published mean and median. Dashed: the log-normal fitted to the
forces at the published pair. Grey: forces below the sensitivity of the experiment.

Upper axes are linear and leave out the largest 3 % of the forces at most. Lower axes are
logarithmic and have all forces. Above the lower panels stands the shape s, the standard deviation
of the logarithm of the force. Published: s = √(2 ln(mean/median)); here: that of the fit, with its
{{ inference.confidence | percent }} interval over scans. In the fit, forces below the sensitivity
count as censored. The measured forces are not public. The upper panels show the published
distribution over the bins of the computed ones. Drawn from adhesion.nc and fit.nc; published
values from parameters.csv and pull_off.csv of resources/paper.
"""

LINEAR_BINS = 24
BINS_PER_DECADE = 8
AT_PUBLISHED: style.Look = {"color": "0.4", "alpha": 0.55}
AT_FIT: style.Look = {"edgecolor": "0.2", "linewidth": 1.2}
PUBLISHED_LINE: style.Look = {"color": style.PUBLISHED_COLOUR, "lw": 1.0}
COMPUTED_LINE: style.Look = {"color": style.PUBLISHED_COLOUR, "lw": 1.0, "ls": "--"}
QUANTITIES = {  # computed variable, unit
    "lognormal_shape": ("lognormal_shape", "1"),
    "lognormal_median": ("lognormal_median", "N"),
    "mean_force": ("mean_force_at_pair", "N"),
    "median_force": ("median_force_at_pair", "N"),
}
COLUMNS = [
    "surface", "label", "basis", "origin", "pair", "quantity", "panel", "force_low", "force_high",
    *tables.VALUE_COLUMNS,
]  # fmt: skip

Pairs = dict[str, np.ndarray]  # forces (N) of one surface by pair, "published" and "fitted"


def draw(
    adhesion: xr.Dataset,
    fit: xr.Dataset,
    published_constants: pd.DataFrame,
    published_pull_off: pd.DataFrame,
) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 3: one column a substrate, linear axes above and logarithmic axes below.

    A `pair` of range and work of adhesion is the published or the fitted pair. The table has the
    probability density of each bin from `force_low` to `force_high`, for the linear panels "1" and
    the logarithmic panels "2", and the numbers of the log-normals.
    """
    plastic_fit = fit.sel(contact_model=PLASTIC)
    floor = fit.attrs["force_floor"]
    work = adhesion.attrs["work_of_adhesion"]
    pairs: dict[str, pd.Series | xr.Dataset] = {
        "published": published_constants["value"],
        "fitted": plastic_fit,
    }
    forces = adhesion["pull_off_force"].sel(contact_model=PLASTIC)
    forces_of_all = {
        name: interpolate_to_range(forces, float(pair["range_of_adhesion"]))
        * (float(pair["work_of_adhesion"]) / work)
        for name, pair in pairs.items()
    }
    colours = style.colours(fit["surface"].values)
    figure = drawing.create(5.0, fit)
    grid = figure.subplots(2, len(colours), squeeze=False)
    frames = []
    for letter, (surface, colour), (linear, logarithmic) in zip(
        ascii_lowercase, colours.items(), grid.T, strict=False
    ):
        surface_forces = {  # a surface with fewer scans than others has NaN in place of theirs
            name: values.sel(surface=surface).stack(force=[...]).dropna("force").values
            for name, values in forces_of_all.items()
        }
        statistics_rows = _statistics_rows(published_pull_off, plastic_fit.sel(surface=surface))
        values = statistics_rows.pivot(index="pair", columns="quantity", values="value")
        lognormals = [
            lognorm(values["lognormal_shape"][pair], scale=values["lognormal_median"][pair])
            for pair in ("", "published")  # of the paper, and of the forces computed at its pair
        ]
        rows = [
            _draw_linear(linear, surface_forces, lognormals[0], colour),
            _draw_logarithmic(logarithmic, surface_forces, lognormals, floor, colour),
            statistics_rows,
        ]
        label = plastic_fit["label"].sel(surface=surface).item()
        style.label_panel(linear, f"{letter}_1", str(label))
        published_pair = plastic_fit.sel(surface=surface, pair="published")
        shape_and_interval = tables.value_and_bounds(published_pair, "lognormal_shape")
        shape = f"published $s$ = {values['lognormal_shape']['']:.2f}"
        shape += f"\nhere {format_with_interval(shape_and_interval, '.2f')}"
        style.label_panel(logarithmic, f"{letter}_2", shape)
        for axes in (linear, logarithmic):
            axes.axvspan(axes.get_xlim()[0], floor / style.MICRONEWTON, color="0.85", zorder=0)
            axes.set_xlabel("pull-off force (µN)")
        frames.append(pd.concat(rows).assign(surface=surface))
    for axes in grid[:, 0]:
        axes.set_ylabel("probability density (1/µN)")
    published, fitted = map(style.print_pair, pairs.values())
    handles = [
        Patch(label=f"computed, published {published}", lw=0, **AT_PUBLISHED),
        Patch(label=f"computed, fitted {fitted}", fill=False, **AT_FIT),
        Line2D([], [], label="published log-normal", **PUBLISHED_LINE),
        Line2D([], [], label="log-normal of the forces at the published pair", **COMPUTED_LINE),
        Patch(color="0.85", label=f"not resolved: below {floor * 1e9:.0f} nN"),
    ]
    style.legend_above(figure, handles, 3)
    return tables.label_rows(frames, fit, COLUMNS), figure


def _statistics_rows(published: pd.DataFrame, fit: xr.Dataset) -> pd.DataFrame:
    """Return statistics of the forces on one surface: published, and computed at each pair."""
    surface = fit["surface"].item()
    mean, median = published["mean_force"][surface], published["median_force"][surface]
    values = (lognormal_shape(mean, median), median, mean, median)
    frames = [
        tables.quantity_rows("", name, unit, "published", pair="", value=value)
        for (name, (_, unit)), value in zip(QUANTITIES.items(), values, strict=True)
    ]
    for pair in ("published", "fitted"):
        for name, (variable, unit) in QUANTITIES.items():
            value_and_interval = tables.value_and_bounds(fit.sel(pair=pair), variable)
            frames.append(tables.quantity_rows("", name, unit, pair=pair, **value_and_interval))
    return pd.concat(frames, ignore_index=True)


def _draw_linear(axes: Axes, forces_by_pair: Pairs, published: Any, colour: str) -> pd.DataFrame:
    """Draw the computed histograms and the published log-normal over the same bins, in µN.

    The bins reach from zero to the highest of high quantiles of the distributions.
    """
    ends = [np.quantile(forces, 0.97) for forces in forces_by_pair.values()]
    edges = np.linspace(0, np.nanmax([*ends, published.ppf(0.9)]), LINEAR_BINS + 1)
    histogram_rows = _draw_histograms(axes, forces_by_pair, edges, colour)
    density = np.diff(published.cdf(edges)) / np.diff(edges)
    axes.stairs(density * style.MICRONEWTON, edges / style.MICRONEWTON, **PUBLISHED_LINE)
    axes.set_xlim(0, edges[-1] / style.MICRONEWTON)
    axes.set_ylim(bottom=0)
    axes.locator_params(nbins=4)
    rows = _bin_rows(edges, density).assign(origin="published", pair="")
    return pd.concat([rows, histogram_rows]).assign(panel="1")


def _draw_logarithmic(
    axes: Axes, forces_by_pair: Pairs, lognormals: Sequence[Any], floor: float, colour: str
) -> pd.DataFrame:
    """Draw histograms and log-normals, published and computed, on logarithmic axes, in µN.

    The bins are equal in the logarithm and contain every force.
    """
    all_forces = np.concatenate(list(forces_by_pair.values()))
    lowest_log, highest_log = np.log10(all_forces.min()), np.log10(all_forces.max())
    steps = np.arange(
        np.floor(lowest_log * BINS_PER_DECADE), np.ceil(highest_log * BINS_PER_DECADE) + 2
    )
    edges = 10 ** (steps / BINS_PER_DECADE)
    rows = _draw_histograms(axes, forces_by_pair, edges, colour)
    high_quantiles = [lognormal.ppf(0.999) for lognormal in lognormals]
    ends = np.nanmin([edges[0], floor / 3]), np.nanmax([edges[-1], *high_quantiles])
    line = np.geomspace(*ends, 200)
    for lognormal, look in zip(lognormals, (PUBLISHED_LINE, COMPUTED_LINE), strict=True):
        curve = lognormal.pdf(line) * style.MICRONEWTON
        axes.plot(line / style.MICRONEWTON, curve, **look)
    bars = rows["value"][rows["value"] > 0] * style.MICRONEWTON
    axes.set(xscale="log", yscale="log", xlim=np.divide(ends, style.MICRONEWTON))
    # The bars set the scale, because a log-normal has no least density and may have a high peak.
    axes.set_ylim(bars.min() / 3, bars.max() * 10)
    style.label_logarithmic(axes.xaxis, axes.yaxis, digits=(1,))
    return rows.assign(panel="2")


def _draw_histograms(
    axes: Axes, forces_by_pair: Pairs, edges: np.ndarray, colour: str
) -> pd.DataFrame:
    """Fill the histogram at the published pair, and outline the histogram at the fitted pair.

    The total includes forces beyond the bins.
    """
    looks: dict[str, style.Look] = {
        "published": {**AT_PUBLISHED, "color": colour, "fill": True},
        "fitted": {**AT_FIT, "edgecolor": colour},
    }
    frames = []
    for pair, look in looks.items():
        forces = forces_by_pair[pair]
        density = np.histogram(forces, edges)[0] / (forces.size * np.diff(edges))
        axes.stairs(density * style.MICRONEWTON, edges / style.MICRONEWTON, **look)
        frames.append(_bin_rows(edges, density).assign(origin="computed", pair=pair))
    return pd.concat(frames)


def _bin_rows(edges: np.ndarray, density: np.ndarray) -> pd.DataFrame:
    """Return a row for each bin (N) with its probability density (1/N)."""
    rows = pd.DataFrame({"force_low": edges[:-1], "force_high": edges[1:], "value": density})
    return rows.assign(quantity="probability_density", unit="1/N")
