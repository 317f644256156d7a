"""Forces on own surfaces, and works of adhesion, with roughness continued beyond the scans."""

import numpy as np
import xarray as xr

from hardcontact.numbers.statistics import bounds, with_interval
from hardcontact.own_surfaces.master_forces import (
    Masters,
    forces_of_masters,
    half_width_over_masters,
)
from hardcontact.own_surfaces.scan_parts import logarithmic_interval
from hardcontact.records.dataset import stack
from hardcontact.surfaces.synthesis import SIDES

__all__ = ["PLASTIC", "continued_force", "with_continued_force", "with_continued_work"]

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


def with_continued_work(fitted: xr.Dataset, force: xr.Dataset) -> xr.Dataset:
    """Return a fit to measured forces with the works of adhesion at the range that is asked for.

    The work is a measured force over that computed at 1 J/m². Where continued roughness changes the
    computed force by a factor, it changes the work by one over that: W F_scan/F_continued. Masters
    were computed at one range and in plastic contact alone, so that this is no curve.

    Parameters
    ----------
    fitted : xarray.Dataset
        Of `fit_measured`: measured_force (surface) in N with its interval.
    force : xarray.Dataset
        Predicted forces, as in force.nc, over the same surfaces and others.

    Returns
    -------
    xarray.Dataset
        With ``continued_work`` (surface, side) in J/m² and its interval: relative ends of measured
        and computed force, which are independent, are added as squares of their logarithms. With
        ``continued_differs`` and ``transition`` of the forces, and the attribute
        ``range_of_adhesion``, at which ``work_of_adhesion`` is to be compared.
    """
    of_fit = force.sel(surface=fitted.surface)
    measured, unit = fitted.measured_force, of_fit.continued_force / force.attrs["work_of_adhesion"]
    less, more = (np.log(end / measured) for end in bounds(fitted, "measured_force"))
    low, high = bounds(of_fit, "continued_force")
    above = np.log(high / of_fit.continued_force)
    below = np.log(low.where(low > 0) / of_fit.continued_force).where(low != 0, -np.inf)
    work = (measured / unit).transpose("surface", "side")
    ends = [-np.hypot(less, above), np.hypot(more, below)]
    interval = xr.concat([work * np.exp(end) for end in ends], "bound")
    return (
        fitted.assign(
            with_interval(
                "continued_work",
                ("surface", "side"),
                work.values,
                interval.transpose("surface", "side", "bound").values,
                {
                    "units": "J m-2",
                    "long_name": f"work with continued roughness, {PLASTIC} contact",
                },
                fitted.attrs["confidence"],
            )
        )
        .assign(continued_differs=of_fit.continued_differs, transition=of_fit.transition)
        .assign_attrs(range_of_adhesion=force.attrs["range_of_adhesion"])
    )
