"""Fig. 1: the topography of the substrates and of the sphere."""

import math
from string import ascii_lowercase

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from hardcontact.report.figures import drawing, panels, style

MAPS_PER_ROW = 3


def draw(topography: xr.Dataset) -> Figure:
    """Draw Fig. 1: a levelled scan of each substrate, and the sphere with and without its shape."""
    sphere_surface = topography.attrs["sphere_surface"]
    colours = style.surface_colours(topography["surface"].values, sphere_surface)
    levelled = topography["example_heights"]
    maps = [(name, "", levelled.sel(surface=name)) for name in colours if name != sphere_surface]
    maps += [
        (sphere_surface, ", sphere as scanned", topography["sphere_as_scanned"]),
        (sphere_surface, ", sphere subtracted", levelled.sel(surface=sphere_surface)),
    ]
    rows = math.ceil(len(maps) / MAPS_PER_ROW)
    figure = drawing.create_figure(2.4 * rows + drawing.FOOTER, topography)
    grid = figure.subplots(rows, MAPS_PER_ROW, squeeze=False).ravel()
    for axes, letter, (surface, state, scan) in zip(grid, ascii_lowercase, maps, strict=False):
        heights = panels.centred_heights(scan)
        surface_data = topography.sel(surface=surface)
        panels.draw_map(axes, heights, surface_data["scan_size"].item(), colours[surface])
        title = f"{surface_data['label'].item()}{state}\nrms {np.std(heights, dtype=float):.1f} nm"
        style.label_panel(axes, letter, title)
    for axes in grid[len(maps) :]:
        axes.set_axis_off()
    return figure
