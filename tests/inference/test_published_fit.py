"""Fits to forces of known range and work of adhesion."""

import numpy as np
import pytest
import xarray as xr
from known_forces import PUBLISHED_MEANS, RHOS, power_forces
from paper_numbers import MEAN_FORCE, SUBSTRATES

from hardcontact.base.statistics import Sampling
from hardcontact.inference import published_fit
from hardcontact.inference.fit import best_fit, interpolate_to_ranges, mean_relative_error
from hardcontact.inference.published_fit import PublishedForces

SAMPLING = Sampling(seed=1, sample_count=50, confidence=0.95)
REFERENCE_INDEX = 1
#: Relative error below which a pair fits.
THRESHOLD = 0.1


def fit_forces(forces, published_forces=MEAN_FORCE):
    return published_fit.fit_contact_model(
        forces, published_forces, REFERENCE_INDEX, THRESHOLD, SAMPLING
    )


def test_the_fit_finds_the_range_and_work_that_made_the_forces():
    fits = fit_forces(power_forces())
    assert float(fits.range_of_adhesion) == pytest.approx(4.0, rel=0.01)
    assert float(fits.range_from_ratios) == pytest.approx(4.0, rel=0.01)
    assert float(fits.work_of_adhesion) == pytest.approx(0.05, rel=0.02)
    assert float(fits.best_error) < 0.01
    for name, value in (("region_range", 4.0), ("region_work", 0.05)):
        low, high = fits[name].sel(end=["low", "high"]).values
        assert low < value < high


def test_the_fit_has_the_smallest_error_of_a_fine_search():
    forces = power_forces(spread=0.5, seed=3)
    forces = forces.mean(["scan", "sphere_scan", "contact_y", "contact_x"]).values
    fine = np.geomspace(RHOS[0], RHOS[-1], 60)
    curve = interpolate_to_ranges(forces, RHOS, fine)
    pair = best_fit(curve, MEAN_FORCE, fine)
    error = pair["best_error"]
    search = mean_relative_error(curve, MEAN_FORCE, np.geomspace(1e-3, 2, 20001))
    assert error <= search.min() + 1e-12
    assert error == pytest.approx(search.min(), rel=1e-3)
    assert fine[np.unravel_index(search.argmin(), search.shape)[0]] == pair["range_of_adhesion"]
    curve[0, 3] = np.nan
    assert np.isnan([*best_fit(curve, MEAN_FORCE, fine).values()]).all()


def test_the_region_extends_over_all_small_errors_and_no_further():
    errors = np.ones((4, 5))
    errors[1, 2] = errors[2, 3] = 0.05
    ranges, works = published_fit.error_region(errors, RHOS[:4], np.arange(5.0), 0.1)
    assert ranges.tolist() == [1.0, 2.0] and works.tolist() == [2.0, 3.0]
    assert np.isnan(published_fit.error_region(np.ones((4, 5)), RHOS[:4], np.ones(5), 0.1)).all()


def test_ratios_met_at_two_ranges_give_two_minima():
    # Forces on two surfaces with the published ratio at 1 nm and at 8 nm, both for W = 0.05.
    ranges = np.geomspace(0.5, 16, 11)
    ratio = np.exp(0.5 * np.log(ranges) * np.log(ranges / 8))
    forces = np.stack([20 * ratio, np.ones_like(ratio)])[:, None, None, :, None, None]
    dims = ("surface", "scan", "sphere_scan", "rho", "contact_y", "contact_x")
    labelled_forces = xr.DataArray(forces, {"surface": ["a", "b"], "rho": ranges}, dims)
    fits = fit_forces(labelled_forces, np.array([1.0, 0.05]))
    assert sorted(fits.range_at_minimum.values[:2]) == pytest.approx([1.0, 8.0], rel=1e-9)
    np.testing.assert_allclose(fits.work_at_minimum[:2], 0.05, rtol=0.02)
    assert fits.error_at_minimum[0] <= fits.error_at_minimum[1] < 0.02
    assert fits.error_at_minimum[0] == fits.best_error == fits.best_error_by_range.min()
    assert fits.range_at_minimum[0] == fits.range_of_adhesion
    assert fits.range_at_minimum.isnull().values.tolist() == [False, False, True]


def make_adhesion(plastic):
    """The forces of adhesion.nc; those of rigid contact are half the plastic ones."""
    names = ("label", "source")
    return xr.Dataset(
        {"pull_off_force": xr.concat([plastic, plastic / 2], "contact_model")}
        | {name: ("surface", [f"{name} of {surface}" for surface in SUBSTRATES]) for name in names},
        {"contact_model": ["plastic", "rigid"]},
        {"sphere_radius": 0.25e6},
    )


#: The published means in another order than the computed ones.
PUBLISHED = PublishedForces(PUBLISHED_MEANS.iloc[::-1], (5.0, 0.04), THRESHOLD)


def fit_published(plastic, published=PUBLISHED):
    return published_fit.fit_published(make_adhesion(plastic), published, "uncd", SAMPLING)


def test_a_published_range_beyond_the_sweep_has_no_forces():
    fits = fit_published(power_forces(), PUBLISHED._replace(pair=(11.0, 0.04)))
    assert fits.mean_force_at_pair.sel(pair="published").isnull().all()
    assert fits.ratio_at_pair_interval.sel(pair="published").isnull().all()
    assert fits.mean_force_at_pair.sel(pair="fitted").notnull().all()


def test_models_are_compared_with_the_same_samples():
    """Twice the work fits half the force equally well: the ratio is certain."""
    fits = fit_published(power_forces(spread=0.5))
    assert fits.model_error_ratio.dims == ()
    assert float(fits.model_error_ratio) == pytest.approx(1.0)
    np.testing.assert_allclose(fits.model_error_ratio_interval, 1.0)
    rigid = fits.sel(contact_model="rigid")
    plastic = fits.sel(contact_model="plastic")
    np.testing.assert_allclose(rigid.sampled_error, plastic.sampled_error)
    np.testing.assert_allclose(rigid.sampled_work, 2 * plastic.sampled_work)
