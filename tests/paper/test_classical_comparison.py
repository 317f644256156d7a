"""classical.nc, from the tables of the paper and a fit."""

import numpy as np
import pytest
import xarray as xr
from intervals import between_multiples
from paper_numbers import AFM, MEAN_FORCE, MODULUS, PARAMETERS, RADIUS, SPHERE, SUBSTRATES, TABLES
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
    """Return mean forces of plastic contact at the published pair, with intervals of ±1 %."""
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
        PARAMETERS.to_dict(),
        published.read_table1(TABLES / "table1.csv"),
        published.read_published_forces(TABLES / "pull_off.csv", dtype=str),
        Sampling(seed=1, sample_count=20, confidence=0.9, stream=("classical",)),
    )


@pytest.fixture(scope="module")
def classical():
    return apply_models(make_fit())


def test_polished_uncd_has_nearly_the_published_effective_work(classical):
    """The paper prints 7.15 mJ/m²; its force and Tabor parameter give 6.97 mJ/m²."""
    work = classical["effective_work_of_adhesion"].sel(surface="polished_uncd")
    assert work.sel(force_source="published").item() == pytest.approx(6.97e-3, rel=1e-3)


def test_intervals_follow_from_the_rounding_and_from_intervals_of_computed_forces(classical):
    polished = classical.sel(surface="polished_uncd", force_source="computed")
    # The paper prints 8.8 µN.
    published_ends = [end.item() for end in interval_ends(polished, "published_mean_force")]
    assert published_ends == pytest.approx([8.75e-6, 8.85e-6])
    work = polished["effective_work_of_adhesion"]
    ratios = [(end / work).item() for end in interval_ends(polished, work.name)]
    assert ratios == pytest.approx([0.99, 1.01])


def test_the_modulus_of_ruby_on_diamond_follows_from_the_published_constants():
    assert published.effective_modulus(PARAMETERS) == pytest.approx(MODULUS)


def test_a_surface_that_the_paper_lacks_has_no_numbers(classical):
    """The published surfaces keep their numbers, and no fit to all of them changes."""
    extended = apply_models(make_fit([*SUBSTRATES, "glass"], [*MEAN_FORCE, 1e-7]))
    assert list(extended["surface"].values) == [*SUBSTRATES, "glass"]
    is_missing = extended["published_mean_force"].isnull()
    assert is_missing.values.tolist() == [False] * 4 + [True]
    assert extended["mean_relative_error"].equals(classical["mean_relative_error"])


@pytest.mark.parametrize("name", CLASSICAL_MODELS)
def test_a_model_has_no_error_on_the_roughness_that_gives_its_forces(name):
    roughness = Roughness(np.array([0.05, 0.1]), np.array([0.1, 0.2]), np.array([0.01, 0.02]))
    target = CLASSICAL_MODELS[name].force(0.08, roughness, SPHERE)
    both = Roughness(*(np.stack([field, 1.5 * field]) for field in roughness))
    error, error_on_rougher = classical_error(CLASSICAL_MODELS[name], both, SPHERE, target)
    assert error < 1e-4 < error_on_rougher


def test_a_model_without_force_has_the_error_one():
    rough = Roughness(AFM.height, AFM.slope, 1e3 * AFM.curvature)
    error = classical_error(CLASSICAL_MODELS["maugis"], rough, SPHERE, MEAN_FORCE)
    assert error == pytest.approx(1)


def test_a_power_law_has_the_least_mean_relative_error():
    works = 3 * AFM.height**-1.2
    assert power_law_error(AFM.height, works) == pytest.approx(0, abs=1e-12)

    def error(parameters):
        log_factor, exponent = parameters
        return np.abs(np.exp(log_factor) * AFM.slope**exponent / works - 1).mean()

    line = np.polyfit(np.log(AFM.slope), np.log(works), 1)
    starts = [line[::-1] + shift for shift in np.random.default_rng(1).normal(0, 0.5, (20, 2))]
    smallest = min(
        minimize(error, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}).fun
        for start in starts
    )
    assert 0.1 < smallest < error(line[::-1])
    assert power_law_error(AFM.slope, works) == pytest.approx(smallest, rel=1e-6)
