"""Short edges with and without plasticity and a long range of adhesion: `edge_shifts.nc`.

Source: the paper, Determining the Most Relevant Length-scales of Roughness.
"""

from itertools import product

import numpy as np
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_MODELS, PLASTIC, RIGID
from hardcontact.paper.edges_of_masters import edges_of_masters


def compute_edge_shifts(forces: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return the edges of the band of plastic and rigid contact at each range of adhesion.

    Forces come from `stack_masters`, with one radius and two loadings. ``edge_shift``
    (cause, side, group) is the edge in plastic contact at the longest range, relative to rigid
    contact at this range (``"plasticity"``) or to plastic contact at the shortest (``"range"``).
    """
    sorted_forces = forces.squeeze("radius", drop=True).sortby("contact_area")
    ranges = sorted_forces["rho"].values.tolist()
    datasets = {}
    edge_samples = {}
    for (index, model), (column, rho) in product(enumerate(CONTACT_MODELS), enumerate(ranges)):
        model_forces = sorted_forces.isel(loading=index, rho=column, drop=True)
        datasets[model, rho], edge_samples[model, rho] = edges_of_masters(
            model_forces, tolerance, sampling
        )
    edges = stack(datasets, ["contact_model", "rho"])
    complete = PLASTIC, max(ranges)
    reduced = {"plasticity": (RIGID, max(ranges)), "range": (PLASTIC, min(ranges))}
    ratios = [datasets[complete]["edge"] / datasets[key]["edge"] for key in reduced.values()]
    samples = [edge_samples[complete] / edge_samples[key] for key in reduced.values()]
    edge_shift = sampling.with_interval(
        "edge_shift", ("cause", "side", "group"), ratios, np.stack(samples, 1), DIMENSIONLESS
    )
    coordinates = {"rho": sorted_forces["rho"], "cause": list(reduced)}
    return edges.assign_coords(coordinates).assign(edge_shift)
