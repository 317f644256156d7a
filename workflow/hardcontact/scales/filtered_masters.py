"""Forces on a master, whole and filtered at every cutoff wavelength, as they are stored."""

from collections.abc import Callable, Mapping
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION
from hardcontact.records.log import progress
from hardcontact.records.netcdf import Arrays, Variable
from hardcontact.surfaces.filters import filtered
from hardcontact.surfaces.height_map import HeightMap

__all__ = ["Cutoffs", "forces_at_cutoffs"]


class Cutoffs(TypedDict):
    """What a master is filtered at.

    Attributes
    ----------
    pixels : int
        Along an edge of a filtered surface.
    cutoffs : list of float
        In nm.
    """

    pixels: int
    cutoffs: list[float]


def forces_at_cutoffs(
    master: HeightMap,
    side: str,
    scales: Cutoffs,
    mean_forces: Callable[[HeightMap], NDArray[np.float64]],
    axes: Mapping[str, Variable],
) -> Arrays:
    """Return the forces on a master, whole and filtered at every cutoff.

    Parameters
    ----------
    master : HeightMap
        Periodic.
    side : str
        ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
    scales : Cutoffs
        The filters.
    mean_forces : callable
        Takes a filtered surface and returns its forces (...) in N at 1 J/m².
    axes : mapping of str to Variable
        The dimensions of the forces, in their order, with their coordinates.

    Returns
    -------
    Arrays
        ``pull_off_force`` (cutoff_wavelength, ...), ``unfiltered_pull_off_force`` (...) and
        ``unfiltered_wavelength``, the end of the unfiltered spectrum.
    """
    cutoffs: list[float | None] = [None, *scales["cutoffs"]]
    unfiltered, *forces = (
        mean_forces(filtered(master, side, cutoff, scales["pixels"]))
        for cutoff in progress(cutoffs, len(cutoffs), "cutoffs")
    )
    end = 2 * master.size / scales["pixels"] if side == "small" else master.size
    nanometres = {"units": "nm", "long_name": "end of the unfiltered spectrum"}
    cutoff_axis = (("cutoff_wavelength",), np.asarray(scales["cutoffs"], float), {"units": "nm"})
    return Arrays(
        {
            "unfiltered_pull_off_force": (tuple(axes), unfiltered, FORCE),
            "pull_off_force": (("cutoff_wavelength", *axes), np.array(forces), FORCE),
            "unfiltered_wavelength": ((), end, nanometres),
        },
        {"cutoff_wavelength": cutoff_axis, **axes},
        {"work_of_adhesion": WORK_OF_ADHESION},
    )
