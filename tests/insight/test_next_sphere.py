"""The next sphere: no change tells nothing, more is told the farther the pairs lie apart."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from known_spectra import rough

from hardcontact.insight.closed_form import Contact, closed_form
from hardcontact.insight.next_sphere import (
    RIGHT,
    Known,
    Spheres,
    checked_changes,
    mean_variance,
    next_spheres,
)
from hardcontact.insight.prediction import change_error, validation
from hardcontact.insight.pull_off_statistics import ForceStatistics

SPHERES = Spheres(
    250e3, 1e-5, 25e9, radii=(2e4, 250e3), preloads=(1e-5, 5e-5), tests=2000, spheres=5, floor=1e-9
)
RANGES = {"long_range": (8.6, 0.15), "short_range": (1.3, 0.33)}

ERRORS = ("range", "spectrum", "model", "test")


def separated(ranges=RANGES, scatter=0.7, height_error=0.1, spheres=SPHERES):
    known = Known(rough(rms=15), height_error, 4e-7, scatter)
    return next_spheres({"uncd": known}, ranges, spheres).squeeze("surface")


def test_the_sphere_that_was_measured_with_tells_nothing():
    found = separated()
    same = found.sel(radius=250e3, preload=1e-5)
    assert (same["separation"] == 0).all() and (same["spectrum_error"] == 0).all()
    assert (same["predicted_force"] == 4e-7).all()
    assert (found["separation"].sel(radius=2e4) > 1).all()


def test_pairs_are_separated_alike_in_either_order_and_equal_ones_never():
    swapped = dict(zip(RANGES, reversed(RANGES.values()), strict=True))
    xr.testing.assert_allclose(separated()["separation"], separated(swapped)["separation"])
    assert (separated(dict.fromkeys(RANGES, (5.6, 0.1)))["separation"] == 0).all()


def test_the_parts_of_the_error_add_as_squares_and_fade_with_tests_and_spheres():
    found = separated()
    variance = sum(found[f"{name}_error"] ** 2 for name in ERRORS)
    apart = np.abs(np.diff(found["predicted_change"], axis=0)[0])
    expected = apart[..., None] / np.sqrt(variance.mean("pair").values)
    np.testing.assert_allclose(found["separation"].transpose("preload", "radius", ...), expected)
    law = ForceStatistics(4.0, 1.0, 1.0, np.ones(1), np.ones(1), np.array([0.3]))
    variance = mean_variance(law, 0.7, SPHERES)
    single = mean_variance(law, 0.7, replace(SPHERES, spheres=1))
    assert single[1] == pytest.approx(np.expm1(0.09) / 2000 + 0.4)
    four = mean_variance(law, 0.7, replace(SPHERES, tests=8000))
    np.testing.assert_allclose(four[0], variance[0] / 4, rtol=1e-3)
    assert np.expm1(variance[1]) == pytest.approx(np.expm1(0.4) / 5, rel=1e-3)
    assert np.ptp(mean_variance(law, 0.1, SPHERES)) == 0


def test_95_of_100_changes_name_the_right_pair_from_the_stated_separation_on():
    drawn = np.random.default_rng(3).standard_normal(40_000)
    assert np.mean(np.abs(drawn) < np.abs(drawn - RIGHT)) == pytest.approx(0.95, abs=0.004)


def test_a_bias_that_all_designed_surfaces_share_cancels(monkeypatch):
    place = {"modulus": 1.5, "contact_over_rolloff": 0.05, "regime": "many points"}
    other = {"modulus": 0.3, "contact_over_rolloff": 0.05, "regime": "single peaks"}
    assert change_error(place, other) == pytest.approx(change_error(other, place))
    assert change_error(place, other) > 0.1
    same = validation().assign(force_error=0.6)
    monkeypatch.setattr("hardcontact.insight.prediction.validation", lambda: same)
    assert change_error(place, other) == 0


def test_forces_of_the_closed_form_are_known_exactly_and_wrong_ones_are_not():
    spectrum, over = rough(rms=15), {"radius": [5e4, 250e3], "area": [400.0, 2e3], "rho": [2.0]}
    forces = xr.DataArray(np.ones((2, 2, 1)), over)
    for radius in over["radius"]:
        for area in over["area"]:
            force = closed_form(spectrum, Contact(radius, 2.0, 1.0, area)).force
            forces.loc[radius, area] = force
    exact = checked_changes({"uncd": forces}, {"uncd": spectrum}, SPHERES)
    assert exact["checked_share"] == 1 and exact["checked_error"] < 1e-9
    assert exact["checked_changes"] == 3 and exact["checked_radii"] == [5e4, 250e3]
    forces.loc[5e4] *= 20
    wrong = checked_changes({"uncd": forces}, {"uncd": spectrum}, SPHERES)
    assert wrong["checked_share"] == pytest.approx(1 / 3)
