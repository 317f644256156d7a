"""Candidates with features: their forces, sets that take them, comparison with the paper."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_numbers import POLISHED
from small_pool import CONTACT, GRID, SUBSTITUTE

from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.inference.published_fit import PublishedForces
from hardcontact.paper.featured_candidates import (
    candidate_of_set,
    compare_features,
    compute_candidates,
)
from hardcontact.surfaces.features import FeaturedSurface, sample_featured_scans
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import metrics

FEATURED = FeaturedSurface(replace(SUBSTITUTE, grid=GRID._replace(size=2500.0), seed=3), POLISHED)
RANGES = [1.0, 5.6]
INPUTS = FEATURED, 2, CONTACT, RANGES
PAIR = (5.6, 0.05)


@pytest.fixture(scope="module")
def candidates():
    return {kind: compute_candidates(kind, [1, 2], *INPUTS) for kind in ("bumps", "pits")}


def test_forces_and_roughness_are_those_of_the_scans_of_the_candidate(candidates):
    features, scans = sample_featured_scans(FEATURED, "pits", [1, 2], 2)
    scan = level_plane(scans[1])
    candidate = candidates["pits"].sel(candidate=2, scan=2)
    bodies = join_bodies(mirror_scan(scan), None, CONTACT)
    forces = pull_off_dataset(bodies, CONTACT, RANGES)["pull_off_force"]
    np.testing.assert_array_equal(candidate["pull_off_force"], forces)
    assert candidate["rms_height"].item() == metrics(scan)["rms_height"]
    assert candidate["feature_width"].item() == features.width


def test_a_candidate_does_not_depend_on_the_other_candidates(candidates):
    candidate = compute_candidates("bumps", [2], *INPUTS)
    xr.testing.assert_equal(candidate.isel(candidate=0), candidates["bumps"].sel(candidate=2))


def test_each_set_has_a_candidate_of_its_own_with_bumps_and_pits_in_turn(candidates):
    set_candidates = [candidate_of_set(candidates, number) for number in (1, 2, 3, 4)]
    heights = [float(candidate["feature_height"]) for candidate in set_candidates]
    assert len(set(heights)) == 4
    assert np.sign(heights).tolist() == [1, -1, 1, -1]


def test_the_comparison_has_the_forces_at_the_published_pair(candidates):
    pull_off_forces = candidates["pits"]["pull_off_force"]
    forces = 0.5 * 0.05 * pull_off_forces.sel(contact_model="plastic", candidate=1, rho=5.6)
    printed = {"mean_force": [1.9 * forces.mean().item()], "median_force": [forces.median().item()]}
    published = PublishedForces(pd.DataFrame(printed, index=["uncd"]), PAIR, 0.1)
    factor = xr.full_like(pull_off_forces.isel(candidate=0, scan=0, contact_y=0, contact_x=0), 0.5)
    factors = factor.expand_dims(surface=["uncd"])
    chunks = {("uncd", kind, 1, 2): dataset for kind, dataset in candidates.items()}
    labels = {"uncd": "UNCD"}
    comparison = compare_features(chunks, factors, published, labels)
    candidate = comparison.sel(features="pits", candidate=1)
    assert candidate["mean_force_at_pair"].item() == pytest.approx(forces.mean().item())
    assert candidate["median_force_at_pair"].item() == pytest.approx(forces.median().item())
    assert candidate["log_force_std"].item() == pytest.approx(np.log(forces).std().item())
    assert candidate["agrees"] == 1
    larger_mean = published._replace(forces=published.forces * [1.2, 1])
    comparison = compare_features(chunks, factors, larger_mean, labels)
    assert comparison["agrees"].sel(features="pits", candidate=1) == 0
    empty = compare_features({}, factors, published, labels)
    assert set(empty) <= set(comparison) and set(empty.attrs) <= set(comparison.attrs)
