"""Maps of the rigid pull-off force against single contacts and the direct sum."""

from dataclasses import replace

import numpy as np
import pytest
from direct_sum import direct_total
from periodic_maps import height_map, over, periodic_noise

from hardcontact.adhesion.pull_off import pull_off_of_pair
from hardcontact.contact.geometry import gap_map
from hardcontact.insight.scan_maps import at_every_pixel, rigid_pull_off
from hardcontact.surfaces.topography import mirror_stitch

LOAD = {"preload": 10e-6, "hardness": 25e9}
RHOS = [0.2, 1.0, 5.6, 40.0]


@pytest.mark.parametrize("rms", [0.5, 4.0, 40.0])
def test_map_is_the_single_contacts_at_common_positions(rms):
    heights = periodic_noise(192, rms, 1).astype("float32")
    pair = over(heights, None, 8.0, 600, 5)
    single = pull_off_of_pair(pair, LOAD, RHOS)["pull_off_force"].values[0]
    places = pair.geometry.positions
    forces = rigid_pull_off(at_every_pixel(pair, 192), RHOS)
    assert forces.shape == (4, 192, 192)
    np.testing.assert_allclose(forces[:, places[:, None], places], single, rtol=1e-12)
    np.testing.assert_allclose(rigid_pull_off(pair, RHOS), single, rtol=1e-12)


@pytest.mark.parametrize("window", [60, 128, 320])
def test_map_is_the_direct_sum_at_any_pixel(window):
    pair = at_every_pixel(over(periodic_noise(128, 12.0, 2), None, 8.0, window, 1), 128)
    forces = rigid_pull_off(pair, [2.0])
    for place in ((0, 0), (127, 3), (64, 64), (31, 100)):
        total = direct_total(gap_map(pair, place), 1, 2.0)
        expected = 1.0 / 2e-9 * 64e-18 * total
        assert forces[0][place] == pytest.approx(expected, rel=1e-12)


def test_a_plane_has_the_force_of_a_smooth_sphere_everywhere():
    pair = at_every_pixel(over(np.zeros((96, 96)), None, 40.0, 384, 1), 96)
    np.testing.assert_allclose(rigid_pull_off(pair, [5.6]), 2 * np.pi * 250e-6, rtol=1e-6)


def test_half_a_period_of_a_stitched_scan_holds_all_of_it():
    stitched = mirror_stitch(height_map(periodic_noise(64, 8.0, 4), 16.0))
    pair = over(stitched.heights, None, 16.0, 640, 1)
    whole = rigid_pull_off(at_every_pixel(pair, 128), [5.6])[0]
    np.testing.assert_array_equal(
        rigid_pull_off(at_every_pixel(pair, 64), [5.6])[0].shape, (64,) * 2
    )
    np.testing.assert_allclose(rigid_pull_off(at_every_pixel(pair, 64), [5.6])[0], whole[:64, :64])
    np.testing.assert_allclose(whole, whole[::-1, ::-1], rtol=1e-6)  # but for the window's edge


def test_what_cannot_be_mapped_is_refused():
    with pytest.raises(ValueError, match="smooth sphere"):
        rigid_pull_off(over(np.zeros((32, 32)), np.zeros((16, 16)), 8.0, 64, 2), [1.0])
    deep = np.zeros((64, 64))
    deep[5, 5] = 10.0
    narrow = over(deep, None, 8.0, 8, 2)
    with pytest.raises(ValueError, match=r"found rho = 0.01 nm, too small"):
        rigid_pull_off(replace(narrow), [0.01])
