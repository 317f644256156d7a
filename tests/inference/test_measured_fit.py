"""Fits to forces made with a known range and work of adhesion."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from intervals import between_multiples
from known_forces import FORCE_DIMS

from hardcontact.base.statistics import Sampling, interval_ends
from hardcontact.inference.measured_fit import (
    ForceSummary,
    add_extrapolated_work,
    fit_measured,
    look_repeated,
    sample_measured_mean,
    summarize_forces,
)

RHOS = np.array([0.5, 1.0, 2.0, 4.0, 8.0, 16.0])
RHO, WORK = 5.0, 0.05
SLOPES = {"a": 1.6, "b": 0.4}


def mean_force(surface, rho):
    """Return the mean force in N at 1 J/m²."""
    return 2e-5 * (rho / RHO) ** SLOPES[surface]


def adhesion(rng, scans=5, spread=0.2, contact_spread=0.3):
    """Forces of contacts whose mean over many scans is `mean_force`."""
    shape = (2, scans, 1, 1, 1, 4, 4)  # FORCE_DIMS
    factor = np.exp(spread * rng.standard_normal(shape[:5] + (1, 1)) - spread**2 / 2)
    factor = factor * np.exp(contact_spread * rng.standard_normal(shape) - contact_spread**2 / 2)
    curves = np.array([mean_force(surface, RHOS) for surface in SLOPES])
    return xr.Dataset(
        {
            "pull_off_force": (FORCE_DIMS, factor * curves[:, None, None, None, :, None, None]),
            "touched_patches": (FORCE_DIMS[:3], np.full(shape[:3], 99.0)),
            "label": ("surface", ["A", "B"]),
            "source": ("surface", ["measured"] * 2),
        },
        {"surface": list(SLOPES), "contact_model": ["plastic"], "rho": RHOS},
        {"sphere_radius": 5e3},
    )


def single_forces(forces, surface="a", sites=""):
    """A table of single forces: each is its own mean and median."""
    return pd.DataFrame(
        {"surface": surface, "mean": forces, "median": forces, "count": 1, "site": sites}
    )


def force_table(rng, count=40, log_std=0.6, surfaces="ab"):
    """Measured forces, log-normal about the forces of RHO and WORK."""
    scatter = [np.exp(log_std * rng.standard_normal(count) - log_std**2 / 2) for _ in surfaces]
    tables = [
        single_forces(WORK * mean_force(surface, RHO) * factors, surface)
        for surface, factors in zip(surfaces, scatter, strict=True)
    ]
    return pd.concat(tables, ignore_index=True)


def fitted(computed_forces, table, factor=1.0):
    """Return the fit of plastic contact; finer pixels raise the high end of works by a factor."""
    sizes = {"a": 2500.0, "b": 2500.0}
    factors = dict.fromkeys(sizes, factor)
    fit = fit_measured(
        computed_forces, table, sizes, factors, Sampling(seed=1, sample_count=1000, confidence=0.95)
    )
    return fit.sel(contact_model="plastic")


def sampled_fit(seed, **options):
    rng = np.random.default_rng(seed)
    return fitted(adhesion(rng, **options), force_table(rng))


def contains_pair(fit, rho=RHO, work=WORK):
    """Whether the region of a fit contains a pair."""
    low, high = fit.region.interp(rho_fine=rho).values
    return low <= work <= high


def test_without_scatter_range_and_work_are_recovered():
    rng = np.random.default_rng(0)
    exact = adhesion(rng, spread=1e-4, contact_spread=1e-4)
    fit = fitted(exact, force_table(rng, count=400, log_std=0.01))
    assert float(fit.range_of_adhesion) == pytest.approx(RHO, rel=0.02)
    assert float(fit.work_of_adhesion) == pytest.approx(WORK, rel=0.02)
    for true_value, (low, high) in ((RHO, fit.region_range.values), (WORK, fit.region_work.values)):
        assert (
            0.97 * true_value < low < 1.01 * true_value
            and 0.99 * true_value < high < 1.03 * true_value
        )


def test_the_region_contains_the_true_pair_in_nineteen_of_twenty_draws_and_no_distant_pair():
    fits = [sampled_fit(seed) for seed in range(20)]
    assert sum(contains_pair(fit) for fit in fits) >= 19
    assert not contains_pair(fits[1], rho=1.0) and not contains_pair(fits[1], work=0.2)
    low, high = fits[1].region_range.values
    assert RHOS[0] < low < RHO < high < RHOS[-1]


def test_finer_pixels_raise_the_upper_end_of_the_work_alone():
    rng = np.random.default_rng(5)
    computed_forces, table = adhesion(rng), force_table(rng)
    low, high = interval_ends(fitted(computed_forces, table), "work_by_range")
    fit = fitted(computed_forces, table, factor=2.0)
    factor_low, factor_high = interval_ends(fit, "work_by_range")
    np.testing.assert_allclose(factor_low, low)
    np.testing.assert_allclose(factor_high, 2 * high)


def test_two_forces_fit_two_unknowns_by_construction():
    rng = np.random.default_rng(0)
    table, fit = force_table(rng), sampled_fit(0)
    assert fit.exact_pairs == 1 and fit.best_error.isnull() and fit.range_of_adhesion.notnull()
    changed_table = table.assign(mean=table["mean"] * np.where(table.surface == "a", 1e4, 1))
    fit = fitted(adhesion(rng), changed_table)
    assert fit.exact_pairs == 0 and fit.best_error > 0.1  # no range has this ratio of forces


def test_one_surface_gives_a_curve_of_works_and_no_range():
    rng = np.random.default_rng(5)
    fit = fitted(adhesion(rng), force_table(rng, surfaces="a"))
    true_work = WORK * mean_force("a", RHO) / mean_force("a", fit.rho_fine)
    low, high = fit.work_by_range_interval.sel(surface="a").transpose("end", "rho_fine")
    assert ((low < true_work) & (true_work < high)).all()
    assert fit.range_of_adhesion.isnull() and fit.region_range.isnull().all()


@pytest.mark.parametrize(
    ("range_count", "force_count", "factor", "is_known"),
    [
        (6, 1, 1, [False, False]),  # a single force a surface: no scatter, no interval
        (6, 40, 1e3, [False, False]),  # forces that no range explains
        (4, 40, 1, [True, False]),  # a range at the end of those computed is no limit
    ],
)
def test_an_unknown_region_has_no_work(range_count, force_count, factor, is_known):
    rng = np.random.default_rng(8)
    computed_forces = adhesion(rng).sel(rho=RHOS[:range_count])
    table = force_table(rng, force_count)
    table.loc[table.surface == "b", ["mean", "median"]] *= factor
    fit = fitted(computed_forces, table)
    assert fit.region_range.notnull().values.tolist() == is_known and fit.region_work.isnull().all()
    assert fit.work_by_range.notnull().all()
    assert fit.work_by_range_interval.notnull().all() == (force_count > 1)


# Mean and scatter


def test_a_summary_is_equivalent_to_its_single_forces():
    forces = np.exp(0.7 * np.random.default_rng(1).standard_normal(4000)) * 1e-7
    single = summarize_forces(single_forces(forces))
    assert single.mean == pytest.approx(forces.mean())
    summary = single_forces([forces.mean()]).assign(median=np.median(forces), count=len(forces))
    assert summarize_forces(summary).log_std == pytest.approx(single.log_std, rel=0.05)


def repeated_forces(seed):
    """Forces (5 sites, 40 at each) that scatter between sites, but hardly at one of them."""
    rng = np.random.default_rng(seed)
    between = np.exp(0.6 * rng.standard_normal((5, 1)))
    return between * np.exp(0.01 * rng.standard_normal((5, 40)))


def test_forces_at_one_site_count_once():
    forces = repeated_forces(0)
    sites = np.repeat([f"p{site}" for site in range(5)], 40)
    means = forces.mean(axis=1)
    expected = ForceSummary(
        means.mean(), np.log(means).std(ddof=1), site_count=5, force_count=200, look_repeated=False
    )
    assert summarize_forces(single_forces(forces.ravel(), sites=sites)) == pytest.approx(expected)


def test_repeated_sites_are_recognised_and_independent_ones_are_not():
    def are_recognised(forces):
        return look_repeated(single_forces(forces))

    forces = repeated_forces(1)
    assert are_recognised(forces.ravel()) and are_recognised(forces.T.ravel())  # by site, in turn
    assert are_recognised(np.repeat([3.0, 1.0, 2.0], 2))
    rng = np.random.default_rng(2)
    independent = [np.exp(0.6 * rng.standard_normal(n)) for n in (3, 5, 10, 40, 200) * 40]
    assert sum(are_recognised(forces) for forces in independent) <= 3  # a chance of 0.001 each


@pytest.mark.parametrize("log_std, count", [(0.7, 40), (1.5, 40), (0.7, 4)])
def test_sampled_means_cover_the_mean_with_their_confidence(log_std, count):
    rng, contained = np.random.default_rng(3), []
    for _ in range(300):
        forces = np.exp(log_std * rng.standard_normal(count))
        summary = ForceSummary(forces.mean(), np.log(forces).std(ddof=1), count, count)
        low, high = np.percentile(sample_measured_mean(rng, summary, 400), [5, 95])
        contained.append(low < np.exp(log_std**2 / 2) < high)
    assert np.mean(contained) > 0.85  # of intervals of 90 %


def test_work_with_extrapolated_roughness_is_inversely_proportional_to_the_force():
    measured_force, extrapolated_force = 0.32, 0.08  # N, the latter at 0.05 J/m²
    fit = xr.Dataset(
        between_multiples("measured_force", "surface", [measured_force], (1 / 1.1, 1.1)),
        {"surface": ["a"]},
        {"confidence": 0.95},
    )
    sides = ("surface", "side")
    force = xr.Dataset(
        between_multiples("extrapolated_force", sides, [[extrapolated_force]], (1 / 1.2, 1.3))
        | {"extrapolation_matters": (sides, [[1]]), "transition": ("side", [20.0])},
        {"surface": ["a"], "side": ["short"]},
        {"work_of_adhesion": 0.05, "rho": 5.0},
    )
    fit_with_work = add_extrapolated_work(fit, force).sel(surface="a", side="short")
    assert float(fit_with_work.extrapolated_work) == pytest.approx(
        0.05 * measured_force / extrapolated_force
    )
    np.testing.assert_allclose(
        np.log(fit_with_work.extrapolated_work_interval / fit_with_work.extrapolated_work),
        [-np.hypot(np.log(1.1), np.log(1.3)), np.hypot(np.log(1.1), np.log(1.2))],
    )
