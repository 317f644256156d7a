"""Whether plasticity and a long range of adhesion enhance each other: edges with and without them.

Source: the paper, Determining the Most Relevant Length-scales of Roughness.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import SampledVariable, add_intervals, sampled_band
from hardcontact.base.statistics import Sampling

#: Contact models in the order of their areas, the smallest first.
CONTACT_MODELS = ["rigid", "plastic"]


def bands_by_contact(forces: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return the critical band of plastic and rigid contact at each range of adhesion.

    forces: from `stacked_forces`, with a single radius, rho, and two loads: plastic and rigid.
    tolerance: relative change of the force that counts.
    sampling: random numbers and confidence of the intervals.
    Returns `critical_band` by contact_model (CONTACT_MODELS) and rho. ``edge_ratio`` (without,
        side, group) with its interval: the edge in plastic contact at the longest range, relative
        to the edge in rigid contact at this range (``"plasticity"``) or to the edge in plastic
        contact at the shortest range (``"long_range"``).
    """
    sorted_forces = forces.squeeze("radius", drop=True).sortby("area")
    models = []
    edges = {}
    for load, model in enumerate(CONTACT_MODELS):
        bands_by_range = []
        for column, rho in enumerate(sorted_forces["rho"].values):
            contact = sorted_forces.isel(load=load, rho=column, drop=True)
            variables = sampled_band(contact, tolerance, sampling)
            bands_by_range.append(add_intervals(variables, contact, sampling))
            edges[model, rho] = variables["edge"]
        models.append(xr.concat(bands_by_range, sorted_forces["rho"]))
    bands = xr.concat(models, pd.Index(CONTACT_MODELS, name="contact_model"))
    return bands.merge(_edge_ratios(edges, sampling))


def _edge_ratios(
    edges: Mapping[tuple[str, float], SampledVariable], sampling: Sampling
) -> xr.Dataset:
    """Return ``edge_ratio`` and its interval, from edges by contact model and range of adhesion."""
    short, *_, long = sorted({rho for _, rho in edges})
    complete = edges["plastic", long]
    reduced_edges = {"plasticity": edges["rigid", long], "long_range": edges["plastic", short]}
    values = np.stack([complete.value / edge.value for edge in reduced_edges.values()])
    samples = np.stack([complete.samples / edge.samples for edge in reduced_edges.values()], axis=1)
    attributes = {
        "units": "1",
        "long_name": "edge relative to the edge without plasticity, or without the long range",
    }
    variables = sampling.with_interval(
        "edge_ratio", ("removed_cause", *complete.dimensions), values, samples, attributes
    )
    return xr.Dataset(variables, {"removed_cause": list(reduced_edges)})
