"""Models of others beside direct integrals, their limits, and what is said of their factors."""

import numpy as np
import pandas as pd
import pytest
from figure_inputs.closed_form import closed_form
from scipy import integrate, stats

from hardcontact.insight.closed_form import MANY_POINTS
from hardcontact.insight.other_models import (
    Cases,
    bearing_approach,
    bearing_area_model,
    forces_of_others,
    models_beside_computed,
    persson_scaraggi,
)
from hardcontact.insight.prediction import VALIDATION

#: Law of attraction over W/rho, of gaps in ranges of adhesion.
LAWS = {
    persson_scaraggi: lambda gap: np.exp(-gap),
    bearing_area_model: lambda gap: gap < 1,
}


def direct(law, sigma, approach, rho):
    """Sum a law of attraction over heights below a sphere and over rings of equal separation."""
    heights = (np.arange(8000) + 0.5) / 8000 * 16 - 8
    weights = stats.norm.pdf(heights) * 16 / 8000
    separations = np.linspace(approach, approach + 12 * sigma + 30 * rho, 4001)
    step = separations[1] - separations[0]
    gaps = separations[:, None] - sigma * heights
    pressure = (np.where(gaps > 0, law(gaps / rho), 0) * weights).sum(axis=1)
    return (pressure.sum() - pressure[[0, -1]].sum() / 2) * step / rho


@pytest.mark.parametrize("model", LAWS)
@pytest.mark.parametrize(
    ("sigma", "approach", "rho"), [(3, 8, 5.6), (20, 50, 2), (1, -0.5, 4), (8, 0, 8)]
)
def test_a_force_is_the_law_summed_over_heights_and_rings(model, sigma, approach, rho):
    expected = direct(LAWS[model], sigma, approach, rho)
    assert model(sigma, approach, rho) == pytest.approx(expected, rel=5e-3)


def test_the_bearing_area_of_a_sphere_is_that_of_its_load():
    heights, radius = np.array([0.5, 5.0, 80.0]), 1e5
    areas = 2 * np.pi * radius * heights * stats.norm.pdf(0)  # at the mean plane
    assert bearing_approach(heights, radius, areas) == pytest.approx(0, abs=1e-10)
    m = bearing_approach(5.0, radius, 400.0)
    above = 5 * integrate.quad(stats.norm.sf, m / 5, 12)[0]
    assert 2 * np.pi * radius * above == pytest.approx(400)
    assert bearing_approach(1e-5, radius, 400.0) == pytest.approx(-400 / (2 * np.pi * radius))


def test_without_roughness_all_are_the_smooth_sphere():
    cases = Cases(1e5, 5.6, 400.0, 1e-6, 1e-9, 0.0)
    share = 400 / (2 * np.pi * 1e5 * 5.6)
    *forces, of_caps = forces_of_others(cases)
    assert forces == pytest.approx([1 + share] * 4, rel=1e-3)
    assert of_caps == pytest.approx(2, rel=1e-5)  # its contact and its plane both count in full


def test_factors_are_predicted_over_computed_and_told_of_what_was_held_back():
    designed = pd.read_csv(VALIDATION)
    grid = {"waves_height": 4.0, "waves_gradient": 0.1, "contact_area": 400.0}
    data = closed_form().assign_attrs(sphere_radius=250e3, work_of_adhesion=0.05)
    data = data.assign(
        {name: (("surface", "map_size"), [[one] * 2] * 4) for name, one in grid.items()}
    )
    data["waves_height"][3] = 0.0
    found = models_beside_computed(designed, data)
    of_formula = designed["predicted_force"] / designed["force"]
    assert found.factor.sel(model="closed_form").values == pytest.approx(of_formula.to_numpy())
    expected = data["error"].sel(source="spectrum").isel(map_size=-1)
    ours = found.surface_factor.sel(model="closed_form")
    assert ours.values == pytest.approx(expected.transpose(*ours.dims).values)
    assert found.surface_factor.drop_sel(model="closed_form")[:, 3].isnull().all()
    chosen = of_formula[(designed["held_back"] == 1) & (designed["regime"] == MANY_POINTS)]
    at = {"model": "closed_form", "regime": MANY_POINTS}
    assert found.median_factor.sel(at).item() == pytest.approx(chosen.median())
    low, high = found.median_factor_interval.sel(at).values
    assert 0.8 < ((low <= chosen) & (chosen <= high)).mean() < 0.95
    assert found.rms_factor.sel(at).item() == pytest.approx(
        np.exp(np.log(chosen).pow(2).mean() ** 0.5)
    )
