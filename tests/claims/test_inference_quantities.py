"""Numbers about range and work of adhesion against closed forms."""

import numpy as np
import pytest
from paper_claims import NUMBERS, PARAMETERS, near
from paper_datasets import RADIUS, make_inference
from scipy.integrate import quad

from hardcontact.claims.inference_quantities import (
    force_at_published_pair,
    half_width_of_range,
    half_width_of_work,
    interaction_radius,
    interaction_share,
    least_ratio_error,
    ratio_at_fit,
    short_range_error,
    short_range_force,
    sinusoid_share,
)


@pytest.mark.parametrize("rho", [PARAMETERS[f"sinusoid_range_{end}"] for end in ("short", "long")])
def test_sinusoid_share(rho):
    def attraction(x):
        return np.exp(-PARAMETERS["sinusoid_amplitude"] * (1 - np.cos(x)) / rho)

    expected = quad(attraction, 0, np.pi / 2)[0] / quad(attraction, 0, np.pi)[0]
    near(sinusoid_share(NUMBERS).sel(rho=rho), expected)


def test_interaction_radius():
    radius = interaction_radius(make_inference()).sel(contact_model="plastic")
    assert float(radius["value"]) == pytest.approx(1673, abs=1)


def test_interaction_share():
    radius, rho = np.sqrt(2 * RADIUS * 5.6), 5.6

    def ring(r):
        return r * np.exp(-(r**2) / (2 * RADIUS * rho))

    expected = quad(ring, 0, radius)[0] / quad(ring, 0, 20 * radius)[0]
    share = interaction_share(make_inference()).sel(contact_model="plastic")
    near(share, expected)
    assert float(share["value"]) == pytest.approx(1 - np.exp(-1))


def test_ratio_at_fit_interpolates_each_contact_model_at_its_own_range():
    inference = make_inference()
    inference["ratio"][:] = inference["rho"]
    inference["range_of_adhesion"][:] = [3.0, 5.0]
    ratio = ratio_at_fit(inference)["value"].sel(surface="mcd")
    np.testing.assert_allclose(ratio, [3.0, 5.0])


def test_forces_at_the_published_pair_and_at_short_range():
    inference = make_inference().sel(contact_model="plastic")
    near(force_at_published_pair(inference, NUMBERS), [8.8e-6, 0.4e-6, 0.16e-6, 0.11e-6])
    short = short_range_force(inference, NUMBERS).sel(surface="polished_uncd")
    near(short, 8.8e-6 * 0.6 / 5.6)
    without = inference.isel(rho=slice(1, None))
    assert np.isnan(short_range_force(without, NUMBERS)["value"]).all()


def test_errors_of_parts_of_the_map():
    inference = make_inference()
    near(short_range_error(inference, NUMBERS), [0.8, 0.8])
    near(least_ratio_error(inference), [0.4, 0.05])
    plastic = inference.sel(contact_model="plastic")
    near(half_width_of_range(plastic), 0.5)
    near(half_width_of_work(plastic), 0.0035)
