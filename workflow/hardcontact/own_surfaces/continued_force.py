"""The force of own surfaces with the roughness continued beyond the wavelengths of their scans."""

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.master_forces import (
    Masters,
    forces_of_masters,
    half_width_over_masters,
)
from hardcontact.own_surfaces.scan_parts import logarithmic_interval
from hardcontact.records.dataset import stack
from hardcontact.statistics import bounds, with_interval
from hardcontact.surfaces.masters import SIDES

__all__ = ["PLASTIC", "continued_force", "with_continued_force"]

#: The contact model of the filtered masters.
PLASTIC = "plastic"


def continued_force(
    scales: xr.Dataset, masters: Masters, work: float, confidence: float
) -> xr.Dataset:
    """Return the mean force on masters with all their roughness, in plastic contact.

    Parameters
    ----------
    scales : xarray.Dataset
        Forces of the masters at 1 J/m², as in scales.nc.
    masters : Masters
        Scans and tiles.
    work : float
        Of adhesion in J/m².
    confidence : float
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        Over surface and side ``continued_force`` in N with its interval, from the same parts and
        realizations as the edges of the band, ``continued_note``, what that comes from, and
        ``continued_end`` in nm, the last wavelength: the shortest or the longest. Over side
        ``transition`` in nm, from which on the roughness is that of the spectrum.
    """
    parts = {
        (str(surface), side): _of_side(scales, str(surface), side, masters, work, confidence)
        for surface in scales.surface.values
        for side in SIDES
    }
    return stack(parts, ["surface", "side"]).assign(transition=scales.transition)


def _of_side(
    scales: xr.Dataset, surface: str, side: str, masters: Masters, work: float, confidence: float
) -> xr.Dataset:
    """Return the variables of one surface and side."""
    given = forces_of_masters(scales, surface, side, masters)
    force = work * given.forces.unfiltered_pull_off_force.mean().values
    half = half_width_over_masters(given, lambda filtered, whole: whole, confidence)
    end = float(scales.unfiltered_wavelength.sel(surface=surface, side=side))
    newton = {"units": "N", "long_name": "mean pull-off force with roughness continued"}
    return xr.Dataset(
        with_interval(
            "continued_force", (), force, logarithmic_interval(force, half), newton, confidence
        )
        | {
            "continued_note": given.note(),
            "continued_end": ((), end, {"units": "nm", "long_name": "last wavelength"}),
        }
    )


def with_continued_force(force: xr.Dataset, continued: xr.Dataset, tolerance: float) -> xr.Dataset:
    """Return predicted forces with those of continued roughness, and whether the two differ.

    Parameters
    ----------
    force : xarray.Dataset
        Of `predicted_force`.
    continued : xarray.Dataset
        Of `continued_force`, at the same work and at the range that is asked for.
    tolerance : float
        Relative change of the force that counts as none.

    Returns
    -------
    xarray.Dataset
        With the variables of `continued_force` and ``continued_differs`` (surface, side): 1 where
        the force with continued roughness lies outside the interval of that on the scans, or there
        is none, and the change is more than the tolerance; 0 where one number says both.
    """
    rho = force.attrs["range_of_adhesion"]
    of_scans = force.sel(contact_model=PLASTIC).sel(rho=rho, method="nearest", drop=True)
    low, high = bounds(of_scans, "force")
    other = continued.continued_force
    inside = (low <= other) & (other <= high)
    changed = np.abs(other / of_scans.force - 1) > tolerance
    differs = (changed & ~inside).drop_vars("contact_model").astype(int)
    return force.merge(continued).assign(continued_differs=differs.transpose("surface", "side"))
