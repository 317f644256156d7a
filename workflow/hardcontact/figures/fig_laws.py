"""Other laws of attraction: their pressure, their fits, ratios of forces, edges of the band."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import drawing, style, tables
from hardcontact.insight.interaction_laws import LAWS, pressure

TITLE = "Other laws of attraction"
CHAPTER = "8. What decides the band"
CAPTION = """\
(a) The laws, each with the range and the work of adhesion that come nearest to the forces of
Eq. 1 at the published pair. (b) Mean relative error against the range. (c) Forces over that on
the reference surface, fitted to the measured ones (grey). (d, e) Short and long edge of the
critical band.

The force of any law that decays steadily is a mixture of the forces of exponential laws (Eq. 1
of the paper), so each law has the force of every contact without another sum; its range is work
of adhesion over attraction at contact. Errors in (b) are those at the best work of adhesion, to
the forces of Eq. 1 and, pale, to the measured ones; line: 0.1. Edges are those of each surface
and of their mean, at the range that comes nearest to Eq. 1 (full) and at an atomic spacing
(open); where a symbol is missing, no cutoff changes the force by the tolerance of the band, so
that the edge lies beyond the last cutoff. Symbols of (c-e): as in (a). Bars:
{{ inference.confidence | percent }} intervals over scans and their masters. Drawn from laws.nc.
"""

# Of no surface (Tol's muted scheme): Eq. 1 black, as all that is published.
COLOURS = (style.PUBLISHED, "#332288", "#882255", "#999933")
DASHES = ("-", "--", "-.", ":")
MARKERS = ("o", "s", "^", "D")
LOOKS: dict[str, style.Look] = {
    law.name: {"color": colour, "marker": marker}
    for law, colour, marker in zip(LAWS, COLOURS, MARKERS, strict=True)
}
GAPS = np.geomspace(0.1, 300.0, 200)  # nm
PRESSURE = 1e9 * 1e-6  # J/m² over nm, in MPa
PANELS = {"small": ("d", "short edge (nm)"), "large": ("e", "long edge (nm)")}
TARGETS = {"Eq. 1": 1.0, "published": 0.4}  # opacity
FITS = {"range_of_law": "nm", "work_of_adhesion": "J/m2", "fit_error": "1"}


def _table(laws: xr.Dataset) -> pd.DataFrame:
    """Return what the figure is drawn from, one row a number.

    By law and case its range (nm), work (J/m2) and error (panel a), the error of every length at
    its best work (b, `case` its target), the ratios of forces, computed and published (c), and the
    edges of the band (d and e) of each substrate and of all pooled: a `group`.
    """
    fits = (("a", name, unit) for name, unit in FITS.items())
    error = laws["error"].rename(target="case")
    published = tables.drawn_rows(laws, ("c", "published_ratio", "1"))
    frames = [
        tables.drawn_rows(laws, *fits, ("a", "implied_over_known", "1")),
        tables.computed_rows(error, panel="b", quantity="error", unit="1"),
        tables.drawn_rows(laws, ("c", "ratio", "1")),
        published.assign(origin="published", quantity="ratio"),
        *(
            tables.drawn_rows(laws.sel(side=[side]), (panel, "critical_wavelength", "nm"))
            for side, (panel, _) in PANELS.items()
        ),
    ]
    by_group = (frame.rename(columns={"surface": "group"}) for frame in frames)
    return tables.tidy(by_group, laws, "law", "case", "side", "length", surfaces="group")


def draw(laws: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw (a) pressures, (b) errors of fits, (c) ratios of forces, (d, e) edges of the band."""
    figure, ((pressures, errors, ratios), edges) = drawing.create_rows(
        5.2, laws, (1, (1, 1, 1)), (1, (1, 1))
    )
    _draw_pressures(pressures, laws)
    _draw_errors(errors, laws)
    _draw_ratios(ratios, laws)
    for axes, (side, (panel, title)) in zip(edges, PANELS.items(), strict=True):
        _draw_edges(axes, laws, side)
        style.label_panel(axes, panel, title)
    return _table(laws), figure


