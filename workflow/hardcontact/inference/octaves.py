"""The sensitivity d ln F / d ln a of the mean force F to the amplitude a of each octave of waves.

The amplitude of one octave is raised and lowered on the same surface: the ratio of both forces
scatters little, because all other waves are the same.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.number import Number
from hardcontact.base.statistics import as_variables
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import (
    FORCE_ATTRS,
    ForceFunction,
    make_force_function,
    pull_off_dataset,
)
from hardcontact.inference.scan_parts import ScanParts, log_force_ratio
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap

#: Limits of octaves in nm, from 0.08 nm to 1.3 mm: all wavelengths of spectra.
OCTAVE_LIMITS: Floats = np.ldexp(10.0, np.arange(-7, 18))
#: Relative change of an amplitude. With smaller steps single contact pixels would decide; with
#: larger ones the error of the central difference grows.
AMPLITUDE_STEP = 0.05
AMPLITUDE_FACTORS = (1 - AMPLITUDE_STEP, 1 + AMPLITUDE_STEP)
#: Number of octaves that an answer names, the strongest first.
NAMED_OCTAVE_COUNT = 3


def octave_limits(shortest: float, longest: float) -> Floats:
    """Return the OCTAVE_LIMITS above the shortest wavelength (nm) and up to the longest."""
    return OCTAVE_LIMITS[(OCTAVE_LIMITS > shortest) & (OCTAVE_LIMITS <= longest)]


def split_octaves(height_map: HeightMap, limits: Sequence[float] | Floats) -> Iterator[HeightMap]:
    """Yield the waves of a periodic surface from each limit (nm, ascending) to the next."""
    series = filtered_series(height_map, "short", list(limits), height_map.pixels)
    for waves, longer in pairwise(series):
        yield replace(height_map, heights=waves.heights - longer.heights)


def octave_force_dataset(
    height_map: HeightMap, limits: Sequence[float] | Floats, compute_forces: ForceFunction
) -> xr.Dataset:
    """Return ``octave_force`` with one octave multiplied by each of AMPLITUDE_FACTORS."""
    changed_map = replace(height_map, heights=np.empty_like(height_map.heights))  # reused

    def octave_forces(octave: HeightMap, factor: float) -> Floats:
        np.multiply(octave.heights, factor - 1, out=changed_map.heights)
        np.add(changed_map.heights, height_map.heights, out=changed_map.heights)
        return compute_forces(changed_map)

    octaves = split_octaves(height_map, limits)
    forces = [[octave_forces(octave, factor) for factor in AMPLITUDE_FACTORS] for octave in octaves]
    return xr.Dataset(
        {"octave_force": (("octave", "factor", *CONTACT_AXES), np.array(forces), FORCE_ATTRS)},
        {
            "octave": ("octave", np.asarray(limits[:-1]), NM),
            "factor": ("factor", list(AMPLITUDE_FACTORS), DIMENSIONLESS),
        },
        {"period": height_map.size},
    )


def whole_surface_forces(
    whole_surface: HeightMap, contact: Contact, ranges: list[float]
) -> xr.Dataset:
    """Return `octave_force_dataset`, and the mean ``pull_off_force`` (contact_model, rho) in N."""
    # The octave that holds the longest wave, the size of the surface, ends within twice the size.
    limits = octave_limits(2 * whole_surface.pixel_size, 2 * whole_surface.size)
    pull_off = pull_off_dataset(join_bodies(whole_surface, None, contact), contact, ranges)
    mean_force = pull_off["pull_off_force"].mean(CONTACT_AXES, keep_attrs=True)
    forces = octave_force_dataset(whole_surface, limits, make_force_function(contact))
    return forces.assign(pull_off_force=mean_force).assign_attrs(map_size=whole_surface.size)


def strongest_octaves(sensitivity: xr.Dataset) -> Iterator[Number]:
    """Yield shortest wavelength and sensitivity of the octaves that change the force most."""
    finite = sensitivity.dropna("octave", subset=["octave_sensitivity"])
    indices = np.argsort(-np.abs(finite["octave_sensitivity"].values))[:NAMED_OCTAVE_COUNT]
    for rank, index in enumerate(indices, start=1):
        octave = finite.isel(octave=index)
        low, high = octave.get("octave_sensitivity_interval", (np.nan, np.nan))
        value = float(octave["octave_sensitivity"])
        yield Number(f"octave_{rank}", float(octave["octave"]), "nm")
        yield Number(f"octave_{rank}_sensitivity", value, "1", float(low), float(high))


def octave_sensitivities(
    forces: xr.Dataset, scan_parts: ScanParts, confidence: float
) -> xr.Dataset:
    """Return ``octave_sensitivity`` (octave): a central difference of logarithms of mean forces.

    `forces` joins results of `octave_force_dataset` along ``map``.
    """
    octave_force = forces["octave_force"]
    weak, strong = (octave_force.sel(factor=factor, drop=True) for factor in AMPLITUDE_FACTORS)
    log_ratio, log_interval = log_force_ratio(strong, weak, scan_parts, confidence)
    sensitivity, interval = log_ratio / (2 * AMPLITUDE_STEP), log_interval / (2 * AMPLITUDE_STEP)
    variables = as_variables(
        "octave_sensitivity", "octave", sensitivity, interval, DIMENSIONLESS, confidence
    )
    map_size = ((), forces.attrs["map_size"], NM)
    return xr.Dataset(variables | {"map_size": map_size}, {"octave": forces["octave"]})
