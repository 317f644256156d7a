"""Laws compared on forces that are powers of the range, whose mixtures have a closed form."""

from functools import cache

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.special import gamma

from hardcontact.base.statistics import Sampling
from hardcontact.inference.error_map import fit_range_and_work
from hardcontact.inference.published_fit import Pair
from hardcontact.paper.law_comparison import compare_laws
from hardcontact.theory.interaction_laws import LAWS, law_forces, range_grid

SURFACES, SLOPES = ["smooth", "middle", "rough"], np.array([0.1, 0.3, 0.5])
RANGES = range_grid(5.6, 0.5, 1e-3, 1e12)
LENGTHS = range_grid(5.6, 0.03, 0.1, 40.0)
PAIR = Pair(5.6, 0.05)
CHOICES = {
    "pair": PAIR,
    "spacing": 0.3,
    "reference_surface": "middle",
    "tolerance": 0.1,
    "sampling": Sampling(1, 10, 0.95),
}


def law_power(law, rho, slope):
    """The force of a law if exponential laws have rho^slope: a moment of its mixture."""
    if law.exponential:
        return rho**slope
    m = law.exponent
    return (m * rho) ** slope * gamma(m - slope) / gamma(m)


def forces(spread=0.1):
    """Forces (surface, scan, rho) of four scans."""
    rng = np.random.default_rng(5)
    scans = np.exp(spread * rng.standard_normal((3, 4, 1)))
    values = scans * 1e-6 * RANGES ** SLOPES[:, None, None]
    dims = ("surface", "scan", "rho")
    return xr.Dataset(
        {
            "pull_off_force": (dims, values),
            "label": ("surface", SURFACES),
            "basis": ("surface", ["substitute"] * 3),
        },
        {"surface": SURFACES, "scan": range(4), "rho": RANGES},
    )


def masters(slope_of_filtered=0.3):
    """Masters whose force grows by 4 % per cutoff, and with another power of the range."""
    cutoffs = np.geomspace(20.0, 5000.0, 8)
    growth = {"small": 1 + 0.04 * np.arange(8.0), "large": 1 + 0.04 * np.arange(8.0)[::-1]}
    growth["small"][6:], growth["large"][:2] = np.nan, np.nan
    change = (RANGES / 5.6) ** (slope_of_filtered - 0.3)
    filtered = np.stack([growth["small"], growth["large"]])[:, :, None] * change
    unfiltered = 1e-6 * RANGES**0.3
    realizations = np.array([1.0, 1.1, 0.9])[:, None, None, None]
    values = np.broadcast_to(realizations * filtered * unfiltered, (3, 3, 2, 8, len(RANGES)))
    return xr.Dataset(
        {
            "pull_off_force": (
                ("surface", "realization", "side", "cutoff_wavelength", "rho"),
                values,
            ),
            "unfiltered_pull_off_force": (
                ("surface", "realization", "side", "rho"),
                np.broadcast_to(realizations[..., 0] * unfiltered, (3, 3, 2, len(RANGES))),
            ),
            "unfiltered_wavelength": (("surface", "side"), [[10.0, 20e3]] * 3),
        },
        {
            "surface": SURFACES,
            "realization": range(3),
            "side": ["small", "large"],
            "cutoff_wavelength": cutoffs,
            "rho": RANGES,
        },
    )


def published(law, rho, work):
    """Measured forces that a law explains exactly."""
    means = forces().pull_off_force.mean("scan").sel(rho=5.6, method="nearest").values
    values = work * means / 5.6**SLOPES * law_power(law, rho, SLOPES)
    return pd.DataFrame({"mean_force": values}, pd.Index(SURFACES, name="surface"))


@cache
def compared_at_published_pair(slope_of_filtered=0.3):
    """Laws compared on forces of Eq. 1 at its published pair."""
    return compare_laws(forces(), masters(slope_of_filtered), published(LAWS[0], *PAIR), **CHOICES)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_force_of_a_law_is_a_moment_of_its_mixture(law):
    for slope in SLOPES:
        mixture = law_forces(law, LENGTHS, RANGES, RANGES**slope)
        np.testing.assert_allclose(mixture, law_power(law, LENGTHS, slope), rtol=1e-4)


@pytest.mark.parametrize("number", range(len(LAWS)))
def test_fit_finds_the_law_that_made_the_forces(number):
    law, rho = LAWS[number], LENGTHS[120]
    laws = compare_laws(forces(), masters(), published(law, rho, 0.03), **CHOICES)
    fitted = laws.sel(law=law.name, range_choice="fitted")
    assert fitted.range_of_law.item() == pytest.approx(rho)
    assert fitted.work_of_adhesion.item() == pytest.approx(0.03, rel=1e-3)
    assert fitted.fit_error.item() < 1e-3
    np.testing.assert_allclose(fitted.force_ratio, laws.published_ratio, rtol=1e-3)
    errors = laws.fit_error.sel(range_choice="fitted")
    ratio = errors / errors.sel(law="exponential")
    np.testing.assert_allclose(laws.error_over_exponential, ratio, rtol=1e-9)


def test_equivalent_lengths_match_the_closed_form():
    laws = compared_at_published_pair()
    target = 0.05 * 5.6**SLOPES
    for law in LAWS:
        curves = np.array([law_power(law, LENGTHS, slope) for slope in SLOPES])
        best, work, error = fit_range_and_work(curves, target)
        equivalent = laws.sel(law=law.name, range_choice="equivalent")
        assert equivalent.range_of_law.item() == pytest.approx(LENGTHS[best], rel=0.07)
        assert equivalent.fit_error.item() == pytest.approx(error, abs=2e-3)
        assert equivalent.work_of_adhesion.item() == pytest.approx(work, rel=0.02)


def test_edges_agree_if_filters_change_all_ranges_alike():
    laws = compared_at_published_pair()
    cutoffs = masters().cutoff_wavelength.values
    # 10 % is half way between 8 % and 12 %, in the logarithm of the cutoff.
    pooled_edges = [np.sqrt(cutoffs[2] * cutoffs[3]), np.sqrt(cutoffs[5] * cutoffs[4])]
    edges = laws.edge.sel(group="pooled")
    np.testing.assert_allclose(edges, np.broadcast_to(pooled_edges, edges.shape), rtol=1e-3)
