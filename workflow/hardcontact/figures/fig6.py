"""Fig. 6: which length scales of roughness the pull-off force depends on."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import marks, style, tables
from hardcontact.numbers.printing import print_share
from hardcontact.scales.critical_band import POOLED

PUBLISHED: dict[str, Any] = {"color": "0.25", "lw": 1.0, "ls": "--"}
CLOSED_FORM: dict[str, Any] = {"lw": 1.0, "ls": (0, (1, 1.2)), "zorder": 3}
COLUMNS = [
    "side", "group", "label", "basis", "origin", "over", "quantity", "cutoff_wavelength",
    *tables.VALUE_COLUMNS, "beyond",
]  # fmt: skip


def table(
    band: xr.Dataset,
    scales: xr.Dataset,
    sets: xr.Dataset,
    closed_form: xr.Dataset,
    published_constants: pd.DataFrame,
) -> pd.DataFrame:
    """Return force ratios and critical wavelengths of Fig. 6, one row a point.

    `ratio` (1) against `cutoff_wavelength` (nm), its distance from one, `change` (1),
    `critical_wavelength` (nm), and `closed_form_ratio` (1) of the spectrum alone. `over` says what
    `value`, `low` and `high` are: mean and interval over the "realizations" of the study, or median
    and SHARE_OF_SETS over the "sets". `beyond` names those of the three that lie beyond the last
    cutoff computed and are empty.
    """
    rows = pd.concat(
        _rows_of_side(
            band.sel(side=side),
            scales.sel(side=side),
            sets.sel(side=side),
            closed_form.sel(side=side),
            tables.published_edge(published_constants, side),
        ).assign(side=side)
        for side in marks.REMOVED
    )
    return tables.label_surfaces(rows, band, "group")[COLUMNS].reset_index(drop=True)


@style.print_style()
def draw(
    band: xr.Dataset,
    scales: xr.Dataset,
    sets: xr.Dataset,
    closed_form: xr.Dataset,
    published_constants: pd.DataFrame,
) -> Figure:
    """Draw Fig. 6: pull-off force of filtered surfaces over that of the unfiltered ones.

    Panel a against the short-, b against the long-wavelength cutoff; below, the change of either
    sign, also of all substrates pooled, and the cutoffs where it exceeds the tolerance. The
    published cutoff runs through all.
    """
    figure = style.create(6.4)
    grid = figure.subplots(3, 2, sharex="col", sharey="row", height_ratios=(3, 1.8, 1.5))
    for letter, side, column in zip("ab", marks.REMOVED, grid.T, strict=True):
        of_side, of_sets = band.sel(side=side), sets.sel(side=side)
        _draw_ratios(column[0], of_side, of_sets, scales.sel(side=side))
        _draw_closed_form(column[0], closed_form.sel(side=side))
        _draw_changes(column[1], of_side, of_sets)
        _draw_critical(column[2], of_side, of_sets)
        for axes in column:
            axes.axvline(tables.published_edge(published_constants, side), zorder=1, **PUBLISHED)
            axes.label_outer()
            style.shade_artificial(axes, [_artificial(scales.sel(side=side))])
        style.label_panel(column[0], letter, marks.REMOVED[side])
    for row, digits in ((grid[0], (1, 2, 3, 5)), (grid[1], (1,))):
        style.end_near_values(row)
        for axes in row:
            style.label_logarithmic(axes.yaxis, at=digits)
    grid[0, 0].set_ylabel(f"pull-off force / unfiltered, at ρ = {scales.attrs['rho']:g} nm")
    cutoffs = [tables.published_edge(published_constants, side) for side in marks.REMOVED]
    style.legend_above(figure, _legend_handles(band, cutoffs))
    figure.align_ylabels(grid[:2, 0])
    style.mark_basis(figure, band)
    return figure


def _rows_of_side(
    band: xr.Dataset, scales: xr.Dataset, sets: xr.Dataset, closed_form: xr.Dataset, edge: float
) -> pd.DataFrame:
    """Return ratios and changes against the cutoff, and critical wavelengths (nm), of one side."""
    drawn: list[tuple[str, Any, xr.Dataset | xr.DataArray]] = [
        (quantity, over, values)
        for quantity in ("ratio", "change")
        for over, values in (
            ("realizations", tables.bounded(band, f"scale_{quantity}")),
            ("sets", tables.over_sets(sets[f"scale_{quantity}"])),
        )
    ]
    drawn += [
        ("ratio", lambda rows: "realization " + rows["realization"].astype(str), scales["ratio"]),
        ("closed_form_ratio", "spectrum", closed_form["filtered_ratio"]),
    ]
    curves = [
        tables.computed_rows(values, over=over, quantity=quantity, unit="1")
        for quantity, over, values in drawn
    ]
    critical = _without_open_ends(_critical_rows(band, sets), _last_cutoff(band))
    published = pd.DataFrame([{"group": POOLED, "origin": "published", "value": edge}])
    of_edges = [
        rows.assign(quantity="critical_wavelength", unit="nm") for rows in (critical, published)
    ]
    return pd.concat([*(rows.rename(columns={"surface": "group"}) for rows in curves), *of_edges])


def _computed_cutoffs(of_side: xr.Dataset) -> np.ndarray:
    """Return the cutoffs (nm) of one side, of the study or of the sets."""
    ratio = of_side["scale_ratio"]
    known = ratio.notnull().any([dim for dim in ratio.dims if dim != "cutoff_wavelength"])
    cutoffs: np.ndarray = of_side["cutoff_wavelength"].values[known.values]
    return cutoffs


def _last_cutoff(of_side: xr.Dataset) -> float:
    """Return the cutoff (nm) that removes most, which stands for all beyond it."""
    cutoffs = _computed_cutoffs(of_side)
    return float(cutoffs[-1] if of_side["side"].item() == "small" else cutoffs[0])


def _critical_rows(of_side: xr.Dataset, of_sets: xr.Dataset) -> pd.DataFrame:
    """Return the critical wavelength (nm) of each group, of the study and over the sets."""
    last = _last_cutoff(of_side)
    of_study = tables.bounded(of_side, "critical_wavelength")
    of_study["value"] = of_study["value"].fillna(last)
    spread = tables.over_sets(of_sets["critical_wavelength"].fillna(last))
    frames = [
        values.to_dataframe()[["value", "low", "high"]].reset_index().assign(over=over)
        for over, values in (("realizations", of_study), ("sets", spread))
    ]
    return pd.concat(frames, ignore_index=True)


def _without_open_ends(critical: pd.DataFrame, last: float) -> pd.DataFrame:
    """Return critical wavelengths without numbers that stand for all beyond the last cutoff."""
    ends = critical[["value", "low", "high"]]
    beyond = np.isclose(ends, last)
    names = [", ".join(ends.columns[row]) for row in beyond]
    return critical.assign(**ends.mask(beyond), beyond=names, origin="computed")


def _artificial(of_side: xr.Dataset) -> tuple[float, float]:
    """Return the wavelengths (nm) at which the masters of one side have artificial roughness."""
    transition = float(of_side["transition"])
    return (0.0, transition) if of_side["side"].item() == "small" else (transition, np.inf)


def _looks(band: xr.Dataset) -> dict[str, dict[str, Any]]:
    """Return colour and marker of each group: those of its surface, black for all pooled."""
    return {**style.looks(band["surface"].values), POOLED: {"color": "black", "marker": "h"}}


def _draw_ratios(axes: Axes, of_side: xr.Dataset, of_sets: xr.Dataset, scales: xr.Dataset) -> None:
    """Draw ratio against cutoff (nm): mean and interval, single realizations, band of the sets."""
    tolerance = of_side.attrs["scale_tolerance"]
    axes.axhspan(1 - tolerance, 1 + tolerance, color="0.88", zorder=0, lw=0)
    curves, spread = (
        tables.bounded(of_side, "scale_ratio"),
        tables.over_sets(of_sets["scale_ratio"]),
    )
    cutoff, of_band = _computed_cutoffs(of_side), _computed_cutoffs(of_sets)
    for surface, look in style.looks(of_side["surface"].values).items():
        at = {"surface": surface, "cutoff_wavelength": cutoff}
        mean, band = curves.sel(at), spread.sel(surface=surface, cutoff_wavelength=of_band)
        marks.fill_sets(axes, of_band, band, look["color"])
        single = scales["ratio"].sel(at).transpose("cutoff_wavelength", "realization")
        axes.plot(cutoff, single, color=look["color"], lw=0.35, alpha=0.7)
        axes.errorbar(cutoff, mean["value"], marks.reach(mean), elinewidth=0.7, **look)
    axes.text(
        0.99,
        1 - tolerance,
        f"±{print_share(tolerance)}",
        transform=axes.get_yaxis_transform(),
        color="0.35",
        fontsize=7,
        ha="right",
        va="bottom",
    )
    axes.set(xscale="log", yscale="log")
    style.label_logarithmic(axes.xaxis, at=(1, 2, 5))


def _draw_closed_form(axes: Axes, of_side: xr.Dataset) -> None:
    """Draw the ratio of the closed form against cutoff (nm)."""
    ratio = of_side["filtered_ratio"].dropna("cutoff_wavelength", how="all")
    for surface, look in style.looks(of_side["surface"].values).items():
        of_surface = ratio.sel(surface=surface)
        axes.plot(ratio["cutoff_wavelength"], of_surface, color=look["color"], **CLOSED_FORM)


def _draw_changes(axes: Axes, of_side: xr.Dataset, of_sets: xr.Dataset) -> None:
    """Draw |ratio - 1| in percent against cutoff (nm), and its mean over the substrates."""
    cutoff, of_band = _computed_cutoffs(of_side), _computed_cutoffs(of_sets)
    change = 100 * tables.bounded(of_side, "scale_change").sel(cutoff_wavelength=cutoff)
    spread = 100 * tables.over_sets(of_sets["scale_change"]).sel(cutoff_wavelength=of_band)
    for surface, look in style.looks(of_side["surface"].values).items():
        axes.plot(cutoff, change["value"].sel(group=surface), color=look["color"], lw=0.8)
    pooled, band = change.sel(group=POOLED), spread.sel(group=POOLED)
    marks.fill_sets(axes, of_band, band, "0")
    look = _looks(of_side)[POOLED]
    axes.errorbar(cutoff, pooled["value"], marks.reach(pooled), elinewidth=0.9, lw=1.8, **look)
    axes.axhline(100 * of_side.attrs["scale_tolerance"], color="0.6", lw=0.8, zorder=0)
    axes.set(yscale="log", ylabel="|ratio − 1| (%)")


def _draw_critical(axes: Axes, of_side: xr.Dataset, of_sets: xr.Dataset) -> None:
    """Mark the critical wavelength (nm) of each group: of the study, over that of the sets."""
    looks, labels = _looks(of_side), _labels(of_side)
    last, arrow = _last_cutoff(of_side), ">" if of_side["side"].item() == "small" else "<"
    critical = _critical_rows(of_side, of_sets).set_index(["group", "over"])
    ends = critical[["value", "low", "high"]].to_dict("index")
    for place, (group, look) in enumerate(looks.items()):
        for over, width, opacity in (("sets", 7, marks.BAND_OF_SETS), ("realizations", 1.4, 1)):
            value, low, high = ends[group, over].values()
            shade = {"color": look["color"], "alpha": opacity}
            axes.plot([low, high], [place] * 2, lw=width, solid_capstyle="butt", **shade)
            if np.isclose([value, low, high], last).any():
                axes.plot(last, place, arrow, ms=5, mew=0, clip_on=False, **shade)
            if over == "realizations" and not np.isclose(value, last):
                axes.plot(value, place, **look)
    axes.set_yticks(range(len(looks)), [labels[group] for group in looks])
    axes.set(ylim=(len(looks) - 0.4, -0.6), xlabel="cutoff wavelength (nm)")


def _labels(band: xr.Dataset) -> dict[str, str]:
    """Return the printed name of each group."""
    names = zip(band["surface"].values, band["label"].values, strict=True)
    return {**{str(name): str(label) for name, label in names}, POOLED: "mean of all"}


def _legend_handles(band: xr.Dataset, cutoffs: list[float]) -> list[Line2D | Patch]:
    """Return one entry a group and one for each kind of line."""
    confidence = print_share(band.attrs["confidence"])
    return [
        *style.surface_handles(band),
        Line2D([], [], lw=1.8, label="mean |ratio − 1| of all", **_looks(band)[POOLED]),
        Line2D([], [], lw=0.35, color="0.3", label="single realization"),
        Line2D([], [], color="0.3", label="closed form of the spectrum", **CLOSED_FORM),
        Line2D([], [], lw=1.4, color="0.3", label=f"{confidence} interval (bars)"),
        marks.sets_handle(),
        Line2D([], [], label="published: {:g} and {:g} nm".format(*cutoffs), **PUBLISHED),
        Patch(label="artificial roughness", **style.ARTIFICIAL),
        Line2D([], [], ls="none", marker=">", ms=5, color="0.3", label="beyond the last cutoff"),
    ]
