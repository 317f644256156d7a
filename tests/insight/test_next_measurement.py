"""The next measurement: nothing told narrows nothing, all told leaves nothing, intervals hold."""

from dataclasses import replace

import numpy as np
import pytest
from known_spectra import rough
from scipy import stats

from hardcontact.insight.closed_form import Contact, closed_form
from hardcontact.insight.next_measurement import (
    CONTACTS,
    OUTCOMES,
    TRUTHS,
    AtHand,
    Scan,
    drawn_truths,
    linear_estimate,
    of_scan,
    present_intervals,
    scans,
    widths_left,
)
from hardcontact.surfaces.spectrum import BIN_CENTRES

CONTACT = Contact(250e3, 5.6, 0.0463, 400.0)
PAIRS = [(5.6, 0.0463), (8.6, 0.013), (1.3, 0.092)]


def drawn(number, seed=1):
    """Spectra whose height and Hurst exponent are not known, and their logarithms at two waves."""
    rng = np.random.default_rng(seed)
    spectra = [
        rough(rms=8 * np.exp(0.2 * height), hurst=0.75 + 0.05 * slope, shortest=20.0)
        for height, slope in rng.standard_normal((number, 2))
    ]
    waves = 2 * np.pi / np.array([900.0, 60.0])
    return spectra, np.log([spectrum(waves) for spectrum in spectra])


def test_what_tells_nothing_narrows_nothing_and_what_tells_all_leaves_nothing():
    y = np.random.default_rng(1).standard_normal((200, 1))
    for data, errors in ((y, [[1e12]]), (np.ones_like(y), [[0.0]])):
        left = linear_estimate(y, data, np.array(errors))[1] / y.var(ddof=1)
        assert left == pytest.approx(1.0, rel=0.01)
    assert linear_estimate(y, 3 - 2 * y, np.zeros((1, 1)))[1] == pytest.approx(0, abs=1e-12)
    half = linear_estimate(y, y, np.array([[y.var(ddof=1)]]))[1] / y.var(ddof=1)
    assert half == pytest.approx(0.5, rel=0.01)


def test_the_order_of_data_and_their_units_do_not_matter():
    rng = np.random.default_rng(2)
    y, x = rng.standard_normal((50, 2)), rng.standard_normal((50, 3))
    errors, scale = np.diag([0.1, 0.2, 0.3]), np.diag([5.0, 0.1, 2.0])
    left = linear_estimate(y, x, errors)[1]
    np.testing.assert_allclose(linear_estimate(y, x @ scale, scale @ errors @ scale)[1], left)
    turned = linear_estimate(y, x[:, ::-1], errors[::-1, ::-1])[1]
    np.testing.assert_allclose(turned, left)


def test_intervals_hold_95_of_100_truths():
    # Forces that the closed form gives other truths, estimated from their spectra with errors.
    errors = np.diag([0.05, 0.1])
    for_sure, tried = drawn(TRUTHS), drawn(200, seed=2)
    known, y = (
        np.log([[closed_form(one, CONTACT).force] for one in spectra])
        for spectra, _ in (for_sure, tried)
    )
    gain, variance = linear_estimate(known, for_sure[1], errors)
    rng = np.random.default_rng(3)
    measured = tried[1] + rng.multivariate_normal(np.zeros(2), errors, len(y))
    estimate = known.mean(axis=0) + (measured - for_sure[1].mean(axis=0)) @ gain
    width = stats.t.ppf(0.975, TRUTHS - 3) * np.sqrt(variance)
    inside = int((np.abs(y - estimate) < width).sum())
    assert stats.binomtest(inside, len(y), 0.95).pvalue > 0.01, inside
    # The interval is narrower than without the measurement, which holds as many.
    assert width < 0.8 * 1.96 * known.std(ddof=1)


@pytest.fixture(scope="module")
def truths():
    spectra, _ = drawn(6)
    rng = np.random.default_rng(1)
    return drawn_truths(rng, spectra, rough(rms=8), CONTACT, PAIRS, 0.1)


def test_truths_are_those_of_the_closed_form_and_take_the_pairs_in_turn(truths):
    spectra, _ = drawn(6)
    rho, work = PAIRS[1]
    force = closed_form(spectra[4], replace(CONTACT, rho=rho, work=work)).force
    of_truth = truths.isel(draw=4)["true_outcome"]
    assert of_truth.sel(outcome=list(OUTCOMES[2:])).values == pytest.approx([force, rho, work])
    forces = truths["true_force"]
    assert (forces.sel(contact="coating") > forces.sel(contact="forces")).all()
    at_radius = closed_form(spectra[4], Contact(25e3, rho, work, 400.0)).force
    assert forces.sel(contact="radius")[4] == pytest.approx(at_radius)
    assert list(truths["contact"].values) == list(CONTACTS)


def test_what_is_measured_already_is_not_proposed_and_one_pair_needs_no_telling(truths):
    possible = scans(100.0, 3000.0, 9000.0, 100.0)
    left = widths_left(truths, possible, AtHand(0.1, 1, False))
    assert set(left) == {*possible, *CONTACTS}
    assert left["forces"]["force"] < 0.5
    assert "forces" not in widths_left(truths, possible, AtHand(0.1, 1, True))
    alone = truths.isel(draw=slice(0, None, 3))
    told = widths_left(alone, {}, AtHand(0.1, 1, False))
    assert np.isnan([told[name]["range"] for name in told]).all()


def test_scans_that_may_be_next_are_what_instruments_reach():
    fine = scans(5.0, 50e3, 10e3, 80.0)
    assert set(fine) == {"more_places", "stylus", "section"}
    assert fine["more_places"] == Scan("map", 10e3, 80.0, 10e3 / 3, 3)
    assert scans(200.0, 20e3, 60e3, 50.0)["larger_map"].size == 100e3


def test_the_present_interval_holds_the_truths(truths):
    low, high = present_intervals(truths, AtHand(0.0, 1, False), 1.0)["force"]
    forces = truths["true_outcome"].sel(outcome="force")
    assert (low, high) == pytest.approx((forces.min().item(), forces.max().item()))


def test_a_scan_tells_its_own_wavelengths_and_more_places_tell_them_better():
    spectra = np.tile(np.where(BIN_CENTRES < 1, rough()(BIN_CENTRES), 0), (4, 1))
    one, three = (of_scan(Scan("map", 9e3, 100.0, 3000.0, places), spectra) for places in (1, 3))
    assert one[0].shape == (4, 3) and (np.diag(three[1]) < np.diag(one[1])).all()
    assert of_scan(Scan("map", 9e3, 1e-3, 2e-3), spectra)[0].shape == (4, 0)
