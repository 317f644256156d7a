"""Each kind of defect is named with its numbers; sound scans have no defect."""

from functools import partial

import numpy as np
import pytest
from measurements import measurement, random_map, self_affine_heights
from scipy.ndimage import gaussian_filter

from hardcontact.base.arrays import generator
from hardcontact.scans.defects import DEFECTS, level_and_list_defects
from hardcontact.surfaces.features import Features, add_features
from hardcontact.surfaces.spectral_models import smooth_rolloff

PIXEL, PIXELS = 20.0, 128  # nm, and pixels per row
SIZE = PIXELS * PIXEL
Y, X = np.indices((PIXELS, PIXELS)) * PIXEL - SIZE / 2


def rough_heights(seed, rms_height, hurst=0.7, rolloff=SIZE / 10):
    """Return heights (y, x) of a self-affine map with a mean of zero; all lengths in nm."""
    heights = self_affine_heights(generator(seed), PIXELS, PIXEL, rms_height, hurst, rolloff)
    return heights - heights.mean()


def defects_of(heights):
    return level_and_list_defects(measurement(heights, PIXEL)).defects


def map_with_spikes(seed, share):
    heights = rough_heights(seed, 12.0)
    rng = generator(seed + 1)
    positions = rng.choice(heights.size, round(share * heights.size), replace=False)
    heights.flat[positions] += rng.choice([-1, 1], len(positions)) * rng.uniform(
        300, 2000, len(positions)
    )
    return heights


def map_with_streaks(seed, sign):
    """Return a rough map with streaks of 25 nm on lines 10, 11 and 90, counted from 1."""
    heights = rough_heights(seed, 3.0)
    for line, start, length in ((9, 20, 30), (10, 35, 12), (89, 60, 25)):
        heights[line, start : start + length] += sign * 25
    return heights


def stopped_scan(seed, line_count, filling, axis=0):
    """Return a map that is measured on its first lines only, and then zero or the last line."""
    heights = rough_heights(seed, 5.0) + 40
    heights[line_count:] = heights[line_count - 1] if filling == "repeated" else 0.0
    return heights if axis == 0 else heights.T


def map_with_grating(period, degrees):
    angle = np.radians(degrees)
    wave = np.cos(2 * np.pi * (X * np.cos(angle) + Y * np.sin(angle)) / period)
    return 15 * wave + rough_heights(9, 0.7)


def curved_map(seed, rms_height, radius_x, radius_y):
    return rough_heights(seed, rms_height) - X**2 / (2 * radius_x) - Y**2 / (2 * radius_y)


def map_with_pillars(seed):
    """Return a map with round pillars of 40 nm on a floor of 1 nm rms height."""
    centres = generator(seed).uniform(0, PIXELS, (60, 2))
    rows, columns = np.indices((PIXELS, PIXELS))
    is_pillar = np.zeros((PIXELS, PIXELS), bool)
    for y, x in centres:
        is_pillar |= (rows - y) ** 2 + (columns - x) ** 2 < 9
    return 40.0 * is_pillar + rough_heights(51, 1.0)


