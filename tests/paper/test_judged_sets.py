"""Numbers of many sets: reproducible, independent for each set, one for every claim."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_claims import CONSTANTS, STATEMENTS
from paper_numbers import MEAN_FORCE, SUBSTRATES
from set_sources import CONFIDENCE, make_adhesion, make_masters, make_pool, make_sources

from hardcontact.base.statistics import Sampling
from hardcontact.inference.published_fit import Pair, PublishedFit, fit_published
from hardcontact.paper.judged_sets import (
    SetSettings,
    gather_sources,
    judge_sets,
    sample_set_scans,
    set_adhesion,
)

SETTINGS = SetSettings(
    seed=1,
    replicates=3,
    realizations=5,
    reference_surface="uncd",
    tolerance=0.1,
    confidence=CONFIDENCE,
)
FORCES = pd.DataFrame({"mean_force": MEAN_FORCE}, index=SUBSTRATES)
REPLICATED = STATEMENTS[STATEMENTS["replicated"] == "yes"]
PAPER = REPLICATED, CONSTANTS, PublishedFit(FORCES, Pair(5.6, 46.3e-3))


@pytest.fixture(scope="module")
def sets():
    return judge_sets(make_sources(), *PAPER, SETTINGS)


def test_every_replicated_claim_has_a_number_of_every_set(sets):
    replicated = REPLICATED["id"]
    assert sets["value"].dims == ("set", "claim")
    assert sets["claim"].values.tolist() == replicated.tolist()
    unfitted_claims = sets["claim"].values[np.isnan(sets["value"]).any("set")]
    assert set(unfitted_claims) <= {
        "half_width_of_range",
        "half_width_of_work",
    }  # no fit is good enough
    height = sets["value"].sel(claim="afm_rms_height_uncd")
    np.testing.assert_allclose(height, 17.4, rtol=1e-12)


def test_numbers_are_those_of_each_set(sets):
    sources = make_sources()
    models = ["rigid", "plastic"]
    for number in (1, 3):
        numbers = sets["value"].sel(set=number)
        sampled_scans = sample_set_scans(sources, 1, number)
        adhesion = set_adhesion(sources, sampled_scans, 1, number)
        inference = fit_published(
            adhesion, PAPER[2], "uncd", 0.1, 30e-9, Sampling(1, 0, CONFIDENCE)
        )
        ranges = sets["range_of_adhesion"].sel(set=number, contact_model=models)
        np.testing.assert_allclose(inference["range_of_adhesion"].sel(contact_model=models), ranges)
        gradient = sampled_scans["ncd"]["rms_gradient"].mean().item()
        assert numbers.sel(claim="afm_rms_slope_ncd").item() == pytest.approx(gradient)


def test_a_set_depends_on_its_number_and_the_seed_alone(sets):
    fewer = judge_sets(make_sources(), *PAPER, SETTINGS._replace(replicates=1))
    xr.testing.assert_identical(fewer.isel(set=0), sets.isel(set=0))
    other_seed = judge_sets(make_sources(), *PAPER, SETTINGS._replace(replicates=1, seed=2))
    assert not np.allclose(
        other_seed["value"].isel(set=0), sets["value"].isel(set=0), equal_nan=True
    )
    assert len(np.unique(sets["range_of_adhesion"])) > 2


def test_the_factor_of_the_sphere_is_the_ratio_of_mean_forces():
    adhesion = make_adhesion()
    means = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    adhesion["smooth_sphere_force"] = 2 * means
    pools = {name: make_pool(name) for name in SUBSTRATES}
    chunks = {
        (name, first, first + 5): pool.sel(scan=slice(first, first + 5))
        for name, pool in pools.items()
        for first in (1, 7)
    }
    study = {"topography": make_sources().topography, "adhesion": adhesion}
    sources = gather_sources(study, chunks, {}, SUBSTRATES, make_masters())
    np.testing.assert_allclose(sources.sphere_factor, 0.5, rtol=1e-12)
    assert set(sources.sphere_factor.dims) == {"contact_model", "surface", "rho"}
    for name, pool in pools.items():
        xr.testing.assert_identical(sources.pools[name], pool)


def test_measured_surfaces_make_sets_too():
    sources = make_sources(measured_surfaces=SUBSTRATES)
    sets = judge_sets(sources, *PAPER, SETTINGS._replace(replicates=2))
    gradient = sources.topography["rms_gradient_mean"].sel(surface="ncd")
    assert sets["value"].isel(set=0).sel(claim="afm_rms_slope_ncd") == gradient
    ranges = sets["range_of_adhesion"].sel(contact_model="plastic")
    assert ranges[0] != ranges[1]
