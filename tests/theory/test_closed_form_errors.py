"""Errors of the closed form, on small surfaces."""

import numpy as np
import pytest
from known_spectra import rough

from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.closed_form_errors import Trial, closed_form_errors, spectrum_of_grid
from hardcontact.theory.summits import moment

TRIAL = Trial(
    pixels=256, realizations=2, sizes=(2560.0, 5120.0), ranges=(5.6, 20.0),
    contact=Contact(radius=20e3, preload=1e-5, hardness=25e9, window=5120.0, count=4),
    work=0.05, rho=5.6, tolerance=0.1, confidence=0.95, seed=1,
)  # fmt: skip


@pytest.fixture(scope="module")
def errors():
    return closed_form_errors({"a": rough(4, 500, 0.8, 40)}, TRIAL)


def test_the_spectrum_of_a_grid_has_the_rms_height_of_its_surfaces():
    spectrum = rough(4, 500, 0.8, 10)
    heights = [random_surface(generator(2, k), 256, 10.0, spectrum).heights for k in range(8)]
    height = np.sqrt(moment(spectrum_of_grid(spectrum, 2560.0, 256), 0))
    assert height == pytest.approx(np.sqrt(np.mean(np.square(heights))), rel=0.03)
    with pytest.raises(ValueError, match="expected waves between"):
        spectrum_of_grid(spectrum, 1e-3, 4)


def test_errors_are_ratios_of_predicted_to_computed_forces(errors):
    assert set(errors.predicted_over_computed.dims) == {"surface", "map_size", "source", "rho"}
    ratio = errors.predicted_force / errors.computed_force
    assert errors.predicted_over_computed.values == pytest.approx(
        ratio.transpose(*errors.predicted_over_computed.dims).values
    )
    assert errors.predicted_over_computed.sel(source="contacts").values == pytest.approx(1, abs=0.1)
    interval = errors.computed_force_interval
    assert (interval.sel(bound="low") <= errors.computed_force).all()
    assert (errors.computed_force <= interval.sel(bound="high")).all()
