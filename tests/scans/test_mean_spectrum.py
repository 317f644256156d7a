"""Means of spectra over measurements, smooth curves through them."""

import numpy as np
import pytest
from measurements import gentle_density, measurement, random_map

from hardcontact.base.arrays import generator
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.scans.mean_spectrum import smooth_curve
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER, variance_of_log
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.spectrum import BIN_CENTRES


def pattern(kind, seed):
    """A height map (nm) of a grating, a step or waves without a roll-off, with some roughness."""
    rng, pixels, pixel = generator(61, seed), 192, 50.0
    position = np.arange(pixels) * pixel
    period, edge = pixels * pixel / rng.uniform(4, 12), pixels * pixel * rng.uniform(0.2, 0.8)
    heights = {
        "grating": 20 * np.cos(2 * np.pi * position / period),
        "square grating": 10 * np.sign(np.cos(2 * np.pi * position / period)),
        "step": 25.0 * (position > edge),
        "waves": 0.0 * position,
    }[kind]
    rough = random_map(
        rng, pixels, pixel, lambda q: smooth_rolloff(q, plateau=1e10, rolloff=1e5, hurst=0.8)
    )
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
    density = np.where(is_measured, gentle_density(BIN_CENTRES), np.nan)
    point_variance = np.where(is_measured, variance_of_log(modes), np.nan)
    wavevector, mean, variance = smooth_curve(density, point_variance)
    curves = [smooth_curve(density, point_variance, generator(23, draw)) for draw in range(400)]
    sampled_logs = np.log([sampled_mean for _, sampled_mean, _ in curves])
    np.testing.assert_allclose(
        sampled_logs.std(axis=0), np.sqrt(variance - CALIBRATION_SCATTER**2), rtol=0.15
    )
    assert (
        np.abs(sampled_logs.mean(axis=0) - np.log(mean)) < 0.25 * sampled_logs.std(axis=0)
    ).all()
    # A power law has no bends: it is its own mean.
    power_law = np.where(is_measured, BIN_CENTRES**-3.0, np.nan)
    _, mean, _ = smooth_curve(power_law, point_variance)
    np.testing.assert_allclose(mean, wavevector**-3.0, rtol=1e-6)
