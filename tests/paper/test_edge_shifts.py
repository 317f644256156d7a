"""Edges that plastic contact and the range of adhesion shift by known factors."""

import numpy as np
import xarray as xr

from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import CONTACT_MODELS
from hardcontact.paper.edge_shifts import compute_edge_shifts

SHORT_CUTOFFS = np.array([20.0, 40.0, 80.0, 160.0])


def test_each_contact_model_has_the_edge_of_its_forces():
    """Forces that are a power of the cutoff have changed by 10 % at a prescribed edge."""
    edges = xr.DataArray(
        [[100.0, 50.0], [30.0, 25.0]],
        {"contact_area": ("loading", [400.0, 1.0]), "rho": [5.6, 1.0]},
        ["loading", "rho"],
    )  # fmt: skip
    cutoff = xr.DataArray(
        SHORT_CUTOFFS, {"cutoff_wavelength": SHORT_CUTOFFS}, ["cutoff_wavelength"]
    )
    ratio = 1.1 ** (np.log(cutoff / 2) / np.log(edges / 2))  # ln F is linear in ln c from 2 nm on
    forces = xr.Dataset(
        {
            "filtered_force_ratio": ratio.expand_dims(
                surface=["a"], realization=[1, 2], side=["short"], radius=[1.0]
            )
        }
    ).assign(spectrum_end=(("surface", "side"), [[2.0]]))
    edge_shifts = compute_edge_shifts(
        forces, 0.1, Sampling(seed=1, sample_count=0, confidence=0.95)
    )
    model_edges = edge_shifts["edge"].sel(group="a", side="short")
    assert edge_shifts["contact_model"].values.tolist() == CONTACT_MODELS
    for model, edge in {"plastic": edges[0], "rigid": edges[1]}.items():
        np.testing.assert_allclose(model_edges.sel(contact_model=model), edge, rtol=1e-9)
    shift = edge_shifts["edge_shift"].sel(group="a", side="short")
    shifts = [edges[0, 0] / edges[1, 0], edges[0, 0] / edges[0, 1]]
    np.testing.assert_allclose(shift.sel(cause=["plasticity", "range"]), shifts)


def test_edges_that_scatter_together_have_a_certain_ratio():
    """Both loadings and ranges have the same forces: the edge is uncertain, its ratio is one."""
    factors = 1.1 ** (np.array([0.7, 1.0, 1.4])[:, None] * np.log(SHORT_CUTOFFS / 2) / np.log(20))
    ratio = xr.DataArray(
        factors, {"realization": [1, 2, 3], "cutoff_wavelength": SHORT_CUTOFFS}
    ).expand_dims(surface=["a"], side=["short"], radius=[1.0], loading=2, rho=[5.6, 1.0])
    forces = xr.Dataset(
        {"filtered_force_ratio": ratio}, {"contact_area": ("loading", [400.0, 1.0])}
    ).assign(spectrum_end=(("surface", "side"), [[2.0]]))
    edge_shifts = compute_edge_shifts(
        forces, 0.1, Sampling(seed=1, sample_count=50, confidence=0.95)
    ).sel(group="a")
    low, high = np.moveaxis(edge_shifts["edge_interval"].values, -1, 0)
    assert (high > 1.2 * low).all()
    np.testing.assert_allclose(edge_shifts["edge_shift_interval"], 1)
