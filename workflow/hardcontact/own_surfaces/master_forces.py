"""Forces on the masters of one surface: how surely their means are known.

A master is a scan with artificial roughness, of which each realization draws its own. The mean over
realizations therefore varies with the scans and, on the same scans, with the random numbers.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.scan_parts import (
    CONTACTS,
    Parts,
    Variance,
    half_width,
    jackknife_variance,
    left_out_logarithms,
    parts_of_scans,
    quarters_of_contacts,
)
from hardcontact.records.dataset import stack


class Masters(NamedTuple):
    """The number of scans of each surface, and of mirrored scans along an edge of a large master.

    Realization r is made of scan (r - 1) modulo the number of scans.
    """

    scans: Mapping[str, int]
    tiles: int


class MasterForces(NamedTuple):
    """Forces on the masters of one surface and side."""

    #: ``pull_off_force`` (realization, cutoff_wavelength, contact_y, contact_x) and
    #: ``unfiltered_pull_off_force`` (realization, contact_y, contact_x), in N at 1 J/m², and the
    #: ``ratio`` of their means over contacts.
    forces: xr.Dataset
    parts: Parts
    cell: float  #: The longest wavelength in nm.


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


def over_masters(
    scales: xr.Dataset, masters: Masters, found: Callable[[MasterForces], xr.Dataset]
) -> xr.Dataset:
    """Return what is found of the forces, as in scales.nc, over surface and side."""
    parts = {
        (surface, side): found(forces_of_masters(scales, surface, side, masters))
        for surface in scales.surface.values.tolist()
        for side in scales.side.values.tolist()
    }
    return stack(parts, ["surface", "side"])


def half_width_over_masters(
    given: MasterForces,
    statistic: Callable[[xr.DataArray, xr.DataArray], xr.DataArray],
    shift: str,
    confidence: float,
) -> np.ndarray:
    """Return the half width of the interval of the logarithm of a mean over masters.

    Three scans or more differ in their realizations too, so that their scatter holds that of the
    artificial roughness. The quarters of one or two scans share their realizations: another seed
    moves all of them at once. The variance of a mean over realizations is added, whatever part of
    it the quarters hold already: rather too wide an interval than one that leaves out the choice of
    random numbers.

    Another spectrum, which the measurements allow as well, moves all realizations at once, too: the
    mean square of its shifts, one a realization, is added as it is.

    The statistic is of the mean forces of a master with and without a filter, (realization, ...),
    which it keeps; its shifts (realization, ...) by another spectrum are a variable of the forces,
    if spectra were drawn. The half width is (...).
    """

    def of_masters(kept: xr.DataArray) -> xr.DataArray:
        """Return the statistic (realization, ...) of the contacts (realization, y, x) kept."""
        filtered, unfiltered = (
            given.forces[name].where(kept).mean(CONTACTS)
            for name in ("pull_off_force", "unfiltered_pull_off_force")
        )
        return statistic(filtered, unfiltered).transpose("realization", ...)

    left_out = left_out_logarithms(
        given.parts, "realization", lambda kept: of_masters(kept).mean("realization")
    )
    sources = [jackknife_variance(left_out, given.parts)]
    count = given.forces.sizes["realization"]
    if given.parts.conditional and count > 1:
        logarithms = np.log(of_masters(xr.DataArray(True)).values)
        sources.append(Variance(logarithms.var(axis=0, ddof=1) / count, count - 1))
    shifts = given.forces.get(shift)
    if shifts is not None and shifts.notnull().any():
        sources.append(Variance((shifts**2).mean("realization").values, count))
    return half_width(sources, confidence)
