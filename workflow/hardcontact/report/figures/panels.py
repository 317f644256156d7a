"""Values and parts of panels that several figures share: maps, curves, edges, octaves, axes."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from hardcontact.base.formatting import format_length, format_share
from hardcontact.base.statistics import interval_ends
from hardcontact.inference.edges import AVERAGED
from hardcontact.report.figures import style
from hardcontact.report.figures.style import Look

OCTAVE_SHARE = 0.84  # of an octave that its bars cover
SPHERE_SHARE_LOOK: Look = {"color": style.SPHERE_COLOUR, "lw": 0}  # of its part of a bar
UNCHANGED_LOOK: Look = {"color": "0.88", "lw": 0}  # of changes of the force within the tolerance
RATIO_BAR_OPACITY = 0.45  # many opaque bars would hide the symbols
#: Largest end of the y axis relative to the largest bar, which longer intervals would make small.
MAX_AXIS_OVER_BAR = 2.0
#: Of arrows at the ends of the axis, where it cuts intervals.
CUT_LOOK: Look = {"color": "0.25", "ms": 3.5, "mew": 0, "clip_on": False, "zorder": 4}
#: Share of the sets of substitutes that Fig. 4 shades, around their median. No verdict uses it.
SHARE_OF_SETS = 0.9


def value_and_interval(data: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable as `value`, with the ends of its interval, if any, as `low` and `high`."""
    value = data[[name]].rename({name: "value"})
    if f"{name}_interval" not in data:
        return value
    low, high = interval_ends(data, name)
    return value.assign(low=low, high=high)


def scalar_and_interval(data: xr.Dataset, name: str) -> dict[str, Any]:
    """Return `value_and_interval` of a variable without dimensions, as numbers."""
    return {str(end): number.item() for end, number in value_and_interval(data, name).items()}


def summarize_sets(values: xr.DataArray) -> xr.Dataset:
    """Return the median over the sets, `value`, and `low` and `high` around SHARE_OF_SETS."""
    tail = (1 - SHARE_OF_SETS) / 2
    quantiles = values.quantile([0.5, tail, 1 - tail], "set", skipna=False)
    ends = zip(("value", "low", "high"), quantiles.drop_vars("quantile"), strict=True)
    return xr.Dataset(dict(ends))


def published_band(constants: pd.DataFrame) -> list[float]:
    """Return the short and the long published edge (nm)."""
    return [float(constants["value"][f"{side}_edge"]) for side in ("short", "long")]


def mask_half_width(mask: xr.DataArray) -> float:
    """Return the largest distance from zero, along x or y, of the true pixels of a mask."""
    return max(float(abs(mask[axis]).where(mask).max()) for axis in "xy")


def format_pair(pair: pd.Series | xr.Dataset) -> str:
    """Return a pair of range (nm) and work of adhesion (J/m²) as text."""
    work = float(pair["work_of_adhesion"]) / style.MILLIJOULE
    return f"ρ = {float(pair['range_of_adhesion']):.3g} nm, $W$ = {work:.3g} mJ/m²"


def centred_heights(heights: xr.DataArray) -> np.ndarray:
    """Return the heights (row, column) of one map minus their mean, without padding."""
    unpadded = heights.dropna("row", how="all").dropna("column", how="all").values
    return np.asarray(unpadded - unpadded.mean())


def draw_map(axes: Axes, heights: np.ndarray, size: float, colour: str) -> None:
    """Draw heights (nm) of a square scan of a size (nm), framed in a colour, and a colour bar."""
    image = axes.imshow(heights, cmap="viridis", extent=(0, size, 0, size))
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.9, pad=0.02)
    bar.ax.set_title("nm", fontsize=rcParams["xtick.labelsize"], loc="left", pad=3)
    axes.set(xticks=[], yticks=[], xlabel=format_length(size))
    axes.spines[:].set(edgecolor=colour, linewidth=1.5)


def draw_band(axes: Axes, x: Any, curve: xr.Dataset, colour: str) -> None:
    """Fill a band from `low` to `high` where `low` is positive and `high` finite."""
    low, high = curve["low"], curve["high"]
    is_bounded = (low > 0) & (high < np.inf)
    axes.fill_between(x, low, high, where=is_bounded, color=colour, **style.SPREAD_LOOK)


def draw_bars(
    axes: Axes, x: Any, curve: xr.Dataset, width: float = 0.8, opacity: float = 1.0, **look: Any
) -> None:
    """Draw `value` against x, and bars of a width (points) from `low` to `high`, without caps.

    `ecolor` is the colour of the bars, if not `color`.
    """
    # Infinite ends become finite, because a line to infinity is not drawn.
    low, high = (np.nan_to_num(curve[end], nan=np.nan) for end in ("low", "high"))
    colour = look.pop("ecolor", look["color"])
    bar_look: Look = {"color": colour, "lw": width, "alpha": opacity}
    # Not axes.errorbar, because a bar may exclude its value.
    axes.vlines(x, low, high, zorder=look.get("zorder", 2), **bar_look)
    axes.plot(x, curve["value"], **look)


def draw_tolerance(axes: Axes, tolerance: float) -> None:
    """Shade the ratios of forces that count as unchanged."""
    label = f"change below {format_share(tolerance)}"
    axes.axhspan(1 - tolerance, 1 + tolerance, zorder=0, label=label, **UNCHANGED_LOOK)


