"""Fig. 1: the topography of the substrates and of the sphere."""

import math
from string import ascii_lowercase

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, style, tables

TITLE = "Fig. 1: surface topography"
CHAPTER = "1. Surfaces"
CAPTION = """\
One levelled scan of each substrate, then the sphere as scanned and with its spherical shape
subtracted. Colours: height about the mean of each map (nm), each on its own scale. Above: rms
height of the map shown; below: side of the scan.

The frame has the colour of the surface in all figures. Table 1 has means over all scans of a
surface. Drawn from topography.nc.
"""

MAPS_IN_A_ROW = 3
AS_SCANNED = "sphere as scanned"
SUBTRACTED = "sphere subtracted"
COLUMNS = [
    "panel", "surface", "label", "basis", "state", "origin", "quantity",
    "value", "uncertainty", "unit",
]  # fmt: skip


def draw(topography: xr.Dataset) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 1: a levelled scan of each substrate, and the sphere with and without curvature.

    The column `uncertainty` has the standard deviation over the scans.
    """
    panels = _panels(topography)
    rows = math.ceil(len(panels) / MAPS_IN_A_ROW)
    figure = drawing.create(2.4 * rows + drawing.FOOTER, topography)
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
        if state != AS_SCANNED:
            values["rms_height_mean"] = surface_data["rms_height_mean"].item()
        name = f"{description['label']}, {state}" if state else description["label"]
        style.label_panel(axes, letter, f"{name}\nrms {values['map_rms_height']:.1f} nm")
        for quantity, value in values.items():
            row = tables.quantity_rows(
                letter, quantity, "nm", value=value, state=state, **description
            )
            if quantity == "rms_height_mean":
                row["uncertainty"] = surface_data["rms_height_std"].item()
            frames.append(row)
    for axes in grid[len(panels) :]:
        axes.set_axis_off()
    return pd.concat(frames).reindex(columns=COLUMNS), figure


def _panels(topography: xr.Dataset) -> list[tuple[xr.Dataset, str, np.ndarray]]:
    """Return surface, state and heights (row, column) in nm of the panels, in drawing order."""
    name = topography.attrs["sphere_surface"]
    sphere = topography.sel(surface=name)
    substrates = topography.drop_sel(surface=name)
    panels = [
        *((surface_data, "", surface_data["example_heights"])
          for _, surface_data in style.iterate_surfaces(substrates)),
        (sphere, AS_SCANNED, topography["sphere_as_scanned"]),
        (sphere, SUBTRACTED, sphere["example_heights"]),
    ]  # fmt: skip
    # The dataset pads smaller scans to the largest scan.
    return [
        (surface_data, state, heights.dropna("row", how="all").dropna("column", how="all").values)
        for surface_data, state, heights in panels
    ]
