"""Protrusions: their shape, their number and the rms height that they leave."""

from dataclasses import replace

import numpy as np
import pytest
from periodic_maps import height_map

from hardcontact.surfaces.height_map import level
from hardcontact.surfaces.protrusions import (
    GAUSSIAN_SHARE,
    Protrusions,
    draw_protrusions,
    with_protrusions,
)


def waves():
    """Return a levelled map of 2 µm with waves of an rms height of 3 nm."""
    place = 2 * np.pi * np.arange(200) / 200
    heights = 3 * np.sqrt(2) * np.tile(np.cos(10 * place), (200, 1))
    return level(replace(height_map(heights, 10.0), periodic=False))


def test_a_protrusion_is_a_gaussian_of_its_height_and_width():
    flat = waves()
    rng = np.random.default_rng(5)
    one = Protrusions(density=0.25, height=10.0, width=60.0)  # one expected on 4 µm²
    while True:  # until a single protrusion stands well inside
        seed = int(rng.integers(1 << 30))
        draw = np.random.default_rng(seed)
        count = draw.poisson(1.0)
        if count == 1 and ((centre := draw.uniform(0, 2000, 2)) % 1500 > 500).all():
            break
    protruded = with_protrusions(np.random.default_rng(seed), flat, one)
    position = (np.arange(200) + 0.5) * 10.0
    distance = (position[:, None] - centre[0]) ** 2 + (position - centre[1]) ** 2
    rms_height = flat.heights.std()
    shape = 10 * rms_height * np.exp(-distance / (2 * 60.0**2))
    expected = level(replace(flat, heights=flat.heights + shape))
    scaled = expected.heights * (rms_height / expected.heights.std())
    np.testing.assert_allclose(protruded.heights, scaled, atol=1e-9)
    assert protruded.heights.std() == pytest.approx(rms_height)


def test_none_leaves_the_map_as_it_is():
    without = with_protrusions(np.random.default_rng(1), waves(), Protrusions(0.0, 0.0, 50.0))
    np.testing.assert_allclose(without.heights, waves().heights, atol=1e-9)


def test_as_many_surfaces_as_assumed_have_no_protrusions():
    rng = np.random.default_rng(2)
    densities = np.array([draw_protrusions(rng).density for _ in range(4000)])
    assert (densities == 0).mean() == pytest.approx(GAUSSIAN_SHARE, abs=0.03)
