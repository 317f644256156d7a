"""The height map of a surface as it is shown on its page."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from hardcontact.answer import canvas
from hardcontact.figures.style import draw_map


def heights_shown(of_surface: xr.Dataset) -> np.ndarray:
    """Return the heights (row, column) in nm about their mean, without rows that only pad them."""
    example = of_surface["example_heights"].dropna("row", how="all").dropna("column", how="all")
    heights: np.ndarray = example.values - example.values.mean()
    return heights


@canvas.canvas_style()
def draw(of_surface: xr.Dataset) -> Figure:
    """Draw the first levelled scan of a surface.

    Parameters
    ----------
    of_surface : xarray.Dataset
        Part of topography.nc: `example_heights` (row, column) and `scan_size`, in nm.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = canvas.create(3.7)
    draw_map(figure.subplots(), heights_shown(of_surface), of_surface["scan_size"].item())
    return figure
