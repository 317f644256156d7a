"""The classical dataset of a study, from the tables of the paper and an inference dataset."""

import numpy as np
import pytest
import xarray as xr
from paper_claims import TABLES
from paper_numbers import MEAN_FORCE, SUBSTRATES
from published_contact import CONTACT, RADIUS, WORK

from hardcontact.contact import smooth_sphere
from hardcontact.inference.classical_comparison import (
    PerSurface,
    apply_classical_models,
    effective_works,
)
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


def test_printed_tabor_parameter_is_not_what_printed_works_imply(classical):
    """8.8 µN and 7.15 mJ/m² imply 1.557 to 1.577; a Tabor parameter of 0.81 gives 1.61."""
    low, high = bounds(classical.sel(surface="polished_uncd"), "implied_pull_off_coefficient")
    assert (float(low), float(high)) == pytest.approx((1.557, 1.577), abs=5e-4)
    maugis = smooth_sphere.maugis_parameter(0.81)
    assert smooth_sphere.maugis_dugdale_coefficient(maugis) == pytest.approx(1.610, abs=1e-3)
    assert smooth_sphere.transition_coefficient(maugis) == pytest.approx(1.607, abs=1e-3)


def test_surfaces_that_the_paper_does_not_know_have_no_numbers(classical):
    """The known ones keep theirs; none of what is fitted to all of them changes."""
    with_glass = classical_of(make_inference([*SUBSTRATES, "glass"], [*MEAN_FORCE, 1e-7]))
    assert list(with_glass["surface"].values) == [*SUBSTRATES, "glass"]
    forces = with_glass["published_mean_force"]
    assert (
        np.isnan(forces.sel(surface="glass")) and not forces.sel(surface=SUBSTRATES).isnull().any()
    )
    assert with_glass["mean_relative_error"].equals(classical["mean_relative_error"])


def test_effective_works_of_the_published_forces():
    force = PerSurface(MEAN_FORCE, np.stack([0.9 * MEAN_FORCE, 1.1 * MEAN_FORCE], axis=-1))
    published = {"tabor_parameter": 0.81, "work_of_adhesion": WORK}
    works = effective_works(force, CONTACT, published, 0.95).isel(surface=0)
    work = works.effective_work_of_adhesion
    assert work.sel(tabor="printed") == pytest.approx(6.97e-3, rel=1e-3)  # 7.15 is printed
    assert work.sel(tabor="self_consistent") == pytest.approx(6.01e-3, rel=1e-3)
    own = work.sel(tabor="self_consistent").item()
    tabor = smooth_sphere.maugis_parameter(smooth_sphere.tabor_parameter(own, *CONTACT))
    coefficient = smooth_sphere.transition_coefficient(tabor)
    assert own * coefficient * np.pi * CONTACT.radius * 1e-9 == pytest.approx(MEAN_FORCE[0])
    low, high = bounds(works, "effective_work_of_adhesion")
    assert (low < work).all() and (work < high).all()
    np.testing.assert_allclose(low.sel(tabor="printed"), 0.9 * work.sel(tabor="printed"))
