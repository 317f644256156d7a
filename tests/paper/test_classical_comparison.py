"""The classical dataset of a study, from the tables of the paper and a fit."""

import numpy as np
import pytest
import xarray as xr
from intervals import between_multiples
from paper_numbers import AFM, MEAN_FORCE, MODULUS, RADIUS, SPHERE, SUBSTRATES, TABLES
from scipy.optimize import minimize

from hardcontact.base import published
from hardcontact.base.statistics import Sampling, interval_ends
from hardcontact.paper.classical_comparison import (
    apply_classical_models,
    classical_error,
    power_law_error,
)
from hardcontact.paper.classical_models import CLASSICAL_MODELS, Roughness


def make_fit(surfaces=SUBSTRATES, forces=MEAN_FORCE):
    """Mean forces of plastic contact at the published pair, to within 1 %."""
    dims = ("contact_model", "pair", "surface")
    return xr.Dataset(
        between_multiples("mean_force_at_pair", dims, [[forces]], (0.99, 1.01))
        | {"label": ("surface", surfaces), "source": ("surface", ["measured"] * len(surfaces))},
        {"contact_model": ["plastic"], "pair": ["published"], "surface": surfaces},
        {"sphere_radius": RADIUS, "error_threshold": 0.1},
    )


def apply_models(fit):
    return apply_classical_models(
        fit,
        published.read_constants(TABLES / "constants.csv")["value"].to_dict(),
        published.read_table1(TABLES / "table1.csv"),
        published.read_published_forces(TABLES / "pull_off.csv", dtype=str),
        Sampling(seed=1, sample_count=20, confidence=0.9, stream=("classical",)),
    )


@pytest.fixture(scope="module")
def classical():
    return apply_models(make_fit())


def test_polished_uncd_has_the_published_force_and_nearly_its_work(classical):
    """The paper prints 8.8 µN and 7.15 mJ/m²; with its Tabor parameter the work is 6.97 mJ/m²."""
    uncd = classical.sel(surface="polished_uncd")
    low, high = interval_ends(uncd, "published_mean_force")
    assert (float(low), float(high)) == pytest.approx((8.75e-6, 8.85e-6))
    work = uncd["effective_work_of_adhesion"].sel(force_source="published")
    assert work.item() == pytest.approx(6.97e-3, rel=1e-3)
    low, high = interval_ends(uncd, "effective_work_of_adhesion")
    work = uncd["effective_work_of_adhesion"].sel(force_source="computed").item()
    ends = [end.sel(force_source="computed").item() / work for end in (low, high)]
    assert ends == pytest.approx([0.99, 1.01])
    constants = published.read_constants(TABLES / "constants.csv").value
    assert published.effective_modulus(constants) == pytest.approx(MODULUS)


def test_a_surface_that_the_paper_lacks_has_no_numbers(classical):
    """The published surfaces keep their numbers, and no fit to all of them changes."""
    extended = apply_models(make_fit([*SUBSTRATES, "glass"], [*MEAN_FORCE, 1e-7]))
    assert list(extended["surface"].values) == [*SUBSTRATES, "glass"]
    is_missing = extended["published_mean_force"].isnull()
    assert is_missing.values.tolist() == [False] * 4 + [True]
    assert extended["mean_relative_error"].equals(classical["mean_relative_error"])


@pytest.mark.parametrize("name", CLASSICAL_MODELS)
def test_the_forces_of_a_model_are_fitted_without_error(name):
    gentle = Roughness(np.array([0.05, 0.1]), np.array([0.1, 0.2]), np.array([0.01, 0.02]))
    target = CLASSICAL_MODELS[name].force(0.08, gentle, SPHERE)
    amplitudes = Roughness(*(np.stack([values, 1.5 * values]) for values in gentle))
    error = classical_error(CLASSICAL_MODELS[name], amplitudes, SPHERE, target)
    assert error[0] < 1e-4 and error[1] > error[0]


def test_forces_that_vanish_have_the_error_one():
    rough = Roughness(AFM.height, AFM.slope, 1e3 * AFM.curvature)
    error = classical_error(CLASSICAL_MODELS["maugis"], rough, SPHERE, MEAN_FORCE)
    assert error == pytest.approx(1)


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
