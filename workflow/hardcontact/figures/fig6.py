"""Fig. 6: which length scales of roughness the pull-off force depends on."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import drawing, style, tables
from hardcontact.numbers.printing import print_share
from hardcontact.scales.critical_band import POOLED

PUBLISHED: style.Look = {"color": "0.25", "lw": 1.0, "ls": "--"}
CLOSED_FORM: style.Look = {"lw": 1.0, "ls": (0, (1, 1.2)), "zorder": 3}
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
    frames = (
        _rows_of_side(
            tables.published_edge(published_constants, side),
            *(data.sel(side=side) for data in (band, scales, sets, closed_form)),
        ).assign(side=side)
        for side in style.REMOVED
    )
    return tables.labelled(frames, band, COLUMNS, "group")


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
    figure = drawing.create(6.4, band)
    grid = figure.subplots(3, 2, sharex="col", sharey="row", height_ratios=(3, 1.8, 1.5))
    cutoffs = {side: tables.published_edge(published_constants, side) for side in style.REMOVED}
    for letter, (side, cutoff), column in zip("ab", cutoffs.items(), grid.T, strict=True):
        of_side, of_sets, of_scales, of_form = (
            data.sel(side=side) for data in (band, sets, scales, closed_form)
        )
        _draw_ratios(column[0], of_side, of_sets, of_scales)
        _draw_closed_form(column[0], of_form)
        _draw_changes(column[1], of_side, of_sets)
        _draw_critical(column[2], of_side, of_sets)
        transition = float(of_scales["transition"])
        artificial = (0.0, transition) if side == "small" else (transition, np.inf)
        for axes in column:
            axes.axvline(cutoff, zorder=1, **PUBLISHED)
            axes.label_outer()
            style.shade_artificial(axes, [artificial])
        style.label_panel(column[0], letter, style.REMOVED[side])
    for row, digits in ((grid[0], (1, 2, 3, 5)), (grid[1], (1,))):
        style.end_near_values(row)
        for axes in row:
            style.label_logarithmic(axes.yaxis, at=digits)
    grid[0, 0].set_ylabel(f"pull-off force / unfiltered, at ρ = {scales.attrs['rho']:g} nm")
    style.legend_above(figure, _legend_handles(band, *cutoffs.values()))
    figure.align_ylabels(grid[:2, 0])
    return figure


def _rows_of_side(
    edge: float, band: xr.Dataset, scales: xr.Dataset, sets: xr.Dataset, closed_form: xr.Dataset
) -> pd.DataFrame:
    """Return ratios and changes against the cutoff, and critical wavelengths (nm), of one side."""
    curves = [
        tables.computed_rows(values, over=over, quantity=quantity)
        for quantity in ("ratio", "change")
        for over, values in (
            ("realizations", tables.bounded(band, f"scale_{quantity}")),
            ("sets", tables.over_sets(sets[f"scale_{quantity}"])),
        )
    ]
    single = tables.computed_rows(scales["ratio"], quantity="ratio")
    of_form = tables.computed_rows(closed_form["filtered_ratio"], quantity="closed_form_ratio")
    single = single.assign(over="realization " + single["realization"].astype(str))
    curves += [single, of_form.assign(over="spectrum")]
    critical = _critical_rows(band, sets)
    ends = critical[["value", "low", "high"]]
    beyond = np.isclose(ends, _last_cutoff(band))  # no numbers: they stand for all beyond it
    names = [", ".join(ends.columns[row]) for row in beyond]
    critical = critical.assign(**ends.mask(beyond), beyond=names, origin="computed")
    published = pd.DataFrame([{"group": POOLED, "origin": "published", "value": edge}])
    edges = pd.concat([critical, published]).assign(quantity="critical_wavelength", unit="nm")
    rows = (curve.rename(columns={"surface": "group"}).assign(unit="1") for curve in curves)
    return pd.concat([*rows, edges])


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
        tables.as_rows(values).assign(over=over)
        for over, values in (("realizations", of_study), ("sets", spread))
    ]
    return pd.concat(frames, ignore_index=True)


def _looks(band: xr.Dataset) -> dict[str, style.Look]:
    """Return colour and marker of each group: those of its surface, black for all pooled."""
    return {**style.looks(band["surface"].values), POOLED: {"color": "black", "marker": "h"}}


def _draw_ratios(axes: Axes, of_side: xr.Dataset, of_sets: xr.Dataset, scales: xr.Dataset) -> None:
    """Draw ratio against cutoff (nm): mean and interval, single realizations, band of the sets."""
    tolerance = of_side.attrs["scale_tolerance"]
    axes.axhspan(1 - tolerance, 1 + tolerance, color="0.88", zorder=0, lw=0)
    of_study, of_band = _computed_cutoffs(of_side), _computed_cutoffs(of_sets)
    curves = tables.bounded(of_side, "scale_ratio").sel(cutoff_wavelength=of_study)
    spread = tables.over_sets(of_sets["scale_ratio"]).sel(cutoff_wavelength=of_band)
    for look, mean in style.by_surface(curves):
        at, colour = {"surface": mean["surface"]}, look["color"]
        style.fill_interval(axes, spread.sel(at), "cutoff_wavelength", colour)
        single = scales["ratio"].sel(at).sel(cutoff_wavelength=of_study)
        single = single.transpose("cutoff_wavelength", "realization")
        axes.plot(of_study, single, color=colour, lw=0.35, alpha=0.7)
        style.draw_bars(axes, of_study, mean, elinewidth=0.7, **look)
    place, text = axes.get_yaxis_transform(), f"±{print_share(tolerance)}"
    at_edge: style.Look = {"transform": place, "ha": "right", "va": "bottom"}
    axes.text(0.99, 1 - tolerance, text, **at_edge, **style.NOTE)
    axes.set(xscale="log", yscale="log")
    style.label_logarithmic(axes.xaxis, at=(1, 2, 5))


def _draw_closed_form(axes: Axes, of_side: xr.Dataset) -> None:
    """Draw the ratio of the closed form against cutoff (nm)."""
    ratios = of_side[["filtered_ratio"]].dropna("cutoff_wavelength", how="all")
    for look, of_surface in style.by_surface(ratios):
        ratio = of_surface["filtered_ratio"]
        axes.plot(ratio["cutoff_wavelength"], ratio, color=look["color"], **CLOSED_FORM)


def _draw_changes(axes: Axes, of_side: xr.Dataset, of_sets: xr.Dataset) -> None:
    """Draw |ratio - 1| in percent against cutoff (nm), and its mean over the substrates."""
    of_study, of_band = _computed_cutoffs(of_side), _computed_cutoffs(of_sets)
    change = 100 * tables.bounded(of_side, "scale_change").sel(cutoff_wavelength=of_study)
    spread = 100 * tables.over_sets(of_sets["scale_change"]).sel(cutoff_wavelength=of_band)
    looks = _looks(of_side)
    pooled = looks.pop(POOLED)
    for surface, look in looks.items():
        axes.plot(of_study, change["value"].sel(group=surface), color=look["color"], lw=0.8)
    band = spread.sel(group=POOLED)
    style.fill_interval(axes, band, "cutoff_wavelength", "0")
    style.draw_bars(axes, of_study, change.sel(group=POOLED), elinewidth=0.9, lw=1.8, **pooled)
    axes.axhline(100 * of_side.attrs["scale_tolerance"], color="0.6", lw=0.8, zorder=0)
    axes.set(yscale="log", ylabel="|ratio − 1| (%)")


def _draw_critical(axes: Axes, of_side: xr.Dataset, of_sets: xr.Dataset) -> None:
    """Mark the critical wavelength (nm) of each group: of the study, over that of the sets."""
    looks = _looks(of_side)
    labels = of_side["label"].to_series().to_dict() | {POOLED: "mean of all"}
    last, arrow = _last_cutoff(of_side), ">" if of_side["side"].item() == "small" else "<"
    critical = _critical_rows(of_side, of_sets).set_index(["group", "over"])
    ends = critical[["value", "low", "high"]].to_dict("index")
    for place, (group, look) in enumerate(looks.items()):
        for over, width, opacity in (("sets", 7, style.BAND_OF_SETS), ("realizations", 1.4, 1)):
            value, low, high = ends[group, over].values()
            shade = {"color": look["color"], "alpha": opacity}
            axes.plot([low, high], [place] * 2, lw=width, solid_capstyle="butt", **shade)
            if np.isclose([value, low, high], last).any():
                axes.plot(last, place, arrow, ms=5, mew=0, clip_on=False, **shade)
            if over == "realizations" and not np.isclose(value, last):
                axes.plot(value, place, **look)
    axes.set_yticks(range(len(looks)), [labels[group] for group in looks])
    axes.set(ylim=(len(looks) - 0.4, -0.6), xlabel="cutoff wavelength (nm)")


def _legend_handles(band: xr.Dataset, short: float, long: float) -> list[Artist]:
    """Return one entry a group and one for each kind of line."""
    confidence = print_share(band.attrs["confidence"])
    return [
        *style.surface_handles(band),
        Line2D([], [], lw=1.8, label="mean |ratio − 1| of all", **_looks(band)[POOLED]),
        Line2D([], [], lw=0.35, color="0.3", label="single realization"),
        Line2D([], [], color="0.3", label="closed form of the spectrum", **CLOSED_FORM),
        Line2D([], [], lw=1.4, color="0.3", label=f"{confidence} interval (bars)"),
        style.sets_handle(),
        Line2D([], [], label=f"published: {short:g} and {long:g} nm", **PUBLISHED),
        Patch(label="artificial roughness", **style.ARTIFICIAL),
        Line2D([], [], ls="none", marker=">", ms=5, color="0.3", label="beyond the last cutoff"),
    ]
