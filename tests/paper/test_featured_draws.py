"""Draws of features: forces on their scans, sets that take them, comparison with the paper."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_numbers import POLISHED
from small_pool import CONTACT, GRID, SOURCES

from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_of_pair
from hardcontact.inference.published_fit import Pair, PublishedFit
from hardcontact.paper.featured_draws import (
    DrawSources,
    compare_with_published,
    compute_draws,
    draw_of_set,
    draws_by_surface,
    no_draws,
)
from hardcontact.surfaces.featured_scans import FeaturedSurface, sample_group
from hardcontact.surfaces.height_map import level, metrics, mirror_stitch

FEATURED = FeaturedSurface("uncd", SOURCES.spectrum, POLISHED, GRID._replace(size=2500.0), seed=3)
DRAW_SOURCES = DrawSources(FEATURED, 2, CONTACT, [1.0, 5.6])
PAIR = Pair(5.6, 0.05)


@pytest.fixture(scope="module")
def draws():
    return {kind: compute_draws(kind, [1, 2], DRAW_SOURCES) for kind in ("bumps", "pits")}


def test_forces_and_roughness_are_those_of_the_scans_of_the_draw(draws):
    features, scans = sample_group(FEATURED, "pits", [1, 2], 2)
    scan = level(scans[1])
    draw = draws["pits"].sel(draw=2, scan=2)
    pair = join_bodies(mirror_stitch(scan), None, CONTACT)
    forces = pull_off_of_pair(pair, CONTACT, DRAW_SOURCES.ranges)["pull_off_force"]
    np.testing.assert_array_equal(draw["pull_off_force"], forces)
    assert draw["rms_height"].item() == metrics(scan)["rms_height"]
    assert draw["feature_width"].item() == features.width


def test_a_draw_does_not_depend_on_the_other_draws(draws):
    draw = compute_draws("bumps", [2], DRAW_SOURCES)
    xr.testing.assert_equal(draw.isel(draw=0), draws["bumps"].sel(draw=2))


def test_each_set_has_a_draw_of_its_own_with_bumps_and_pits_in_turn(draws):
    heights = [float(draw_of_set(draws, number)["feature_height"]) for number in (1, 2, 3, 4)]
    assert len(set(heights)) == 4
    assert np.sign(heights).tolist() == [1, -1, 1, -1]


def test_chunks_are_joined_by_surface_and_kind(draws):
    chunks = {
        ("uncd", kind, number, number): kind_draws.sel(draw=[number])
        for kind, kind_draws in draws.items()
        for number in (1, 2)
    }
    joined = draws_by_surface(chunks)["uncd"]
    for kind, kind_draws in draws.items():
        xr.testing.assert_equal(joined[kind], kind_draws)


def test_the_comparison_has_the_forces_at_the_published_pair(draws):
    plastic = {kind: draw.sel(contact_model="plastic") for kind, draw in draws.items()}
    forces = 0.5 * 0.05 * plastic["pits"]["pull_off_force"].sel(draw=1, rho=5.6)
    published = {
        "mean_force": [1.9 * forces.mean().item()],
        "median_force": [forces.median().item()],
    }
    measured = PublishedFit(pd.DataFrame(published, index=["uncd"]), PAIR)
    factor = xr.DataArray([0.5, 0.5], {"rho": [1.0, 5.6]})
    comparison = compare_with_published(plastic, factor, measured, "uncd")
    draw = comparison.sel(features="pits", draw=1)
    assert draw["mean_force"].item() == pytest.approx(forces.mean().item())
    assert draw["median_force"].item() == pytest.approx(forces.median().item())
    assert draw["log_force_std"].item() == pytest.approx(np.log(forces).std().item())
    assert draw["agrees"] == 1
    halved = measured._replace(forces=measured.forces * [1.2, 1])
    assert (
        compare_with_published(plastic, factor, halved, "uncd")["agrees"].sel(
            features="pits", draw=1
        )
        == 0
    )
    assert set(no_draws()) <= set(comparison)
    assert set(no_draws().attrs) <= set(comparison.assign_attrs(label="").attrs)
