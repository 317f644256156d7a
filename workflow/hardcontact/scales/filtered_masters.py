"""Forces on masters, whole and filtered at every cutoff wavelength; those of all masters."""

from collections.abc import Callable, Mapping
from typing import Any, TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION, Axis
from hardcontact.records.dataset import stack
from hardcontact.records.log import progress
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap

__all__ = ["CONTACT_AXES", "Cutoffs", "forces_at_cutoffs", "stacked_forces", "with_transitions"]

#: Forces that have these dimensions are averaged over them before a ratio is taken.
CONTACT_AXES = ("contact_y", "contact_x")


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
    forces: Callable[[HeightMap], NDArray[np.float64]],
    axes: Mapping[str, Axis],
) -> xr.Dataset:
    """Return the forces on a master, whole and filtered at every cutoff.

    Parameters
    ----------
    master : HeightMap
        Periodic.
    side : str
        ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
    scales : Cutoffs
        The filters.
    forces : callable
        Takes a filtered surface and returns its forces (...) in N at 1 J/m². No surface is kept
        while the next one is filtered.
    axes : mapping of str to Axis
        The dimensions of the forces, in their order, with their coordinates.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (cutoff_wavelength, ...), ``unfiltered_pull_off_force`` (...) and
        ``unfiltered_wavelength``, the end of the unfiltered spectrum.
    """
    cutoffs: list[float | None] = [None, *scales["cutoffs"]]
    surfaces = filtered_series(master, side, cutoffs, scales["pixels"])
    unfiltered, *filtered = progress(map(forces, surfaces), len(cutoffs), "cutoffs")
    end = 2 * master.size / scales["pixels"] if side == "small" else master.size
    nanometres = {"units": "nm", "long_name": "end of the unfiltered spectrum"}
    cutoff_axis = (("cutoff_wavelength",), np.asarray(scales["cutoffs"], float), {"units": "nm"})
    return xr.Dataset(
        {
            "unfiltered_pull_off_force": (tuple(axes), unfiltered, FORCE),
            "pull_off_force": (("cutoff_wavelength", *axes), np.array(filtered), FORCE),
            "unfiltered_wavelength": ((), end, nanometres),
        },
        {"cutoff_wavelength": cutoff_axis, **axes},
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def stacked_forces(masters: Mapping[tuple[Any, ...], xr.Dataset]) -> xr.Dataset:
    """Return the forces on all filtered masters, and their ratios to those on the whole ones.

    Parameters
    ----------
    masters : mapping of tuple to xarray.Dataset
        (surface, realization, side) -> `forces_at_cutoffs`.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (surface, realization, side, cutoff_wavelength, ...), NaN at cutoffs of
        the other side, ``unfiltered_pull_off_force`` (surface, realization, side, ...),
        ``unfiltered_wavelength`` (surface, side) and ``ratio`` (surface, realization, side,
        cutoff_wavelength, ...) of the means over contacts.
    """
    stacked = stack(masters, ["surface", "realization", "side"]).sortby("cutoff_wavelength")
    contacts = [axis for axis in CONTACT_AXES if axis in stacked.dims]
    filtered, whole = (
        stacked[name].mean(contacts) for name in ("pull_off_force", "unfiltered_pull_off_force")
    )
    ratio = (filtered / whole).assign_attrs(
        units="1", long_name="mean pull-off force over that unfiltered"
    )
    ends = stacked["unfiltered_wavelength"].max("realization", keep_attrs=True)  # all are the same
    scales = stacked.assign(ratio=ratio, unfiltered_wavelength=ends)
    scales["cutoff_wavelength"].attrs = {"units": "nm", "long_name": "cutoff wavelength"}
    return scales


def with_transitions(scales: xr.Dataset, transitions: Mapping[str, float]) -> xr.Dataset:
    """Return forces of masters with the wavelength (nm) beyond which their roughness is artificial.

    Parameters
    ----------
    scales : xarray.Dataset
        Of `stacked_forces`.
    transitions : mapping of str to float
        By side, in nm.

    Returns
    -------
    xarray.Dataset
        With ``transition`` (side): below it on the small side, above it on the large one.
    """
    attributes = {"units": "nm", "long_name": "artificial roughness begins"}
    lengths = [transitions[str(side)] for side in scales["side"].values]
    return scales.assign(transition=("side", lengths, attributes))
