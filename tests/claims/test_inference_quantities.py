"""Numbers about range and work of adhesion against closed forms."""

import numpy as np
import pytest
from paper_claims import NUMBERS, PARAMETERS, near
from paper_datasets import RADIUS, make_inference, make_laws
from scipy import constants
from scipy.integrate import quad

from hardcontact.claims.inference_quantities import (
    error_overlap,
    half_width_of_range,
    half_width_of_work,
    interaction_radius,
    interaction_radius_at_fit,
    interaction_share,
    least_ratio_error,
    only_longer_range_fits,
    only_one_minimum_fits,
    only_plastic_fits,
    short_range_force,
    sinusoid_share,
    strength_over_known,
)


@pytest.mark.parametrize("rho", [PARAMETERS[f"sinusoid_range_{end}"] for end in ("short", "long")])
def test_sinusoid_share(rho):
    def attraction(x):
        return np.exp(-PARAMETERS["sinusoid_amplitude"] * (1 - np.cos(x)) / rho)

    expected = quad(attraction, 0, np.pi / 2)[0] / quad(attraction, 0, np.pi)[0]
    near(sinusoid_share(NUMBERS).sel(rho=rho), expected)


@pytest.mark.parametrize(
    ("law", "known"),
    [
        ("retarded", lambda gap: np.pi**2 * constants.hbar * constants.c / (240 * gap**4)),
        ("van_der_waals", lambda gap: 5e-19 / (6 * np.pi * gap**3)),
        ("electrostatic", lambda gap: constants.epsilon_0 / (2 * gap**2)),  # of one volt
    ],
)
def test_strength_is_the_largest_ratio_of_pressures_at_any_gap(law, known):
    rho, gaps = 5.6e-9, np.geomspace(1e-10, 1e-6, 4001)
    expected = (0.0463 / rho * np.exp(-gaps / rho) / known(gaps)).max()
    near(strength_over_known(NUMBERS).sel(law=law), expected, rtol=1e-5)


def test_errors_overlap_if_they_have_a_value_in_common():
    laws = make_laws()
    near(error_overlap(laws), [1.01 / 0.99] * 3)
    laws["fit_error_interval"].loc[{"law": "electrostatic", "case": "fitted"}] = [0.4, 0.5]
    near(error_overlap(laws).sel(case="fitted"), 0.3 * 1.01 / 0.4)


def test_interaction_radius():
    near(interaction_radius(NUMBERS), 1673, atol=1)
    near(interaction_radius_at_fit(make_inference()).sel(contact_model="plastic"), 1673, atol=1)


def test_interaction_share():
    radius, rho = np.sqrt(2 * RADIUS * 5.6), 5.6

    def ring(r):
        return r * np.exp(-(r**2) / (2 * RADIUS * rho))

    near(interaction_share(NUMBERS), quad(ring, 0, radius)[0] / quad(ring, 0, 20 * radius)[0])
    near(interaction_share(NUMBERS), 1 - np.exp(-1))


def test_force_at_short_range():
    inference = make_inference().sel(contact_model="plastic")
    short = short_range_force(inference, NUMBERS).sel(surface="polished_uncd")
    near(short, 8.8e-6 * 0.6 / 5.6)
    without = inference.isel(rho=slice(1, None))
    assert np.isnan(short_range_force(without, NUMBERS)["value"]).all()


#: Errors of what must not fit and of what must, and whether only the second fits: threshold 0.1.
FITS = [(0.5, 0.05, True), (0.5, 0.3, False), (0.05, 0.03, False), (0.05, 0.5, False)]


@pytest.mark.parametrize(("misfit", "fit", "expected"), FITS)
def test_what_fits_nothing_shows_nothing(misfit, fit, expected):
    inference = make_inference()
    for end in ("", "_interval"):
        inference[f"best_error{end}"].loc[{"contact_model": "rigid"}] = misfit
        inference[f"best_error{end}"].loc[{"contact_model": "plastic"}] = fit
    inference["error_of_range"].loc[{"rho_fine": 0.5}] = misfit
    inference["minimum_error"].loc[{"minimum": 2}] = misfit
    plastic = inference.sel(contact_model=["plastic"])
    for computed in (
        only_plastic_fits(inference, NUMBERS),
        only_longer_range_fits(plastic, NUMBERS),
        only_one_minimum_fits(plastic, NUMBERS),
    ):
        near(computed, min(misfit / 0.1, 0.1 / fit))
        assert bool((computed["value"] > 1).all()) is expected


def test_a_single_minimum_is_the_only_one_that_fits():
    inference = make_inference().sel(contact_model="plastic")
    near(only_one_minimum_fits(inference, NUMBERS), 2.0)
    inference["minimum_error"].loc[{"minimum": 2}] = np.nan
    near(only_one_minimum_fits(inference, NUMBERS), 2.0)


def test_error_of_ratios_and_half_widths():
    near(least_ratio_error(make_inference()), [0.4, 0.05])
    plastic = make_inference().sel(contact_model="plastic")
    near(half_width_of_range(plastic), 0.5)
    near(half_width_of_work(plastic), 0.0035)
