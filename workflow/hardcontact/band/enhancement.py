"""Whether plasticity and a long range of adhesion enhance each other: edges with and without them.

Source: the paper, Determining the Most Relevant Length-scales of Roughness.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import Sampled, sampled_band, with_intervals
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
        `critical_band` over contact_model (CONTACTS) and rho, and ``edge_ratio`` (without, side,
        group) with its interval: the edge of plastic contact at the longest range over that without
        plasticity, at the same range, or without the long range, in plastic contact.
    """
    by_area = forces.squeeze("radius", drop=True).sortby("area")
    models = []
    edges = {}
    for load, model in enumerate(CONTACTS):
        ranges = []
        for column, rho in enumerate(by_area["rho"].values):
            contact = by_area.isel(load=load, rho=column, drop=True)
            variables = sampled_band(contact, tolerance, sampling)
            ranges.append(with_intervals(variables, contact, sampling))
            edges[model, rho] = variables["critical_wavelength"]
        models.append(xr.concat(ranges, by_area["rho"]))
    bands = xr.concat(models, pd.Index(CONTACTS, name="contact_model"))
    return bands.merge(_edge_ratios(edges, sampling))


def _edge_ratios(edges: Mapping[tuple[str, float], Sampled], sampling: Sampling) -> xr.Dataset:
    """Return the variables of ``edge_ratio``, of edges by contact model and range of adhesion."""
    short, *_, long = sorted({rho for _, rho in edges})
    complete = edges["plastic", long]
    without = {"plasticity": edges["rigid", long], "long_range": edges["plastic", short]}
    values = np.stack([complete.value / edge.value for edge in without.values()])
    samples = np.stack([complete.samples / edge.samples for edge in without.values()], axis=1)
    attributes = {"units": "1", "long_name": "edge of the band over that without a cause"}
    variables = sampling.with_interval(
        "edge_ratio", ("without", *complete.dimensions), values, samples, attributes
    )
    return xr.Dataset(variables, {"without": list(without)})
