"""Fits of classical models and of power laws to known forces."""

import numpy as np
import pytest
from paper_numbers import AFM, MEAN_FORCE, SPHERE
from scipy.optimize import minimize

from hardcontact.paper.classical_fits import fit_classical_work, power_law_error
from hardcontact.paper.classical_models import MODELS, Roughness


@pytest.mark.parametrize("name", MODELS)
def test_fit_finds_the_work_that_made_the_forces(name):
    gentle = Roughness(np.array([0.05, 0.1]), np.array([0.1, 0.2]), np.array([0.01, 0.02]))
    target = MODELS[name].force(0.08, gentle, SPHERE)
    amplitudes = Roughness(*(np.stack([values, 1.5 * values]) for values in gentle))
    work, error = fit_classical_work(MODELS[name], amplitudes, SPHERE, target)
    assert work[0] == pytest.approx(0.08, rel=1e-4) and error[0] < 1e-3
    assert error[1] > error[0]


def test_fit_of_forces_that_vanish_has_no_work():
    rough = Roughness(AFM.height, AFM.slope, 1e3 * AFM.curvature)
    work, error = fit_classical_work(MODELS["maugis"], rough, SPHERE, MEAN_FORCE)
    assert np.isnan(work) and error == pytest.approx(1)


def test_a_power_law_has_the_least_mean_relative_error():
    works = 3 * AFM.height**-1.2
    assert power_law_error(AFM.height, works) == pytest.approx(0, abs=1e-12)

    def error(parameters):
        factor, exponent = parameters
        return np.abs(np.exp(factor) * AFM.slope**exponent / works - 1).mean()

    line = np.polyfit(np.log(AFM.slope), np.log(works), 1)
    starts = [line[::-1] + shift for shift in np.random.default_rng(1).normal(0, 0.5, (20, 2))]
    smallest = min(
        minimize(error, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}).fun
        for start in starts
    )
    assert 0.1 < smallest < error(line[::-1])
    assert power_law_error(AFM.slope, works) == pytest.approx(smallest, rel=1e-6)
