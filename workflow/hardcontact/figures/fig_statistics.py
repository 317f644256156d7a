"""The scatter of pull-off forces: the law beside designed surfaces, the study and the paper."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from hardcontact.figures import drawing, style, tables
from hardcontact.insight.pull_off_statistics import CHANCE, LEAST_LEVEL, held_back

TITLE = "How pull-off forces scatter"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) Standard deviation of ln F over 400 independent places of designed surfaces, computed,
against that of the law. (b) Distances of Kolmogorov and Smirnov between computed forces and
three distributions, by the modulus k = ρm/σ². (c) Quantiles of computed forces over those of
the law. (d) The four coatings.

Forces in (a) to (c) are those of rigid and plastic contact of a smooth sphere. Nothing is
fitted but the mean of each surface; the log-normal is fitted to each. Filled: surfaces that
were not looked at while the law was made; only these are in (b) and (c). Crosses: skewed
heights (skewness ±0.6), on which the law, which is one of Gaussian surfaces, fails. Grey in
(a): contacts below two rms heights above the mean plane, left out of (b) and (c). Dotted in
(b): the distance that one in twenty samples of 400 from the law itself exceeds. Bands in (c):
nine tenths of the surfaces. (d) shows the law at the range of adhesion ρ of {{ scales.range }}
in plastic contact, over places and over places and scans, whose rms heights are taken to differ
by the uncertainties of Table 1; crosses: what mean and median of the latter tell, √(2
ln(mean/median)), as of the published forces; and the computed values of the study with
{{ inference.confidence | percent }} intervals, an arrow where they leave the frame. Drawn from
statistics.nc.
"""

#: Distributions by their names in the dataset, as they are drawn and printed.
DISTANCES: dict[str, tuple[style.Look, str]] = {
    "law": ({"color": "black", "marker": "o"}, "law"),
    "lognormal_fitted": ({"color": style.FIT, "marker": "^"}, "log-normal, fitted"),
    "weibull": ({"color": "0.6", "marker": "s"}, "Weibull of modulus k"),
}
#: Surfaces below and above k = 1.
PARTS = {"k < 1": "#882255", "k > 1": "black"}
#: Spreads of a coating: how each is drawn, and its name.
SPREADS: dict[str, tuple[style.Look, str]] = {
    "spread": ({"mfc": "none"}, "law: places"),
    "total_spread": ({}, "law: places and scans"),
    "total_shape": ({"marker": "x"}, "the same, mean and median"),
    "computed_spread": ({"alpha": 0.5, "ms": 2.5}, "study"),
}
#: That the panel holds, over the highest published or predicted spread.
ROOM = 1.6


def _table(statistics: xr.Dataset) -> pd.DataFrame:
    """Return what the panels are drawn from, one row a number.

    Panels a and b: of each designed case `designed_spread`, `designed_predicted_spread` and the
    distances; c: the median ratio of quantiles with its interval, by `share` and `part`; d: spreads
    of the coatings.
    """
    of_cases = ["designed_spread", "designed_predicted_spread"]
    distances = [f"designed_distance_{name}" for name in DISTANCES]
    tested, at = held_back(statistics), statistics.sel(rho=statistics.attrs["reference_rho"])
    quantiles = pd.concat(
        tables.as_rows(one.drop_vars("quantile", errors="ignore")).assign(part=part)
        for part, one in _quantiles(tested)
    )
    rows = [
        tables.drawn_rows(statistics, *(("a", name, "1") for name in of_cases)),
        tables.drawn_rows(tested, *(("b", name, "1") for name in distances)),
        quantiles.assign(panel="c", quantity="quantile_ratio", unit="1", origin="computed"),
        tables.drawn_rows(at, *(("d", name, "1") for name in SPREADS)),
        tables.drawn_rows(at, ("d", "published_spread", "1")).assign(origin="published"),
    ]
    return tables.tidy(rows, statistics, "case", "part", "share")


