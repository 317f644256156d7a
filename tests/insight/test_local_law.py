"""Corrections to local laws against direct sums over pairs and solutions of Laplace's equation."""

import numpy as np
import pytest
import xarray as xr
from known_spectra import rough
from scipy import integrate, special

from hardcontact.insight import local_law
from hardcontact.insight.closed_form import Contact
from hardcontact.insight.summits import banded, moment


@pytest.mark.parametrize("exponent", [2.0, 3.0])
def test_pairs_damp_waves_as_their_sum_over_the_plane(exponent):
    def kernel(phase):
        def of_ring(r):
            return r * special.j0(phase * r) / (1 + r**2) ** (exponent / 2 + 2)

        return integrate.quad(of_ring, 0, 60, limit=400)[0]

    for phase in (0.3, 1.0, 3.0):
        found = local_law.pair_damping(exponent, phase)
        assert found == pytest.approx(kernel(phase) / kernel(0.0), rel=1e-4)


@pytest.mark.parametrize("phase", [0.5, 1.5, 4.0])
def test_conductors_attract_as_laplaces_equation_says(phase):
    amplitude, waves, points = 0.02, np.arange(1, 9), np.linspace(0, np.pi, 60)
    height = amplitude * np.cos(points)
    # phi = 1 + c0 (z - 1) + sum of cn sinh(n q (1 - z))/sinh(n q) cos(n q x), zero on the wave.
    rows = np.sinh(phase * waves * (1 - height[:, None])) / np.sinh(phase * waves)
    design = np.column_stack([height - 1, rows * np.cos(points[:, None] * waves)])
    c0, *cn = np.linalg.lstsq(design, -np.ones(len(points)))[0]
    field = np.array(cn) * phase * waves / np.sinh(phase * waves)
    pressure = c0**2 + (field**2).sum() / 2
    local = (
        1 / (1 - amplitude * np.cos(np.linspace(0, 2 * np.pi, 400, endpoint=False))) ** 2
    ).mean()
    found = local_law.conductor_kernel(phase) * amplitude**2 / 2
    assert pressure - local == pytest.approx(found, rel=0.02)


def test_long_waves_miss_a_third_of_their_mean_square_slope():
    spectrum = rough(4.0, 1000.0, shortest=400.0)
    slope = moment(banded(spectrum, 0, np.inf), 2)
    assert local_law.conductor_excess(spectrum, 1.0) == pytest.approx(slope / 3, rel=1e-3)


def test_gap_of_the_attraction_is_that_of_the_weighted_heights():
    for sigma, m, rho in ((4.0, 10.0, 8.0), (20.0, 60.0, 5.6), (100.0, 300.0, 5.6)):
        heights = np.linspace(m - 12 * sigma, m, 200_001)
        weights = np.exp(-(heights**2) / (2 * sigma**2) + (heights - m) / rho + m**2 / 2 / sigma**2)
        expected = np.average(m - heights, weights=weights)
        assert local_law.attraction_gap(sigma, m, rho) == pytest.approx(expected, rel=1e-3)
    assert local_law.attraction_gap(100.0, 300.0, 5.6) == pytest.approx(5.6 / (1 - 0.168), rel=0.05)


def test_all_surfaces_have_their_gap_and_what_is_missed_there():
    spectra = {"a": rough(4.0), "b": rough(100.0, 2500.0)}
    edges = xr.DataArray([300.0, np.nan], {"surface": ["a", "b"]})
    found = local_law.local_law(spectra, Contact(250e3, 5.6, 1.0, 400.0), edges)
    gap = found["attraction_gap"].sel(surface="a").item()
    excess = local_law.conductor_excess(spectra["a"], gap)
    assert found["conductor_excess"].sel(surface="a").item() == pytest.approx(excess)
    damping = found["pair_damping"]
    assert damping[0] == pytest.approx(local_law.pair_damping(2.0, 2 * np.pi * gap / 300.0))
    assert np.isnan(damping[1])
