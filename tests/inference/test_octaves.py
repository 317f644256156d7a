"""Waves are split without loss, sensitivities are derivatives, forces on a band are relative."""

import numpy as np
import pytest
import xarray as xr
from periodic_maps import periodic_map

from hardcontact.inference.band_forces import BAND_PARTS, band_force_dataset, band_ratios
from hardcontact.inference.octaves import (
    AMPLITUDE_FACTORS,
    AMPLITUDE_STEP,
    octave_force_dataset,
    octave_limits,
    octave_sensitivities,
    split_octaves,
)
from hardcontact.inference.scan_parts import ScanParts, parts_of_maps

#: Pixel size (nm) of a map of 2560 nm.
PIXEL_SIZE = 20.0
PIXELS = 128


def wavy(*wavelengths):
    """Return a map of 2560 nm with waves along y whose amplitudes are 1 nm."""
    y = np.arange(PIXELS) * PIXEL_SIZE
    profile = sum(np.cos(2 * np.pi * y / wavelength) for wavelength in wavelengths)
    return periodic_map(np.tile(profile[:, None], PIXELS), PIXEL_SIZE)


#: Parts of three maps: the maps themselves.
MAP_PARTS = ScanParts(
    part_of_contact=np.arange(3)[:, None, None], correlation_matrix=np.eye(3), scan_count=3
)


def test_limits_of_octaves_lie_between_the_shortest_and_the_longest_wavelength():
    limits = octave_limits(41.0, 1000.0)
    np.testing.assert_array_equal(limits, [80.0, 160.0, 320.0, 640.0])


def test_each_wave_is_in_one_octave_with_its_shorter_limit():
    surface = wavy(160.0, 256.0, 1280.0)
    limits = [80.0, 160.0, 320.0, 640.0, 1280.0, 2560.0]
    waves = np.array([octave.heights for octave in split_octaves(surface, limits)])
    rms = waves.std(axis=(1, 2))
    # The squares 1/2 of 160 and 256 nm add up in the second octave; 1280 nm is alone in the last.
    np.testing.assert_allclose(rms, [0, 1, 0, 0, np.sqrt(0.5)], atol=1e-6)
    np.testing.assert_allclose(waves.sum(axis=0), surface.heights, atol=1e-5)


def test_the_sensitivity_of_a_power_is_its_exponent():
    # Forces that are powers of the rms height of one wave, on three maps of different amplitude.
    maps = [
        octave_force_dataset(
            periodic_map(scale * wavy(160.0).heights, PIXEL_SIZE),
            [80.0, 160.0, 320.0],
            lambda surface: np.full((1, 1), surface.heights.std() ** -1.5),
        )
        for scale in (1.0, 2.0, 3.0)
    ]
    forces = xr.concat(maps, "map").assign_attrs(map_size=2560.0)
    result = octave_sensitivities(forces, MAP_PARTS, 0.95)
    # The difference of logarithms is ln((1 + step)/(1 - step)) = 2 arctanh(step), over 2 steps.
    exponent = -1.5 * np.arctanh(AMPLITUDE_STEP) / AMPLITUDE_STEP
    np.testing.assert_allclose(result.octave_sensitivity, [0.0, exponent], atol=1e-6)
    assert result.octave.values.tolist() == [80.0, 160.0]


def test_intervals_of_few_skewed_contacts_contain_the_sensitivity_with_their_confidence():
    # The 64 contacts of a study of your scans at quick effort; each octave is another trial.
    rng = np.random.default_rng(3)
    trials, contacts, sensitivity = 3000, (8, 8), -0.5
    force = np.exp(0.4 * rng.standard_normal((trials, 1, *contacts)))
    # The mean of the exponential distribution is 1, so the expected sensitivity is -0.5.
    single_sensitivity = sensitivity + 1 - rng.exponential(size=force.shape)
    change = np.array([-AMPLITUDE_STEP, AMPLITUDE_STEP])[:, None, None]
    axes = ("map", "octave", "factor", "contact_y", "contact_x")
    forces = xr.Dataset(
        {"octave_force": (axes, (force * (1 + change * single_sensitivity))[None])},
        {"octave": np.arange(trials), "factor": list(AMPLITUDE_FACTORS)},
        {"map_size": 10_000.0, "period": 20_000.0},
    )
    result = octave_sensitivities(forces, parts_of_maps(forces, radius=50_000.0, rho=3.0), 0.95)
    interval = result.octave_sensitivity_interval
    is_inside = (interval.sel(end="low") < sensitivity) & (sensitivity < interval.sel(end="high"))
    assert float(is_inside.mean()) == pytest.approx(0.95, abs=0.02)


def test_ratios_of_a_band_are_relative_to_the_force_with_all_roughness():
    bands = {"published": (200.0, 600.0), "computed": (100.0, 2561.0)}
    maps = [
        band_force_dataset(
            periodic_map(scale * wavy(160.0, 512.0, 1280.0).heights, PIXEL_SIZE),
            bands,
            lambda surface: np.full((1, 1), surface.heights.var()),
        )
        for scale in (1.0, 2.0, 3.0)
    ]
    # Each wave has a third of the variance; the published band holds one wave.
    ratios = band_ratios(xr.concat(maps, "map"), MAP_PARTS, 0.95)
    assert ratios.band_part.values.tolist() == list(BAND_PARTS)
    np.testing.assert_allclose(
        ratios.band_force_ratio, [[1 / 3, 2 / 3, 2 / 3], [1, 1, 1]], rtol=1e-6
    )
    np.testing.assert_array_equal(maps[0].band_edge, list(bands.values()))
    # All maps have the same ratios, so that intervals come from rounding.
    widths = np.ptp(ratios.band_force_ratio_interval.values, axis=-1)
    np.testing.assert_allclose(widths[np.isfinite(widths)], 0, atol=1e-5)
