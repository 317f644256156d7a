"""Indents and force-carrying asperities against ones made by hand."""

import numpy as np
import pytest

from hardcontact import patches


def test_indents_made_by_hand():
    # A row of three pixels with one more at a corner, and a lone pixel: 0 is the deepest.
    offsets = np.array([[10, 10], [10, 11], [40, 40], [10, 12], [11, 13]])
    gaps = np.array([-3.0, -2.5, -2.0, -1.5, -1.0])
    found = patches.indents(gaps, offsets, 5.0)
    assert found.depth == 2.0
    assert found.count == 2
    assert found.edge_length == pytest.approx(2 * 5.0)  # four pixels
    assert found.lateral_size == 4 * 5.0
    depth = patches.flattening(gaps, offsets, 3)
    assert depth.shape == (7, 7)
    assert depth[3, 3:6].tolist() == [2.0, 1.5, 0.5]
    assert depth.sum() == 4.0  # the lone pixel lies outside, the last one is not flattened


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_paraboloid_carries_its_force_in_one_patch_of_known_extent(share):
    # exp(-r²/2R rho) holds a share 1 - exp(-r²/2R rho) of the force within r.
    pixel_size, radius, rho = 20.0, 250e3, 2.0
    offset = (np.arange(600) - 300) * pixel_size
    attraction = np.exp(-(offset[:, None] ** 2 + offset**2) / (2 * radius * rho))
    found = patches.asperities(attraction, share, pixel_size)
    within = 2 * np.sqrt(-2 * radius * rho * np.log(1 - share))
    assert found.extent == pytest.approx(within, abs=2 * pixel_size)
    assert found.patches == 1
    assert found.largest_share == found.two_largest_share == pytest.approx(share, abs=0.01)


def test_two_peaks_share_the_force():
    attraction = np.full((200, 200), 1e-9)
    attraction[50:52, 50:52] = 3.0
    attraction[50, 150] = 2.0
    attraction[120, 20] = 1.0
    found = patches.asperities(attraction, 0.9, 4.0)
    assert found.patches == 2
    assert found.largest_share == pytest.approx(12 / 15, rel=1e-3)
    assert found.two_largest_share == pytest.approx(14 / 15, rel=1e-3)
    assert patches.asperities(attraction, 0.99, 4.0).patches == 3


def test_a_flat_is_one_patch_of_all_it_needs():
    found = patches.asperities(np.ones((101, 101)), 0.7, 1.0)
    assert found.patches == 1
    # A circle of 0.7 of the area of the square, which holds it whole.
    assert found.extent == pytest.approx(2 * 101 * np.sqrt(0.7 / np.pi), rel=0.03)
