"""Exponents of known power laws, and edges that shift by known factors."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from hardcontact.base.statistics import Sampling, interval_ends
from hardcontact.contact.contact import CONTACT_MODELS
from hardcontact.paper.contact_dependence import compute_edge_shifts, edge_exponents, force_exponent

RADII, AREAS = [1e4, 1e5, 1e6], [50.0, 400.0, 3200.0]
#: The contact touches another area on the larger pixels of long-edge masters.
LONG_AREAS = np.power(AREAS, 0.9).tolist()
CUTOFFS = np.geomspace(10, 2e4, 60)


def power_law(radius_exponent, area_exponent):
    """Return edges in nm over RADII and AREAS; exponents may differ by realization."""
    radius = xr.DataArray(RADII, {"radius": RADII}, "radius")
    area = xr.DataArray(AREAS, {"contact_area": AREAS}, "contact_area")
    return 600 * np.sqrt(radius / 1e5) ** radius_exponent * np.sqrt(area / 400) ** area_exponent


def curves(*exponents, scatter=0.0):
    """Return ratios of three realizations: edges are power laws with scattered exponents."""
    cutoff = xr.DataArray(CUTOFFS, {"cutoff_wavelength": CUTOFFS}, "cutoff_wavelength")
    noise = np.random.default_rng(5).standard_normal(3)
    noise = xr.DataArray(scatter * (noise - noise.mean()), dims="realization")
    edge = power_law(*(exponent + noise for exponent in exponents)) * np.exp(noise)
    # ln(ratio) is linear in ln(cutoff) and ln(1.1) at the edge, on either side.
    sign = xr.DataArray([1, -1], {"side": ["short", "long"]}, "side")
    log_distance = sign * np.log(cutoff / edge)
    ratio = np.exp(np.maximum(np.log(1.1) * (1 + 2 * log_distance), 0)).expand_dims(surface=["a"])
    return xr.Dataset(
        {
            "filtered_force_ratio": ratio,
            "spectrum_end": (("surface", "side"), [[5.0, 4e4]]),
            "touching_area": (
                ("surface", "realization", "side", "contact_area"),
                [[[AREAS, LONG_AREAS]] * 3],
            ),
        }
    )


@pytest.mark.parametrize("exponents", [(1.0, 0.0), (0.2, 0.9), (0.0, -0.8)])
def test_exponents_of_a_known_power_law_are_recovered(exponents):
    fitted = edge_exponents(curves(*exponents, scatter=0.02), 0.1, 0.95).sel(surface="a")
    exponent = fitted["edge_exponent"]
    radius_exponent, area_exponent = exponents
    long_exponents = radius_exponent, area_exponent / 0.9  # of LONG_AREAS
    np.testing.assert_allclose(exponent, [exponents, long_exponents], atol=0.02)
    low, high = interval_ends(fitted, "edge_exponent")
    assert (low <= exponent).all() and (exponent <= high).all()


def test_the_exponent_of_a_force_against_the_radius_is_recovered():
    radius = xr.DataArray(RADII, {"radius": RADII}, "radius")
    exponents = xr.DataArray([0.3, 0.4, 0.5], {"realization": [1, 2, 3]}, "realization")
    contact_factor = xr.DataArray([[1.0, 3.0]], dims=("contact_y", "contact_x"))
    axes = {"side": ["short", "long"], "surface": ["a"], "contact_area": AREAS}
    forces = (1e-6 * contact_factor * (radius / 1e5) ** exponents).expand_dims(axes)
    # Only these forces count.
    counts = (forces["side"] == "long") & (forces["contact_area"] == 400)
    masters = xr.Dataset({"unfiltered_pull_off_force": forces.where(counts, 1.0)})
    exponent = force_exponent(masters, 400.0, 0.95)
    assert exponent["force_exponent"].item() == pytest.approx(0.4)
    half_width = stats.t.ppf(0.975, 2) * 0.1 / np.sqrt(3)
    np.testing.assert_allclose(
        interval_ends(exponent, "force_exponent"), [[0.4 - half_width], [0.4 + half_width]]
    )


SHORT_CUTOFFS = np.array([20.0, 40.0, 80.0, 160.0])


def edge_shifts(ratio, sample_count):
    """Return the shifts for ratios of plastic and rigid contact at 5.6 and 1 nm."""
    axes = {"surface": ["a"], "side": ["short"], "radius": [1.0]}
    forces = xr.Dataset(
        {
            "filtered_force_ratio": ratio.expand_dims(axes),
            "spectrum_end": (("surface", "side"), [[2.0]]),
        },
        {"rho": [5.6, 1.0], "contact_area": ("loading", [400.0, 0.0])},
    )
    sampling = Sampling(seed=1, sample_count=sample_count, confidence=0.95)
    return compute_edge_shifts(forces, 0.1, sampling).sel(group="a", side="short")


def test_each_contact_model_has_the_edge_of_its_forces():
    """Forces that are a power of the cutoff have changed by 10 % at a prescribed edge."""
    edges = xr.DataArray([[100.0, 50.0], [30.0, 25.0]], dims=["loading", "rho"])
    cutoff = xr.DataArray(SHORT_CUTOFFS, {"cutoff_wavelength": SHORT_CUTOFFS})
    ratio = 1.1 ** (np.log(cutoff / 2) / np.log(edges / 2))  # ln F is linear in ln c from 2 nm on
    shifts = edge_shifts(ratio.expand_dims(realization=[1, 2]), sample_count=0)
    assert shifts["contact_model"].values.tolist() == CONTACT_MODELS
    for model, edge in {"plastic": edges[0], "rigid": edges[1]}.items():
        np.testing.assert_allclose(shifts["edge"].sel(contact_model=model), edge, rtol=1e-9)
    expected_shifts = [100 / 30, 100 / 50]
    np.testing.assert_allclose(
        shifts["edge_shift"].sel(cause=["plasticity", "range"]), expected_shifts
    )


def test_edges_that_scatter_together_have_a_certain_ratio():
    """Both loadings and ranges have the same forces: the edge is uncertain, its ratio is one."""
    factors = 1.1 ** (np.array([0.7, 1.0, 1.4])[:, None] * np.log(SHORT_CUTOFFS / 2) / np.log(20))
    ratio = xr.DataArray(factors, {"realization": [1, 2, 3], "cutoff_wavelength": SHORT_CUTOFFS})
    shifts = edge_shifts(ratio.expand_dims(loading=2, rho=2), sample_count=50)
    low, high = np.moveaxis(shifts["edge_interval"].values, -1, 0)
    assert (high > 1.2 * low).all()
    np.testing.assert_allclose(shifts["edge_shift_interval"], 1)
