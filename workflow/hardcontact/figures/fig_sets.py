"""Many sets of substitutes: where each puts range and work of adhesion, and what moves them."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy import stats

from hardcontact.figures import drawing, style, tables
from hardcontact.numbers.printing import print_share

PLASTIC = "plastic"  # the contact model that the paper's conclusions rest on
MODELS: dict[str, style.Look] = {
    "plastic": {"fill": True, "color": "0.55"},
    "rigid": {"color": "black", "ls": "--", "lw": 1.0},
}
BINS_PER_DECADE = 8
FITTED_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
UNITS = {"minimum_range": "nm", "minimum_work": "J/m2", "minimum_error": "1", **FITTED_UNITS}
#: Printed names of the facts, and their units. Every set of several substitute scans has the
#: heights of Table 1.
FACTS = {
    "rms_height": ("height", "nm"),
    "rms_height_std": ("height, sd", "nm"),
    "rms_gradient": ("slope", ""),
    "rms_gradient_std": ("slope, sd", ""),
    "rms_half_laplacian": ("curvature", "nm⁻¹"),
    "rms_half_laplacian_std": ("curvature, sd", "nm⁻¹"),
}
CONFIDENCE = 0.95
FEWEST_SETS = 5  # fewer have no correlation worth showing
LEAST_SPREAD = 1e-6  # over the sets, of a fact that can move anything, as a share of its mean
BETWEEN = ("contact_model", "set", "minimum", "range_low", "range_high")  # columns of the table


def table(
    sets: xr.Dataset, inference: xr.Dataset, published_constants: pd.DataFrame
) -> pd.DataFrame:
    """Return the fits of each set and the rank correlations of its facts, one row a number.

    Panel a: share of the sets (1) whose best range lies between `range_low` and `range_high` (nm).
    b: range (nm) and work of adhesion (J/m2) at each minimum of each set, and published. c: rank
    correlation (1) with its interval. d: least error (1) of each set.
    """
    of_sets = sets.sel(contact_model=PLASTIC)
    computed = pd.concat(
        [
            *(
                _histogram(sets, inference, model).assign(panel="a", contact_model=model)
                for model in MODELS
            ),
            tables.drawn_rows(of_sets, *(("b", name, unit) for name, unit in UNITS.items())),
            _correlations(of_sets).assign(panel="c", contact_model=PLASTIC),
            tables.as_rows(sets["best_error"]).assign(panel="d", quantity="best_error"),
        ]
    )
    computed = computed.assign(origin="computed", unit=computed["unit"].fillna("1"))
    published = tables.published_rows(published_constants, FITTED_UNITS, "b")
    return tables.tidy([computed, published], inference, *BETWEEN)


def draw(sets: xr.Dataset, inference: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw (a, b) the best fits of all sets, (c) what moves them, (d) their least errors."""
    fit, of_sets = (data.sel(contact_model=PLASTIC) for data in (inference, sets))
    labels = {str(name): str(label) for name, label in inference["label"].to_series().items()}
    facts = _correlations(of_sets)
    figure = drawing.create(5.8, inference)
    columns = figure.add_gridspec(1, 2, width_ratios=(1.45, 1))
    left = columns[0].subgridspec(2, 1, height_ratios=(1, 2.6))
    counts, places = left.subplots(sharex=True, squeeze=False)[:, 0]
    right = columns[1].subgridspec(2, 1, height_ratios=(1.3, 1))
    bars, errors = right.subplots(squeeze=False)[:, 0]
    _draw_histogram(counts, sets, inference)
    _draw_places(places, of_sets, _strongest(facts), labels)
    style.draw_fit(places, fit, "work", style.MILLIJOULE)
    style.draw_published_fit(places, published_constants)
    for axes in (counts, places):
        style.draw_published_range(axes, published_constants)
    _draw_correlations(bars, facts, list(labels))
    style.label_panel(bars, "c", "what moves ρ: facts of the scans")
    figure.align_ylabels([counts, places])
    _draw_errors(errors, sets, inference)
    published = published_constants["value"]["range_of_adhesion"]
    handles = [
        *style.surface_handles(inference, ls="none", marker="s"),
        Line2D([], [], ls="none", marker="o", color="0.4", label="best fit of a set"),
        *style.legend_entries([places]).values(),
        Line2D([], [], label=f"published ρ = {published:g} nm", **style.PUBLISHED_RANGE),
    ]
    style.legend_above(figure, handles, 5)
    return figure


def _histogram(sets: xr.Dataset, inference: xr.Dataset, model: str) -> pd.DataFrame:
    """Return the share of the sets whose best range lies in each bin between ranges (nm).

    The bins, even in the logarithm, hold all ranges computed.
    """
    low, high = (float(end) for end in inference["rho"].values[[0, -1]])
    edges = np.geomspace(low, high, 1 + round(BINS_PER_DECADE * np.log10(high / low)))
    ranges = sets["range_of_adhesion"].sel(contact_model=model)
    inside = ranges.clip(edges[0], edges[-1])  # the ends of a sweep belong to it
    shares = np.histogram(inside, edges)[0] / ranges.size
    bins = pd.DataFrame({"range_low": edges[:-1], "range_high": edges[1:], "value": shares})
    return bins.assign(quantity="share_of_sets")


