"""What rare protrusions on one surface would do to the fit of range and work of adhesion."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.base.printing import print_share
from hardcontact.report.figures import drawing, style, tables

TITLE = "If one surface had rare protrusions"
CHAPTER = "3. Adhesion"
CAPTION = """\
(a) Mean and median force on one surface with rare protrusions. (b) Best range and work of adhesion
of sets with it; filled: both forces are within a factor of two of the published ones.

The surface is {{ robustness.heights.surface }}, in place of its Gaussian scans, (a) at the
published range and work, (b) at those that fit the mean forces of all surfaces best. Black:
published. Protrusions have Gaussian shape and stand at random places, 0.1 to 3 per µm², 3 to 8 rms
heights high (colour) and 30 to 100 nm wide; a quarter of the surfaces has none (dark). All are
scaled to the rms height of Table 1. The factor of two is the only condition, and it is not on range
or work. Pairs that are chosen by the forces test no pair that follows from the same forces: where
they lie about the published one (with its uncertainty), they are consistent with it. Drawn from
protruded.nc and resources/paper/parameters.csv and pull_off.csv.
"""

COLOURS = "viridis"
COLUMNS = [
    "panel", "variant", "set", "origin", "quantity", "density", "height", "width", "agrees",
    *tables.VALUE_COLUMNS,
]  # fmt: skip


def draw(
    protruded: xr.Dataset, published_constants: pd.DataFrame, published_pull_off: pd.DataFrame
) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) forces of each protruded surface, (b) fits of all sets with each of them.

    The table has (a) mean and median force (N), (b) range (nm) and work of adhesion (J/m2) of each
    set, and whether its forces agree with the published ones (1) or not (0).
    """
    measured = published_pull_off.loc[protruded.attrs["surface"]]
    agrees = protruded["agrees"] == 1
    figure = drawing.create(3.4, protruded)
    forces, fits = figure.subplots(1, 2, width_ratios=(1, 1.3))
    norm = Normalize(0, np.max(protruded["height"].values, initial=1.0))
    _draw_forces(forces, protruded, measured, norm)
    _draw_fits(fits, protruded, agrees, norm)
    style.draw_published_fit(fits, published_constants)
    share = agrees.values.mean() if agrees.size else 0.0
    style.label_panel(fits, "b", f"best fits; {print_share(share)} of the sets agree")
    handles = [
        Line2D([], [], ls="none", marker="o", color="0.4", label="forces agree (b)"),
        Line2D([], [], ls="none", marker="o", mfc="none", color="0.4", label="they do not (b)"),
        Line2D([], [], ls="none", marker="s", color="black", label="published"),
    ]
    style.legend_above(figure, handles)
    published = [
        tables.rows_of(
            "a", f"{name}_at_published", "N", "published", value=measured[f"{name}_force"]
        )
        for name in ("mean", "median")
    ]
    parts = protruded[["density", "height", "width"]]
    frames = [
        tables.computed_rows(
            parts.assign(value=protruded[name]), panel="a", quantity=name, unit="N"
        )
        for name in ("mean_at_published", "median_at_published")
    ] + [
        tables.computed_rows(
            parts.assign(value=protruded[name], agrees=protruded["agrees"]),
            panel="b", quantity=name, unit=unit,
        )
        for name, unit in (("range_of_adhesion", "nm"), ("work_of_adhesion", "J/m2"))
    ]  # fmt: skip
    return pd.concat([*frames, *published], ignore_index=True).reindex(columns=COLUMNS), figure


def _draw_forces(
    axes: Axes, protruded: xr.Dataset, measured: "pd.Series[float]", norm: Normalize
) -> None:
    """Draw median against mean force (µN) at the published pair."""
    mean, median = (
        protruded[f"{name}_at_published"] / style.MICRONEWTON for name in ("mean", "median")
    )
    axes.scatter(mean, median, c=protruded["height"], cmap=COLOURS, norm=norm, s=18)
    published = [measured[name] / style.MICRONEWTON for name in ("mean_force", "median_force")]
    axes.plot(*published, "s", color="black", ms=5)
    largest = np.max([mean.values, median.values], initial=max(published))
    ends = np.array([0.7 * min(published), 1.5 * largest])
    axes.plot(ends, ends, color="0.7", lw=0.6, zorder=0)
    axes.set(xscale="log", yscale="log", xlabel="mean force (µN)", ylabel="median force (µN)")
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1, 2, 5))
    style.label_panel(axes, "a", "at the published pair")


def _draw_fits(axes: Axes, protruded: xr.Dataset, agrees: xr.DataArray, norm: Normalize) -> None:
    """Draw work (mJ/m²) against range of adhesion (nm) of each set."""
    heights = protruded["height"].broadcast_like(agrees).values
    ranges = protruded["range_of_adhesion"].transpose(*agrees.dims).values
    works = protruded["work_of_adhesion"].transpose(*agrees.dims).values / style.MILLIJOULE
    inside = agrees.values
    axes.plot(ranges[~inside], works[~inside], "o", mfc="none", mec="0.75", mew=0.4, ms=2.5)
    marks = axes.scatter(
        ranges[inside], works[inside], c=heights[inside], cmap=COLOURS, norm=norm, s=8, zorder=3
    )
    axes.figure.colorbar(marks, ax=axes, label="height of protrusions / rms height")
    axes.set(
        xscale="log", yscale="log", xlabel="range of adhesion ρ (nm)",
        ylabel="work of adhesion $W$ (mJ/m²)",
    )  # fmt: skip
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1, 3))
