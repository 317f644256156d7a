"""Range and work of adhesion, fitted with one surface left out at a time."""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact.force_curves import interpolate_to_ranges
from hardcontact.paper import error_map
from hardcontact.paper.inference import FINE_RANGE_COUNT, INFERRED_UNITS

#: Label of the fit to all surfaces.
NONE_LEFT_OUT = "none"


def fitted_pairs(mean_forces: xr.DataArray, published_mean_forces: pd.Series) -> xr.Dataset:
    """Fit range and work of adhesion to the mean forces of several surfaces.

    mean_forces: forces (..., surface, rho) in N at 1 J/m²; each element of the other dimensions has
        its fit.
    published_mean_forces: measured mean forces in N by surface. Surfaces without a force do not
        enter the fit.
    Returns ``range_of_adhesion`` (...) in nm, ``work_of_adhesion`` (...) in J/m² and ``best_error``
        (...), the mean relative error of the fitted forces.
    """
    targets = published_mean_forces.reindex(mean_forces["surface"].values).dropna()
    dimensions = [dim for dim in mean_forces.dims if dim not in ("surface", "rho")]
    forces = mean_forces.sel(surface=targets.index).transpose(*dimensions, "surface", "rho")
    ranges = forces["rho"].values
    fine_ranges = np.geomspace(ranges[0], ranges[-1], FINE_RANGE_COUNT)
    curves = interpolate_to_ranges(forces.values, ranges, fine_ranges)
    best_index, work, error = error_map.fit_range_and_work(curves, targets.to_numpy())
    values = {
        "range_of_adhesion": fine_ranges[best_index], "work_of_adhesion": work, "best_error": error,
    }  # fmt: skip
    return xr.Dataset(
        {name: (dimensions, value, INFERRED_UNITS[name]) for name, value in values.items()},
        {dim: forces[dim] for dim in dimensions},
    )


def leave_one_out_fits(mean_forces: xr.DataArray, published_mean_forces: pd.Series) -> xr.Dataset:
    """Return the `fitted_pairs` for all surfaces, and without one surface at a time.

    mean_forces: as for `fitted_pairs`.
    published_mean_forces: as for `fitted_pairs`.
    Returns the variables of `fitted_pairs` by left_out: NONE_LEFT_OUT, then each surface.
    """
    surfaces = mean_forces["surface"].values.tolist()
    fits = [fitted_pairs(mean_forces, published_mean_forces)]
    fits += [
        fitted_pairs(mean_forces.drop_sel(surface=name), published_mean_forces) for name in surfaces
    ]
    return xr.concat(fits, pd.Index([NONE_LEFT_OUT, *surfaces], name="left_out"))
