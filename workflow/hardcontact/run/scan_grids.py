"""The grids of the scans of a study: pixels, size and relief, which limit the keys of the study."""

from glob import escape, glob
from typing import Any

import numpy as np
import pandas as pd

from hardcontact.config.configuration import reading_keys
from hardcontact.config.limits import PIXEL_SIZES, same_grid
from hardcontact.contact.numerical_limits import Grid
from hardcontact.files.patterns import MEASUREMENT
from hardcontact.records.origin import canonical_json, is_current
from hardcontact.scans.reading import read_scan
from hardcontact.surfaces.height_map import HeightMap, load_height_map, refuse_line_scan
from hardcontact.surfaces.substitute_spectra import (
    described_rms_height,
    needs_calibration,
    read_segments,
)

#: Upper bound on the differences in height between contacts on a substitute for a surface of the
#: paper, in nm: about five times the largest rms height (MCD).
SUBSTITUTE_RELIEF = 500.0
#: The same bound relative to the rms height of all waves of a domain. The largest ratio on 24
#: random surfaces of 10 to 40 um, from descriptions of 18 to 850 nm rms, was 3.7; this is a fifth
#: more.
RELIEF_OVER_RMS = 4.5


def stored_scan(config: dict[str, Any], row: Any) -> HeightMap:
    """Return a measured scan of a row of the table, as `read_scan` reads it.

    The rule read_scan stores scans, so that a file is read here only if it, its keys or the code
    changed.
    """
    file = MEASUREMENT.format(surface=row.surface, scan=row.scan, digest="*")
    arguments = reading_keys(config) | {"dataset": row.dataset}
    for stored_path in glob(f"{escape(config['store'])}/measurements/*/{file}"):
        if is_current(stored_path, canonical_json(arguments), row.path):
            return load_height_map(stored_path)
    return read_scan(row.path, **arguments)


def surface_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    """Return the grid of the scans of a surface, with the largest relief on scans or masters."""
    path = rows.path.iloc[0]
    if rows.source.iloc[0] == "substitute":
        pixels = config["substitutes"]["pixels"]
        size = config["substitutes"]["size"]
        relief = SUBSTITUTE_RELIEF
        if not needs_calibration(read_segments(path)):
            largest = 2 * size * config["scales"]["long"]["tiles"]
            relief = RELIEF_OVER_RMS * described_rms_height(path, largest)
        grid = Grid(pixels, size / pixels, size, relief)
        location = "config key substitutes.size"
    else:
        grid = _measured_grid(config, surface, rows)
        location = path
    low, high = PIXEL_SIZES
    if not low <= grid.pixel_size <= high:
        raise ValueError(
            f"{location}: expected pixels of {low:g} to {high:g} nm, where spectra are known, "
            f"found {grid.pixel_size:.6g} nm"
        )
    return grid


def _measured_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    """Return the grid of the measured scans of a surface."""
    grids: list[Grid] = []
    for row in rows.itertuples():
        scan = stored_scan(config, row)
        refuse_line_scan(scan)
        relief = float(np.ptp(scan.heights))
        if relief == 0:
            raise ValueError(f"{row.path}: expected a rough surface, found constant height")
        grids.append(Grid(scan.pixels, scan.pixel_size, scan.size, relief))
        if not same_grid(grids[0], grids[-1]):
            raise ValueError(
                f"{row.path}: expected, as in the first scan of {surface}, "
                f"{grids[0].pixels} pixels of {grids[0].pixel_size:.4g} nm; "
                f"found {scan.pixels} of {scan.pixel_size:.4g} nm"
            )
    return grids[0]._replace(relief=max(grid.relief for grid in grids))