def _draw_histogram(axes: Axes, sets: xr.Dataset, inference: xr.Dataset) -> None:
    """Draw the share of the sets (%) by their best range (nm), for both contact models."""
    for model, look in MODELS.items():
        bins = _histogram(sets, inference, model)
        edges = [*bins["range_low"], bins["range_high"].iloc[-1]]
        axes.stairs(100 * bins["value"], edges, label=f"{model} contact", **look)
    spread = tables.over_sets(sets["range_of_adhesion"].sel(contact_model=PLASTIC))
    low, middle, high = (spread[name].item() for name in ("low", "value", "high"))
    axes.set(xscale="log", ylabel="share of sets (%)")
    axes.legend(loc="upper left")
    share = print_share(tables.SHARE_OF_SETS)
    title = f"median {middle:.3g} nm, {share} in {low:.2g} to {high:.3g} nm"
    style.label_panel(axes, "a", f"best ρ of {sets.sizes['set']} sets: {title}")


def _draw_places(
    axes: Axes, of_sets: xr.Dataset, moved_by: pd.Series | None, labels: dict[str, str]
) -> None:
    """Mark the best range (nm) and work of adhesion (mJ/m2) of each set, and its other minima."""
    best = of_sets["range_of_adhesion"]
    others = of_sets["minimum_range"].where(of_sets["minimum_range"] != best)
    works = of_sets[["minimum_work", "work_of_adhesion"]] / style.MILLIJOULE
    ring: style.Look = {
        "marker": "o",
        "mfc": "none",
        "mec": "0.6",
        "mew": 0.5,
        "ms": 3.5,
        "ls": "none",
    }
    minima = others.values.ravel(), works["minimum_work"].values.ravel()
    axes.plot(*minima, zorder=1, label="other minimum of a set", **ring)
    shown: style.Look = {"c": "0.4"}
    if moved_by is not None:
        fact = of_sets[moved_by["quantity"]].sel(surface=moved_by["surface"])
        shown = {"c": fact.values, "cmap": "cividis"}
    dots: style.Look = {"s": 20, "zorder": 3, "edgecolors": "white", "lw": 0.3}
    points = axes.scatter(best, works["work_of_adhesion"], **dots, **shown)
    if moved_by is not None:
        bar = axes.figure.colorbar(points, ax=axes, location="bottom", pad=0.02, aspect=40)
        bar.ax.locator_params(nbins=6)
        name, unit = FACTS[moved_by["quantity"]]
        of_surface = f"rms {name}, of {labels[moved_by['surface']]}"
        bar.set_label(of_surface + (f" ({unit})" if unit else ""))
    axes.set(xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)")
    axes.set(ylabel="work of adhesion $W$ (mJ/m²)")
    style.label_logarithmic(axes.xaxis, at=(1, 3))
    style.label_logarithmic(axes.yaxis)
    style.label_panel(axes, "b", "best fit of each set, plastic contact")


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
    text = f"dotted: paper, below {threshold:g}"
    axes.text(0.98, 0.03, text, transform=axes.transAxes, ha="right", **style.NOTE)
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
    axes.set(xlabel="least error, plastic", ylabel="least error, rigid")
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1, 2, 5))
    share = print_share(float((plastic < rigid).mean()))
    style.label_panel(axes, "d", f"plastic better in {share} of sets")


def _correlations(of_sets: xr.Dataset) -> pd.DataFrame:
    """Return the rank correlation over the sets of each fact with the range of adhesion.

    Columns: `quantity` (the fact), `surface`, `value`, Spearman's coefficient, and its interval
    `low`, `high` by Fisher's transformation. Facts that are the same in all sets are left out.
    """
    count, rows = of_sets.sizes["set"], []
    for name in FACTS if count >= FEWEST_SETS else ():
        for surface in map(str, of_sets["surface"].values):
            fact = of_sets[name].sel(surface=surface).values
            if fact.std() > LEAST_SPREAD * abs(fact.mean()):
                value = stats.spearmanr(fact, of_sets["range_of_adhesion"].values).statistic
                rows.append({"quantity": name, "surface": surface, **_with_bounds(value, count)})
    return pd.DataFrame(rows, columns=["quantity", "surface", "value", "low", "high"])


def _with_bounds(value: float, count: int) -> dict[str, float]:
    """Return a rank correlation of `count` pairs with its interval.

    The variance of its Fisher transform is 1.06/(count - 3) (Fieller, Hartley and Pearson 1957).
    """
    half = stats.norm.ppf((1 + CONFIDENCE) / 2) * np.sqrt(1.06 / (count - 3))
    low, high = np.tanh(np.arctanh(np.clip(value, -0.999999, 0.999999)) + [-half, half])
    return {"value": float(value), "low": float(low), "high": float(high)}


def _strongest(rows: pd.DataFrame) -> pd.Series | None:
    """Return the row of `_correlations` of the largest absolute value; None if there is none."""
    known = rows.dropna(subset="value")
    return None if known.empty else known.iloc[int(known["value"].abs().argmax())]


def _draw_correlations(axes: Axes, rows: pd.DataFrame, surfaces: list[str]) -> None:
    """Draw a bar for each rank correlation, by fact and, within it, by surface, of its colour."""
    colours, most = style.colours(surfaces), _strongest(rows)
    facts = [name for name in FACTS if name in set(rows["quantity"])]
    step = 0.8 / len(surfaces)
    for index, row in rows.iterrows():
        place = facts.index(row["quantity"]) + step * (surfaces.index(row["surface"]) + 0.5) - 0.4
        edge: style.Look = {"edgecolor": "black", "linewidth": 1.2}
        look = edge if most is not None and index == most.name else {}
        axes.barh(place, row["value"], step, color=colours[row["surface"]], **look)
        axes.plot([row["low"], row["high"]], [place] * 2, color="0.2", lw=0.8)
    axes.axvline(0, color="0.3", lw=0.6)
    axes.set_yticks(range(len(facts)), [FACTS[name][0] for name in facts])
    axes.set(xlim=(-1, 1), xlabel="rank correlation with ρ")
    axes.set_ylim(max(len(facts), 1) - 0.4, -0.6)