ROUGH = rough_heights(3, 6.0)
#: Isotropic long waves, and a short wave along y with an amplitude of 2.5 nm, five pixels long.
LONG_WAVES = gaussian_filter(rough_heights(45, 1.0), 6, mode="wrap")
LONG_WAVES *= 6 / LONG_WAVES.std()
SHORT_WAVE = 2.5 * np.cos(2 * np.pi * Y / (5 * PIXEL))
#: Rms slope along y of both, from the steps of the short wave between pixels.
SHORT_SLOPE = np.hypot(
    2 * np.pi * 2.5 / (5 * PIXEL) / np.sqrt(2) * np.sinc(1 / 5),
    np.diff(LONG_WAVES, axis=0).std() / PIXEL,
)
#: Heights, and their defects with the numbers with which they were made, in the order of DEFECTS.
#: None stands for a number that is not known.
CASES = {
    "few spikes": (map_with_spikes(11, 10 / PIXELS**2), {"spikes": (10 / PIXELS**2, 12.0)}),
    "spikes": (map_with_spikes(12, 2e-3), {"spikes": (2e-3, 12.0)}),
    "many spikes": (map_with_spikes(13, 0.03), {"spikes": (0.03, 12.0)}),
    "streaks": (map_with_streaks(14, 1), {"streaks": (3, 10, 90, 3.0)}),
    "streaks below": (map_with_streaks(14, -1), {"streaks": (3, 10, 90, 3.0)}),
    "stopped, zero": (stopped_scan(21, 96, "zero"), {"equal_lines": (0.25,)}),
    "stopped, repeated": (stopped_scan(22, 64, "repeated"), {"equal_lines": (0.5,)}),
    "stopped, along y": (stopped_scan(23, 100, "repeated", 1), {"equal_lines": (28 / PIXELS,)}),
    "clipped at the top": (np.minimum(ROUGH, np.quantile(ROUGH, 0.96)), {"highest": (0.04,)}),
    "clipped at both ends": (
        np.clip(ROUGH, *np.quantile(ROUGH, [0.05, 0.99])),
        {"highest": (0.01,), "lowest": (0.05,)},
    ),
    "clipped, quantised": (
        np.round(np.minimum(ROUGH, 9.0), 1), {"highest": ((ROUGH >= 8.95).mean(),)},
    ),
    "ball": (
        curved_map(31, 1.0, 30e3, 30e3),
        {"curvature": (30e3, 1 / np.hypot(1, (X**2 + Y**2).std() / 60e3))},
    ),
    "bow": (curved_map(32, 0.5, -60e3, -120e3), {"curvature": (60e3, None)}),
    "cylinder": (curved_map(33, 0.5, 1e5, np.inf), {"curvature": (1e5, None)}),
    "grating": (map_with_grating(300, 0), {"lay": (None,)}),
    "oblique grating": (map_with_grating(700, 45), {"lay": (None,)}),
    "step": (
        np.where(X > SIZE / 8, 18.0, 0.0) + rough_heights(41, 0.6),
        {"lay": (None,), "sidewalls": (None,)},
    ),
    "offset lines": (
        rough_heights(43, 0.2) + generator(44).normal(0, 0.3, (PIXELS, 1)),
        {"offset_lines": (0.3,)},
    ),
    "noise": (
        rough_heights(46, 0.2, 1.0, SIZE / 4) + generator(47).normal(0, 0.1, X.shape),
        {"noise": (0.1, 0.2)},
    ),
    "lay of short waves": (LONG_WAVES + SHORT_WAVE, {"slopes": (None, SHORT_SLOPE)}),
    "lay": (gaussian_filter(generator(42).standard_normal(X.shape), (12, 2)), {"lay": (None,)}),
    "pillars": (map_with_pillars(62), {"sidewalls": (None,)}),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_each_defect_is_named_with_its_numbers(case):
    heights, true_defects = CASES[case]
    defects = defects_of(heights)
    assert set(defects) == set(true_defects)
    for code, numbers in true_defects.items():
        assert list(defects[code]) == list(DEFECTS[code])
        for number, true_number in zip(defects[code].values(), numbers, strict=True):
            assert true_number is None or number == pytest.approx(true_number, rel=0.05)


def map_with_wide_streak(seed):
    """Return a rough map with a streak of 25 nm on three neighbouring lines."""
    heights = rough_heights(seed, 3.0)
    heights[40:43, 30:60] += 25
    return heights


@pytest.mark.parametrize(
    ("heights", "largest_error"),
    # Parts of the 25 nm of a streak: the lines beside its middle are farther if it is wide.
    [(map_with_streaks(14, 1), 25 / 5), (map_with_wide_streak(14), 25 / 2)],
)
def test_levelling_of_lines_fills_streaks(heights, largest_error):
    flat = level_and_list_defects(measurement(heights, PIXEL), levelling="lines")
    sound = level_and_list_defects(measurement(rough_heights(14, 3.0), PIXEL), levelling="lines")
    errors = np.abs(flat.heights - sound.heights)
    assert (errors < 0.2).mean() > 0.99 and errors.max() < largest_error
    assert not flat.defects and "3 lines" in flat.notes[-1] and not sound.notes


@pytest.mark.parametrize("batch", range(4))
def test_no_self_affine_surface_has_a_defect(batch):
    """Four batches of ten: H from 0.3 to 1, roll-offs from a twentieth to twice the scan size."""
    rng = generator(100 + batch)
    for _ in range(10):
        hurst, rolloff = rng.uniform(0.3, 1), 64 * PIXEL * np.exp(rng.uniform(*np.log([0.05, 2])))
        density = partial(smooth_rolloff, plateau=1e6, rolloff=rolloff, hurst=hurst)
        assert not level_and_list_defects(random_map(rng, 64, PIXEL, density)).defects


def map_with_bumps(seed):
    scan = measurement(rough_heights(seed, 5.0), PIXEL)
    bumps = Features(number_density=3.0, height=35.0, width=40.0, base_factor=1.0, counts=(20,))
    return add_features(generator(seed), scan, bumps, 20).heights


SOUND_SCANS = {
    "bumps": map_with_bumps(61),
    "heavy tail": np.exp(rough_heights(63, 0.6)),
    "noise": generator(64).standard_normal((PIXELS, PIXELS)),
    "few levels": np.round(rough_heights(65, 0.05), 1),
    "levels": np.round(rough_heights(66, 1.0)),
    "line": generator(67).normal(0, 0.05, 64),
    "rounded line": np.round(rough_heights(68, 1.0)[0], 1),
    "flat line": np.zeros(64),
}


@pytest.mark.parametrize("name", SOUND_SCANS)
def test_no_sound_scan_has_a_defect(name):
    assert not defects_of(SOUND_SCANS[name])
