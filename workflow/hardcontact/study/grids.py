"""The pixels that the scans of a surface have."""

import math
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from hardcontact.surfaces.scans import read_scan
from hardcontact.surfaces.substitute_spectra import described_rms_height, is_calibrated

__all__ = ["PIXEL_SIZES", "Grid", "surface_grid"]

#: Pixel sizes in nm at which spectra are known: tables and bins end at 0.1 nm and 100 um.
PIXEL_SIZES = (0.05, 1e4)
#: Upper bound on the differences in height between contacts on a substitute for a surface of the
#: paper, in nm: five times the rms height of the roughest.
SUBSTITUTE_RELIEF = 500.0
#: The same bound over the rms height of all waves of a domain: 3.7 was found at most on 24 random
#: surfaces of 10 to 40 um, from descriptions of 18 to 850 nm rms; a fifth more for others.
RELIEF_OVER_RMS = 4.5


class Grid(NamedTuple):
    """What all scans of a surface share.

    Attributes
    ----------
    pixels : int
        Pixels along an edge.
    pixel_size : float
        Edge of a pixel in nm.
    size : float
        Edge of the scan in nm.
    relief : float
        Largest difference in height in nm.
    """

    pixels: int
    pixel_size: float
    size: float
    relief: float


def surface_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    """Return the grid of the scans of a surface; measured scans are read.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    surface : str
        Id of the surface.
    rows : pandas.DataFrame
        Its rows in the table of surfaces.

    Returns
    -------
    Grid
        Relief of measured scans: the largest of them; of substitutes that of their largest master.

    Raises
    ------
    ValueError
        In one line, if a scan cannot be used or has other pixels than the first.
    """
    if rows.source.iloc[0] == "substitute":
        pixels, size = config["scan"]["pixels"], config["scan"]["size"]
        relief = _substitute_relief(config, rows.path.iloc[0])
        grid, where = Grid(pixels, size / pixels, size, relief), "config key scan.size"
    else:
        grid, where = _measured_grid(config, surface, rows), rows.path.iloc[0]
    least, most = PIXEL_SIZES
    if not least <= grid.pixel_size <= most:
        raise ValueError(
            f"{where}: expected pixels of {least:g} to {most:g} nm, where spectra are known, "
            f"found {grid.pixel_size:.6g} nm"
        )
    return grid


def _substitute_relief(config: dict[str, Any], path: str) -> float:
    """Return a bound on the differences in height (nm) of contacts on the largest master."""
    if is_calibrated(pd.read_csv(path)):
        return SUBSTITUTE_RELIEF
    period = 2 * config["scan"]["size"] * config["scales"]["large"]["tiles"]
    return RELIEF_OVER_RMS * described_rms_height(path, period)


def _measured_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    grids: list[Grid] = []
    for path, dataset in zip(rows.path, rows.dataset, strict=True):
        scan = read_scan(path, dataset, config["scan"]["undefined_pixels"])
        relief = float(np.ptp(scan.heights))
        if relief == 0:
            raise ValueError(f"{path}: expected a rough surface, found constant height")
        grids.append(Grid(scan.pixels, scan.pixel_size, scan.size, relief))
        first, last = grids[0], grids[-1]
        same_size = math.isclose(last.pixel_size, first.pixel_size, rel_tol=1e-3)
        if last.pixels != first.pixels or not same_size:
            raise ValueError(
                f"{path}: expected, as in the first scan of {surface}, "
                f"{first.pixels} pixels of {first.pixel_size:.4g} nm; "
                f"found {last.pixels} of {last.pixel_size:.4g} nm"
            )
    return grids[0]._replace(relief=max(grid.relief for grid in grids))
