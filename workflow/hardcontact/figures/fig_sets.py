"""Many sets of substitutes: where each puts range and work of adhesion, and the critical band."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import drawing, style, tables
from hardcontact.numbers.printing import print_share

TITLE = "Many sets of substitutes"
CHAPTER = "3. Adhesion"
CAPTION = """\
Sets of substitute scans as good as the study's. (a) Range of adhesion ρ that fits the published
forces best. (b) Best ρ and work of adhesion W of each set; star: the study's own. (c) Least
error with rigid against plastic contact. (d, e) Pull-off force without roughness below or above
a cutoff, over that with all, of 90 % of the sets.

Each set has as many scans as the study, drawn at random from a pool, with exactly the mean and
standard deviation of the rms height of Table 1. (a) Plastic (filled) and rigid contact (dashed
line). (b) Plastic contact; rings: further ranges at which the error has a minimum; purple ring:
other minima of the study's own scans. Black: published result, 46.3 mJ/m² and 5.6 nm, with its
uncertainty. (c) Above the line plastic contact fits better; dotted: the paper's threshold.
(d, e) Lines: medians; dashed: the published edges of the critical band. The table has the edge
of each surface, too. Dashed in (a) and (b): the published range. Drawn from sets.nc,
inference.nc and resources/paper/parameters.csv.
"""

PLASTIC = "plastic"  # the contact model that the paper's conclusions rest on
MODELS: dict[str, style.Look] = {
    "plastic": {"fill": True, "color": "0.55"},
    "rigid": {"color": "black", "ls": "--", "lw": 1.0},
}
BINS_PER_DECADE = 8
FITTED_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
UNITS = {"minimum_range": "nm", "minimum_work": "J/m2", "minimum_error": "1", **FITTED_UNITS}
PANELS = {"small": "d", "large": "e"}  # of the sides of the band
COLUMNS = [
    "panel", "group", "label", "basis", "origin", "quantity", "contact_model", "set", "minimum",
    "range_low", "range_high", "side", "cutoff_wavelength", *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(
    sets: xr.Dataset, inference: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a, b) the best fits of all sets, (c) their least errors, (d, e) filtered surfaces.

    The table has (a) the share of the sets (1) whose best range lies between `range_low` and
    `range_high` (nm), (b) range (nm) and work of adhesion (J/m2) at each minimum of each set, and
    published, (c) the least error (1) of each set, (d, e) median and middle SHARE_OF_SETS of the
    force ratio (1) against `cutoff_wavelength` (nm), and of the critical wavelength (nm).
    """
    fit, of_sets = (data.sel(contact_model=PLASTIC) for data in (inference, sets))
    histograms = {model: _histogram(sets, inference, model) for model in MODELS}
    figure, (row, ratios) = drawing.create_rows(5.6, inference, (1, (1, 1.2, 1)), (1, (1, 1)))
    counts, places, errors = row
    _draw_histogram(counts, histograms, of_sets)
    _draw_places(places, of_sets)
    style.draw_fit(places, fit, "work", style.MILLIJOULE)
    style.draw_published_fit(places, published_constants)
    for axes in (counts, places):
        style.draw_published_range(axes, published_constants)
    _draw_errors(errors, sets, inference)
    spreads = []
    for axes, (side, panel) in zip(ratios, PANELS.items(), strict=True):
        ratio, critical = _spread(sets.sel(side=side))
        _draw_ratios(axes, ratio)
        axes.axvline(tables.published_edge(published_constants, side), **style.PUBLISHED_RANGE)
        style.label_panel(axes, panel, style.REMOVED[side])
        by_group = tables.computed_rows(ratio, quantity="ratio", unit="1")
        edges = tables.computed_rows(critical, quantity="critical_wavelength", unit="nm")
        spreads.append(by_group.rename(columns={"surface": "group"}).assign(panel=panel, side=side))
        spreads.append(edges.assign(panel=panel, side=side))
    style.end_near_values([ratios[0]])
    ratios[0].set_ylabel("pull-off force / unfiltered")
    handles = [
        *style.surface_handles(inference, marker=""),
        style.sets_handle(),
        Line2D([], [], ls="none", marker="o", color="0.4", label="best fit of a set"),
        *style.legend_entries([places]).values(),
        Line2D([], [], label="published range and edges", **style.PUBLISHED_RANGE),
    ]
    style.legend_above(figure, handles, 4)
    fits = [
        *(rows.assign(panel="a", contact_model=model) for model, rows in histograms.items()),
        tables.drawn_rows(of_sets, *(("b", name, unit) for name, unit in UNITS.items())),
        tables.as_rows(sets["best_error"]).assign(panel="c", quantity="best_error", unit="1"),
    ]
    published = tables.published_rows(published_constants, FITTED_UNITS, "b")
    computed = pd.concat([*fits, *spreads]).assign(origin="computed")
    return tables.labelled([computed, published], inference, COLUMNS, "group"), figure


