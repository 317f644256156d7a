"""The classical dataset of a study, from the tables of the paper and an inference dataset."""

import numpy as np
import pytest
import xarray as xr
from paper_numbers import MEAN_FORCE, MODULUS, RADIUS, SUBSTRATES, TABLES

from hardcontact.base import published
from hardcontact.base.statistics import Sampling, interval_ends
from hardcontact.paper.classical_comparison import apply_classical_models


def make_inference(surfaces=SUBSTRATES, forces=MEAN_FORCE):
    """Mean forces of plastic contact at the published pair, to within 1 %."""
    dims = ("contact_model", "pair", "surface")
    return xr.Dataset(
        {
            "mean_force_at_pair": (dims, [[forces]]),
            "mean_force_at_pair_interval": ((*dims, "end"), [[np.outer(forces, [0.99, 1.01])]]),
            "label": ("surface", surfaces),
            "source": ("surface", ["measured"] * len(surfaces)),
        },
        {"contact_model": ["plastic"], "pair": ["published"], "surface": surfaces,
         "end": ["low", "high"]},
        {"sphere_radius": RADIUS, "error_threshold": 0.1},
    )  # fmt: skip


def apply_models(inference, seed=1):
    return apply_classical_models(
        inference,
        published.read_constants(TABLES / "constants.csv"),
        published.read_table1(TABLES / "table1.csv"),
        published.read_printed_statistics(TABLES / "pull_off.csv"),
        Sampling(seed, 20, 0.9, ("classical",)),
    )


@pytest.fixture(scope="module")
def classical():
    return apply_models(make_inference())


def test_polished_uncd_has_the_published_force_and_work(classical):
    """The paper prints 8.8 µN and, with the printed Tabor parameter, 7.15 mJ/m²."""
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
    extended = apply_models(make_inference([*SUBSTRATES, "glass"], [*MEAN_FORCE, 1e-7]))
    assert list(extended["surface"].values) == [*SUBSTRATES, "glass"]
    forces = extended["published_mean_force"]
    assert (
        np.isnan(forces.sel(surface="glass")) and not forces.sel(surface=SUBSTRATES).isnull().any()
    )
    assert extended["mean_relative_error"].equals(classical["mean_relative_error"])
