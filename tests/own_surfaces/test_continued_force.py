"""Forces with continued roughness: their mean, how surely it is known, and the work they mean."""

import numpy as np
import pytest
import xarray as xr
from known_masters import LARGE, SMALL, scales

from hardcontact.own_surfaces.master_forces import (
    Masters,
    forces_of_masters,
    half_width_over_masters,
)
from hardcontact.own_surfaces.own_fit import with_continued_work
from hardcontact.own_surfaces.predicted_force import continued_force, with_continued_force

MASTERS = Masters({"a": 1}, 2)


def given(**options):
    return scales([[SMALL, LARGE]], **options).assign(transition=("side", [20.0, 4e3]))


def with_force(mean, low, high, rho=5.0, work=0.05):
    """Forces with and without continued roughness, that on the scans as stated."""
    axes = ("surface", "contact_model", "rho")
    of_scans = xr.Dataset(
        {"force": (axes, [[[mean]]]), "force_interval": ((*axes, "bound"), [[[[low, high]]]])},
        {"surface": ["a"], "contact_model": ["plastic"], "rho": [rho], "bound": ["low", "high"]},
        {"range_of_adhesion": rho, "work_of_adhesion": work},
    )
    return with_continued_force(of_scans, continued_force(given(), MASTERS, work, 0.95), 0.1)


def test_the_force_is_the_mean_over_contacts_and_masters_at_the_work():
    found = continued_force(given(), MASTERS, 0.05, 0.95)
    mean = given().unfiltered_pull_off_force.mean(["realization", "contact_y", "contact_x"])
    np.testing.assert_allclose(found.continued_force, 0.05 * mean)
    assert found.continued_end.values.tolist() == [[1.0, 10e3]]
    assert found.continued_source.values.tolist() == [["quarters"] * 2]


@pytest.mark.parametrize(
    "mean, half, differs", [(0.16, 0.02, 1), (0.16, 0.15, 0), (0.053, 0.001, 0), (0.16, np.nan, 1)]
)
def test_both_forces_are_said_where_they_differ_by_more_than_the_interval(mean, half, differs):
    assert 0.05 < with_force(1.0, 0.5, 2.0).continued_force.sel(side="small").item() < 0.056
    found = with_force(mean, mean - half, mean + half).continued_differs
    assert found.sel(side="small").values.tolist() == [differs]


def test_work_is_inversely_proportional_to_the_force():
    force = with_force(0.16, 0.14, 0.18)
    fit = xr.Dataset(
        {
            "measured_force": ("surface", [0.32]),
            "measured_force_interval": (("surface", "bound"), [[0.32 / 1.1, 0.32 * 1.1]]),
        },
        {"surface": ["a"], "bound": ["low", "high"]},
        {"confidence": 0.95},
    )
    found = with_continued_work(fit, force).sel(surface="a", side="small")
    continued = force.continued_force.sel(surface="a", side="small")
    of_scans = 0.05 * 0.32 / 0.16
    assert float(found.continued_work) == pytest.approx(of_scans * 0.16 / float(continued))
    low, high = np.log(force.continued_force_interval.sel(surface="a", side="small") / continued)
    np.testing.assert_allclose(
        np.log(found.continued_work_interval / found.continued_work),
        [-np.hypot(np.log(1.1), high), np.hypot(np.log(1.1), low)],
    )


@pytest.mark.study
@pytest.mark.parametrize("count", [2, 5])
def test_the_interval_covers_the_scatter_of_realizations_that_all_quarters_share(count):
    rng = np.random.default_rng(3)
    drawn, held = 300, 0
    template = given(realizations=count)
    for _ in range(drawn):
        shared = 0.3 * rng.standard_normal((1, count, 1, 1, 1))
        single = 0.05 * rng.standard_normal((1, count, 2, 4, 4))
        forces = xr.zeros_like(template.unfiltered_pull_off_force) + np.exp(shared + single)
        masters = forces_of_masters(
            template.assign(unfiltered_pull_off_force=forces), "a", "small", MASTERS
        )
        half = half_width_over_masters(
            masters, lambda filtered, whole: whole, "unfiltered_shift", 0.95
        )
        mean = float(masters.forces.unfiltered_pull_off_force.mean())
        held += abs(np.log(mean) - (0.3**2 + 0.05**2) / 2) < half
    assert held >= 0.9 * drawn