def _histogram(sets: xr.Dataset, inference: xr.Dataset, model: str) -> pd.DataFrame:
    """Return the share of the sets whose best range lies in each bin between ranges (nm).

    The bins, even in the logarithm, hold all ranges computed.
    """
    low, high = inference["rho"].values[[0, -1]]
    edges = np.geomspace(low, high, 1 + round(BINS_PER_DECADE * np.log10(high / low)))
    ranges = sets["range_of_adhesion"].sel(contact_model=model)
    inside = ranges.clip(edges[0], edges[-1])  # the ends of a sweep belong to it
    shares = np.histogram(inside, edges)[0] / ranges.size
    bins = pd.DataFrame({"range_low": edges[:-1], "range_high": edges[1:], "value": shares})
    return bins.assign(quantity="share_of_sets", unit="1")


def _spread(side_sets: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """Return force ratio and critical wavelength (nm) of one side over the sets.

    Where a set has no critical wavelength, it lies beyond the last cutoff, which stands for it.
    """
    ratio = tables.over_sets(side_sets["scale_ratio"]).dropna("cutoff_wavelength", how="all")
    cutoffs = ratio["cutoff_wavelength"].values
    last = cutoffs[-1] if side_sets["side"].item() == "small" else cutoffs[0]
    return ratio, tables.over_sets(side_sets["critical_wavelength"].fillna(last))


def _draw_histogram(axes: Axes, histograms: dict[str, pd.DataFrame], of_sets: xr.Dataset) -> None:
    """Draw the share of the sets (%) by their best range (nm), for both contact models."""
    for model, look in MODELS.items():
        bins = histograms[model]
        edges = [*bins["range_low"], bins["range_high"].iloc[-1]]
        axes.stairs(100 * bins["value"], edges, label=f"{model} contact", **look)
    spread = tables.over_sets(of_sets["range_of_adhesion"])
    low, middle, high = (spread[name].item() for name in ("low", "value", "high"))
    axes.set(xscale="log", xlabel="range of adhesion ρ (nm)", ylabel="share of sets (%)")
    axes.set_ylim(top=1.3 * axes.get_ylim()[1])
    style.label_logarithmic(axes.xaxis, at=(1, 3))
    axes.legend(loc="upper left")
    share = print_share(tables.SHARE_OF_SETS)
    style.label_panel(axes, "a", f"{of_sets.sizes['set']} sets: median {middle:.3g} nm,\n"
                      f"{share} in {low:.2g} to {high:.3g} nm")  # fmt: skip


def _draw_places(axes: Axes, of_sets: xr.Dataset) -> None:
    """Mark the best range (nm) and work of adhesion (mJ/m2) of each set, and its other minima."""
    best = of_sets["range_of_adhesion"]
    others = of_sets["minimum_range"].where(of_sets["minimum_range"] != best)
    works = of_sets[["minimum_work", "work_of_adhesion"]] / style.MILLIJOULE
    minima = others.values.ravel(), works["minimum_work"].values.ravel()
    ring: style.Look = {"mfc": "none", "mec": "0.6", "mew": 0.5, "ms": 3.5}
    axes.plot(*minima, "o", zorder=1, label="other minimum of a set", **ring)
    axes.plot(best, works["work_of_adhesion"], "o", color="0.4", ms=4, mec="white", mew=0.3)
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set(ylabel="work of adhesion $W$ (mJ/m²)")
    style.label_logarithmic(axes.xaxis, at=(1, 3))
    style.label_logarithmic(axes.yaxis)
    style.label_panel(axes, "b", "best fits, plastic contact")


def _draw_ratios(axes: Axes, ratio: xr.Dataset) -> None:
    """Draw median and band of the force ratio of each surface against cutoff (nm)."""
    for look, curve in style.by_surface(ratio):
        style.fill_interval(axes, curve, "cutoff_wavelength", look["color"])
        axes.plot(curve["cutoff_wavelength"], curve["value"], color=look["color"])
    axes.axhline(1, color="0.6", lw=0.6, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="cutoff wavelength (nm)")
    style.label_logarithmic(axes.xaxis, axes.yaxis)


def _draw_errors(axes: Axes, sets: xr.Dataset, inference: xr.Dataset) -> None:
    """Mark the least error of each set and of the study with rigid over that with plastic."""
    threshold = inference.attrs["error_threshold"]
    plastic, rigid = (sets["best_error"].sel(contact_model=name) for name in MODELS)
    axes.plot(plastic, rigid, ".", color="0.55", ms=4, mew=0)
    of_study = [inference["best_error"].sel(contact_model=name).item() for name in MODELS]
    axes.plot(*([value] for value in of_study), **style.FIT_STAR)
    errors = [*plastic.values, *rigid.values, *of_study, threshold]
    ends = 0.8 * np.nanmin(errors), 1.25 * np.nanmax(errors)
    axes.plot(ends, ends, color="0.3", lw=0.8)
    for line in (axes.axhline, axes.axvline):
        line(threshold, color="0.6", lw=0.8, ls=":")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
    axes.set(xlabel="least error, plastic", ylabel="least error, rigid")
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1, 2, 5))
    share = print_share(float((plastic < rigid).mean()))
    style.label_panel(axes, "c", f"plastic better in {share} of sets")
