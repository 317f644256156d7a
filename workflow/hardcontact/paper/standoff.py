"""Heights of the sphere's apex above the mean planes, inferred from pull-off forces.

The apex is at the height m above the mean plane of Gaussian roughness of the rms height sigma. The
points below the sphere attract by Eq. 2, together with the force

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

#: Number of heights of the apex, and the highest in rms heights and in ranges of adhesion.
TABULATED_HEIGHTS = 20001
HIGHEST_IN_RMS, HIGHEST_IN_RANGES = 10, 40
STATISTICS = ["mean", "median"]
#: The work of adhesion: the published one, or that which fits all forces best at each range.
WORKS = ["published", "fitted"]
NM = {"units": "nm"}


def apex_height(share: Floats, rms_height: float, rho: float) -> Floats:
    """Return the height m (...) of the apex in nm that gives a force.

    The force (...) is a share of 2 pi R W. The rms height and rho are in nm. The height is NaN
    where every height gives a smaller force. Heights below that of the largest force are left out:
    there fewer points lie below the sphere.
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
        As adhesion.nc, of one contact model.
    published : pandas.DataFrame
        ``mean_force`` and ``median_force`` in N by surface.
    work : float
        The published work of adhesion in J/m².
    rms_heights : pandas.Series
        Root of the sum of the squares of substrate and sphere in nm, by surface.

    Returns
    -------
    xarray.Dataset
        ``computed_height`` (surface, statistic, rho) in nm follows from computed forces and does
        not depend on W. ``required_height`` (surface, statistic, work_of_adhesion, rho) in nm
        follows from published forces. ``rms_height`` (surface) is in nm.
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
    computed_height = np.empty(computed.shape)
    for row, surface in enumerate(surfaces):
        for column, rho in enumerate(ranges):
            rms_height = rms_heights[surface]
            measured_shares = measured[row, :, None] / (smooth * works[:, column])
            required[row, :, :, column] = apex_height(measured_shares, rms_height, rho)
            computed_shares = computed.values[row, :, column] / smooth
            computed_height[row, :, column] = apex_height(computed_shares, rms_height, rho)
    return xr.Dataset(
        {
            "required_height": (("surface", "statistic", "work_of_adhesion", "rho"), required, NM),
            "computed_height": (("surface", "statistic", "rho"), computed_height, NM),
            "rms_height": ("surface", rms_heights[surfaces].to_numpy(), NM),
        },
        {"statistic": STATISTICS, "work_of_adhesion": WORKS, "rho": computed["rho"]},
    ).assign(adhesion[["label", "basis"]])
