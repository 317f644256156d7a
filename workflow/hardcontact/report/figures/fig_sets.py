"""Many sets of substitutes: range and work of adhesion, and critical band, of each set."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.formatting import format_share
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.edges import last_cutoff
from hardcontact.report.figures import drawing, style, tables

TITLE = "Many sets of substitutes"
CHAPTER = "3. Adhesion"
CAPTION = """\
Each set holds substitute scans as good as the study's. (a) Range of adhesion ρ that fits the
published forces best. (b) Best ρ and work of adhesion W of each set; star: the study's own. (c, d)
Pull-off force without roughness below or above a cutoff, relative to the force with all roughness;
bands: 90 % of the sets.

Each set has as many scans as the study, drawn at random from a pool. Its rms heights have the mean
and standard deviation of Table 1. (a) Plastic (filled) and rigid contact (dashed line). (b)
Plastic contact. Grey rings: further ranges at which the error of a set has a minimum. Purple ring:
other minima of the study's own scans. Black: published result, 46.3 mJ/m² and 5.6 nm, with its
uncertainty. (c, d) Lines: medians. Dashed: the published range, in (c, d) the published edges of
the critical band. The table has the edge of each surface, too. Drawn from sets.nc, fit.nc
and resources/paper/parameters.csv.
"""

MODEL_LOOKS: dict[str, style.Look] = {
    "plastic": {"fill": True, "color": "0.55"},
    "rigid": {"color": "black", "ls": "--", "lw": 1.0},
}
BINS_PER_DECADE = 8
FITTED_UNITS = {"range_of_adhesion": "nm", "work_of_adhesion": "J/m2"}
FIT_UNITS = {
    "range_at_minimum": "nm",
    "work_at_minimum": "J/m2",
    "error_at_minimum": "1",
    **FITTED_UNITS,
}
COLUMNS = [
    "panel", "group", "label", "basis", "origin", "quantity", "contact_model", "set", "minimum",
    "range_low", "range_high", "side", "cutoff_wavelength", *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(
    sets: xr.Dataset, fit: xr.Dataset, published_constants: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a, b) the best fits of all sets, (c, d) filtered surfaces.

    The table has (a) the share of the sets whose best range lies between `range_low` and
    `range_high`, and (c, d) medians over the sets with the ends of SHARE_OF_SETS.
    """
    plastic_fit = fit.sel(contact_model=PLASTIC)
    set_fits = sets.sel(contact_model=PLASTIC)
    figure, ((count_panel, fit_panel), ratios) = drawing.create_rows(
        5.6, fit, (1, (1, 1)), (1, (1, 1))
    )
    frames = [
        _draw_histograms(count_panel, sets, fit["rho"].values[[0, -1]]),
        _draw_best_fits(fit_panel, set_fits),
        tables.published_rows(published_constants, FITTED_UNITS, "b"),
    ]
    style.draw_fit(fit_panel, plastic_fit, "work", style.MILLIJOULE)
    style.draw_published_fit(fit_panel, published_constants)
    for axes in (count_panel, fit_panel):
        style.draw_published_range(axes, published_constants)
        axes.set(xscale="log", xlabel="range of adhesion ρ (nm)")
        style.label_logarithmic(axes.xaxis, digits=(1, 3))
    for letter, axes, side in zip("cd", ratios, style.REMOVED_TITLES, strict=True):
        rows = _draw_ratios(axes, sets.sel(side=side))
        axes.axvline(tables.published_edge(published_constants, side), **style.PUBLISHED_RANGE)
        style.label_panel(axes, letter, style.REMOVED_TITLES[side])
        frames.append(rows.assign(panel=letter, side=side))
    style.end_near_values([ratios[0]])
    ratios[0].set_ylabel("pull-off force / unfiltered")
    handles = [
        *style.surface_handles(fit, marker=""),
        style.sets_handle(),
        Line2D([], [], ls="none", marker="o", color="0.4", label="best fit of a set"),
        *style.legend_entries([fit_panel]).values(),
        Line2D([], [], label="published range and edges", **style.PUBLISHED_RANGE),
    ]
    style.legend_above(figure, handles, 4)
    return tables.label_rows(frames, fit, COLUMNS, "group"), figure


