"""Substitutes: random surfaces in place of surfaces of the paper that were not measured here.

A substitute has a spectrum calibrated on Table 1, a grid of scans, and targets: the published
statistics that batches of its scans meet.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base import published
from hardcontact.base.arrays import generator
from hardcontact.base.dataset import read_dataset
from hardcontact.surfaces.metrics import TABLE1_METRICS
from hardcontact.surfaces.spectrum import Spectrum, spectrum_of_dataset
from hardcontact.surfaces.synthesis import ScanGrid
from hardcontact.surfaces.table1_calibration import AFM_ROWS, expected_scan_rms, scan_rms_weights


class Targets(NamedTuple):
    """The statistics that a batch of scans of one surface meets."""

    means: Mapping[str, float]  #: Mean height, slope and curvature, by `metrics.METRICS`.
    rms_height_std: float  #: Standard deviation of the rms heights in nm (ddof 1).
    met_rows: tuple[str, ...]  #: Names of the rows of Table 1 that these targets meet.


@dataclass(frozen=True, eq=False)
class Substitute:
    """A substitute: its spectrum, its published statistics, and the grid of its scans."""

    surface_name: str
    spectrum_data: xr.Dataset  #: Its calibrated spectrum, from `substitute_spectrum`.
    table1: pd.DataFrame  #: Its rows of Table 1, from `rows_of_surface`.
    constants: pd.DataFrame  #: Numbers of the paper, from `read_constants`.
    grid: ScanGrid  #: Pixels and size of its scans.
    seed: int  #: Seed of the study.

    def generator(self, *names: object) -> np.random.Generator:
        """Return the random generator of one sampled quantity of the surface."""
        return generator(self.seed, self.surface_name, *names)

    @cached_property
    def spectrum(self) -> Spectrum:
        """The calibrated C_iso."""
        return spectrum_of_dataset(self.spectrum_data)

    @cached_property
    def targets(self) -> Targets | None:
        """Targets of scans on the study's pixels; None if no rms height is published.

        They are the calibrated rows of Table 1: the rms height of scans of the paper's size, slope
        and curvature of scans with its pixels, too. Others are expected values of the spectrum.
        """
        if "afm_rms_height" not in self.table1.index:
            return None
        grid = self.grid
        paper_constants = self.constants["value"]
        same_size = math.isclose(grid.size, paper_constants["scan_size"])
        same_pixels = same_size and grid.pixels == paper_constants["scan_pixels"]
        rms_values = np.array(self.spectrum_data.attrs["expected_scan_rms"])
        if not same_pixels:
            # Waves up to four times the scan's width change its heights, although it is levelled.
            weights = scan_rms_weights(4 * grid.pixels, grid.pixel_size, grid.pixels)
            rms_values = expected_scan_rms(self.spectrum, weights)
        calibrated_rows = self.spectrum_data.attrs["table1_rows_met"].split(",")
        holds_on_grid = dict(zip(AFM_ROWS, (same_size, same_pixels, same_pixels), strict=True))
        met_rows = [row for row in AFM_ROWS if holds_on_grid[row] and row in calibrated_rows]
        for row in met_rows:
            rms_values[AFM_ROWS.index(row)] = self.table1.loc[row, "value"]
        height = self.table1.loc["afm_rms_height"]
        return Targets(
            means=dict(zip(TABLE1_METRICS.values(), rms_values.tolist(), strict=True)),
            rms_height_std=float(rms_values[0] * height["uncertainty"] / height["value"]),
            met_rows=tuple(met_rows),
        )


def read_substitute(
    surface_name: str, paths: Sequence[str], grid: Mapping[str, Any], seed: int
) -> Substitute:
    """Read a substitute from the paths of its spectrum, of Table 1 and of the paper's constants."""
    spectrum_path, table1_path, constants_path = paths
    table1 = published.rows_of_surface(published.read_table1(table1_path), surface_name)
    constants = published.read_constants(constants_path)
    spectrum_data = read_dataset(spectrum_path)
    return Substitute(surface_name, spectrum_data, table1, constants, ScanGrid(**grid), seed)


def required_targets(substitute: Substitute) -> Targets:
    """Return the targets of a substitute; raises ValueError if it has no published rms height."""
    if substitute.targets is None:
        raise ValueError(
            f"{substitute.surface_name}: expected afm_rms_height in resources/paper/table1.csv, "
            "found none"
        )
    return substitute.targets
