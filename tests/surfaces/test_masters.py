"""Masters by side: artificial roughness only on its side of the transition, of the given size."""

import numpy as np
import pytest

from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.synthesis import SIDES, synthesized_master

WHITE = Spectrum(WAVEVECTORS, np.full(WAVEVECTORS.shape, 1e3))


@pytest.mark.parametrize("side", SIDES)
def test_a_flat_scan_has_artificial_roughness_on_one_side_of_the_transition(side):
    flat = HeightMap(np.zeros((32, 32)), 10.0, periodic=True, basis="substitute")
    scales = {"pixels": 128, "tiles": 4, "transition": 80.0}
    master = synthesized_master(side, np.random.default_rng(5), flat, scales, WHITE)
    power = np.abs(np.fft.fft2(master.heights)) ** 2
    waves = np.fft.fftfreq(master.pixels, master.pixel_size)
    frequency = np.hypot(*np.meshgrid(waves, waves))
    share = power[frequency > 1 / scales["transition"]].sum() / power.sum()
    assert master.size == flat.size * {"small": 1, "large": 4}[side]
    assert master.pixels == 128
    assert share > 0.9 if side == "small" else share < 1e-6
