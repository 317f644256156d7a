"""Fig. 1: the topography of the substrates and of the sphere."""

import math
from string import ascii_lowercase

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import drawing, style, tables
from hardcontact.records.published import rows_met

TITLE = "Fig. 1: surface topography"
CHAPTER = "1. Surfaces"
CAPTION = """\
One levelled scan of each substrate, in the order of the study, then the sphere as scanned and
with its spherical shape subtracted. Colours: height in nm about the mean of each map, each on
its own scale. Above: rms height of the map shown and, in brackets, mean ± standard deviation
over all scans of the surface.

The frame has the colour of the surface in all figures. A dagger marks rms heights that
substitutes are made to have, equal to Table 1: they test nothing. Drawn from topography.nc.
"""

MAPS_IN_A_ROW = 3
AS_SCANNED = "sphere as scanned"
SUBTRACTED = "sphere subtracted"
COLUMNS = [
    "panel", "surface", "label", "basis", "state", "origin", "quantity",
    "value", "uncertainty", "unit",
]  # fmt: skip
NOTE = (
    "all: mean ± standard deviation over the scans of the surface; "
    f"{tables.BY_CONSTRUCTION} by construction those of Table 1"
)


def draw(topography: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 1: a levelled scan of each substrate, the sphere with and without its curvature.

    The column `uncertainty` has the standard deviation over the scans.
    """
    panels = _panels(topography)
    rows = math.ceil(len(panels) / MAPS_IN_A_ROW)
    figure = drawing.create(2.15 * rows + 2 * drawing.FOOTER, topography)
    grid = figure.subplots(rows, MAPS_IN_A_ROW, squeeze=False).ravel()
    colours = style.colours(topography["surface"].values, topography.attrs["sphere_surface"])
    frames = []
    for axes, letter, (surface_data, state, heights) in zip(
        grid, ascii_lowercase, panels, strict=False
    ):
        description = {
            name: str(surface_data[name].item()) for name in ("surface", "label", "basis")
        }
        style.draw_map(axes, heights, float(surface_data["scan_size"]))
        axes.spines[:].set(edgecolor=colours[description["surface"]], linewidth=1.5)
        values = {
            "map_rms_height": float(np.std(heights, dtype=float)),
            "map_peak_to_valley": np.ptp(heights),
        }
        rms = f"rms {values['map_rms_height']:.3g} nm"
        if state != AS_SCANNED:
            values["rms_height_mean"] = surface_data["rms_height_mean"].item()
            rms += f" ({_print_over_scans(surface_data)})"
        name = f"{description['label']}, {state}" if state else description["label"]
        style.label_panel(axes, letter, f"{name}\n{rms}")
        for quantity, value in values.items():
            row = tables.rows_of(letter, quantity, "nm", value=value, state=state, **description)
            if quantity == "rms_height_mean":
                row["uncertainty"] = surface_data["rms_height_std"].item()
            frames.append(row)
    for axes in grid[len(panels) :]:
        axes.set_axis_off()
    note = Line2D([], [], ls="none", label=NOTE)
    figure.legend(handles=[note], loc="outside upper left", handlelength=0, handletextpad=0)
    return pd.concat(frames).reindex(columns=COLUMNS), figure


def _panels(topography: xr.Dataset) -> list[tuple[xr.Dataset, str, np.ndarray]]:
    """Return surface, state and heights (row, column) in nm of each panel, in drawing order."""
    name = topography.attrs["sphere_surface"]
    sphere = topography.sel(surface=name)
    substrates = topography.drop_sel(surface=name)
    panels = [
        *((surface_data, "", surface_data["example_heights"])
          for _, surface_data in style.by_surface(substrates)),
        (sphere, AS_SCANNED, topography["sphere_as_scanned"]),
        (sphere, SUBTRACTED, sphere["example_heights"]),
    ]  # fmt: skip
    # Smaller scans are padded to the largest.
    return [
        (surface_data, state, heights.dropna("row", how="all").dropna("column", how="all").values)
        for surface_data, state, heights in panels
    ]


def _print_over_scans(surface_data: xr.Dataset) -> str:
    """Return mean and standard deviation (nm) over the scans, marked if they are so by design."""
    mean, deviation = surface_data["rms_height_mean"].item(), surface_data["rms_height_std"].item()
    met = rows_met(surface_data["calibrated_to_table1"].item())
    mark = tables.BY_CONSTRUCTION if "afm_rms_height" in met else ""
    scatter = f" ± {deviation:.2g}" if math.isfinite(deviation) else ""
    return f"all: {mean:.3g}{scatter}{mark}"
