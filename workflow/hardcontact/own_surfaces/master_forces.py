"""Forces on the masters of one surface: how surely their means are known.

A master is a scan with artificial roughness, of which each realization draws its own. The mean over
realizations therefore varies with the scans and, on the same scans, with the random numbers.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.scan_parts import (
    Parts,
    Variance,
    half_width,
    jackknife_variance,
    parts_of_scans,
    quarters_of_contacts,
)

CONTACTS = ("contact_y", "contact_x")


class Masters(NamedTuple):
    """The number of scans of each surface, and of mirrored scans along an edge of a large master.

    Realization r is made of scan (r - 1) modulo the number of scans.
    """

    scans: Mapping[str, int]
    tiles: int


class MasterForces(NamedTuple):
    """Forces on the masters of one surface and side, parts of the scans, longest wavelength in nm.

    The forces are ``pull_off_force`` (realization, cutoff_wavelength, contact_y, contact_x) and
    ``unfiltered_pull_off_force`` (realization, contact_y, contact_x), in N at 1 J/m², and ``ratio``
    of their means over contacts.
    """

    forces: xr.Dataset
    parts: Parts
    cell: float


def forces_of_masters(
    scales: xr.Dataset, surface: str, side: str, masters: Masters
) -> MasterForces:
    """Return the forces, as in scales.nc, on the masters there are of one surface and side."""
    cell = float(scales.unfiltered_wavelength.sel(surface=surface, side="large"))
    tiles = masters.tiles if side == "large" else 1
    cell *= tiles / masters.tiles
    forces = scales.sel(surface=surface, side=side).dropna(
        "realization", how="all", subset=["ratio"]
    )
    parts = parts_of_scans(
        (forces.realization.values - 1) % masters.scans[surface],
        quarters_of_contacts(forces.sizes["contact_y"], tiles),
        cell / tiles / 2,
        float(np.sqrt(scales.attrs["sphere_radius"] * scales.attrs["rho"])),
    )
    return MasterForces(forces, parts, cell)


def half_width_over_masters(
    given: MasterForces,
    statistic: Callable[[xr.DataArray, xr.DataArray], xr.DataArray],
    confidence: float,
) -> np.ndarray:
    """Return the half width of the interval of the logarithm of a mean over masters.

    Three scans or more differ in their realizations too, so that their scatter holds that of the
    artificial roughness. The quarters of one or two scans share their realizations: long waves run
    through all quarters, and another seed moves all of them at once. The variance of a mean over
    realizations is added, whatever part of it the quarters hold already: rather too wide an
    interval than one that leaves out the choice of random numbers.

    The statistic is of the mean forces of a master with and without a filter, (realization, ...),
    which it keeps; the half width is (...).
    """
    parts = given.parts
    left_out = [
        np.log(_of_masters(given, parts.of_contact != part, statistic).mean("realization").values)
        for part in range(len(parts.correlation))
    ]
    sources = [jackknife_variance(np.array(left_out), parts)]
    count = given.forces.sizes["realization"]
    if parts.conditional and count > 1:
        logarithms = np.log(_of_masters(given, np.isfinite(parts.of_contact), statistic).values)
        sources.append(Variance(logarithms.var(axis=0, ddof=1) / count, count - 1))
    return half_width(sources, confidence)


def _of_masters(
    given: MasterForces,
    kept: np.ndarray,
    statistic: Callable[[xr.DataArray, xr.DataArray], xr.DataArray],
) -> xr.DataArray:
    """Return the statistic (realization, ...) of the contacts (realization, y, x) that are kept."""
    mask = xr.DataArray(kept, dims=("realization", *CONTACTS))
    filtered, unfiltered = (
        given.forces[name].where(mask).mean(CONTACTS)
        for name in ("pull_off_force", "unfiltered_pull_off_force")
    )
    return statistic(filtered, unfiltered).transpose("realization", ...)
