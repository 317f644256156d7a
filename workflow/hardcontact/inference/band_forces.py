"""The force with the waves of a band alone, or without those shorter or longer than its edges."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.base.statistics import as_variables
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import FORCE_ATTRS, ForceFunction
from hardcontact.inference.scan_parts import ScanParts, log_force_ratio
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.synthesis import SIDES

#: Parts of the roughness whose forces are compared with the force on all of it.
BAND_PARTS = ("only the band", "no shorter waves", "no longer waves")


def band_parts(height_map: HeightMap, band: tuple[float, float]) -> list[HeightMap]:
    """Return a periodic surface for each of BAND_PARTS; a band (nm) excludes its long edge."""
    series = filtered_series(height_map, "short", band, height_map.pixels)
    band_and_longer, longer = (waves.heights for waves in series)
    part_heights = (band_and_longer - longer, band_and_longer, height_map.heights - longer)
    return [replace(height_map, heights=heights) for heights in part_heights]


def band_force_dataset(
    height_map: HeightMap, bands: Mapping[str, tuple[float, float]], compute_forces: ForceFunction
) -> xr.Dataset:
    """Return ``force`` with all roughness of a surface, ``band_force`` with parts of each band."""
    part_forces = [
        [compute_forces(part) for part in band_parts(height_map, band)] for band in bands.values()
    ]
    return xr.Dataset(
        {
            "force": (CONTACT_AXES, compute_forces(height_map), FORCE_ATTRS),
            "band_force": (("band", "band_part", *CONTACT_AXES), part_forces, FORCE_ATTRS),
            "band_edge": (("band", "side"), np.array(list(bands.values())), NM),
        },
        {"band": list(bands), "band_part": list(BAND_PARTS), "side": list(SIDES)},
    )


def band_ratios(forces: xr.Dataset, scan_parts: ScanParts, confidence: float) -> xr.Dataset:
    """Return ``band_force_ratio`` (band, band_part): the force on a part relative to all roughness.

    `forces` joins results of `band_force_dataset` along ``map``.
    """
    log_ratio, log_interval = log_force_ratio(
        forces["band_force"], forces["force"], scan_parts, confidence
    )
    ratio, interval = np.exp(log_ratio), np.exp(log_interval)
    dimensions = ("band", "band_part")
    variables = as_variables(
        "band_force_ratio", dimensions, ratio, interval, DIMENSIONLESS, confidence
    )
    return xr.Dataset(variables, {name: forces[name] for name in dimensions})
