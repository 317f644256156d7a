"""Range and work of adhesion fitted without one surface: which surface decides them."""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact.force_curves import on_fine_grid
from hardcontact.paper import error_map
from hardcontact.paper.inference import FINE_RANGES, UNITS

#: Stands for the fit to all surfaces, of which none is left out.
NONE_LEFT_OUT = "none"


def leave_one_out_fits(mean_forces: xr.DataArray, published: pd.Series) -> xr.Dataset:
    """Fit range and work of adhesion to all surfaces, and to all but each one.

    Parameters
    ----------
    mean_forces : xarray.DataArray
        (..., surface, rho) in N at 1 J/m²; the other dimensions are fitted each by itself.
    published : pandas.Series
        Measured mean forces in N, by surface.

    Returns
    -------
    xarray.Dataset
        ``range_of_adhesion`` (left_out, ...) in nm, ``work_of_adhesion`` in J/m² and
        ``best_error``, the mean relative error of the forces there. NONE_LEFT_OUT is first.
    """
    surfaces = [str(surface) for surface in mean_forces["surface"].values]
    others = [dim for dim in mean_forces.dims if dim not in ("surface", "rho")]
    forces = mean_forces.transpose(*others, "surface", "rho")
    ranges = forces["rho"].values
    fine = np.geomspace(ranges[0], ranges[-1], FINE_RANGES)
    curves = on_fine_grid(forces.values, ranges, fine)
    measured = published.reindex(surfaces).to_numpy()
    fits = []
    for left_out in [NONE_LEFT_OUT, *surfaces]:
        kept = np.array([surface != left_out for surface in surfaces])
        best, work, error = error_map.fit(curves[..., kept, :], measured[kept])
        values = {"range_of_adhesion": fine[best], "work_of_adhesion": work, "best_error": error}
        variables = {name: (others, value, UNITS[name]) for name, value in values.items()}
        fits.append(xr.Dataset(variables, {dim: forces[dim] for dim in others}))
    return xr.concat(fits, pd.Index([NONE_LEFT_OUT, *surfaces], name="left_out"))