def _draw_histograms(axes: Axes, sets: xr.Dataset, ends: np.ndarray) -> pd.DataFrame:
    """Draw the share of the sets (%) by their best range (nm), for both contact models.

    The bins are equal in the logarithm and contain all ranges computed, between two ends.
    """
    low, high = ends
    edges = np.geomspace(low, high, 1 + round(BINS_PER_DECADE * np.log10(high / low)))
    frames = []
    for model, look in MODEL_LOOKS.items():
        ranges = sets["range_of_adhesion"].sel(contact_model=model)
        clipped = ranges.clip(edges[0], edges[-1])  # rounding may put ends outside
        shares = np.histogram(clipped, edges)[0] / ranges.size
        axes.stairs(shares / style.PERCENT, edges, label=f"{model} contact", **look)
        bins = tables.quantity_rows(
            "a", "share_of_sets", "1", range_low=edges[:-1], range_high=edges[1:], value=shares
        )
        frames.append(bins.assign(contact_model=model))
    spread = tables.summarize_sets(sets["range_of_adhesion"].sel(contact_model=PLASTIC))
    median = spread["value"].item()
    low, high = spread["low"].item(), spread["high"].item()
    axes.set_ylabel("share of sets (%)")
    axes.set_ylim(top=1.3 * axes.get_ylim()[1])
    axes.legend(loc="upper left")
    interval = f"{format_share(tables.SHARE_OF_SETS)} in {low:.2g} to {high:.3g} nm"
    title = f"{sets.sizes['set']} sets: median {median:.3g} nm,\n{interval}"
    style.label_panel(axes, "a", title)
    return pd.concat(frames)


def _draw_best_fits(axes: Axes, set_fits: xr.Dataset) -> pd.DataFrame:
    """Mark the best range (nm) and work of adhesion (mJ/m2) of each set, and its other minima."""
    best = set_fits["range_of_adhesion"]
    other_ranges = set_fits["range_at_minimum"].where(set_fits["range_at_minimum"] != best)
    works = set_fits[["work_at_minimum", "work_of_adhesion"]] / style.MILLIJOULE
    minima = other_ranges.values.ravel(), works["work_at_minimum"].values.ravel()
    ring: style.Look = {"mfc": "none", "mec": "0.6", "mew": 0.5, "ms": 3.5}
    axes.plot(*minima, "o", zorder=1, label="other minimum of a set", **ring)
    axes.plot(best, works["work_of_adhesion"], "o", color="0.4", ms=4, mec="white", mew=0.3)
    axes.set(yscale="log", ylabel="work of adhesion $W$ (mJ/m²)")
    style.label_logarithmic(axes.yaxis)
    style.label_panel(axes, "b", "best fits, plastic contact")
    return tables.variable_rows(set_fits, *(("b", name, unit) for name, unit in FIT_UNITS.items()))


def _draw_ratios(axes: Axes, side_sets: xr.Dataset) -> pd.DataFrame:
    """Draw median and band of the force ratio of each surface against cutoff (nm).

    Edges beyond the last cutoff are missing; the last cutoff replaces them.
    """
    ratio = tables.summarize_sets(side_sets["filtered_force_ratio"]).dropna(
        "cutoff_wavelength", how="all"
    )
    for look, curve in style.iterate_surfaces(ratio):
        style.fill_interval(axes, curve, "cutoff_wavelength", look["color"])
        axes.plot(curve["cutoff_wavelength"], curve["value"], color=look["color"])
    axes.axhline(1, color="0.6", lw=0.6, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="cutoff wavelength (nm)")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    end_cutoff = last_cutoff(side_sets["filtered_force_ratio"], side_sets["side"].item())
    edges = tables.summarize_sets(side_sets["edge"].fillna(end_cutoff))
    ratio_rows = tables.computed_rows(ratio, quantity="filtered_force_ratio", unit="1")
    edge_rows = tables.computed_rows(edges, quantity="edge", unit="nm")
    return pd.concat([ratio_rows.rename(columns={"surface": "group"}), edge_rows])
