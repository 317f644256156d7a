"""How large a scan must be: force and long edge on windows and whole surfaces, and a rule."""

from collections.abc import Iterator

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, style, tables

TITLE = "How large a scan must be"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) Mean force on windows cut out of large random surfaces, relative to that on the whole surfaces;
lines: the rule. (b) Side of a scan on which the force is too large by the factor in the title, by
the rule. (c) Long edge of the critical band on windows (filled) and on whole surfaces (open).
Dashed: the scans of the paper.

Windows are levelled, mirrored and brought into contact as the paper does with its scans. Computed
once, with the settings of the paper (resources/validation). The rule is a power law of 2√(2Rσ) and
of the roll-off, each relative to the side of the scan, and of σ/ρ. σ is the rms height, R the
radius of the sphere and ρ the range of adhesion. The rule was fitted to other random self-affine
surfaces.
The long edge is the wavelength above which removing roughness changes the mean force by 10 %.
Bars: 95 % intervals over realizations, random surfaces of one spectrum. An interval without an end
reaches to the shortest cutoff or the longest wave. An edge without a value stands at its bound.
Grey: longest wave of a mirrored window. In (a, c) surfaces stand side by side. Drawn from
scan_size.nc.
"""

FURTHER_COLUMNS = ("scan_size", "rho", "predicted", "mirrored", "status")  # columns
MICROMETRE = 1000  # nm
SCAN_LINE: style.Look = {"color": style.PUBLISHED_COLOUR, "lw": 0.8, "ls": "--", "zorder": 1}


def draw(scan_size: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) the excess against the size of a scan, (b) sizes needed, (c) long edges."""
    figure = drawing.create(3.2, scan_size)
    sizes, needed, edges = figure.subplots(1, 3)
    rho = scan_size.attrs["rho"]
    allowed = scan_size.attrs["allowed_ratio"]
    frames = [
        _draw_sizes(sizes, scan_size.sel(rho=rho, method="nearest")),
        tables.variable_rows(scan_size, ("b", "size_needed", "nm")),
        _draw_edges(edges, scan_size),
    ]
    for look, surface_data in style.iterate_surfaces(scan_size):
        needed.plot(
            scan_size["rho"], surface_data["size_needed"] / MICROMETRE, ms=3, lw=0.6, **look
        )
    needed.axhline(scan_size.attrs["scan_size"] / MICROMETRE, **SCAN_LINE)
    needed.set(xlabel="range of adhesion ρ (nm)", ylabel="side of the scan needed (µm)")
    style.label_panel(needed, "b", f"scan for {allowed:g} times the force")
    for axes in (sizes, edges):
        axes.axvline(scan_size.attrs["scan_size"] / MICROMETRE, **SCAN_LINE)
        axes.set_xlabel("side of the scan (µm)")
    for axes in (sizes, needed, edges):
        axes.set(xscale="log", yscale="log")
        style.label_logarithmic(axes.xaxis, axes.yaxis, digits=(1, 3))
    style.end_near_values([sizes])
    style.legend_above(figure, style.surface_handles(scan_size, ls="none"))
    return tables.tidy_table(frames, scan_size, *FURTHER_COLUMNS), figure


def _draw_sizes(axes: Axes, section: xr.Dataset) -> pd.DataFrame:
    """Draw the excess of all surfaces with intervals, and the rule as lines."""
    excess = tables.value_and_interval(section, "finite_scan_ratio").assign(
        predicted=section["predicted_finite_scan_ratio"]
    )
    sizes = section["scan_size"] / MICROMETRE
    for look, surface_data, factor in _side_by_side(excess):
        style.draw_bars(axes, factor * sizes, surface_data, ls="none", ms=3, elinewidth=0.6, **look)
        axes.plot(sizes, surface_data["predicted"], color=look["color"], lw=0.7)
    axes.set_ylabel("force relative to a large surface")
    style.label_panel(axes, "a", f"force on windows, ρ = {section['rho']:g} nm")
    return tables.computed_rows(excess, panel="a", quantity="finite_scan_ratio", unit="1")


def _side_by_side(data: xr.Dataset) -> Iterator[tuple[style.Look, xr.Dataset, float]]:
    """Yield look and data of each surface, and a factor that shifts its symbols along x."""
    factors = np.geomspace(0.88, 1 / 0.88, data.sizes["surface"])
    for (look, surface_data), factor in zip(style.iterate_surfaces(data), factors, strict=True):
        yield look, surface_data, float(factor)


def _draw_edges(axes: Axes, scan_size: xr.Dataset) -> pd.DataFrame:
    """Draw long edges on windows (filled) and whole surfaces (hollow), with open ends drawn out."""
    edges = tables.value_and_interval(scan_size, "long_edge").assign(
        mirrored=scan_size["mirrored"], status=scan_size["long_edge_status"]
    )
    edges["value"] = edges["value"].fillna(scan_size["long_edge_bound"])
    shortest = scan_size["cutoff_wavelength"].min()
    period = scan_size["period"]
    ends = edges.assign(low=edges["low"].fillna(shortest), high=edges["high"].fillna(period))
    ends = ends.assign(ends[["value", "low", "high"]] / MICROMETRE)
    for look, surface_data, factor in _side_by_side(ends):
        for mirrored, fill in ((1, look["color"]), (0, "white")):
            group = surface_data.sel(map_size=ends["mirrored"] == mirrored)
            positions = factor * group["map_size"] / MICROMETRE
            marks = look | {"mfc": fill, "ls": "none", "ms": 3.5, "elinewidth": 0.7}
            style.draw_bars(axes, positions, group, **marks)
    windows = period.sel(map_size=scan_size["mirrored"] == 1) / MICROMETRE
    axes.plot(windows["map_size"] / MICROMETRE, windows, color="0.7", lw=0.8, zorder=0)
    axes.set_ylabel("long edge of the band (µm)")
    style.label_panel(axes, "c", f"long edge, ρ = {scan_size.attrs['rho']:g} nm")
    rows = tables.computed_rows(edges, panel="c", quantity="long_edge", unit="nm")
    return rows.rename(columns={"map_size": "scan_size"}).assign(rho=scan_size.attrs["rho"])
