"""Change of the force with the amplitude of each octave, and forces with parts of the roughness."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from hardcontact.base.formatting import format_quantity, format_share
from hardcontact.report.figures import drawing, panels, style

PUBLISHED_BAND_LOOK: style.Look = {"color": "0.9", "lw": 0, "zorder": 0}


def draw(
    sensitivity: xr.Dataset,
    band_forces: xr.Dataset,
    edges: xr.Dataset,
    published_constants: pd.DataFrame,
) -> Figure:
    """Draw (a) the sensitivity to each octave, (b, c) forces with parts of the roughness."""
    figure, ((octave_axes,), ratio_axes) = drawing.create_rows(
        5.4, sensitivity, row_heights=(3, 2.2), panel_widths=([1], [1, 1])
    )
    octave_axes.axvspan(*panels.published_band(published_constants), **PUBLISHED_BAND_LOOK)
    panels.draw_octaves(octave_axes, sensitivity)
    style.label_panel(octave_axes, "a", "change of the force with the amplitude of one octave")
    tolerance = edges.attrs["tolerance"]  # all that this figure takes from the edges
    titles = {"published": "published band", "computed": "averaged edges"}
    ratio_axes[1].sharey(ratio_axes[0])
    for letter, axes, (band_name, title) in zip("bc", ratio_axes, titles.items(), strict=True):
        ratios = band_forces.sel(band=band_name)
        _draw_band_ratios(axes, ratios, tolerance)
        band_edges = [format_quantity(edge, "nm", digits=2) for edge in ratios["band_edge"].values]
        style.label_panel(axes, letter, f"{title}: {' to '.join(band_edges)}")
    ratio_axes[0].set_ylabel("force / unfiltered force")
    confidence = format_share(sensitivity.attrs["confidence"])
    handles = [
        *style.surface_handles(sensitivity),
        Line2D([], [], lw=1.0, color="0.25", label=f"{confidence} interval (bars)"),
        Patch(label="published band (a)", **PUBLISHED_BAND_LOOK),
        Patch(label=f"change below {format_share(tolerance)} (b, c)", **panels.UNCHANGED_LOOK),
    ]
    style.legend_above(figure, handles)
    return figure


def _draw_band_ratios(axes: Axes, ratios: xr.Dataset, tolerance: float) -> None:
    """Draw the force with each part of the roughness, relative to the unfiltered force."""
    panels.draw_tolerance(axes, tolerance)
    band_parts = ratios["band_part"].values
    positions = np.arange(len(band_parts))
    values = panels.value_and_interval(ratios, "band_force_ratio")
    shifts = np.linspace(-0.25, 0.25, values.sizes["surface"])
    for shift, (look, curve) in zip(shifts, style.iterate_surfaces(values), strict=True):
        panels.draw_bars(axes, positions + shift, curve, ls="none", width=0.9, **look)
    axes.set_xticks(positions, band_parts)
    axes.set_xlim(-0.5, len(band_parts) - 0.5)