def draw_ratios(axes: Axes, ratio: xr.Dataset, tolerance: float) -> None:
    """Draw the force ratios of each surface against the cutoff (nm), and the tolerance."""
    draw_tolerance(axes, tolerance)
    for factor, look, curve in style.iterate_dodged(ratio):
        cutoffs = factor * curve["cutoff_wavelength"]
        draw_bars(axes, cutoffs, curve, width=0.7, opacity=RATIO_BAR_OPACITY, **look)
    axes.set_xscale("log")
    axes.margins(x=0.03)
    style.label_logarithmic(axes.xaxis, digits=(1, 2, 5))


def draw_edges(
    axes: Axes, edges: xr.Dataset, labels: xr.DataArray, arrows: Mapping[str, float]
) -> None:
    """Draw the edge (nm) of each group with its interval, a row for each surface and for the mean.

    `arrows` has the position (nm) of each marker: edges and ends of intervals there lie beyond.
    """
    looks = style.surface_looks(labels["surface"].values) | {AVERAGED: style.AVERAGED_LOOK}
    for row, (group, look) in enumerate(looks.items()):
        value, low, high = edges[["value", "low", "high"]].sel(group=group).to_array().values
        axes.plot([low, high], [row, row], color=look["color"], lw=1.4)
        for arrow, position in arrows.items():
            if np.isclose([value, low, high], position).any():
                axes.plot(position, row, arrow, color=look["color"], ms=5, mew=0, clip_on=False)
        if not np.isclose(value, list(arrows.values())).any():
            axes.plot(value, row, **look)
    axes.set_yticks(range(len(looks)), [*labels.values, "averaged change"])
    axes.set(ylim=(len(looks) - 0.4, -0.6))


def draw_octaves(axes: Axes, sensitivity: xr.Dataset) -> None:
    """Draw the change of the force with the amplitude of each octave, with intervals, by surface.

    `octave` is the shortest wavelength (nm) of each. Optional are `is_shown`, false where no
    scan is reliable, and `sphere_share`, the part of a bar in the colour of the sphere.
    """
    octaves = sensitivity["octave"].values
    surfaces = sensitivity.assign(value_and_interval(sensitivity, "octave_sensitivity"))
    width = OCTAVE_SHARE / surfaces.sizes["surface"]  # of a bar, in octaves
    for column, (look, curve) in enumerate(style.iterate_surfaces(surfaces)):
        starts = octaves * 2 ** ((1 - OCTAVE_SHARE) / 2 + width * column)
        if "is_shown" in curve:
            for start in starts[~curve["is_shown"].values]:
                axes.axvspan(start, start * 2**width, **style.HATCHED_LOOK)
        widths = starts * (2**width - 1)  # in nm
        axes.bar(starts, curve["value"], widths, align="edge", color=look["color"])
        if "sphere_share" in curve:
            sphere_part = curve["value"] * curve["sphere_share"]
            axes.bar(starts, sphere_part, widths, align="edge", **SPHERE_SHARE_LOOK)
        symbol: Look = look | {"mec": "white", "mew": 0.6, "ms": 4}
        middles = starts * 2 ** (width / 2)
        draw_bars(axes, middles, curve, width=0.7, ls="none", ecolor="0.25", **symbol)
    axes.axhline(0, color="0.3", lw=0.6)
    axes.set(xscale="log", xlabel="wavelength (nm)", ylabel="force change (%) per 1 % amplitude")
    axes.set_xlim(octaves[0], 2 * octaves[-1])
    style.label_logarithmic(axes.xaxis, digits=(1, 2, 5))


def cut_long_intervals(axes: Axes, largest_bar: float) -> None:
    """Limit the y axis to MAX_AXIS_OVER_BAR times the largest bar; arrows mark longer intervals."""
    limit = MAX_AXIS_OVER_BAR * largest_bar
    low, high = axes.get_ylim()
    low, high = max(low, -limit), min(high, limit)
    axes.set_ylim(low, high)
    artists = [artist for artist in axes.collections if isinstance(artist, LineCollection)]
    segments = [line for artist in artists for line in artist.get_segments() if len(line) == 2]
    x, y = np.moveaxis(np.array(segments).reshape(-1, 2, 2), -1, 0)  # each (interval, end)
    for end, is_beyond, arrow in ((low, y < low, "v"), (high, y > high, "^")):
        cut_x = x[is_beyond.any(axis=1), 0]
        axes.plot(cut_x, np.full(cut_x.size, end), arrow, **CUT_LOOK)


def hatch_wavelengths(axes: Axes, wavelengths: Iterable[tuple[float, float]]) -> None:
    """Hatch pairs of wavelengths (nm), from shortest to longest, within logarithmic axes."""
    low, high = axes.get_xlim()
    for shortest, longest in wavelengths:
        if longest > low and shortest < high:
            axes.axvspan(max(shortest, low), min(longest, high), **style.HATCHED_LOOK)
    axes.set_xlim(low, high)


def finish_range_axis(axes: Axes, ranges: np.ndarray, published_constants: pd.DataFrame) -> None:
    """Draw the published range of adhesion (nm), and limit and label the x axis of ranges."""
    rho = published_constants["value"]["range_of_adhesion"]
    axes.axvline(rho, zorder=1, **style.PUBLISHED_LOOK)
    axes.set(xlim=(ranges[0], ranges[-1]), xlabel="range of adhesion ρ (nm)")
    style.label_logarithmic(axes.xaxis, digits=(1, 3))
