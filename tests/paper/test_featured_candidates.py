"""Candidates with features: forces on them, sets that take them, comparison with the paper."""

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
    MAX_FORCE_FACTOR,
    candidate_of_set,
    compare_features,
    compute_candidates,
)
from hardcontact.surfaces.features import FeaturedSurface, sample_featured_scans
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import metrics

FEATURED = FeaturedSurface(replace(SUBSTITUTE, grid=GRID._replace(size=2500.0), seed=3), POLISHED)
RANGE, WORK = 5.6, 0.05  # the published pair: nm, J/m²
RANGES = [1.0, RANGE]
SCAN_COUNT = 2
INPUTS = FEATURED, SCAN_COUNT, CONTACT, RANGES
SPHERE_FACTOR = 0.5  # force on the rough sphere relative to a smooth one
SPHERE_FACTORS = xr.DataArray(
    np.full((1, 2, 2), SPHERE_FACTOR),
    {"surface": ["uncd"], "contact_model": ["rigid", "plastic"], "rho": RANGES},
    ("surface", "contact_model", "rho"),
)


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


@pytest.fixture(scope="module")
def pit_forces(candidates):
    """Return the plastic forces on a candidate with pits at the published pair."""
    selection = {"contact_model": "plastic", "candidate": 1, "rho": RANGE}
    return SPHERE_FACTOR * WORK * candidates["pits"]["pull_off_force"].sel(selection)


def compare_pits(candidates, pit_forces, published_mean_ratio=1.5):
    """Return the comparison of a candidate with its median and a multiple of its mean as published.

    A log-normal distribution has a mean above its median.
    """
    mean, median = pit_forces.mean().item(), pit_forces.median().item()
    printed = {"mean_force": [published_mean_ratio * mean], "median_force": [median]}
    published = PublishedForces(pd.DataFrame(printed, index=["uncd"]), (RANGE, WORK), 0.1)
    chunks = {("uncd", kind, 1, 2): dataset for kind, dataset in candidates.items()}
    comparison = compare_features(chunks, SPHERE_FACTORS, published, {"uncd": "UNCD"})
    return comparison.sel(features="pits", candidate=1)


def test_the_comparison_has_the_forces_at_the_published_pair(candidates, pit_forces):
    candidate = compare_pits(candidates, pit_forces)
    assert candidate["mean_force_at_pair"].item() == pytest.approx(pit_forces.mean().item())
    assert candidate["median_force_at_pair"].item() == pytest.approx(pit_forces.median().item())
    assert candidate["log_force_std"].item() == pytest.approx(np.log(pit_forces).std().item())


@pytest.mark.parametrize(("share_of_limit", "agrees"), [(0.95, 1), (1.05, 0)])
def test_a_candidate_agrees_within_the_largest_factor(
    candidates, pit_forces, share_of_limit, agrees
):
    candidate = compare_pits(candidates, pit_forces, share_of_limit * MAX_FORCE_FACTOR)
    assert candidate["agrees"] == agrees


def test_a_study_without_features_has_the_same_variables(candidates, pit_forces):
    comparison = compare_pits(candidates, pit_forces)
    empty = compare_features({}, SPHERE_FACTORS, None, {})
    assert set(empty) <= set(comparison) and set(empty.attrs) <= set(comparison.attrs)
