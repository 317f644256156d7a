"""Range and work of adhesion fitted without one surface: which surface decides them."""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact.force_curves import on_fine_grid
from hardcontact.paper import error_map
from hardcontact.paper.inference import FINE_RANGES, UNITS

#: Stands for the fit to all surfaces, of which none is left out.
NONE_LEFT_OUT = "none"


def fitted_pairs(mean_forces: xr.DataArray, published: pd.Series) -> xr.Dataset:
    """Fit range and work of adhesion to the mean forces of several surfaces.

    Parameters
    ----------
    mean_forces : xarray.DataArray
        (..., surface, rho) in N at 1 J/m²; the other dimensions are fitted each by itself.
    published : pandas.Series
        Measured mean forces in N, by surface; those without one do not enter.

    Returns
    -------
    xarray.Dataset
        ``range_of_adhesion`` (...) in nm, ``work_of_adhesion`` in J/m² and ``best_error``, the
        mean relative error of the forces there.
    """
    measured = published.reindex(mean_forces["surface"].values).dropna()
    others = [dim for dim in mean_forces.dims if dim not in ("surface", "rho")]
    forces = mean_forces.sel(surface=measured.index).transpose(*others, "surface", "rho")
    ranges = forces["rho"].values
    fine = np.geomspace(ranges[0], ranges[-1], FINE_RANGES)
    curves = on_fine_grid(forces.values, ranges, fine)
    best, work, error = error_map.fit(curves, measured.to_numpy())
    values = {"range_of_adhesion": fine[best], "work_of_adhesion": work, "best_error": error}
    return xr.Dataset(
        {name: (others, value, UNITS[name]) for name, value in values.items()},
        {dim: forces[dim] for dim in others},
    )


def leave_one_out_fits(mean_forces: xr.DataArray, published: pd.Series) -> xr.Dataset:
    """Return the `fitted_pairs` of all surfaces, and of all but each one, over left_out.

    NONE_LEFT_OUT is first.
    """
    surfaces = mean_forces["surface"].values.tolist()
    fits = [fitted_pairs(mean_forces, published)]
    fits += [fitted_pairs(mean_forces.drop_sel(surface=name), published) for name in surfaces]
    return xr.concat(fits, pd.Index([NONE_LEFT_OUT, *surfaces], name="left_out"))
