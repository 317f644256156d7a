"""Inference on forces whose answer is known, and the statistics around it."""

import numpy as np
import pytest
import xarray as xr
from scipy.stats import lognorm

from hardcontact import inference, scales, statistics

RHOS = np.array([0.5, 1, 2, 3, 5, 7, 10.0])
PUBLISHED = np.array([8.8, 0.4, 0.16, 0.11]) * 1e-6


def power_forces(rho=4.0, work=0.05, spread=0.0, scans=4, seed=0):
    """Forces that meet PUBLISHED exactly at rho and work, each surface with its own slope."""
    slopes = np.array([2.0, 1.3, 0.7, 0.4])[:, None]
    mean = PUBLISHED[:, None] / work * (RHOS / rho) ** slopes
    rng = np.random.default_rng(seed)
    factor = np.exp(spread * rng.standard_normal((4, scans, scans, 1, 2, 2)))
    return xr.DataArray(
        mean[:, None, None, :, None, None] * factor,
        dims=("surface", "scan", "sphere_scan", "rho", "contact_y", "contact_x"),
        coords={"surface": list("abcd"), "rho": RHOS},
    )


def infer(forces):
    return inference.infer(forces, PUBLISHED, 1, np.random.default_rng(1), 50, 0.95, 0.1)


def test_inference_finds_the_range_and_work_that_made_the_forces():
    found = infer(power_forces())
    assert float(found.range_of_adhesion) == pytest.approx(4.0, rel=0.01)
    assert float(found.range_from_ratios) == pytest.approx(4.0, rel=0.01)
    assert float(found.work_of_adhesion) == pytest.approx(0.05, rel=0.02)
    assert float(found.best_error) < 0.01
    assert found.region_range_low < 4.0 < found.region_range_high
    assert found.region_work_low < 0.05 < found.region_work_high


def test_interval_holds_the_answer_and_is_wide_where_scans_differ():
    narrow, wide = (infer(power_forces(spread=spread)) for spread in (0.02, 0.6))
    for found in (narrow, wide):
        assert found.range_of_adhesion_low <= found.range_of_adhesion_high
    width = [float(f.range_of_adhesion_high - f.range_of_adhesion_low) for f in (narrow, wide)]
    assert width[1] > 3 * width[0]


def test_missing_scans_do_not_count():
    forces = power_forces(spread=0.3)
    short = forces.copy()
    short[0, 3] = np.nan
    found = infer(short)
    np.testing.assert_allclose(
        found.mean_force.isel(surface=0),
        forces[0, :3].mean(["scan", "sphere_scan", "contact_y", "contact_x"]),
    )


def test_fit_is_the_least_of_a_fine_search():
    forces = (
        power_forces(spread=0.5, seed=3)
        .mean(["scan", "sphere_scan", "contact_y", "contact_x"])
        .values
    )
    fine = np.geomspace(RHOS[0], RHOS[-1], 60)
    curve = inference.on_fine_grid(forces, RHOS, fine)
    best, work, error = inference.fit(curve, PUBLISHED)
    search = inference.mean_relative_error(curve, PUBLISHED, np.geomspace(1e-3, 2, 20001))
    assert error <= search.min() + 1e-12
    assert error == pytest.approx(search.min(), rel=1e-3)
    assert np.unravel_index(search.argmin(), search.shape)[0] == best


def test_region_is_empty_where_nothing_fits():
    assert np.isnan(inference.error_region(np.ones((3, 4)), RHOS[:3], np.ones(4), 0.1)).all()
    said = inference.undecided(0.4, 0.1, 0.5, 10.0, RHOS)
    assert "no range and work" in said and "no upper bound" in said and "no lower bound" in said
    clear = inference.undecided(0.05, 0.1, 3.0, 5.0, RHOS)
    assert "bound" not in clear and "3.0 and 5.0" in clear


def test_resampled_means_of_full_counts_are_means():
    pairs = np.random.default_rng(0).random((2, 3, 4, 5))
    means = inference.resampled_means(pairs, np.ones((1, 2, 3)), np.ones((1, 4)))
    np.testing.assert_allclose(means[0], pairs.mean(axis=(1, 2)))
    counts = statistics.resampling_counts(
        np.random.default_rng(0), np.array([True, False, True]), 200
    )
    assert (counts.sum(axis=1) == 2).all() and (counts[:, 1] == 0).all()


def test_published_lognormal_shapes():
    mean, median = [8.8, 0.4, 0.16, 0.11], [1.75, 0.31, 0.12, 0.06]
    np.testing.assert_allclose(
        statistics.lognormal_shape(mean, median), [1.80, 0.71, 0.76, 1.10], atol=0.006
    )


def test_censored_fit_recovers_the_distribution_that_was_cut():
    forces = lognorm.rvs(0.9, scale=6e-8, size=20000, random_state=np.random.default_rng(0))
    shape, median, below = statistics.lognormal_fit(forces, 3e-8)
    assert shape == pytest.approx(0.9, rel=0.03)
    assert median == pytest.approx(6e-8, rel=0.03)
    assert below == pytest.approx(lognorm.cdf(3e-8, 0.9, scale=6e-8), abs=0.01)
    shape, median, below = statistics.lognormal_fit(forces * 1e-3, 3e-8)
    assert np.isnan(shape) and np.isnan(median) and below == 1


def test_critical_wavelength_interpolates_in_log_wavelength():
    cutoffs, ratios = np.array([1.0, 10.0, 100.0]), np.array([1.0, 1.05, 1.15])
    assert scales.critical_wavelength(cutoffs, ratios, 0.1) == pytest.approx(10**1.5)
    falling = np.array([1.0, 1.0, 0.8])
    assert scales.critical_wavelength(cutoffs, falling, 0.1) == pytest.approx(10**1.5)
    assert np.isnan(scales.critical_wavelength(cutoffs, np.array([1.0, 0.95, 1.05]), 0.1))


def test_critical_band_reads_each_side_from_its_unfiltered_end():
    cutoffs = np.array([10.0, 100.0, 1000.0, 10000.0])
    small = [1.0, 1.2, np.nan, np.nan]
    large = [np.nan, np.nan, 3.0, 1.0]
    found = scales.critical_band(
        xr.Dataset(
            {
                "ratio": (
                    ("surface", "realization", "side", "cutoff_wavelength"),
                    np.array([[[small, large]] * 3]),
                ),
                "unfiltered_wavelength": (("surface", "side"), [[1.0, 20000.0]]),
            },
            {"surface": ["a"], "side": ["small", "large"], "cutoff_wavelength": cutoffs},
        ),
        0.1,
        np.random.default_rng(0),
        20,
        0.95,
    )
    assert found.critical_wavelength.sel(side="small", group="a") == pytest.approx(10**1.5)
    expected = 10000 * 10**-0.05
    assert found.critical_wavelength.sel(side="large", group="pooled") == pytest.approx(expected)
    assert found.critical_wavelength_low.sel(side="small", group="a") == pytest.approx(10**1.5)
