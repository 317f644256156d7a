"""Where the bearing area is wrong: plasticity indices, areas, forces, slopes by scale."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables
from hardcontact.insight.elastic_limit import VARIANTS

SHARES = {"plastic_share": "estimated", "solved_plastic_share": "solved"}
OPEN: dict[str, style.Look] = {"plastic_share": {}, "solved_plastic_share": {"mfc": "white"}}
AREAS = ("solved_area", "estimated_area")
NAMES = {
    "bearing_area": "bearing area",
    "recovered": "elastic ones recover",
    "larger_area": "larger area",
    "rigid": "rigid",
}
STEPS = np.linspace(0, 1, 101)  # of the distributions
LEAST_INDEX = 0.01  # that is drawn over wavelengths


def table(elastic_limit: xr.Dataset) -> pd.DataFrame:
    """Return what the figure is drawn from, one row a number.

    The plasticity index that a `share` of contacts does not exceed (panel a), shares of plastic
    contacts (b), solved and estimated areas in nm2 of single contacts (c), ratios of forces by
    variant (d), indices of all waves down to a shortest wavelength in nm (e), and the bearing area.
    """
    computed = tables.drawn_rows(
        _drawn_indices(elastic_limit).assign(plasticity_index=_distribution(elastic_limit)),
        ("a", "plasticity_index", "1"),
        *(("b", name, "1") for name in SHARES),
        *(("c", name, "nm2") for name in AREAS),
        ("d", "force_ratio", "1"),
        ("e", "slope_index", "1"),
    )
    bearing = {"panel": "c", "origin": "given", "quantity": "bearing_area", "unit": "nm2"}
    given = pd.DataFrame([{**bearing, "value": elastic_limit.attrs["bearing_area"]}])
    between = ("variant", "scan", "contact", "share", "shortest_wavelength")
    return tables.tidy([computed, given], elastic_limit, *between)


def _drawn_indices(limit: xr.Dataset) -> xr.Dataset:
    """Return the dataset without indices of long waves that are far below one."""
    index = limit["slope_index"]
    return limit.assign(slope_index=index.where(index > LEAST_INDEX))


def _distribution(limit: xr.Dataset) -> xr.DataArray:
    """Return the index (surface, share) that a share of the contacts does not exceed."""
    over = ["scan", "contact_y", "contact_x"]
    values = limit["plasticity_index"].quantile(STEPS, over, method="inverted_cdf")
    return values.rename(quantile="share").transpose("surface", "share")


def draw(elastic_limit: xr.Dataset) -> Figure:
    """Draw (a) indices, (b) plastic shares, (c) elastic areas, (d) forces, (e) indices by scale."""
    figure, rows = drawing.create_rows(6.6, elastic_limit, (1, [1, 1]), (1, [1, 1]), (0.8, [1]))
    indices, shares, areas, forces, scales = np.concatenate(rows)
    _draw_indices(indices, elastic_limit)
    _draw_shares(shares, elastic_limit)
    _draw_areas(areas, elastic_limit)
    _draw_forces(forces, elastic_limit)
    _draw_scales(scales, elastic_limit)
    for axes in (shares, forces):
        axes.set_xticks(range(elastic_limit.sizes["surface"]), elastic_limit["label"].values)
        axes.set_xlim(-0.5, elastic_limit.sizes["surface"] - 0.5)
    return figure


def _draw_indices(axes: Axes, limit: xr.Dataset) -> None:
    """Draw the distribution of the index over contacts; from 1 on they yield."""
    for look, of_surface in style.by_surface(limit.assign(index=_distribution(limit))):
        look = {"color": look["color"], "label": str(of_surface["label"].item())}
        axes.plot(of_surface["index"], STEPS, drawstyle="steps-post", **look)
    axes.axvline(1, color="black", lw=0.9)
    axes.set(xscale="log", ylim=(-0.03, 1.03), ylabel="cumulative share of contacts")
    axes.set_xlabel("elastic pressure on the bearing area / hardness")
    axes.legend(loc="best")
    style.label_logarithmic(axes.xaxis, at=(1, 3))
    style.label_panel(axes, "a", "plasticity index")


def _draw_shares(axes: Axes, limit: xr.Dataset) -> None:
    """Draw the share of contacts that yield, by the index and by solved contacts."""
    for (name, label), shift in zip(SHARES.items(), (-0.12, 0.12), strict=True):
        for place, (look, one) in enumerate(style.by_surface(tables.bounded(limit, name))):
            style.draw_bars(axes, place + shift, one, ls="none", **look, **OPEN[name])
        axes.plot([], [], "o", color="0.3", ls="none", label=label, **OPEN[name])
    axes.set(ylim=(-0.06, 1.06), yticks=np.linspace(0, 1, 6), ylabel="share of contacts")
    _draw_legend_within(axes)
    style.label_panel(axes, "b", "bearing area holds")


def _draw_areas(axes: Axes, limit: xr.Dataset) -> None:
    """Draw the estimated against the solved elastic area of single contacts."""
    for look, of_surface in style.by_surface(limit):
        solved, estimated = (of_surface[name].values.ravel() for name in AREAS)
        axes.plot(solved, estimated, ls="none", alpha=0.7, **look)
    bearing = limit.attrs["bearing_area"]
    axes.axvline(bearing, color="black", lw=0.9, label="bearing area")
    axes.axhline(bearing, color="black", lw=0.9)
    axes.axline((bearing, bearing), slope=1, color="0.6", lw=0.8, ls="--", label="equal")
    axes.set(xscale="log", yscale="log")
    axes.set(xlabel="solved area (nm²)", ylabel="estimated area (nm²)")
    axes.legend(loc="best")
    style.label_logarithmic(axes.xaxis, axes.yaxis)
    style.label_panel(axes, "c", "elastic contact")


def _draw_forces(axes: Axes, limit: xr.Dataset) -> None:
    """Draw the force of each variant over that of the bearing area."""
    beside = np.linspace(-0.25, 0.25, len(VARIANTS) - 1)
    for variant, marker, shift in zip(VARIANTS[1:], "^sv", beside, strict=True):
        ratio = tables.bounded(limit, "force_ratio").sel(variant=variant)
        for place, (look, one) in enumerate(style.by_surface(ratio)):
            style.draw_bars(axes, place + shift, one, fmt=marker, color=look["color"])
        axes.plot([], [], marker, color="0.3", label=NAMES[variant])
    axes.axhline(1, color="0.7", lw=0.6, zorder=0)
    axes.set_ylabel("force / that of the bearing area")
    _draw_legend_within(axes)
    style.label_panel(axes, "d", "pull-off force")


def _draw_scales(axes: Axes, limit: xr.Dataset) -> None:
    """Draw the index of the slope of all waves down to a shortest one; line: two pixels."""
    for look, of_surface in style.by_surface(_drawn_indices(limit)):
        index = of_surface["slope_index"]
        axes.plot(index["shortest_wavelength"], index, color=look["color"])
    axes.axhline(1, color="black", lw=0.9)
    axes.axvline(2 * limit.attrs["pixel_size"], color="0.5", lw=0.9, ls="--", label="two pixels")
    axes.set(xscale="log", yscale="log", xlabel="shortest wavelength (nm)")
    axes.set_ylabel("E*h'/(1.67 H)")
    axes.legend(loc="lower left")
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1,))
    style.label_panel(axes, "e", "slope of all waves down to a shortest one")


def _draw_legend_within(axes: Axes) -> None:
    """Write the legend in one line above all marks: the axis is made longer for it."""
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.15 * (high - low))
    labels = axes.get_legend_handles_labels()[1]
    axes.legend(loc="upper center", ncols=len(labels), columnspacing=1.0, handletextpad=0.2)
