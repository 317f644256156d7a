"""Heights of the sphere's apex above the mean planes, inferred from pull-off forces.

The apex is at the height m above the mean plane of Gaussian roughness of the rms height sigma. By
Eq. 2 all points below the sphere attract together with the force

    F = 2 pi R W exp(sigma²/2 rho² - m/rho) Phi(m/sigma - sigma/rho).

A force therefore gives m for every rho and W. The formula is too small where few points carry the
force. Published forces are therefore compared with computed forces by the same formula.
"""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.paper import error_map
from hardcontact.surfaces.spectrum import Floats
from hardcontact.theory.closed_form import gaussian_share

#: Number of tabulated heights of the apex; the highest one in rms heights plus ranges of adhesion.
TABULATED_HEIGHTS = 20001
HIGHEST_IN_RMS, HIGHEST_IN_RANGES = 10, 40
STATISTICS = ["mean", "median"]
#: Work of adhesion: the published work, or the work that fits all forces best at each range.
WORKS = ["published", "fitted"]
NM = {"units": "nm"}


def apex_height(share: Floats, rms_height: float, rho: float) -> Floats:
    """Return the height m of the apex that gives a force.

    Heights below the height of the largest force do not count: there fewer points lie below the
    sphere.

    Parameters
    ----------
    share : numpy.ndarray
        Force (...) relative to 2 pi R W.
    rms_height, rho : float
        Rms height and range of adhesion in nm.

    Returns
    -------
    numpy.ndarray
        Heights (...) in nm, NaN if every height gives a smaller force.
    """
    highest = HIGHEST_IN_RMS * rms_height + HIGHEST_IN_RANGES * rho
    heights = np.linspace(0, highest, TABULATED_HEIGHTS)
    shares = gaussian_share(rms_height, heights, rho)
    falling = slice(shares.argmax(), None)
    logarithm = -np.log(shares[falling])
    return np.interp(-np.log(share), logarithm, heights[falling], np.nan, np.nan)


def standoff(
    adhesion: xr.Dataset, published: pd.DataFrame, work: float, rms_heights: pd.Series
) -> xr.Dataset:
    """Infer the height of the apex from published and from computed forces.

    Parameters
    ----------
    adhesion : xarray.Dataset
        adhesion.nc for one contact model.
    published : pandas.DataFrame
        ``mean_force`` and ``median_force`` in N by surface.
    work : float
        The published work of adhesion in J/m².
    rms_heights : pandas.Series
        Root of the sum of the squared rms heights of substrate and sphere in nm, by surface.

    Returns
    -------
    xarray.Dataset
        ``height_from_computed`` (surface, statistic, rho) in nm follows from computed forces and
        does not depend on W. ``height_from_published`` (surface, statistic, work_source, rho) in nm
        follows from published forces. ``combined_rms_height`` (surface) is in nm.
    """
    forces = adhesion["pull_off_force"].stack(
        contact=["scan", "sphere_scan", "contact_y", "contact_x"]
    )
    computed_forces = xr.concat([forces.mean("contact"), forces.median("contact")], "statistic")
    computed_forces = computed_forces.transpose("surface", "statistic", "rho")
    surfaces = computed_forces["surface"].values
    ranges = computed_forces["rho"].values
    published_forces = published.loc[surfaces, [f"{name}_force" for name in STATISTICS]].to_numpy()
    fitted_work, _ = error_map.fit_work(
        computed_forces.isel(statistic=0).values, published_forces[:, 0]
    )
    smooth = float(dmt_pull_off(1.0, adhesion.attrs["sphere_radius"]))
    works = np.stack([np.full(ranges.size, work), fitted_work])
    required = np.empty((surfaces.size, len(STATISTICS), len(WORKS), ranges.size))
    height_from_computed = np.empty(computed_forces.shape)
    for row, surface in enumerate(surfaces):
        for column, rho in enumerate(ranges):
            rms_height = rms_heights[surface]
            measured_shares = published_forces[row, :, None] / (smooth * works[:, column])
            required[row, :, :, column] = apex_height(measured_shares, rms_height, rho)
            computed_shares = computed_forces.values[row, :, column] / smooth
            height_from_computed[row, :, column] = apex_height(computed_shares, rms_height, rho)
    return xr.Dataset(
        {
            "height_from_published": (("surface", "statistic", "work_source", "rho"), required, NM),
            "height_from_computed": (("surface", "statistic", "rho"), height_from_computed, NM),
            "combined_rms_height": ("surface", rms_heights[surfaces].to_numpy(), NM),
        },
        {"statistic": STATISTICS, "work_source": WORKS, "rho": computed_forces["rho"]},
    ).assign(adhesion[["label", "basis"]])
