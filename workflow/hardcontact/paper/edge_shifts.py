"""Edges that plastic contact and a long range of adhesion shift: edge_shifts.nc."""

import numpy as np
import xarray as xr

from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_MODELS, PLASTIC, RIGID
from hardcontact.inference.edges_of_masters import edges_of_masters


def compute_edge_shifts(forces: xr.Dataset, tolerance: float, sampling: Sampling) -> xr.Dataset:
    """Return the edges of plastic and rigid contact at each range of adhesion, and their shifts.

    Forces come from `read_master_forces`, at one radius and load. Edges are (contact_model, rho,
    side, group). ``edge_shift`` (cause, side, group) is the edge of plastic contact at the longest
    range, relative to rigid contact (``"plasticity"``) or to the shortest range (``"range"``).
    """
    # Sorted by area, rigid contact is the first, as in CONTACT_MODELS: its area is zero.
    forces = forces.squeeze("radius", drop=True).sortby("contact_area").drop_vars("contact_area")
    forces = forces.rename(loading="contact_model").assign_coords(contact_model=CONTACT_MODELS)
    edges, sampled_edges = edges_of_masters(forces, tolerance, sampling)
    shortest, longest = forces["rho"].min().item(), forces["rho"].max().item()
    complete = sampled_edges.sel(contact_model=PLASTIC, rho=longest, drop=True)
    without_cause = {
        "plasticity": {"contact_model": RIGID, "rho": longest},
        "range": {"contact_model": PLASTIC, "rho": shortest},
    }
    shifts = [complete / sampled_edges.sel(labels, drop=True) for labels in without_cause.values()]
    edge_shift = sampling.sampled_variables(
        "edge_shift", ("cause", "side", "group"), np.stack(shifts, axis=1), DIMENSIONLESS
    )
    edge_shifts = edges.assign_coords(cause=list(without_cause)).assign(edge_shift)
    return edge_shifts.assign_attrs(tolerance=tolerance, confidence=sampling.confidence)
