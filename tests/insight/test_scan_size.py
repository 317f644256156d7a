"""Windows of surfaces against the surfaces; rules for the scan size against known ones."""

import numpy as np
import pytest
from scan_windows import LOAD, RANGES, contacts_on

from hardcontact.adhesion.pull_off import mean_pull_off_of_pair
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.insight.scan_size_trials import Case, ScanSizeRule, correction_errors, fitted_rule
from hardcontact.insight.scan_windows import window_forces
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.topography import level, mirror_stitch

WINDOWS = contacts_on(640.0, 2000.0, [320.0, 640.0])


def surface(rms):
    heights = rms * np.random.default_rng(4).standard_normal((64, 64))
    return HeightMap(heights, 10.0, periodic=True, basis="substitute")


def mean_force(one):
    contact = Contact(radius=2000.0, window=640.0, count=2, **LOAD)
    return mean_pull_off_of_pair(bodies(one, None, contact), [contact], RANGES)[
        "pull_off_force"
    ].values[0]


def test_windows_of_a_flat_surface_have_its_force():
    forces = window_forces(surface(0.0), WINDOWS)
    assert len(forces) == 3  # of two sizes of windows and of the surface
    np.testing.assert_allclose(forces, np.broadcast_to(forces[-1:], forces.shape))


def test_windows_are_cut_along_the_diagonal_levelled_and_mirrored():
    whole = surface(3.0)
    windows = [
        HeightMap(whole.heights[part, part], 10.0, periodic=False, basis="substitute")
        for part in (slice(0, 32), slice(32, 64))
    ]
    expected = np.mean([mean_force(mirror_stitch(level(one))) for one in windows], axis=0)
    forces = window_forces(whole, WINDOWS)
    np.testing.assert_allclose(forces[0], expected)
    np.testing.assert_allclose(forces[-1], mean_force(whole))


TRUE = ScanSizeRule(0.4, np.array([1.2, 0.5, 0.3]))


def cases(seed, count=40):
    rng = np.random.default_rng(seed)
    return Case(
        rng.uniform(1000, 10e3, count),
        rng.uniform(2, 50, count),
        rng.uniform(400, 2500, count),
        rng.choice([20e3, 250e3], count),
        rng.uniform(2, 10, count),
    )


def test_rule_is_found_again_and_corrects_surfaces_it_was_not_fitted_to():
    known, others = cases(1), cases(2)
    rule = fitted_rule(known, TRUE.excess(known))
    assert rule.strength == pytest.approx(TRUE.strength, rel=1e-3)
    np.testing.assert_allclose(rule.exponents, TRUE.exponents, atol=1e-3)
    corrected, uncorrected = correction_errors(rule.excess(others), TRUE.excess(others))
    assert corrected < 1e-3 * uncorrected


def test_rule_of_noise_does_not_correct():
    rng = np.random.default_rng(9)
    known, others = cases(1), cases(2)
    rule = fitted_rule(known, np.exp(0.3 * rng.standard_normal(40)))
    noise = np.exp(0.3 * rng.standard_normal(40))
    corrected, uncorrected = correction_errors(rule.excess(others), noise)
    assert corrected > 0.9 * uncorrected


def test_size_for_an_excess_has_that_excess():
    case = cases(3)
    size = TRUE.size_for(case, 1.1)
    np.testing.assert_allclose(TRUE.excess(case._replace(size=size)), 1.1)


def test_rule_needs_four_scans():
    few = Case([1e3, 2e3], 10.0, 900.0, 250e3, 5.6)
    with pytest.raises(ValueError, match="four scans or more"):
        fitted_rule(few, [2.0, 1.5])
