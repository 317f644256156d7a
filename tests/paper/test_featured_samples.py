"""Samples of features: forces on their scans, sets that take them, comparison with the paper."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_numbers import POLISHED
from small_pool import CONTACT, GRID, SUBSTITUTE

from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.paper.featured_samples import (
    compare_with_published,
    compute_samples,
    empty_comparison,
    sample_of_set,
)
from hardcontact.paper.published_fit import PublishedForces
from hardcontact.surfaces.featured_scans import FeaturedSurface, sample_group
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import metrics

FEATURED = FeaturedSurface(replace(SUBSTITUTE, grid=GRID._replace(size=2500.0), seed=3), POLISHED)
RANGES = [1.0, 5.6]
INPUTS = FEATURED, 2, CONTACT, RANGES
PAIR = (5.6, 0.05)


@pytest.fixture(scope="module")
def samples():
    return {kind: compute_samples(kind, [1, 2], *INPUTS) for kind in ("bumps", "pits")}


def test_forces_and_roughness_are_those_of_the_scans_of_the_draw(samples):
    features, scans = sample_group(FEATURED, "pits", [1, 2], 2)
    scan = level_plane(scans[1])
    sample = samples["pits"].sel(sample=2, scan=2)
    bodies = join_bodies(mirror_scan(scan), None, CONTACT)
    forces = pull_off_dataset(bodies, CONTACT, RANGES)["pull_off_force"]
    np.testing.assert_array_equal(sample["pull_off_force"], forces)
    assert sample["rms_height"].item() == metrics(scan)["rms_height"]
    assert sample["feature_width"].item() == features.width


def test_a_sample_does_not_depend_on_the_other_samples(samples):
    sample = compute_samples("bumps", [2], *INPUTS)
    xr.testing.assert_equal(sample.isel(sample=0), samples["bumps"].sel(sample=2))


def test_each_set_has_a_sample_of_its_own_with_bumps_and_pits_in_turn(samples):
    heights = [float(sample_of_set(samples, number)["feature_height"]) for number in (1, 2, 3, 4)]
    assert len(set(heights)) == 4
    assert np.sign(heights).tolist() == [1, -1, 1, -1]


def test_the_comparison_has_the_forces_at_the_published_pair(samples):
    plastic = {kind: sample.sel(contact_model="plastic") for kind, sample in samples.items()}
    forces = 0.5 * 0.05 * plastic["pits"]["pull_off_force"].sel(sample=1, rho=5.6)
    published = {
        "mean_force": [1.9 * forces.mean().item()],
        "median_force": [forces.median().item()],
    }
    published_forces = PublishedForces(pd.DataFrame(published, index=["uncd"]), PAIR, 0.1, 30e-9)
    factor = xr.DataArray([0.5, 0.5], {"rho": [1.0, 5.6]})
    comparison = compare_with_published(plastic, factor, published_forces, "uncd")
    sample = comparison.sel(features="pits", sample=1)
    assert sample["mean_force_at_pair"].item() == pytest.approx(forces.mean().item())
    assert sample["median_force_at_pair"].item() == pytest.approx(forces.median().item())
    assert sample["log_force_std"].item() == pytest.approx(np.log(forces).std().item())
    assert sample["agrees"] == 1
    halved = published_forces._replace(forces=published_forces.forces * [1.2, 1])
    assert (
        compare_with_published(plastic, factor, halved, "uncd")["agrees"].sel(
            features="pits", sample=1
        )
        == 0
    )
    assert set(empty_comparison()) <= set(comparison)
    assert set(empty_comparison().attrs) <= set(comparison.assign_attrs(label="").attrs)
