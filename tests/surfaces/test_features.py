"""Features: Campbell's theorem, the published statistics of scans, and seeds."""

from dataclasses import replace

import numpy as np
import pytest
from measurements import UNCD
from paper_numbers import POLISHED
from periodic_maps import periodic_map

from hardcontact.surfaces.features import (
    FeaturedSurface,
    Features,
    add_features,
    feature_squares,
    featured_rms,
    nearest_featured_scans,
    sample_permitted_features,
    standardized_differences,
)
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics
from hardcontact.surfaces.spectrum import spectrum_dataset
from hardcontact.surfaces.substitutes import Substitute
from hardcontact.surfaces.synthesis import ScanGrid

PIXELS, PIXEL = 200, 12.5  # 2.5 µm
SIZE = PIXELS * PIXEL
FLAT = replace(periodic_map(np.zeros((PIXELS, PIXELS)), PIXEL), periodic=False)


def squares(scan):
    """The squares of rms height, gradient and half-Laplacian of a levelled scan."""
    if not scan.heights.any():
        return np.zeros(3)
    values = metrics(level_plane(scan))
    return np.array([values[name] ** 2 for name in TABLE1_METRICS.values()])


def rms_of(features):
    added = feature_squares(features.height, features.width, SIZE)
    return featured_rms(features.base_factor, features.counts, added, POLISHED)


@pytest.mark.parametrize("periodic", [False, True])
def test_a_feature_is_a_gaussian_of_its_height_and_width(periodic):
    features = Features(number_density=0.1, height=-20.0, width=60.0, base_factor=1.0, counts=(1,))
    flat = replace(FLAT, periodic=periodic)
    heights = add_features(np.random.default_rng(4), flat, features, 1).heights
    centre = np.random.default_rng(4).uniform(0, SIZE, (2, 1, 1)).ravel()
    position = (np.arange(PIXELS) + 0.5) * PIXEL
    offsets = np.abs(position - centre[:, None])
    if periodic:
        offsets = np.minimum(offsets, SIZE - offsets)
    distance = offsets[0][:, None] ** 2 + offsets[1] ** 2
    np.testing.assert_allclose(heights, -20 * np.exp(-distance / (2 * 60.0**2)), atol=1e-9)


def test_mean_and_variance_of_squares_follow_campbells_theorem():
    """The variance of the mean square height has a term of pairs: twice the squared covariance."""
    density, width = 2.0, 120.0
    features = Features(density, height=30.0, width=width, base_factor=1.0, counts=())
    rng = np.random.default_rng(1)
    flat = replace(periodic_map(np.zeros((50, 50)), SIZE / 50), periodic=False)
    mean_count = density * (SIZE / 1e3) ** 2
    counts = rng.poisson(mean_count, 600)
    values = np.array([squares(add_features(rng, flat, features, count)) for count in counts])
    added = feature_squares(30.0, width, SIZE)
    np.testing.assert_allclose(values.mean(axis=0), mean_count * added, rtol=0.08)
    squared_covariance = (mean_count * added[0]) ** 2 * 2 * np.pi * width**2 / SIZE**2
    variance = mean_count * added[0] ** 2 + 2 * squared_covariance
    assert values[:, 0].var() == pytest.approx(variance, rel=0.2)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("scans", [1, 2, 5])
def test_sampled_features_have_the_published_statistics(sign, scans):
    rng = np.random.default_rng(scans)
    for _ in range(3):
        features = sample_permitted_features(
            rng, POLISHED, scans, ScanGrid(PIXELS, SIZE, PIXELS), sign
        )
        assert np.sign(features.height) == sign and len(features.counts) == scans
        rms_values = rms_of(features)
        means = rms_values.mean(axis=0)
        assert (np.abs(means - POLISHED.means) <= POLISHED.stds / np.sqrt(5)).all()
        if scans > 1:
            ratios = rms_values.std(axis=0, ddof=1)[:2] / POLISHED.stds[:2]
            assert (np.abs(ratios - 1) <= 1 / np.sqrt(8)).all()


def test_deviations_are_in_standard_errors():
    values = np.array([1.6, 4.8])[:, None] * [1, 0.0125, 0.000625]
    deviations = standardized_differences(values, POLISHED)
    np.testing.assert_allclose(deviations[:3], 0, atol=1e-12)
    np.testing.assert_allclose(deviations[3], (np.sqrt(2) - 1) * np.sqrt(8))
    shifted = standardized_differences(values + POLISHED.stds / np.sqrt(5), POLISHED)
    np.testing.assert_allclose(shifted[:3], 1)


SUBSTITUTE = Substitute(
    "uncd", spectrum_dataset(UNCD.density), None, None, ScanGrid(64, SIZE, 64), seed=1
)
SOURCE = FeaturedSurface(SUBSTITUTE, POLISHED)


def test_the_nearest_scans_have_bumps_or_pits(monkeypatch):
    monkeypatch.setattr("hardcontact.surfaces.features.PERMITTED_SAMPLES", 4)
    features, scans = nearest_featured_scans(SOURCE, [1, 2])
    candidates = [
        SOURCE.sample_features(kind, 2, 1, candidate)
        for candidate, kind in enumerate(["bumps", "pits", "bumps", "pits"])
    ]
    distances = [
        np.linalg.norm(standardized_differences(rms_of(candidate), POLISHED))
        for candidate in candidates
    ]
    assert features == candidates[int(np.argmin(distances))]
    assert [scan.pixels for scan in scans] == [64, 64]
