"""How high above the mean planes pull-off forces put the apex of the sphere.

A sphere whose apex stays at the height m above the mean plane of Gaussian roughness of the rms
height sigma feels the force 2 pi R W exp(sigma²/2 rho² - m/rho) Phi(m/sigma - sigma/rho): the
points below the sphere, each with Eq. 1. A force therefore tells m, for every rho and W. Forces of
few points that touch are larger, so that m is compared with that of computed forces by the same
formula.
"""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.paper import error_map
from hardcontact.surfaces.spectrum import Floats
from hardcontact.theory.closed_form import gaussian_share

#: Number of heights of the apex, and the highest in rms heights and in ranges of adhesion.
TABULATED_HEIGHTS = 20001
HIGHEST_IN_RMS, HIGHEST_IN_RANGES = 10, 40
STATISTICS = ["mean", "median"]
#: The work of adhesion: the published one, or that which fits all forces best at each range.
WORKS = ["published", "fitted"]
NM = {"units": "nm"}


def apex_height(share: Floats, rms_height: float, rho: float) -> Floats:
    """Return the height m (...) in nm at which the points of a surface attract with a force.

    The force (...) is a share of 2 pi R W, the rms height and rho are in nm. Only heights count
    beyond that of the largest force: closer to the surface fewer points lie below the sphere. NaN
    where no height gives as large a force.
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
    """Return the heights of the apex that follow from published and from computed forces.

    Parameters
    ----------
    adhesion : xarray.Dataset
        As adhesion.nc, of one contact model.
    published : pandas.DataFrame
        ``mean_force`` and ``median_force`` in N by surface.
    work : float
        The published work of adhesion in J/m².
    rms_heights : pandas.Series
        By surface in nm, of the substrate and the sphere together.

    Returns
    -------
    xarray.Dataset
        Over (surface, statistic, rho) in nm ``computed_height``, from the forces computed, which
        does not depend on W; over work_of_adhesion, too, ``required_height``, from the published
        ones. Over surface ``rms_height``, over rho the ``fitted_work`` in J/m².
    """
    forces = adhesion["pull_off_force"].stack(
        contact=["scan", "sphere_scan", "contact_y", "contact_x"]
    )
    computed = xr.concat([forces.mean("contact"), forces.median("contact")], "statistic")
    computed = computed.transpose("surface", "statistic", "rho")
    surfaces, ranges = computed["surface"].values, computed["rho"].values
    measured = published.loc[surfaces, [f"{name}_force" for name in STATISTICS]].to_numpy()
    fitted, _ = error_map.fit_work(computed.isel(statistic=0).values, measured[:, 0])
    smooth = float(dmt_pull_off(1.0, adhesion.attrs["sphere_radius"]))
    works = np.stack([np.full(ranges.size, work), fitted])
    required = np.empty((surfaces.size, len(STATISTICS), len(WORKS), ranges.size))
    of_computed = np.empty(computed.shape)
    for place, surface in enumerate(surfaces):
        for column, rho in enumerate(ranges):
            height = rms_heights[surface]
            measured_shares = measured[place, :, None] / (smooth * works[:, column])
            required[place, :, :, column] = apex_height(measured_shares, height, rho)
            computed_shares = computed.values[place, :, column] / smooth
            of_computed[place, :, column] = apex_height(computed_shares, height, rho)
    return xr.Dataset(
        {
            "required_height": (("surface", "statistic", "work_of_adhesion", "rho"), required, NM),
            "computed_height": (("surface", "statistic", "rho"), of_computed, NM),
            "fitted_work": ("rho", fitted, {"units": "J m-2"}),
            "rms_height": ("surface", rms_heights[surfaces].to_numpy(), NM),
        },
        {"statistic": STATISTICS, "work_of_adhesion": WORKS, "rho": computed["rho"]},
    ).assign(adhesion[["label", "basis"]])
