"""Means of spectra over measurements, smooth curves through them, contradicting measurements."""

from dataclasses import replace

import numpy as np
import pytest
from measurements import gentle_density, measurement, random_line, random_map, uncd_density
from refusals import assert_says

from hardcontact.base.arrays import generator
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.scans.mean_spectrum import (
    describe_contradictions,
    find_contradictions,
    smooth_curve,
)
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER, variance_of_log
from hardcontact.surfaces.spectrum import BIN_CENTRES, smooth_rolloff


def pattern(kind, seed, pixels=192, pixel=50.0):
    """A height map (nm) of a grating, a step or waves without a roll-off, with some roughness."""
    rng = generator(61, seed)
    position = np.arange(pixels) * pixel
    period, edge = pixels * pixel / rng.uniform(4, 12), pixels * pixel * rng.uniform(0.2, 0.8)
    heights = {
        "grating": 20 * np.cos(2 * np.pi * position / period),
        "square grating": 10 * np.sign(np.cos(2 * np.pi * position / period)),
        "step": 25.0 * (position > edge),
        "waves": 0.0 * position,
    }[kind]
    rough = random_map(rng, pixels, pixel, lambda q: smooth_rolloff(q, 1e10, 1e5, 0.8))
    return measurement(heights + rough.heights, pixel)


@pytest.mark.parametrize("kind", ["grating", "square grating", "step", "waves"])
def test_a_joined_spectrum_keeps_the_variance_of_its_bins(kind):
    for seed in range(5):
        scan = pattern(kind, seed)
        joined_data = joined_spectrum([scan], [1e-3])
        is_reliable = joined_data["reliable"].values[0] == 1
        power = BIN_CENTRES[is_reliable] ** 2 * joined_data["psd"].values[0, is_reliable]
        joined_power = BIN_CENTRES[is_reliable] ** 2 * joined_data["joined_psd"].values[is_reliable]
        assert joined_power.sum() == pytest.approx(power.sum(), rel=1e-12)
        if "grating" in kind:  # The line keeps its wavelength.
            peak = power.argmax()
            assert joined_power[peak] == pytest.approx(power[peak], rel=0.05)


def test_sampled_curves_scatter_with_the_stated_variance():
    modes = np.where((BIN_CENTRES > 0.02) & (BIN_CENTRES < 0.3), 0.01 / BIN_CENTRES**2, 1.5)
    is_measured = (
        (BIN_CENTRES > 0.005) & (BIN_CENTRES < 2) & ~((BIN_CENTRES > 0.1) & (BIN_CENTRES < 0.3))
    )
    points = (
        np.where(is_measured, gentle_density(BIN_CENTRES), np.nan),
        np.where(is_measured, variance_of_log(modes), np.nan),
    )
    wavevector, mean, variance = smooth_curve(*points)
    sampled_logs = np.log([smooth_curve(*points, generator(23, draw))[1] for draw in range(400)])
    np.testing.assert_allclose(
        sampled_logs.std(axis=0), np.sqrt(variance - CALIBRATION_SCATTER**2), rtol=0.15
    )
    assert (
        np.abs(sampled_logs.mean(axis=0) - np.log(mean)) < 0.25 * sampled_logs.std(axis=0)
    ).all()
    # A power law has no bends: it is its own mean.
    slope = np.where(is_measured, BIN_CENTRES**-3.0, np.nan)
    np.testing.assert_allclose(smooth_curve(slope, points[1])[1], wavevector**-3.0, rtol=1e-6)


# Contradictions

NAMES = ["large.spm", "small.spm", "line.txt"]


def test_a_half_decade_in_which_two_scans_differ_is_named():
    density = np.tile(uncd_density(BIN_CENTRES), (2, 1))
    wavelength = 2 * np.pi / BIN_CENTRES
    reliable = (wavelength > 50) & (wavelength < 5000) & np.ones((2, 1), bool)  # 20 bins
    density[1, (wavelength > 50) & (wavelength < 150)] *= 0.01  # a blunt tip
    (contradiction,) = find_contradictions(density, reliable, ["map", "map"], [50e3, 50e3])
    assert contradiction[:2] == (0, 1) and contradiction.factor == pytest.approx(100, rel=1e-12)
    assert contradiction.longest < 160


def simulate_contradictions(seed, heights=1.0):
    """Return the contradictions of three measurements, the second with multiplied heights."""
    scans = [
        random_map(generator(seed, 0), 128, 80.0, uncd_density),
        random_map(generator(seed, 1), 128, 16.0, uncd_density),
        random_line(generator(seed, 2), 2000, 20.0, uncd_density),
    ]
    scans[1] = replace(scans[1], heights=heights * scans[1].heights)
    spectrum = joined_spectrum(scans, [None] * 3)
    return find_contradictions(
        *(spectrum[name].values for name in ("psd", "reliable", "kind", "size"))
    )


def test_scans_of_one_surface_agree_within_their_scatter_and_calibration():
    assert not any(simulate_contradictions(seed) for seed in range(8))
    assert not any(simulate_contradictions(seed, 1.1) for seed in range(3))  # 10 % calibration


@pytest.mark.parametrize(("heights", "order"), [(10.0, [1, 0]), (0.1, [0, 1])])
def test_a_scan_of_other_heights_is_named_with_the_square_of_their_factor(heights, order):
    contradictions = simulate_contradictions(1, heights)
    assert [sorted(item[:2]) for item in contradictions] in ([[0, 1], [1, 2]], [[1, 2], [0, 1]])
    large_and_small = next(item for item in contradictions if set(item[:2]) == {0, 1})
    assert list(large_and_small[:2]) == order and large_and_small.factor == pytest.approx(
        100, rel=0.4
    )
    assert (
        320 <= large_and_small.shortest < large_and_small.longest <= 2048 / 3
    )  # four pixels, a third of the size
    line = describe_contradictions([large_and_small, contradictions[1]], NAMES)
    assert_says(line, "large.spm", "small.spm", "contradict", "times", "more pairs that do: 1")
