"""Protrusions: their shape, their number and their limit by published roughness."""

from dataclasses import replace
from itertools import product

import numpy as np
import pandas as pd
import pytest
from periodic_maps import height_map

from hardcontact.surfaces.height_map import metrics
from hardcontact.surfaces.protrusions import (
    DENSITY_BOUNDS,
    HEIGHT_BOUNDS,
    SHARE_WITHOUT_PROTRUSIONS,
    WIDTH_BOUNDS,
    Protrusions,
    PublishedRoughness,
    add_protrusions,
    sample_protrusions,
)

POLISHED = PublishedRoughness(3.2, 0.04, 0.05, 1.0)
FLAT = replace(height_map(np.zeros((200, 200)), 10.0), periodic=False)  # 2 µm


def test_a_protrusion_is_a_gaussian_of_its_height_and_width():
    protrusions = Protrusions(density=0.25, height=10.0, width=60.0)  # one expected on 4 µm²
    seed = 0
    while np.random.default_rng(seed).poisson(1.0) != 1:  # until there is a single one
        seed += 1
    rng = np.random.default_rng(seed)
    rng.poisson(1.0)
    centre = rng.uniform(0, 2000, 2)
    protruded = add_protrusions(np.random.default_rng(seed), FLAT, protrusions, 3.0)
    position = (np.arange(200) + 0.5) * 10.0
    distance = (position[:, None] - centre[0]) ** 2 + (position - centre[1]) ** 2
    np.testing.assert_allclose(protruded.heights, 30 * np.exp(-distance / (2 * 60.0**2)), atol=1e-9)


@pytest.mark.parametrize(("density", "width"), [(3.0, 60.0), (20.0, 120.0)])
def test_rms_height_and_slope_follow_campbells_theorem(density, width):
    protrusions = Protrusions(density, 4.0, width)
    rng = np.random.default_rng(3)
    heights = [add_protrusions(rng, FLAT, protrusions, 3.2).heights for _ in range(60)]
    inner_heights = np.array(heights)[:, 40:-40, 40:-40]  # the edges lack protrusions from outside
    assert inner_heights.std() == pytest.approx(3.2 * protrusions.rms_height, rel=0.05)
    slopes = [metrics(replace(FLAT, heights=scan))["rms_gradient"] for scan in inner_heights]
    slope = np.sqrt(np.mean(np.square(slopes)))
    assert slope == pytest.approx(3.2 * protrusions.rms_slope, rel=0.05)


@pytest.mark.parametrize("on_sphere", [False, True])
def test_sampled_protrusions_keep_within_the_published_roughness(on_sphere):
    rng = np.random.default_rng(2)
    surfaces = [sample_protrusions(rng, POLISHED, on_sphere) for _ in range(2000)]
    densities = np.array([protrusions.density for protrusions in surfaces])
    assert (densities == 0).mean() == pytest.approx(SHARE_WITHOUT_PROTRUSIONS, abs=0.03)
    rms_heights = np.array([3.2 * protrusions.rms_height for protrusions in surfaces])
    slopes = np.array([3.2 * protrusions.rms_slope for protrusions in surfaces])
    if on_sphere:
        assert 0.95 < rms_heights.max() <= 1
    else:
        scaled = np.sqrt((0.04**2 + slopes**2) / (3.2**2 + rms_heights**2)) * 3.2
        assert 0.03 < scaled.min() < 0.039 and 0.049 < scaled.max() <= 0.05


def test_the_curvature_of_polished_uncd_stays_within_table_1():
    table = pd.read_csv("resources/paper/table1.csv", index_col=["surface", "quantity"])
    published = table.loc[("polished_uncd", "afm_rms_curvature")]
    for density, height, width in product(DENSITY_BOUNDS, HEIGHT_BOUNDS, WIDTH_BOUNDS):
        protrusions = Protrusions(density, height, width)
        # Half the Laplacian of a Gaussian, squared and integrated, is pi (height/width)^2/2.
        added = 3.2 * protrusions.rms_slope / width / np.sqrt(2)
        curvature = np.hypot(published["value"], added) / np.hypot(1, protrusions.rms_height)
        assert abs(curvature - published["value"]) < published["uncertainty"]
