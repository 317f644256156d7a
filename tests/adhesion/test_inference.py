"""Inference on forces whose answer is known."""

import numpy as np
import pytest
import xarray as xr
from known_forces import RHOS, TABLE, power_forces
from paper_numbers import MEAN_FORCE, SUBSTRATES

from hardcontact.adhesion import inference
from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.adhesion.force_curves import on_fine_grid
from hardcontact.statistics import bounds

BOOTSTRAP = Bootstrap(1, 50, 0.95)


def infer_model(forces, published=MEAN_FORCE, bootstrap=BOOTSTRAP):
    return inference.infer_model(forces, published, 1, 0.1, bootstrap)


def width(dataset, name):
    low, high = bounds(dataset, name)
    return float(high - low)


def test_inference_finds_the_range_and_work_that_made_the_forces():
    inferred = infer_model(power_forces())
    assert float(inferred.range_of_adhesion) == pytest.approx(4.0, rel=0.01)
    assert float(inferred.range_from_ratios) == pytest.approx(4.0, rel=0.01)
    assert float(inferred.work_of_adhesion) == pytest.approx(0.05, rel=0.02)
    assert float(inferred.best_error) < 0.01
    for name, known in (("region_range", 4.0), ("region_work", 0.05)):
        low, high = inferred[name].sel(bound=["low", "high"]).values
        assert low < known < high


def test_interval_holds_the_answer_and_is_wide_where_scans_differ():
    narrow, wide = (infer_model(power_forces(spread=spread)) for spread in (0.02, 0.6))
    assert width(wide, "range_of_adhesion") > 3 * width(narrow, "range_of_adhesion")
    low, high = bounds(narrow, "range_of_adhesion")
    assert low <= narrow.range_of_adhesion <= high


def test_interval_is_of_the_confidence_that_is_asked_for():
    half, most = (
        infer_model(power_forces(spread=0.3), bootstrap=Bootstrap(1, 200, confidence))
        for confidence in (0.5, 0.95)
    )
    assert half.mean_force_interval.attrs == {"units": "N", "confidence": 0.5}
    narrow, wide = (one.mean_force_interval.diff("bound") for one in (half, most))
    assert (narrow.values < wide.values).all()
    np.testing.assert_array_equal(half.mean_force, most.mean_force)
    low, high = np.quantile(half.bootstrap_range, [0.25, 0.75])
    np.testing.assert_allclose(half.range_of_adhesion_interval, [low, high])


def test_missing_scans_do_not_count():
    forces = power_forces(spread=0.3)
    short = forces.copy()
    short[0, 3] = np.nan
    np.testing.assert_allclose(
        infer_model(short).mean_force.isel(surface=0),
        forces[0, :3].mean(["scan", "sphere_scan", "contact_y", "contact_x"]),
    )


def test_a_surface_without_a_published_force_does_not_enter_the_fit():
    forces = power_forces()
    forces[0] *= 100
    published = np.where(np.arange(4) == 0, np.nan, MEAN_FORCE)
    inferred = infer_model(forces, published)
    assert float(inferred.range_of_adhesion) == pytest.approx(4.0, rel=0.01)
    assert float(inferred.range_from_ratios) == pytest.approx(4.0, rel=0.01)
    assert inferred.mean_force.sizes["surface"] == 4


def test_fit_is_the_least_of_a_fine_search():
    forces = power_forces(spread=0.5, seed=3)
    forces = forces.mean(["scan", "sphere_scan", "contact_y", "contact_x"]).values
    fine = np.geomspace(RHOS[0], RHOS[-1], 60)
    curve = on_fine_grid(forces, RHOS, fine)
    best, _, error = inference.fit(curve, MEAN_FORCE)
    search = inference.mean_relative_error(curve, MEAN_FORCE, np.geomspace(1e-3, 2, 20001))
    assert error <= search.min() + 1e-12
    assert error == pytest.approx(search.min(), rel=1e-3)
    assert np.unravel_index(search.argmin(), search.shape)[0] == best


def test_region_holds_the_places_of_small_error_and_no_more():
    errors = np.ones((4, 5))
    errors[1, 2] = errors[2, 3] = 0.05
    ranges, works = inference.error_region(errors, RHOS[:4], np.arange(5.0), 0.1)
    assert ranges.tolist() == [1.0, 2.0] and works.tolist() == [2.0, 3.0]
    assert np.isnan(inference.error_region(np.ones((4, 5)), RHOS[:4], np.ones(5), 0.1)).all()


def test_what_cannot_be_decided():
    said = inference.undecided(0.4, 0.1, np.array([0.5, 10.0]), RHOS)
    assert "no range and work" in said and "no upper bound" in said and "no lower bound" in said
    clear = inference.undecided(0.05, 0.1, np.array([3.0, 5.0]), RHOS)
    assert "bound" not in clear and "3.0 and 5.0" in clear


def test_inference_of_a_study_covers_contact_models_and_surfaces():
    plastic = power_forces(spread=0.02, scans=2)
    names = ("label", "basis")
    adhesion = xr.Dataset(
        {"pull_off_force": xr.concat([plastic, plastic / 2], "contact_model")}
        | {name: ("surface", [f"{name} of {surface}" for surface in SUBSTRATES]) for name in names},
        {"contact_model": ["plastic", "rigid"]},
        {"sphere_radius": 0.25e6, "parameters": "those of adhesion"},
    )
    table = TABLE.iloc[::-1]  # the order of the table does not matter
    inferred = inference.infer(adhesion, table, "uncd", 0.1, 30e-9, BOOTSTRAP)
    assert inferred.contact_model.values.tolist() == ["plastic", "rigid"]
    np.testing.assert_allclose(inferred.range_of_adhesion, 4.0, rtol=0.1)
    np.testing.assert_allclose(inferred.work_of_adhesion, [0.05, 0.1], rtol=0.1)
    np.testing.assert_allclose(inferred.force_mean.sel(contact_model="rigid"), MEAN_FORCE, rtol=0.1)
    assert inferred.force_mean_interval.dims == ("contact_model", "surface", "bound")
    assert inferred.label.values.tolist() == [f"label of {surface}" for surface in SUBSTRATES]
    assert inferred.attrs == {
        "error_threshold": 0.1,
        "force_floor": 30e-9,
        "confidence": 0.95,
        "sphere_radius": 0.25e6,
    }
