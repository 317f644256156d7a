"""Work of adhesion that measured forces mean, with the roughness continued beyond the scans."""

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.continued_force import PLASTIC
from hardcontact.statistics import bounds, with_interval

__all__ = ["with_continued_work"]


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
