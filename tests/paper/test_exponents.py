"""Scaled contacts against closed forms and single contacts; exponents against power laws."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from periodic_maps import periodic_map
from scipy import stats
from scipy.special import erf

from hardcontact.base.statistics import interval_ends
from hardcontact.contact.contact import Contact
from hardcontact.inference.filtered_masters import Filters, filtered_pull_off
from hardcontact.paper.exponents import edge_exponents, force_exponent

CONTACTS = [
    Contact(radius=500.0, preload=preload, hardness=25e9, window=640.0, contacts_per_row=3)
    for preload in (2.5e-6, 20e-6)
]
FILTERS, COMBINATIONS = Filters("short", 64, [40.0, 80.0]), ([500.0, 2000.0], [2.0, 5.0])


def master(rms):
    heights = rms * np.random.default_rng(3).standard_normal((64, 64))
    return periodic_map(heights, 10.0)


def test_a_flat_surface_gives_the_force_of_a_smooth_sphere_at_every_radius_range_and_area():
    forces = filtered_pull_off(master(0.0), FILTERS, CONTACTS, None, *COMBINATIONS)
    mean_force = forces["unfiltered_pull_off_force"].mean(["contact_y", "contact_x"]).values
    radius, rho = (np.array(values) for values in COMBINATIONS)
    radius = radius[:, None]
    # 2 pi R W without the attraction outside the window of 640 nm.
    rigid = 2 * np.pi * radius * 1e-9 * erf(640 / np.sqrt(8 * radius * rho)) ** 2
    np.testing.assert_allclose(mean_force[:, 0], rigid, rtol=2e-3)
    # Eight pixels touch: the apex, its neighbours, and three of the four at the distance sqrt(2).
    gaps = np.array([0, *[100] * 4, *[200] * 3]) / (2 * radius[..., None])
    approach = np.exp(gaps.max(-1) / rho)
    flattened = (np.exp((gaps.max(-1, keepdims=True) - gaps) / rho[:, None]) - 1).sum(-1)
    plastic = approach * rigid - flattened * 100 / rho * 1e-9
    np.testing.assert_allclose(mean_force[:, 1], plastic, rtol=2e-3)


def test_every_combination_equals_its_single_contact():
    forces = filtered_pull_off(master(3.0), FILTERS, CONTACTS, None, *COMBINATIONS)
    single = filtered_pull_off(master(3.0), FILTERS, [replace(CONTACTS[1], radius=2000.0, rho=5.0)])
    for name in ("pull_off_force", "unfiltered_pull_off_force"):
        np.testing.assert_allclose(
            forces[name].isel(radius=1, loading=1, rho=1),
            single[name].isel(radius=0, loading=0, rho=0),
        )
    assert forces["contact_area"].values == pytest.approx([100.0, 800.0])
    assert forces["touching_area"].values == pytest.approx([100.0, 800.0])


RADII, AREAS = [1e4, 1e5, 1e6], [50.0, 400.0, 3200.0]
CUTOFFS = np.geomspace(10, 2e4, 60)


def power_law(radius_exponent, contact_exponent):
    """Return edges in nm over RADII and AREAS; exponents may differ by realization."""
    radius = xr.DataArray(RADII, {"radius": RADII}, "radius")
    area = xr.DataArray(AREAS, {"contact_area": AREAS}, "contact_area")
    return 600 * np.sqrt(radius / 1e5) ** radius_exponent * np.sqrt(area / 400) ** contact_exponent


def curves(*exponents, scatter=0.0):
    """Return ratios of three realizations whose edges are a known power law.

    The exponents of the realizations scatter about the given exponents, and each edge scatters
    about the power law of its exponents.
    """
    cutoff = xr.DataArray(CUTOFFS, {"cutoff_wavelength": CUTOFFS}, "cutoff_wavelength")
    noise = np.random.default_rng(5).standard_normal(3)
    noise = xr.DataArray(scatter * (noise - noise.mean()), dims="realization")
    scattered_edge = power_law(*(exponent + noise for exponent in exponents))
    # ln(ratio) is linear in ln(cutoff) and ln(1.1) at the edge, on either side.
    sign = xr.DataArray([1, -1], {"side": ["short", "long"]}, "side")
    distance = sign * np.log(cutoff / (scattered_edge * np.exp(noise)))
    ratio = np.exp(np.maximum(np.log(1.1) * (1 + 2 * distance), 0)).expand_dims(surface=["a"])
    return xr.Dataset(
        {
            "filtered_force_ratio": ratio,
            "unfiltered_wavelength": (("surface", "side"), [[5.0, 4e4]]),
            "touching_area": (
                ("surface", "realization", "side", "contact_area"),
                [[[AREAS] * 2] * 3],
            ),
        }
    )


@pytest.mark.parametrize("exponents", [(1.0, 0.0), (0.2, 0.9), (0.0, -0.8)])
def test_exponents_of_a_known_power_law_are_recovered(exponents):
    fitted = edge_exponents(curves(*exponents, scatter=0.02), 0.1, 0.95).sel(surface="a")
    exponent = fitted["edge_exponent"]
    np.testing.assert_allclose(exponent, [exponents] * 2, atol=0.02)
    low, high = interval_ends(fitted, "edge_exponent")
    assert (low <= exponent).all() and (exponent <= high).all()


def test_the_exponent_of_a_force_in_the_radius_is_recovered():
    radius = xr.DataArray(RADII, {"radius": RADII}, "radius")
    power = xr.DataArray([0.3, 0.4, 0.5], {"realization": [1, 2, 3]}, "realization")
    factor = xr.DataArray([[1.0, 3.0]], dims=("contact_y", "contact_x"))
    axes = {"side": ["short", "long"], "surface": ["a"], "contact_area": AREAS}
    forces = (1e-6 * factor * (radius / 1e5) ** power).expand_dims(axes)
    # Forces at another side or contact area differ.
    is_other = (forces["side"] == "short") | (forces["contact_area"] != 400)
    data = xr.Dataset({"unfiltered_pull_off_force": forces.where(~is_other, 1.0)})
    exponent = force_exponent(data, 400.0, 0.95)
    assert exponent["force_exponent"].item() == pytest.approx(0.4)
    half_width = stats.t.ppf(0.975, 2) * 0.1 / np.sqrt(3)
    np.testing.assert_allclose(
        interval_ends(exponent, "force_exponent"), [[0.4 - half_width], [0.4 + half_width]]
    )
