"""The asperities that carry the force of one contact against ones made by hand."""

import numpy as np
import pytest
from periodic_maps import RADIUS, over

from hardcontact.contact.asperities import asperities, asperities_of_pair
from hardcontact.contact.contact import Contact


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_paraboloid_carries_its_force_in_one_patch_of_known_extent(share):
    # exp(-r²/2R rho) holds a share 1 - exp(-r²/2R rho) of the force within r.
    pixel_size, radius, rho = 20.0, 250e3, 2.0
    offset = (np.arange(600) - 300) * pixel_size
    attraction = np.exp(-(offset[:, None] ** 2 + offset**2) / (2 * radius * rho))
    carriers = asperities(attraction, share, pixel_size)
    within = 2 * np.sqrt(-2 * radius * rho * np.log(1 - share))
    assert carriers.extent == pytest.approx(within, abs=2 * pixel_size)
    assert carriers.patches == 1
    assert carriers.largest_share == carriers.two_largest_share == pytest.approx(share, abs=0.01)


def test_two_peaks_share_the_force():
    attraction = np.full((200, 200), 1e-9)
    attraction[50:52, 50:52] = 3.0
    attraction[50, 150] = 2.0
    attraction[120, 20] = 1.0
    carriers = asperities(attraction, 0.9, 4.0)
    assert carriers.patches == 2
    assert carriers.largest_share == pytest.approx(12 / 15, rel=1e-3)
    assert carriers.two_largest_share == pytest.approx(14 / 15, rel=1e-3)
    assert asperities(attraction, 0.99, 4.0).patches == 3


def test_a_summit_at_a_crease_carries_the_force_there():
    """A single peak on a flat, at a corner of the scan, in the middle of an edge, or within it."""
    contact = Contact(radius=RADIUS, preload=1e-6, hardness=25e9)
    places = np.array([(0, 0), (0, 1), (1, 0), (1, 1)])
    for row, column, expected in ((0, 199, 1.0), (100, 50, 1.0), (104, 50, 1.0), (105, 94, 0.0)):
        heights = np.zeros((200, 200))
        heights[row, column] = 60.0
        pair = over(heights, None, 20.0, 200, 2)
        found = asperities_of_pair(pair, contact, places, 0.9, [1.0])
        assert (found.crease_contact == expected).all()
        assert abs(found.crease_force - expected).max() < 0.01
        away = np.array([25, 125]) - np.array([[row], [column]])  # of apexes from the peak
        away = 20.0 * np.abs((away + 100) % 200 - 100)
        distance = np.hypot(away[0, found.contact_y], away[1, found.contact_x])
        np.testing.assert_allclose(found.contact_distance, distance)
        np.testing.assert_allclose(found.closest_approach, 60 - distance**2 / (2 * RADIUS))
        assert float(found.crease_area) == pytest.approx(1 - 0.9**2)
