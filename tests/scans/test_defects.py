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

PIXEL, PIXELS = 20.0, 128
SIZE = PIXELS * PIXEL
Y, X = np.indices((PIXELS, PIXELS)) * PIXEL - SIZE / 2


def rough(seed, rms_height, hurst=0.7, rolloff=SIZE / 10):
    """Heights of a self-affine map with an rms height."""
    heights = self_affine_heights(generator(seed), PIXELS, PIXEL, rms_height, hurst, rolloff)
    return heights - heights.mean()


def defects_of(heights):
    return level_and_list_defects(measurement(heights, PIXEL)).defects


def add_spikes(seed, share):
    heights = rough(seed, 12.0)
    rng = generator(seed + 1)
    positions = rng.choice(heights.size, round(share * heights.size), replace=False)
    heights.flat[positions] += rng.choice([-1, 1], len(positions)) * rng.uniform(
        300, 2000, len(positions)
    )
    return heights


def add_streaks(seed, sign):
    """Streaks on lines 10, 11 and 90 of a rough map."""
    heights = rough(seed, 3.0)
    for line, start, length in ((9, 20, 30), (10, 35, 12), (89, 60, 25)):
        heights[line, start : start + length] += sign * 25
    return heights


def stop_scan(seed, lines, filling, axis=0):
    heights = rough(seed, 5.0) + 40
    filling_heights = heights[lines - 1] if filling == "repeated" else 0.0
    heights[lines:] = filling_heights
    return heights if axis == 0 else heights.T


def grating(period, degrees):
    angle = np.radians(degrees)
    wave = np.cos(2 * np.pi * (X * np.cos(angle) + Y * np.sin(angle)) / period)
    return 15 * wave + rough(9, 0.7)


def curved(seed, rms_height, radius_x, radius_y):
    return rough(seed, rms_height) - X**2 / (2 * radius_x) - Y**2 / (2 * radius_y)


def pillars(rng):
    """Round pillars, twenty rms heights of the floor high."""
    centres = rng.uniform(0, PIXELS, (60, 2))
    rows, columns = np.indices((PIXELS, PIXELS))
    is_pillar = np.zeros((PIXELS, PIXELS), bool)
    for y, x in centres:
        is_pillar |= (rows - y) ** 2 + (columns - x) ** 2 < 9
    return 40.0 * is_pillar + rough(51, 1.0)


ROUGH = rough(3, 6.0)
#: Long waves alike in all directions, and a short one along y whose crests are straight.
LONG_WAVES = gaussian_filter(rough(45, 1.0), 6, mode="wrap")
LONG_WAVES *= 6 / LONG_WAVES.std()
SHORT_WAVE = 2.5 * np.cos(2 * np.pi * Y / (5 * PIXEL))
SHORT_SLOPE = np.hypot(
    2 * np.pi * 2.5 / (5 * PIXEL) / np.sqrt(2) * np.sinc(1 / 5),
    np.diff(LONG_WAVES, axis=0).std() / PIXEL,
)
#: Heights, and the defects that they have with the numbers that they were made with, in the order
#: of DEFECTS; None stands for a number that is not known.
CASES = {
    "few spikes": (add_spikes(11, 10 / PIXELS**2), {"spikes": (10 / PIXELS**2, 12.0)}),
    "spikes": (add_spikes(12, 2e-3), {"spikes": (2e-3, 12.0)}),
    "many spikes": (add_spikes(13, 0.03), {"spikes": (0.03, 12.0)}),
    "streaks": (add_streaks(14, 1), {"streaks": (3, 10, 90, 3.0)}),
    "streaks below": (add_streaks(14, -1), {"streaks": (3, 10, 90, 3.0)}),
    "stopped, zero": (stop_scan(21, 96, "zero"), {"equal_lines": [0.25]}),
    "stopped, repeated": (stop_scan(22, 64, "repeated"), {"equal_lines": [0.5]}),
    "stopped, along y": (stop_scan(23, 100, "repeated", 1), {"equal_lines": [28 / PIXELS]}),
    "clipped at the top": (np.minimum(ROUGH, np.quantile(ROUGH, 0.96)), {"highest": [0.04]}),
    "clipped at both ends": (
        np.clip(ROUGH, *np.quantile(ROUGH, [0.05, 0.99])),
        {"highest": [0.01], "lowest": [0.05]},
    ),
    "clipped, quantised": (
        np.round(np.minimum(ROUGH, 9.0), 1), {"highest": [(ROUGH >= 8.95).mean()]},
    ),
    "ball": (
        curved(31, 1.0, 30e3, 30e3),
        {"curvature": (30e3, 1 / np.hypot(1, (X**2 + Y**2).std() / 60e3))},
    ),
    "bow": (curved(32, 0.5, -60e3, -120e3), {"curvature": (60e3, None)}),
    "cylinder": (curved(33, 0.5, 1e5, np.inf), {"curvature": (1e5, None)}),
    "grating": (grating(300, 0), {"lay": [None]}),
    "oblique grating": (grating(700, 45), {"lay": [None]}),
    "step": (
        np.where(X > SIZE / 8, 18.0, 0.0) + rough(41, 0.6), {"lay": [None], "sidewalls": [None]}
    ),
    "offset lines": (
        rough(43, 0.2) + generator(44).normal(0, 0.3, (PIXELS, 1)), {"offset_lines": [0.3]},
    ),
    "noise": (
        rough(46, 0.2, 1.0, SIZE / 4) + generator(47).normal(0, 0.1, X.shape),
        {"noise": [0.1, 0.2]},
    ),
    "lay of short waves": (LONG_WAVES + SHORT_WAVE, {"slopes": [None, SHORT_SLOPE]}),
    "lay": (gaussian_filter(generator(42).standard_normal(X.shape), (12, 2)), {"lay": [None]}),
    "pillars": (pillars(generator(62)), {"sidewalls": [None]}),
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


def add_wide_streak(seed):
    """A streak on three neighbouring lines."""
    heights = rough(seed, 3.0)
    heights[40:43, 30:60] += 25
    return heights


@pytest.mark.parametrize(
    ("heights", "largest_error"), [(add_streaks(14, 1), 25 / 5), (add_wide_streak(14), 25 / 2)]
)
def test_levelling_of_lines_fills_streaks(heights, largest_error):
    flat = level_and_list_defects(measurement(heights, PIXEL), levelling="lines")
    sound = level_and_list_defects(measurement(rough(14, 3.0), PIXEL), levelling="lines")
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


def with_bumps(seed):
    scan = measurement(rough(seed, 5.0), PIXEL)
    bumps = Features(number_density=3.0, height=35.0, width=40.0, base_factor=1.0, counts=(20,))
    return add_features(generator(seed), scan, bumps, 20).heights


@pytest.mark.parametrize(
    "heights",
    [
        with_bumps(61),
        np.exp(rough(63, 0.6)),
        generator(64).standard_normal((PIXELS, PIXELS)),
        np.round(rough(65, 0.05), 1),
        np.round(rough(66, 1.0)),
        generator(67).normal(0, 0.05, 64),
        np.round(rough(68, 1.0)[0], 1),
        np.zeros(64),
    ],
    ids=["bumps", "heavy tail", "noise", "few levels", "levels", "line", "digits", "flat line"],
)  # fmt: skip
def test_no_sound_scan_has_a_defect(heights):
    assert not defects_of(heights)
