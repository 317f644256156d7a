"""The classical dataset of a study, from the tables of the paper and an inference dataset."""

import numpy as np
import pytest
import xarray as xr
from paper_claims import TABLES
from paper_numbers import MEAN_FORCE, SUBSTRATES
from published_contact import AFM, CONTACT, RADIUS, WORK

from hardcontact.contact import smooth_sphere
from hardcontact.inference.classical_comparison import apply_classical_models
from hardcontact.inference.classical_models import MODELS
from hardcontact.numbers.statistics import Sampling, bounds
from hardcontact.records import published


def make_inference(surfaces=SUBSTRATES, forces=MEAN_FORCE):
    """Mean forces of plastic contact at the published pair, to within 1 %."""
    dims = ("contact_model", "pair", "surface")
    return xr.Dataset(
        {
            "force_mean": (dims, [[forces]]),
            "force_mean_interval": ((*dims, "bound"), [[np.outer(forces, [0.99, 1.01])]]),
            "label": ("surface", surfaces),
            "basis": ("surface", ["measured"] * len(surfaces)),
        },
        {"contact_model": ["plastic"], "pair": ["published"], "surface": surfaces,
         "bound": ["low", "high"]},
        {"sphere_radius": RADIUS, "error_threshold": 0.1},
    )  # fmt: skip


def classical_of(inference, seed=1):
    return apply_classical_models(
        inference,
        published.constants(TABLES / "parameters.csv"),
        published.table1(TABLES / "table1.csv"),
        published.printed_pull_off(TABLES / "pull_off.csv"),
        Sampling(seed, 20, 0.9, ("classical",)),
    )


@pytest.fixture(scope="module")
def classical():
    return classical_of(make_inference())


def test_forces_are_the_printed_and_the_computed_ones(classical):
    np.testing.assert_allclose(classical["published_mean_force"], MEAN_FORCE, rtol=1e-15)
    np.testing.assert_array_equal(classical["computed_mean_force"], MEAN_FORCE)
    low, high = bounds(classical.sel(surface="polished_uncd"), "published_mean_force")
    assert (float(low), float(high)) == pytest.approx((8.75e-6, 8.85e-6))  # 8.8e-6 is printed
    low, high = bounds(classical, "computed_mean_force")
    np.testing.assert_allclose(low, 0.99 * MEAN_FORCE)


def test_printed_tabor_parameter_is_not_what_printed_works_imply(classical):
    """8.8 µN and 7.15 mJ/m² imply 1.557 to 1.577; a Tabor parameter of 0.81 gives 1.61."""
    low, high = bounds(classical.sel(surface="polished_uncd"), "implied_pull_off_coefficient")
    assert (float(low), float(high)) == pytest.approx((1.557, 1.577), abs=5e-4)
    maugis = smooth_sphere.maugis_parameter(0.81)
    assert smooth_sphere.maugis_dugdale_coefficient(maugis) == pytest.approx(1.610, abs=1e-3)
    assert smooth_sphere.transition_coefficient(maugis) == pytest.approx(1.607, abs=1e-3)


def test_smooth_sphere_is_that_of_the_published_parameters(classical):
    assert float(classical["effective_modulus"]) == CONTACT.modulus
    assert float(classical["hertz_peak_pressure"]) == pytest.approx(137e6, rel=5e-3)
    assert float(classical["tabor_parameter"]) == pytest.approx(0.618, abs=5e-4)
    assert float(classical["printed_tabor_parameter"]) == 0.81
    assert classical.attrs["sphere_radius"] == RADIUS and classical.attrs["confidence"] == 0.9


def test_models_take_the_roughness_of_the_scans_and_of_all_scales(classical):
    assert list(classical["model"].values) == list(MODELS)
    for name, model in MODELS.items():
        of_scans = classical["pull_off_force"].sel(metrics="afm", model=name)
        np.testing.assert_allclose(of_scans, model.force(WORK, AFM, CONTACT))
    assert list(classical["metrics"].values) == ["afm", "all_scales"]
    unlike = classical["adhesion_index"]
    assert (unlike.sel(metrics="all_scales") > unlike.sel(metrics="afm")).all()


def test_every_interval_has_the_confidence_that_is_given(classical):
    intervals = [name for name in classical if str(name).endswith("_interval")]
    assert len(intervals) == 10
    assert {classical[name].attrs["confidence"] for name in intervals} == {0.9}
    assert all(classical[name].dims[-1] == "bound" for name in intervals)


def test_draws_depend_on_the_seed_alone(classical):
    assert classical_of(make_inference()).identical(classical)
    other = classical_of(make_inference(), seed=2)
    assert other["mean_relative_error"].equals(classical["mean_relative_error"])
    assert not other["mean_relative_error_interval"].equals(
        classical["mean_relative_error_interval"]
    )


def test_surfaces_that_the_paper_does_not_know_have_no_numbers(classical):
    """The known ones keep theirs; none of what is fitted to all of them changes."""
    with_glass = classical_of(make_inference([*SUBSTRATES, "glass"], [*MEAN_FORCE, 1e-7]))
    assert list(with_glass["surface"].values) == [*SUBSTRATES, "glass"]
    forces = with_glass["published_mean_force"]
    assert (
        np.isnan(forces.sel(surface="glass")) and not forces.sel(surface=SUBSTRATES).isnull().any()
    )
    assert with_glass["mean_relative_error"].equals(classical["mean_relative_error"])
