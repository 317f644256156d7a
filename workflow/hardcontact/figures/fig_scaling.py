"""Scaling of the band: edges against the reach of the attraction and the contact, exponents."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hardcontact.figures import drawing, style, tables
from hardcontact.insight.edge_scaling import LENGTHS, PARTS

TITLES = {"small": "short edge (nm)", "large": "long edge (nm)"}
REACH = "$\\sqrt{2R\\rho}$"
CONTACT = "$\\sqrt{F/H}$"
#: Exponents that are drawn, from above: edge, length or part of the combinations, name.
EXPONENTS = [
    *((side, length, name)
      for side in TITLES
      for length, name in zip(LENGTHS, ("$\\sqrt{R}$", "$\\sqrt{\\rho}$", CONTACT), strict=True)),
    ("large", PARTS[1], f"{REACH}, below"),
    ("large", PARTS[2], f"{REACH}, above"),
]  # fmt: skip
#: In the table, the exponent of the reach in place of those of the radius and the range apart.
REACH_LENGTH = "reach"
BETWEEN = ("side", "radius", "area", "rho", "reach", "part", "length", "dependence")  # columns
PUBLISHED = {"color": style.PUBLISHED, "lw": 0.8, "ls": "--", "zorder": 1}


def table(scaling: xr.Dataset, published_constants: pd.DataFrame) -> pd.DataFrame:
    """Return what the figure is drawn from, one row a number.

    Edges (nm) of all combinations (panel a: short edges at the paper's contact area, b: long edges,
    c: short edges at other areas), exponents with what they say (d), rms height and roll-off (nm)
    of each surface, and the published edges.
    """
    edges = tables.bounded(scaling, "edge").assign(reach=scaling["reach"])
    exponents = _exponents(scaling).assign(dependence=scaling["dependence"])
    spectra = scaling[["rms_height", "roll_off"]].to_array("quantity", "value")
    area = scaling["area"].sel(area=scaling.attrs["area"], method="nearest").item()

    def panel_of_edge(rows: pd.DataFrame) -> np.ndarray:
        return np.select([rows["side"] == "large", rows["area"] == area], ["b", "a"], "c")

    of_paper = [tables.published_edge(published_constants, side) for side in TITLES]
    published = pd.DataFrame({"side": list(TITLES), "value": of_paper})
    frames = [
        tables.computed_rows(edges, panel=panel_of_edge, quantity="edge", unit="nm"),
        tables.computed_rows(exponents, panel="d", quantity="exponent", unit="1"),
        tables.computed_rows(spectra.to_dataset(), panel="b", unit="nm"),
        published.assign(panel=["a", "b"], quantity="edge", unit="nm", origin="published"),
    ]
    return tables.tidy(frames, scaling, *BETWEEN)


def _exponents(scaling: xr.Dataset) -> xr.Dataset:
    """Return all exponents with their bounds; the length of that of the reach is REACH_LENGTH."""
    of_reach = tables.bounded(scaling, "reach_exponent").assign_coords(length=REACH_LENGTH)
    return xr.concat([tables.bounded(scaling, "exponent"), of_reach], "length")


def draw(scaling: xr.Dataset, published_constants: pd.DataFrame) -> Figure:
    """Draw edges against (a) the range and (b) reach of the attraction, (c) contact, (d) exponents.

    Sections go through the combination nearest to the paper's radius, range (nm) and area (nm²).
    """
    figure = drawing.create(5.6, scaling)
    (short, long), (contact, exponents) = figure.subplots(2, 2)
    at_area = scaling.sel(area=scaling.attrs["area"], method="nearest")
    _draw_edges(short, at_area, "small", "rho", ["radius", "rho"])
    short.set(xlabel="range of adhesion ρ (nm)")
    _draw_edges(long, at_area, "large", "reach", ["radius", "rho"])
    long.set(xlabel=f"reach of the attraction {REACH} (nm)")
    for axes, letter in ((short, "a"), (long, "b")):
        style.label_panel(axes, letter, f"F/H = {at_area['area']:g} nm²")
    _draw_proportional(long, scaling)
    radius, rho = scaling.attrs["sphere_radius"], scaling.attrs["rho"]
    at_paper = scaling.sel(radius=radius, rho=rho, method="nearest")
    width = np.sqrt(at_paper["contact_area"].sel(side="small"))
    _draw_edges(contact, at_paper.assign(width=width), "small", "width", ["area"])
    contact.set(xlabel=f"width of the contact {CONTACT} (nm)")
    radius = at_paper["radius"].item() / 1e3
    style.label_panel(contact, "c", f"R = {radius:g} µm, ρ = {at_paper['rho']:g} nm")
    for axes, side in ((short, "small"), (long, "large"), (contact, "small")):
        axes.axhline(tables.published_edge(published_constants, side), **PUBLISHED)
    _draw_exponents(exponents, scaling)
    style.legend_above(figure, style.surface_handles(scaling, ls="none"))
    return figure


def _draw_edges(
    axes: Axes, cases: xr.Dataset, side: str, along: str, dimensions: list[str]
) -> None:
    """Draw the edges of one side, all surfaces, with intervals, against a length of the cases.

    Edges that differ in the last dimension alone are connected.
    """
    edges = tables.bounded(cases, "edge").assign(along=cases[along]).sel(side=side)
    for look, of_surface in style.by_surface(edges.transpose(..., *dimensions)):
        stacked = of_surface.stack(case=dimensions).dropna("case", subset=["value"])
        style.draw_bars(axes, stacked["along"], stacked, ls="none", ms=3, elinewidth=0.4, **look)
        lines = (
            one.broadcast_like(of_surface["value"]).transpose(*dimensions).values
            for one in (of_surface["along"], of_surface["value"])
        )
        last = edges.sizes[dimensions[-1]]
        for line in zip(*(one.reshape(-1, last) for one in lines), strict=True):
            axes.plot(*line, color=look["color"], lw=0.5, alpha=0.6)
    axes.set(xscale="log", yscale="log", ylabel=TITLES[side])
    style.label_logarithmic(axes.xaxis, axes.yaxis, at=(1, 3))


def _draw_proportional(axes: Axes, scaling: xr.Dataset) -> None:
    """Draw the edge that is the reach, and at the right the roll-off of every surface."""
    ends = np.array([scaling["reach"].min(), scaling["reach"].max()])
    axes.plot(ends, ends, color="0.7", lw=0.8, zorder=0)
    at_right = axes.get_yaxis_transform()
    for look, of_surface in style.by_surface(scaling):
        roll_off, colour = of_surface["roll_off"].item(), look["color"]
        axes.plot(1.0, roll_off, "<", transform=at_right, color=colour, ms=6, clip_on=False)


def _draw_exponents(axes: Axes, scaling: xr.Dataset) -> None:
    """Draw EXPONENTS of all surfaces with their intervals, each surface a little lower."""
    exponents, drawn = _exponents(scaling), [-0.8, 1.8]
    intervals: list[tuple[float, float, float, str]] = []
    places = -np.arange(len(EXPONENTS), dtype=float)
    beside = np.linspace(0.27, -0.27, scaling.sizes["surface"])
    for (look, of_surface), offset in zip(style.by_surface(exponents), beside, strict=True):
        for place, (side, which, _) in zip(places + offset, EXPONENTS, strict=True):
            part, length = (which, REACH_LENGTH) if which in PARTS else (PARTS[0], which)
            one = of_surface.sel(side=side, part=part, length=length)
            axes.errorbar([one["value"]], [place], xerr=style.reach(one), ms=3, lw=0.8, **look)
            drawn.append(one["value"].item())
            intervals.append((one["low"].item(), one["high"].item(), place, look["color"]))
    for value in (0.0, 1.0):
        axes.axvline(value, color="0.7", lw=0.6, zorder=0)
    in_italics: style.Look = {"ha": "right", "va": "top", "fontsize": 7, "style": "italic"}
    for name, place in (("short edge", 0.5), ("long edge", -2.5)):
        axes.text(0.98, place - 0.06, name, transform=axes.get_yaxis_transform(), **in_italics)
        axes.axhline(place, color="0.7", lw=0.4)
    axes.set_yticks(places, [name for *_, name in EXPONENTS])
    axes.set(xlabel="exponent", xlim=(np.nanmin(drawn) - 0.2, np.nanmax(drawn) + 0.2))
    left, right = axes.get_xlim()
    # Arrows where intervals reach beyond the panel.
    for low, high, height, colour in intervals:
        for end, marker, cut in ((left, "<", low < left), (right, ">", high > right)):
            if cut:
                axes.plot(end, height, marker, color=colour, ms=4, clip_on=False)
    style.label_panel(axes, "d", "1: in proportion, 0: independent")
