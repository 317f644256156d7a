"""Features: their shape, Campbell's theorem, and the published statistics of scans."""

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

PIXELS, PIXEL = 200, 12.5
SIZE = PIXELS * PIXEL  # 2500 nm, as in the paper
FLAT = replace(periodic_map(np.zeros((PIXELS, PIXELS)), PIXEL), periodic=False)


def squares(scan):
    """The squares of rms height, gradient and half-Laplacian of a scan, after levelling."""
    if not scan.heights.any():
        return np.zeros(3)
    scan_metrics = metrics(level_plane(scan))
    return np.array([scan_metrics[name] ** 2 for name in TABLE1_METRICS.values()])


def expected_rms(features):
    added = feature_squares(features.height, features.width, SIZE)
    return featured_rms(features.base_factor, features.counts, added, POLISHED)


@pytest.mark.parametrize("periodic", [False, True])
def test_a_feature_is_a_gaussian_of_its_height_and_width(periodic):
    features = Features(number_density=0.1, height=-20.0, width=60.0, base_factor=1.0, counts=(1,))
    flat = replace(FLAT, periodic=periodic)
    heights = add_features(np.random.default_rng(4), flat, features, 1).heights
    centre = np.random.default_rng(4).uniform(0, SIZE, 2)  # the same sample
    position = (np.arange(PIXELS) + 0.5) * PIXEL
    offsets = np.abs(position - centre[:, None])
    if periodic:
        offsets = np.minimum(offsets, SIZE - offsets)
    squared_distance = offsets[0][:, None] ** 2 + offsets[1] ** 2
    gaussian = np.exp(-squared_distance / (2 * 60.0**2))
    np.testing.assert_allclose(heights, -20 * gaussian, atol=1e-9)


def test_mean_and_variance_of_squares_follow_campbells_theorem():
    """Pairs of features add twice the mean squared covariance to the variance of squares."""
    density, width = 2.0, 120.0
    features = Features(density, height=30.0, width=width, base_factor=1.0, counts=())
    rng = np.random.default_rng(1)
    flat = replace(periodic_map(np.zeros((50, 50)), SIZE / 50), periodic=False)
    mean_count = density * (SIZE / 1e3) ** 2
    counts = rng.poisson(mean_count, 600)
    scans = [add_features(rng, flat, features, count) for count in counts]
    scan_squares = np.array([squares(scan) for scan in scans])
    added = feature_squares(30.0, width, SIZE)
    np.testing.assert_allclose(scan_squares.mean(axis=0), mean_count * added, rtol=0.08)
    # The covariance at a distance d is that at zero times exp(-d²/4w²).
    squared_covariance = (mean_count * added[0]) ** 2 * 2 * np.pi * width**2 / SIZE**2
    variance = mean_count * added[0] ** 2 + 2 * squared_covariance
    assert scan_squares[:, 0].var() == pytest.approx(variance, rel=0.2)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("scan_count", [1, 2, 5])
def test_sampled_features_are_within_standard_errors_of_table_1(sign, scan_count):
    rng, grid = np.random.default_rng(scan_count), ScanGrid(PIXELS, SIZE, PIXELS)
    for _ in range(3):
        features = sample_permitted_features(rng, POLISHED, scan_count, grid, sign)
        assert np.sign(features.height) == sign and len(features.counts) == scan_count
        rms_values = expected_rms(features)
        means = rms_values.mean(axis=0)
        # Of five scans, as published: 1/sqrt(n), and 1/sqrt(2(n - 1)) for standard deviations.
        assert (np.abs(means - POLISHED.means) <= POLISHED.stds / np.sqrt(5)).all()
        if scan_count > 1:
            ratios = rms_values.std(axis=0, ddof=1)[:2] / POLISHED.stds[:2]
            assert (np.abs(ratios - 1) <= 1 / np.sqrt(8)).all()


def test_differences_are_in_standard_errors():
    # Two scans with the published means; the deviation of their heights is sqrt(2) times 1.6 nm.
    rms_values = np.array([0.5, 1.5])[:, None] * POLISHED.means
    differences = standardized_differences(rms_values, POLISHED)
    np.testing.assert_allclose(differences[:3], 0, atol=1e-12)
    np.testing.assert_allclose(differences[3], (np.sqrt(2) - 1) * np.sqrt(8))
    shifted = standardized_differences(rms_values + POLISHED.stds / np.sqrt(5), POLISHED)
    np.testing.assert_allclose(shifted[:3], 1)


SUBSTITUTE = Substitute(
    "uncd", spectrum_dataset(UNCD.density), None, None, ScanGrid(64, SIZE, 64), seed=1
)
SURFACE = FeaturedSurface(SUBSTITUTE, POLISHED)


def test_of_permitted_bumps_and_pits_the_nearest_to_table_1_are_taken(monkeypatch):
    monkeypatch.setattr("hardcontact.surfaces.features.PERMITTED_SAMPLES", 4)
    features, scans = nearest_featured_scans(SURFACE, [1, 2])
    samples = [
        SURFACE.sample_features(kind, 2, 1, sample_number)
        for sample_number, kind in enumerate(["bumps", "pits", "bumps", "pits"])
    ]
    distances = [
        np.linalg.norm(standardized_differences(expected_rms(sample), POLISHED))
        for sample in samples
    ]
    assert features == samples[int(np.argmin(distances))]
    assert [scan.pixels for scan in scans] == [64, 64]
