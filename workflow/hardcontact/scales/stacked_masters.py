"""The forces on all filtered masters of a study in one dataset, and their ratios."""

from collections.abc import Mapping
from typing import Any

import xarray as xr

from hardcontact.records.dataset import stack

#: Forces that have these dimensions are averaged over them before a ratio is taken.
CONTACT_AXES = ("contact_y", "contact_x")


def stacked_forces(masters: Mapping[tuple[Any, ...], xr.Dataset]) -> xr.Dataset:
    """Return the forces on all filtered masters, and their ratios to those on the whole ones.

    The masters are of `forces_at_cutoffs`, by (surface, realization, side). ``pull_off_force``
    (surface, realization, side, cutoff_wavelength, ...) is NaN at cutoffs of the other side;
    ``unfiltered_pull_off_force`` (surface, realization, side, ...), ``unfiltered_wavelength``
    (surface, side) and ``ratio`` (surface, realization, side, cutoff_wavelength, ...) of the means
    over contacts stand beside it.
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

    It is ``transition`` (side): below it on the small side, above it on the large one.
    """
    attributes = {"units": "nm", "long_name": "artificial roughness begins"}
    lengths = [transitions[str(side)] for side in scales["side"].values]
    return scales.assign(transition=("side", lengths, attributes))