def draw(statistics: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) spreads, (b) distances, (c) quantiles of designed surfaces, (d) the coatings."""
    figure = drawing.create(5.4, statistics)
    (spreads, distances), (quantiles, coatings) = figure.subplots(2, 2)
    tested = held_back(statistics)
    _draw_spreads(spreads, statistics)
    _draw_distances(distances, tested)
    _draw_quantiles(quantiles, tested)
    _draw_coatings(coatings, statistics.sel(rho=statistics.attrs["reference_rho"]))
    return _table(statistics), figure


def _draw_spreads(axes: Axes, statistics: xr.Dataset) -> None:
    skewed = statistics["designed_skewed"] != 0
    low = (statistics["designed_level"] < LEAST_LEVEL) & ~skewed
    fair, held = ~skewed & ~low, statistics["designed_held_back"] == 1
    groups: list[tuple[xr.DataArray, str, style.Look]] = [
        (skewed, "skewed heights", {"marker": "x", "color": "0.55", "ms": 3}),
        (low, f"below {LEAST_LEVEL:g} rms heights", {"marker": ".", "color": "0.75"}),
        (
            fair & ~held,
            "used for the law",
            {"marker": "o", "color": "black", "mfc": "none", "ms": 3},
        ),
        (fair & held, "held out", {"marker": "o", "color": "black", "ms": 3}),
    ]
    for chosen, label, look in groups:
        part = statistics.isel(case=np.flatnonzero(chosen))
        x, y = part["designed_predicted_spread"], part["designed_spread"]
        axes.plot(x, y, ls="none", mew=0.7, label=label, **look)
    ends = [0.05, 1.5]
    axes.plot(ends, ends, color="0.4", lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
    axes.set(xlabel="standard deviation of ln F, law", ylabel="computed")
    axes.legend(loc="upper left")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, "a", "scatter over places")


def _draw_distances(axes: Axes, tested: xr.Dataset) -> None:
    for name, (look, label) in reversed(DISTANCES.items()):
        distance = tested[f"designed_distance_{name}"]
        axes.plot(tested["designed_modulus"], distance, ls="none", ms=3, label=label, **look)
    axes.axhline(CHANCE, color="0.4", lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", ylim=(0.004, 1.2))
    axes.set(xlabel="modulus k = ρm/σ²", ylabel="largest difference of probabilities")
    axes.legend(loc="lower left")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, "b", "distance of distributions")


def _quantiles(tested: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    """Return the median ratio of quantiles (share) and its band over surfaces of each part."""
    low = (tested["designed_modulus"] < 1).values
    found = []
    for part, chosen in zip(PARTS, (low, ~low), strict=True):
        ratio = tested["designed_quantile"].isel(case=np.flatnonzero(chosen))
        band = [ratio.quantile(at, "case").drop_vars("quantile") for at in (0.5, 0.05, 0.95)]
        found.append((part, xr.Dataset(dict(zip(("value", "low", "high"), band, strict=True)))))
    return found


def _draw_quantiles(axes: Axes, tested: xr.Dataset) -> None:
    for part, curve in _quantiles(tested):
        look = {"color": PARTS[part], "marker": "o", "label": part}
        style.draw_with_band(axes, curve, "share", **look)
    axes.axhline(1, color="0.4", lw=0.8, ls=":")
    axes.set(xscale="logit", ylim=(0.6, 1.6))
    axes.set(xlabel="share of places with less force (%)", ylabel="force, computed / law")
    shares = tested["share"].values
    axes.set_xticks(shares, [f"{100 * share:g}" for share in shares])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.legend(loc="upper right")
    style.label_panel(axes, "c", "quantiles")


def _draw_coatings(axes: Axes, there: xr.Dataset) -> None:
    # Intervals of two scans may reach far beyond all values: an arrow marks those that do.
    highest = ROOM * there[["published_spread", *SPREADS]].to_array().max().item()
    for place, (look, one) in enumerate(style.by_surface(there)):
        for step, (name, (more, _)) in enumerate(SPREADS.items()):
            curve, x = tables.bounded(one, name).expand_dims("place"), place + 0.15 * (step - 1.5)
            if "low" not in curve:
                curve = curve.assign(low=curve["value"], high=curve["value"])
            style.draw_bars(axes, [x], curve, ls="none", **look | more)
            if curve["high"].item() > highest:
                axes.plot(x, 0.98 * highest, "^", color=look["color"], ms=3)
        published = one["published_spread"].item()
        axes.plot([place - 0.3, place + 0.3], [published] * 2, color=style.PUBLISHED, lw=1.6)
    axes.set(ylim=(0, highest), ylabel="standard deviation of ln F")
    axes.set_xticks(range(there.sizes["surface"]), there["label"].values, **style.TILTED)
    handles = [Line2D([], [], color=style.PUBLISHED, lw=1.6, label="published, mean and median")]
    marks: style.Look = {"color": "0.3", "marker": "o", "ls": "none"}
    handles += [Line2D([], [], **marks | more, label=label) for more, label in SPREADS.values()]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.28), ncols=2)
    style.label_panel(axes, "d", f"coatings at ρ = {there['rho'].item():g} nm")