def _draw_pressures(axes: Axes, laws: xr.Dataset) -> None:
    """Draw the pressure of every law at the length and work equivalent to Eq. 1."""
    case = laws.sel(case="equivalent")
    for law, colour, dashes in zip(LAWS, COLOURS, DASHES, strict=True):
        of_law = case.sel(law=law.name)
        rho, work = of_law["range_of_law"].item(), of_law["work_of_adhesion"].item()
        values = PRESSURE * work / rho * pressure(law, GAPS, rho)
        axes.plot(GAPS, values, color=colour, ls=dashes, label=law.label)
    # Lines of (a) and (b) with the marks of the other panels.
    handles = [
        Line2D([], [], ls=dashes, ms=3.5, label=law.label, **look)
        for law, dashes, look in zip(LAWS, DASHES, LOOKS.values(), strict=True)
    ]
    axes.set(xscale="log", yscale="log", xlabel="gap (nm)", ylabel="attraction (MPa)")
    axes.set_ylim(bottom=1e-7)
    axes.legend(handles=handles, loc="lower left", handlelength=1.8, handletextpad=0.4)
    style.label_logarithmic(axes.xaxis, at=(1,))
    style.label_panel(axes, "a", "laws of like force")


def _draw_errors(axes: Axes, laws: xr.Dataset) -> None:
    """Draw the error at the best work against the length of each law, for both targets."""
    for law, colour, dashes in zip(LAWS, COLOURS, DASHES, strict=True):
        for target, opacity in TARGETS.items():
            error = laws["error"].sel(law=law.name, target=target)
            axes.plot(laws["length"], error, color=colour, ls=dashes, alpha=opacity)
    axes.axhline(0.1, color="0.7", lw=0.6, zorder=0)
    axes.set(xscale="log", xlabel="range W/|p(0)| (nm)", ylabel="mean error at the best W")
    axes.set_ylim(0, 1.02 * float(laws["error"].max()))
    style.label_logarithmic(axes.xaxis, at=(1,))
    style.label_panel(axes, "b", "to Eq. 1; pale: to measured")


def _draw_ratios(axes: Axes, laws: xr.Dataset) -> None:
    """Draw ratios of forces to the reference surface at the length fitted to the measured ones."""
    places = np.arange(laws.sizes["surface"])
    axes.hlines(laws["published_ratio"], places - 0.42, places + 0.42, color="0.6", lw=4, alpha=0.6)
    _draw_beside(axes, tables.bounded(laws.sel(case="fitted"), "ratio"))
    axes.set(yscale="log", ylabel=f"force / that on {laws.attrs['reference_label']}")
    axes.set_xticks(places, laws["label"].values, **style.TILTED)
    style.label_panel(axes, "c", "grey: published")


def _draw_edges(axes: Axes, laws: xr.Dataset, side: str) -> None:
    """Draw where the force leaves its tolerance, of each surface and pooled.

    Full marks stand at lengths equivalent to Eq. 1, open ones at an atomic spacing.
    """
    edges = tables.bounded(laws, "critical_wavelength").sel(side=side)
    _draw_beside(axes, edges.sel(case="equivalent"))
    _draw_beside(axes, edges.sel(case="atomic"), 0.07, mfc="white")
    labels = laws["label"].to_series()
    groups = ["\n".join(str(labels.get(group, group)).split()) for group in laws["group"].values]
    axes.set_xticks(range(len(groups)), groups)
    axes.set(yscale="log", xlabel="full: like Eq. 1; open: atomic spacing")
    style.label_logarithmic(axes.yaxis)


def _draw_beside(axes: Axes, values: xr.Dataset, shift: float = 0.0, **fill: Any) -> None:
    """Draw values with their intervals of each law, side by side at each place."""
    beside = np.linspace(-0.3, 0.3, len(LOOKS))
    for (law, look), offset in zip(LOOKS.items(), beside, strict=True):
        of_law = values.sel(law=law)
        places = np.arange(of_law["value"].size) + offset + shift
        style.draw_bars(axes, places, of_law, ls="none", ms=3.5, lw=0.8, **look, **fill)
