"""Own forces made with a range and a work of adhesion that are known."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from known_forces import FORCE_DIMS

from hardcontact.numbers.statistics import Sampling
from hardcontact.own_surfaces.own_fit import fit_measured

RHOS = np.array([0.5, 1.0, 2.0, 4.0, 8.0, 16.0])
RHO, WORK = 5.0, 0.05
SLOPES = {"a": 1.6, "b": 0.4}
SIZES = {"a": 2500.0, "b": 2500.0}
SAMPLING = Sampling(1, 1000, 0.95)


def mean_force(surface, rho):
    """Mean forces in N at 1 J/m²."""
    return 2e-5 * (rho / RHO) ** SLOPES[surface]


def adhesion(rng, scans=5, spread=0.2, of_contacts=0.3, surfaces="ab"):
    """Forces of contacts whose mean over many scans is `mean_force`."""
    shape = (len(surfaces), scans, 1, 1, 1, 4, 4)
    factor = np.exp(spread * rng.standard_normal(shape[:5] + (1, 1)) - spread**2 / 2)
    factor = factor * np.exp(of_contacts * rng.standard_normal(shape) - of_contacts**2 / 2)
    curves = np.array([mean_force(surface, RHOS) for surface in surfaces])
    return xr.Dataset(
        {
            "pull_off_force": (FORCE_DIMS, factor * curves[:, None, None, None, :, None, None]),
            "label": ("surface", [name.upper() for name in surfaces]),
        },
        {"surface": list(surfaces), "contact_model": ["plastic"], "rho": RHOS},
        {"sphere_radius": 5e3},
    )


def drawn_tests(rng, number=40, shape=0.6, surfaces="ab"):
    """Single tests, log-normal about the forces of RHO and WORK."""
    rows = [
        (surface, force, force, 1)
        for surface in surfaces
        for force in WORK
        * mean_force(surface, RHO)
        * np.exp(shape * rng.standard_normal(number) - shape**2 / 2)
    ]
    return pd.DataFrame(rows, columns=["surface", "mean", "median", "count"])


def fitted(seed=0, sampling=SAMPLING, **options):
    rng = np.random.default_rng(seed)
    return fit_measured(adhesion(rng, **options), drawn_tests(rng), SIZES, sampling).sel(
        contact_model="plastic"
    )


def holds(fit, rho=RHO, work=WORK):
    low, high = fit.region.interp(rho=rho).values
    return low <= work <= high


def test_without_scatter_range_and_work_are_recovered():
    rng = np.random.default_rng(0)
    exact = adhesion(rng, spread=1e-4, of_contacts=1e-4)
    forces = drawn_tests(rng, number=400, shape=0.01)
    fit = fit_measured(exact, forces, SIZES, SAMPLING).sel(contact_model="plastic")
    assert float(fit.best_range) == pytest.approx(RHO, rel=0.02)
    assert float(fit.best_work) == pytest.approx(WORK, rel=0.02)
    assert fit.region_status.values.tolist() == ["found", "found"]
    for known, (low, high) in ((RHO, fit.region_range.values), (WORK, fit.region_work.values)):
        assert 0.97 * known < low < 1.01 * known and 0.99 * known < high < 1.03 * known


def test_two_forces_fit_two_unknowns_by_construction():
    rng = np.random.default_rng(0)
    forces = drawn_tests(rng)
    fit = fitted(0)
    assert fit.exact_pairs == 1 and fit.best_error.isnull() and fit.best_range.notnull()
    beyond = forces.assign(mean=forces["mean"] * np.where(forces.surface == "a", 1e4, 1))
    fit = fit_measured(adhesion(rng), beyond, SIZES, SAMPLING).sel(contact_model="plastic")
    assert fit.exact_pairs == 0 and fit.best_error > 0.1  # no range has this ratio of forces


def test_the_region_holds_the_truth_in_nineteen_of_twenty_draws():
    assert sum(holds(fitted(seed)) for seed in range(20)) >= 19


def test_the_region_of_one_scan_a_surface_holds_it_too():
    # Quarters are all that differs here: with spread 0 no scan has a factor of its own.
    assert sum(holds(fitted(seed, scans=1, spread=0.0)) for seed in range(10)) >= 9


def test_the_region_does_not_hold_whatever_one_likes():
    fit = fitted(1)
    assert not holds(fit, rho=1.0) and not holds(fit, work=0.2)
    low, high = fit.region_range.values
    assert RHOS[0] < low < RHO < high < RHOS[-1]
    assert fit.attrs["basis"] == "measured" and fit.tests.values.tolist() == [40, 40]


def test_one_surface_gives_a_curve_and_no_range():
    rng = np.random.default_rng(5)
    forces = drawn_tests(rng, surfaces="a")
    fit = fit_measured(adhesion(rng), forces, SIZES, SAMPLING).sel(contact_model="plastic")
    assert fit.surface.values.tolist() == ["a"]
    known = WORK * mean_force("a", RHO) / mean_force("a", fit.rho)
    low, high = (fit.work_of_adhesion_interval.isel(surface=0, bound=bound) for bound in (0, 1))
    assert ((low < known) & (known < high)).all()
    assert fit.best_range.isnull() and fit.region_range.isnull().all()
    assert fit.region_status.values.tolist() == ["open", "open"]


def test_a_single_test_has_a_work_but_no_interval():
    rng = np.random.default_rng(6)
    fit = fit_measured(adhesion(rng), drawn_tests(rng, number=1), SIZES, SAMPLING)
    assert fit.work_of_adhesion.notnull().all()
    assert fit.work_of_adhesion_interval.isnull().all() and fit.region.isnull().all()
    assert fit.interval_source.values[0] == "one_test"


def test_forces_that_nothing_explains_give_no_region():
    rng = np.random.default_rng(7)
    forces = drawn_tests(rng, shape=0.05)
    forces.loc[forces.surface == "b", ["mean", "median"]] *= 1e3
    fit = fit_measured(adhesion(rng), forces, SIZES, SAMPLING).sel(contact_model="plastic")
    assert fit.region_status.values.tolist() == ["none", "none"]


def test_a_range_at_the_end_of_those_computed_is_no_limit():
    rng = np.random.default_rng(8)
    given = adhesion(rng).sel(rho=RHOS[:4])
    fit = fit_measured(given, drawn_tests(rng), SIZES, SAMPLING).sel(contact_model="plastic")
    assert fit.region_status.values[1] == "open" and np.isnan(fit.region_range.values[1])
