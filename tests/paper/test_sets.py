"""Sets: their datasets but for the scans those of the study, a number for every claim."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_numbers import CLAIMS, CONSTANTS, MEAN_FORCE, SUBSTRATES
from set_inputs import CONFIDENCE, SCANS, make_adhesion, make_inputs, make_masters

from hardcontact.base.statistics import Sampling
from hardcontact.inference.published_fit import PublishedForces, fit_published
from hardcontact.paper.sets import (
    SetSettings,
    adhesion_of_set,
    edges_of_set,
    sample_set_scans,
    sample_sets,
    sphere_factor,
    topography_of_set,
)
from hardcontact.surfaces.metrics import TABLE1_METRICS

SETTINGS = SetSettings(
    seed=1,
    set_count=2,
    realizations=5,
    reference_surface="uncd",
    tolerance=0.1,
    confidence=CONFIDENCE,
)
FORCES = pd.DataFrame({"mean_force": MEAN_FORCE}, index=SUBSTRATES)
REPLICATED = CLAIMS[CLAIMS["samples_from"] == "sets"]
PAPER = REPLICATED, CONSTANTS, PublishedForces(FORCES, (5.6, 46.3e-3), 0.1)


@pytest.fixture(scope="module")
def sets():
    return sample_sets(make_inputs(), *PAPER, SETTINGS)


def test_numbers_are_those_of_each_set(sets):
    inputs = make_inputs()
    models = ["rigid", "plastic"]
    for number in (1, 2):
        numbers = sets["value"].sel(set=number)
        sampled_scans = sample_set_scans(inputs, 1, number)
        adhesion = adhesion_of_set(inputs, sampled_scans, 1, number)
        inference = fit_published(adhesion, PAPER[2], "uncd", Sampling(1, 0, CONFIDENCE))
        ranges = sets["range_of_adhesion"].sel(set=number, contact_model=models)
        np.testing.assert_allclose(inference["range_of_adhesion"].sel(contact_model=models), ranges)
        gradient = sampled_scans["ncd"]["rms_gradient"].mean().item()
        assert numbers.sel(claim="afm_rms_slope_ncd").item() == pytest.approx(gradient)


def test_the_factor_of_the_sphere_is_the_ratio_of_mean_forces():
    adhesion = make_adhesion()
    means = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    adhesion["smooth_sphere_force"] = 2 * means
    factor = sphere_factor(adhesion, ["uncd", "mcd"])
    assert set(factor.dims) == {"contact_model", "surface", "rho"}
    np.testing.assert_allclose(factor.sel(surface=["uncd", "mcd"]), 0.5, rtol=1e-12)
    assert factor.sel(surface="ncd").isnull().all()


#: Seed of the study, then number of the set.
DRAW = 1, 3
NO_SAMPLES = Sampling(1, 0, CONFIDENCE)


def test_topography_of_a_set_replaces_only_sampled_scans():
    inputs = make_inputs(measured_surfaces=["mcd"])
    sampled_scans = sample_set_scans(inputs, *DRAW)
    study = inputs.topography
    topography = topography_of_set(inputs, sampled_scans, CONFIDENCE)
    for name in TABLE1_METRICS.values():
        uncd_metric = topography[name].sel(surface="uncd")
        np.testing.assert_allclose(uncd_metric, sampled_scans["uncd"][name], rtol=1e-12)
        mean = topography[f"{name}_mean"].sel(surface="uncd").item()
        assert mean == pytest.approx(sampled_scans["uncd"][name].mean().item(), rel=1e-12)
        for surface in ("mcd", "ruby"):
            np.testing.assert_array_equal(
                topography[name].sel(surface=surface), study[name].sel(surface=surface)
            )
    heights = topography["rms_height_mean"].sel(surface="uncd").item()
    assert heights == pytest.approx(17.4, rel=1e-12)
    assert topography["rms_height_std"].sel(surface="uncd").item() == pytest.approx(3.48)
    xr.testing.assert_identical(topography["source"], study["source"])
    assert topography.attrs == study.attrs


def test_forces_of_sampled_scans_are_scaled_to_the_rough_sphere():
    inputs = make_inputs()
    sampled_scans = sample_set_scans(inputs, *DRAW)
    adhesion = adhesion_of_set(inputs, sampled_scans, *DRAW)
    assert adhesion["pull_off_force"].dims == inputs.adhesion["pull_off_force"].dims
    assert adhesion.attrs == inputs.adhesion.attrs
    for surface, scans in sampled_scans.items():
        ratio = adhesion["pull_off_force"].sel(surface=surface) / scans["pull_off_force"]
        np.testing.assert_allclose(ratio.sel(contact_model="rigid"), 0.9, rtol=1e-12)
        np.testing.assert_allclose(ratio.sel(contact_model="plastic"), 0.95, rtol=1e-12)


def test_forces_on_measured_scans_change_by_one_factor_per_range():
    inputs = make_inputs(measured_surfaces=["mcd"])
    adhesion = adhesion_of_set(inputs, sample_set_scans(inputs, *DRAW), *DRAW)
    set_forces = adhesion["pull_off_force"].transpose("contact_model", "rho", ...)
    study_forces = inputs.adhesion["pull_off_force"].transpose("contact_model", "rho", ...)
    ranges = study_forces.sizes["rho"]
    ratio = (set_forces / study_forces).sel(surface="mcd").values.reshape(2, ranges, -1)
    np.testing.assert_allclose(ratio, ratio[..., :1] * np.ones(ratio.shape[-1]), rtol=1e-12)
    assert not np.isclose(ratio, 1).any()
    # Arrays of sampled scans have fewer contacts; they are padded with NaN.
    uncd_forces = adhesion["pull_off_force"].sel(surface="uncd")
    assert np.isfinite(uncd_forces).sum() == SCANS * 2 * ranges * 9


def test_masters_are_sampled_again_for_every_set_and_surface():
    masters = make_masters().isel(surface=slice(2))
    bands = [edges_of_set(masters, 5, 0.1, NO_SAMPLES, n) for n in range(60)]
    ratio = np.array([band["filtered_force_ratio"].values for band in bands])
    mean = (
        masters["filtered_force_ratio"].mean("realization").transpose("side", "surface", ...).values
    )
    deviation = (
        masters["filtered_force_ratio"].std("realization").transpose("side", "surface", ...).values
    )
    error = deviation / np.sqrt(5)
    np.testing.assert_allclose(ratio.std(axis=0), error, rtol=0.3)
    assert (np.abs(ratio.mean(axis=0) - mean) < 4 * error / np.sqrt(60))[~np.isnan(mean)].all()
    assert abs(np.corrcoef(ratio[:, 0, 0, 0], ratio[:, 0, 1, 0])[0, 1]) < 0.2
