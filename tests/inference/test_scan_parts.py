"""Parts of scans: positions of contacts, correlation of parts, coverage of intervals."""

import numpy as np
import pytest
from scipy import fft

from hardcontact.contact.geometry import contact_positions
from hardcontact.inference.scan_parts import (
    interval_half_width,
    jackknife_variance,
    parts_of_scans,
    quarters_of_contacts,
)


def half_width_of(delete_one_logs, scan_parts, confidence):
    return interval_half_width([jackknife_variance(delete_one_logs, scan_parts)], confidence)


@pytest.mark.parametrize("count, tiles", [(4, 1), (20, 1), (20, 4), (7, 2), (6, 4)])
def test_contacts_lie_on_the_quarters_of_the_mirrored_scan(count, tiles):
    # A scan whose heights are the numbers of its quarters, mirrored, repeated, read at contacts.
    scan = np.kron(np.arange(4).reshape(2, 2), np.ones((500, 500), int))
    mirrored = np.pad(scan, ((0, 1000), (0, 1000)), mode="symmetric")
    positions = contact_positions(2000 * tiles, count) % 2000
    quarters = mirrored[np.ix_(positions, positions)]
    np.testing.assert_array_equal(quarters_of_contacts(count, tiles), quarters)


QUARTERS = quarters_of_contacts(4, 1)


def test_three_scans_are_independent_parts_and_fewer_are_divided_into_quarters():
    three = parts_of_scans(np.array([0, 1, 2, 0]), QUARTERS, period=200.0, weight_deviation=50.0)
    assert not three.are_quarters and three.part_of_contact[:, 0, 0].tolist() == [0, 1, 2, 0]
    np.testing.assert_array_equal(three.correlation_matrix, np.eye(3))
    two = parts_of_scans(np.array([0, 1, 0]), QUARTERS, period=200.0, weight_deviation=50.0)
    assert two.are_quarters and (two.correlation_matrix[:4, 4:] == 0).all()
    np.testing.assert_array_equal(two.part_of_contact[1], QUARTERS + 4)


def random_forces(rng, trials, pixels, deviation):
    """Return forces (trial, pixels, pixels) at every pixel of mirrored white roughness.

    The surface attracts with a Gaussian weight, whose deviation is in pixels.
    """
    spectrum = fft.dctn(rng.standard_normal((trials, pixels, pixels)), axes=(1, 2), norm="ortho")
    decay = np.exp(-((np.pi * np.arange(pixels) * deviation / pixels) ** 2) / 2)
    return fft.idctn(spectrum * decay[:, None] * decay, axes=(1, 2), norm="ortho")


def quarter_means(forces):
    """Return means (trial, quarter) of forces (trial, pixels, pixels)."""
    half = forces.shape[1] // 2
    return forces.reshape(-1, 2, half, 2, half).mean(axis=(2, 4)).reshape(-1, 4)


@pytest.mark.parametrize("deviation", [0.02, 0.2, 0.47])
def test_quarters_correlate_as_those_of_smoothed_noise(deviation):
    means = quarter_means(random_forces(np.random.default_rng(1), 4000, 32, deviation * 32))
    measured_correlation = means.T @ means / np.mean(means**2) / len(means)
    scan_parts = parts_of_scans(np.zeros(1), QUARTERS, period=2.0, weight_deviation=deviation)
    # Three standard errors of a correlation over 4000 trials.
    np.testing.assert_allclose(scan_parts.correlation_matrix, measured_correlation, atol=0.05)


@pytest.mark.parametrize("deviation", [0.02, 0.15, 0.3])
def test_quarters_of_a_surface_that_is_not_mirrored_correlate_as_those_of_noise(deviation):
    # The force at each pixel is periodic noise, smoothed by a Gaussian with a deviation in periods.
    pixels, trials = 32, 4000
    noise = np.random.default_rng(1).standard_normal((trials, pixels, pixels))
    decay = np.exp(-2 * (np.pi * fft.fftfreq(pixels, 1 / pixels) * deviation) ** 2)
    forces = fft.ifftn(fft.fftn(noise, axes=(1, 2)) * decay[:, None] * decay, axes=(1, 2)).real
    quarters = quarters_of_contacts(pixels, 1)
    means = np.stack([forces[:, quarters == quarter].mean(axis=1) for quarter in range(4)], axis=1)
    measured_correlation = means.T @ means / np.mean(means**2) / trials
    scan_parts = parts_of_scans(np.zeros(1), quarters, period=1.0, weight_deviation=deviation)
    # Three standard errors of a correlation over 4000 trials.
    np.testing.assert_allclose(scan_parts.correlation_matrix, measured_correlation, atol=0.05)


@pytest.mark.parametrize("scans", [1, 2, 3, 5])
def test_intervals_contain_the_mean_with_their_confidence(scans):
    trials, deviation = 1500, 0.3
    means = quarter_means(
        random_forces(np.random.default_rng(2), trials * scans, 16, deviation * 16)
    )
    means = means.reshape(trials, -1)
    scan_parts = parts_of_scans(np.arange(scans), QUARTERS, period=2.0, weight_deviation=deviation)
    if not scan_parts.are_quarters:
        means = means.reshape(trials, scans, 4).mean(axis=-1)
    count = means.shape[1]
    delete_one_means = (means.sum(axis=1, keepdims=True) - means) / (count - 1)
    half_width = half_width_of(delete_one_means.T, scan_parts, 0.9)
    # Four standard errors of a share of 0.9 over 1500 trials.
    assert np.mean(np.abs(means.mean(axis=1)) < half_width) == pytest.approx(0.9, abs=0.03)


def test_a_single_part_has_no_interval_and_equal_parts_one_without_width():
    correlated_parts = parts_of_scans(np.zeros(1), QUARTERS, period=2.0, weight_deviation=5.0)
    assert np.isnan(half_width_of(np.arange(4.0), correlated_parts, 0.95))
    single = parts_of_scans(np.zeros(1), np.zeros((1, 1), int), period=2.0, weight_deviation=0.1)
    assert np.isnan(half_width_of(np.zeros(1), single, 0.95))
    independent_parts = parts_of_scans(np.zeros(1), QUARTERS, period=2.0, weight_deviation=0.1)
    half_width = half_width_of(np.array([[0.1, 0.2]] * 4) + 1e-17, independent_parts, 0.95)
    np.testing.assert_array_equal(half_width, 0.0)
