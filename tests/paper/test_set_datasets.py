"""Datasets of a set equal those of the study, but for the scans."""

import numpy as np
import pytest
import xarray as xr
from set_sources import CONFIDENCE, SCANS, make_masters, make_sources

from hardcontact.base.statistics import Sampling
from hardcontact.inference.edges import edges_of_realizations
from hardcontact.paper.judged_sets import (
    sample_set_scans,
    set_adhesion,
    set_edges,
    set_topography,
)
from hardcontact.surfaces.height_map import TABLE1_METRICS

#: Seed of the study and number of the set.
DRAW = 1, 3
NO_SAMPLES = Sampling(1, 0, CONFIDENCE)
CONTACTS = ["contact_y", "contact_x"]


def test_topography_of_a_set_replaces_only_sampled_scans():
    sources = make_sources(measured_surfaces=["mcd"])
    sampled_scans = sample_set_scans(sources, *DRAW)
    study = sources.topography
    topography = set_topography(study, sampled_scans, CONFIDENCE)
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
    xr.testing.assert_identical(topography["basis"], study["basis"])
    assert topography.attrs == study.attrs


def test_forces_of_sampled_scans_are_scaled_to_the_rough_sphere():
    sources = make_sources()
    sampled_scans = sample_set_scans(sources, *DRAW)
    adhesion = set_adhesion(sources, sampled_scans, *DRAW)
    assert adhesion["pull_off_force"].dims == sources.adhesion["pull_off_force"].dims
    assert adhesion.attrs == sources.adhesion.attrs
    for surface, scans in sampled_scans.items():
        ratio = adhesion["pull_off_force"].sel(surface=surface) / scans["pull_off_force"]
        np.testing.assert_allclose(ratio.sel(contact_model="rigid"), 0.9, rtol=1e-12)
        np.testing.assert_allclose(ratio.sel(contact_model="plastic"), 0.95, rtol=1e-12)


def test_forces_on_measured_scans_change_by_one_factor_per_range():
    sources = make_sources(measured_surfaces=["mcd"])
    adhesion = set_adhesion(sources, sample_set_scans(sources, *DRAW), *DRAW)
    set_forces = adhesion["pull_off_force"].transpose("contact_model", "rho", ...)
    study_forces = sources.adhesion["pull_off_force"].transpose("contact_model", "rho", ...)
    ranges = study_forces.sizes["rho"]
    ratio = (set_forces / study_forces).sel(surface="mcd").values.reshape(2, ranges, -1)
    np.testing.assert_allclose(ratio, ratio[..., :1] * np.ones(ratio.shape[-1]), rtol=1e-12)
    assert not np.isclose(ratio, 1).any()
    # Arrays of sampled scans have fewer contacts; they are padded with NaN.
    uncd_forces = adhesion["pull_off_force"].sel(surface="uncd")
    assert np.isfinite(uncd_forces).sum() == SCANS * 2 * ranges * 9


def test_equal_masters_have_the_band_of_one():
    masters = make_masters()
    alike = masters.isel(realization=[0] * 6).assign_coords(realization=range(1, 7))
    band = set_edges(alike, 5, 0.1, NO_SAMPLES, 3)
    single_band = edges_of_realizations(alike.isel(realization=[0]), 0.1, NO_SAMPLES)
    for name in ("filtered_force_ratio", "filtered_force_change", "edge"):
        np.testing.assert_allclose(band[name], single_band[name], rtol=1e-12)


def test_masters_are_sampled_again_for_every_set_and_surface():
    masters = make_masters()
    bands = [set_edges(masters, 5, 0.1, NO_SAMPLES, n) for n in range(300)]
    ratio = np.array([band["filtered_force_ratio"].values for band in bands])
    mean = (
        masters["filtered_force_ratio"].mean("realization").transpose("side", "surface", ...).values
    )
    deviation = (
        masters["filtered_force_ratio"].std("realization").transpose("side", "surface", ...).values
    )
    error = deviation / np.sqrt(5)
    np.testing.assert_allclose(ratio.std(axis=0), error, rtol=0.14)
    assert (np.abs(ratio.mean(axis=0) - mean) < 4 * error / np.sqrt(300))[~np.isnan(mean)].all()
    assert abs(np.corrcoef(ratio[:, 0, 0, 0], ratio[:, 0, 1, 0])[0, 1]) < 0.2
