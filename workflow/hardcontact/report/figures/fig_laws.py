"""Other interaction laws: their pressure, and the edges of the critical band."""

from itertools import cycle

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.report.figures import drawing, style, tables
from hardcontact.theory.interaction_laws import LAWS, pressure

TITLE = "Other interaction laws"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) Attraction against the gap by other interaction laws than Eq. 1 of the paper. Range and work of
each law come nearest to the forces of Eq. 1 at the published range and work. (b) Short and (c)
long edge of the critical band by each law, of each surface and of their mean.

Full symbols: the range that comes nearest to Eq. 1; open symbols: a range of an atomic spacing.
Where a symbol is missing, the edge lies beyond the last cutoff. Bars:
{{ inference.confidence | percent }} intervals over realizations, random surfaces of one spectrum.
The range of a law is its work of adhesion over its attraction at contact. The force of any law
that decays steadily is a mixture of the forces of exponential laws (Eq. 1). Drawn from laws.nc.
"""

# Tol's muted scheme, whose colours no surface has; Eq. 1 is published, thus black.
COLOURS = (style.PUBLISHED_COLOUR, "#332288", "#882255", "#999933", "#44AA99")
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
LAW_MARKERS = ("o", "s", "^", "D", "v")
LOOKS: dict[str, style.Look] = {
    law.name: {"color": colour, "marker": marker}
    for law, colour, marker in zip(LAWS, cycle(COLOURS), cycle(LAW_MARKERS), strict=False)
}
GAPS = np.geomspace(0.1, 300.0, 200)  # nm
PRESSURE = 1e9 * 1e-6  # J/m² over nm, in MPa
PANELS = {"small": ("b", "short edge (nm)"), "large": ("c", "long edge (nm)")}
FITS = {"range_of_law": "nm", "work_of_adhesion": "J/m2"}


def draw(laws: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) pressures, (b, c) edges of the band; a `group` is a substrate, or all of them."""
    figure, ((pressures, *edges),) = drawing.create_rows(3.2, laws, (1, (1, 1.2, 1.2)))
    _draw_pressures(pressures, laws)
    frames = [tables.variable_rows(laws, *(("a", name, unit) for name, unit in FITS.items()))]
    for axes, (side, (panel, title)) in zip(edges, PANELS.items(), strict=True):
        _draw_edges(axes, laws, side)
        style.label_panel(axes, panel, title)
        column = (panel, "edge", "nm")
        frames.append(tables.variable_rows(laws.sel(side=[side]), column))
    handles = [
        Line2D([], [], ls=dashes, label=law.label, **LOOKS[law.name])
        for law, dashes in zip(LAWS, cycle(DASHES), strict=False)
    ]
    mark: style.Look = {"ls": "none", "marker": "o", "color": "0.3"}
    handles += [
        Line2D([], [], label="range nearest to Eq. 1", **mark),
        Line2D([], [], label="range of an atomic spacing", mfc="white", **mark),
    ]
    style.legend_above(figure, handles, 6)
    return tables.tidy_table(frames, laws, "law", "range_choice", "side", surfaces="group"), figure


def _draw_pressures(axes: Axes, laws: xr.Dataset) -> None:
    """Draw the pressure of every law at the length and work equivalent to Eq. 1."""
    case = laws.sel(range_choice="equivalent")
    for law, colour, dashes in zip(LAWS, cycle(COLOURS), cycle(DASHES), strict=False):
        law_data = case.sel(law=law.name)
        rho, work = law_data["range_of_law"].item(), law_data["work_of_adhesion"].item()
        values = PRESSURE * work / rho * pressure(law, GAPS, rho)
        axes.plot(GAPS, values, color=colour, ls=dashes)
    axes.set(xscale="log", yscale="log", xlabel="gap (nm)", ylabel="attraction (MPa)")
    axes.set_ylim(bottom=1e-7)
    style.label_logarithmic(axes.xaxis, digits=(1,))
    style.label_panel(axes, "a", "interaction laws")


def _draw_edges(axes: Axes, laws: xr.Dataset, side: str) -> None:
    """Draw the edges of each surface and of their mean, with the laws side by side.

    Filled marks have ranges equivalent to Eq. 1, open marks a range of an atomic spacing.
    """
    edges = tables.value_and_interval(laws, "edge").sel(side=side)
    positions = np.arange(edges.sizes["group"])
    offsets = np.linspace(-0.3, 0.3, len(LOOKS))
    fills: dict[str, style.Look] = {"equivalent": {}, "atomic": {"mfc": "white"}}
    for (case, fill), shift in zip(fills.items(), (0, 0.07), strict=True):
        for (law, look), offset in zip(LOOKS.items(), offsets, strict=True):
            law_data = edges.sel(range_choice=case, law=law)
            marks = look | fill | {"ls": "none", "ms": 3.5, "lw": 0.8}
            style.draw_bars(axes, positions + offset + shift, law_data, **marks)
    labels = laws["label"].to_series()
    groups = [labels.get(group, "mean of all") for group in laws["group"].values]
    axes.set_xticks(range(len(groups)), groups, **style.TILTED)
    axes.set(yscale="log")
    style.label_logarithmic(axes.yaxis)
