"""The closed form and models of others beside computed forces, against the modulus."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.figures import drawing, style, tables
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS

PANELS = {
    "closed_form": "closed form",
    "persson_scaraggi": "Persson and Scaraggi",
    "bearing_area": "bearing area",
    "rabinovich": "Rabinovich",
}
#: Regimes by the moduli on their side of one.
SIDES = {SINGLE_PEAKS: (0.0, 1.0), MANY_POINTS: (1.0, np.inf)}
AT_SUMMITS = "_at_summits"
LEAST_MODULUS, HELD_BACK, LOOKED_AT = 5e-3, "0.45", "0.7"


def table(models: xr.Dataset) -> pd.DataFrame:
    """Return predicted over computed forces, one row a point, and what holds for each regime.

    Against the `modulus`; of designed surfaces with their number, whether they were `held_back`,
    and the error of the computed force as `low` and `high`.
    """
    designed = models[["factor", "modulus", "held_back"]].rename(factor="value")
    spread = np.exp(models["force_error"])
    designed = designed.assign(low=designed["value"] / spread, high=designed["value"] * spread)
    named = {"surface_factor": "value", "surface_modulus": "modulus"}
    of_surfaces = models[list(named)].rename(named)
    rows = [
        tables.computed_rows(designed, quantity="factor", unit="1"),
        tables.computed_rows(of_surfaces, quantity="factor", unit="1"),
        *(
            tables.computed_rows(tables.bounded(models, name), quantity=name, unit="1")
            for name in ("median_factor", "rms_factor")
        ),
    ]
    between = ("model", "regime", "rho", "design", "held_back", "modulus")
    found = tables.tidy(rows, models, *between)
    base = found["model"].str.removesuffix(AT_SUMMITS)
    return found.assign(panel=base.map(dict(zip(PANELS, "abcd", strict=True))))


def draw(models: xr.Dataset) -> Figure:
    """Draw predicted over computed forces against k, a panel a model."""
    figure = drawing.create(3.1, models)
    panels = figure.subplots(1, len(PANELS), sharey=True, sharex=True)
    for axes, (name, label), letter in zip(panels, PANELS.items(), "abcd", strict=True):
        axes.axhspan(0.5, 2, color="0.93", zorder=0)
        axes.axhline(1, color="0.4", lw=0.8, ls=":")
        axes.axvline(1, color="0.4", lw=0.8, ls=":")
        _draw_designed(axes, models, name)
        for look, of_surface in style.by_surface(models):
            x = np.maximum(of_surface["surface_modulus"], LEAST_MODULUS)
            axes.plot(x, of_surface["surface_factor"].sel(model=name), **look, ms=2.5, lw=0.9)
        style.label_panel(axes, letter, label)
    axes.set(xscale="log", yscale="log", ylim=(3e-3, 2e2))
    for axes, name in zip(panels, PANELS, strict=True):
        _draw_typical(axes, models, name)
        axes.set_xlabel("$k = \\rho m/\\sigma^2$")
        style.label_logarithmic(axes.xaxis)
    panels[0].set_ylabel("predicted / computed force")
    style.label_logarithmic(panels[0].yaxis)
    mark: style.Look = {"ls": "none", "marker": "o", "ms": 2.5}
    handles = [
        *style.surface_handles(models, ms=3),
        Line2D([], [], color=HELD_BACK, label="designed, held back", **mark),
        Line2D([], [], color=LOOKED_AT, mfc="none", label="designed, not held back", **mark),
        Line2D([], [], color="black", ls="none", marker="x", ms=3, label="closed form's approach"),
        Patch(color=style.FIT, alpha=0.25, lw=0, label="median, nine tenths"),
    ]
    style.legend_above(figure, handles)
    return figure


def _draw_designed(axes: Axes, models: xr.Dataset, name: str) -> None:
    """Draw the designed surfaces, with the standard error of those computed forces."""
    at_summits = name + AT_SUMMITS
    for held_back, colour, face in ((0, LOOKED_AT, "none"), (1, HELD_BACK, HELD_BACK)):
        some = models.sel(design=models["held_back"] == held_back)
        x = np.maximum(some["modulus"], LEAST_MODULUS)
        factor, spread = some["factor"].sel(model=name), np.exp(some["force_error"])
        axes.vlines(x, factor / spread, factor * spread, color=colour, lw=0.5)
        axes.plot(x, factor, "o", color=colour, mfc=face, mew=0.6, ms=2.5)
        if held_back and at_summits in models["model"]:
            axes.plot(x, some["factor"].sel(model=at_summits), "x", color="black", ms=2.5, mew=0.7)


def _draw_typical(axes: Axes, models: xr.Dataset, name: str) -> None:
    """Draw the median of what was held back, and the range of nine tenths, over each regime."""
    typical = tables.bounded(models, "median_factor").sel(model=name)
    ends = axes.get_xlim()
    for regime in typical["regime"].values:
        left, right = np.clip(SIDES.get(regime, ends), *ends)
        one = typical.sel(regime=regime)
        low, middle, high = (one[end].item() for end in ("low", "value", "high"))
        axes.fill_between([left, right], low, high, color=style.FIT, alpha=0.25, lw=0, zorder=0.5)
        axes.plot([left, right], [middle] * 2, color=style.FIT, lw=1.2, zorder=3)
    axes.set_xlim(ends)
