"""A scan that mirror images continue is mirror-symmetric."""

import numpy as np

from hardcontact.surfaces.height_map import HeightMap, mirror_scan


def test_a_mirrored_map_is_mirror_symmetric():
    heights = np.random.default_rng(0).standard_normal((7, 7))
    mirrored = mirror_scan(HeightMap(heights, 10.0, periodic=False, source="measured"))
    assert mirrored.heights.shape == (14, 14) and mirrored.periodic
    np.testing.assert_array_equal(mirrored.heights[:7, :7], heights)
    for axis in (0, 1):
        flipped = np.flip(mirrored.heights, axis)
        np.testing.assert_array_equal(mirrored.heights, flipped)
