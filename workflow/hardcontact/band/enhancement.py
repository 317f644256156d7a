"""Whether plasticity and a long range of adhesion enhance each other: edges with and without them.

Source: the paper, Determining the Most Relevant Length-scales of Roughness.
"""

import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import critical_band
from hardcontact.base.statistics import Sampling

#: Contacts in the order of their areas, the smallest first.
CONTACTS = ["rigid", "plastic"]


def bands_by_contact(forces: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return the critical band of plastic and rigid contact at each range of adhesion.

    Parameters
    ----------
    forces : xarray.Dataset
        As from `stacked_forces`, over a single radius, two loads and rho. The rigid load is the one
        that a single pixel carries.
    tolerance : float
        Relative change of the force that counts.
    sampling : Sampling
        Of the intervals.

    Returns
    -------
    xarray.Dataset
        `critical_band` over contact_model (CONTACTS) and rho.
    """
    by_area = forces.squeeze("radius", drop=True).sortby("area")
    models = []
    for load in range(len(CONTACTS)):
        ranges = [
            critical_band(by_area.isel(load=load, rho=column, drop=True), tolerance, sampling)
            for column in range(by_area.sizes["rho"])
        ]
        models.append(xr.concat(ranges, by_area["rho"]))
    return xr.concat(models, pd.Index(CONTACTS, name="contact_model"))
