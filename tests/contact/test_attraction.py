"""The attraction over one contact, and the asperities that carry it."""

import numpy as np
import pytest
from periodic_maps import CONTACT, RADIUS, make_bodies, periodic_noise

from hardcontact.contact.attraction import (
    asperity_sizes,
    find_carrying_asperities,
    least_carrying_attraction,
    trace_contact,
)
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import pull_off_dataset


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_paraboloid_carries_its_force_in_one_asperity_of_known_extent(share):
    # exp(-r²/2R rho) holds a share 1 - exp(-r²/2R rho) of the force within r.
    pixel_size, radius, rho = 20.0, 250e3, 2.0
    offset = (np.arange(600) - 300) * pixel_size
    attraction = np.exp(-(offset[:, None] ** 2 + offset**2) / (2 * radius * rho))
    largest, two_largest, count, extent = asperity_sizes(attraction, share, pixel_size)
    diameter = 2 * np.sqrt(-2 * radius * rho * np.log(1 - share))
    assert extent == pytest.approx(diameter, abs=2 * pixel_size)
    assert count == 1
    assert largest == two_largest == pytest.approx(share, abs=1e-3)


def test_peaks_share_the_force():
    attraction = np.full((200, 200), 1e-9)
    attraction[50:52, 50:52] = 3.0
    attraction[50, 150] = 2.0
    attraction[120, 20] = 1.0  # The peaks carry 12, 2 and 1 of 15.
    largest, two_largest, count, _ = asperity_sizes(attraction, 0.9, 4.0)
    assert count == 2
    assert largest == pytest.approx(12 / 15, rel=1e-3)
    assert two_largest == pytest.approx(14 / 15, rel=1e-3)
    _, _, count, _ = asperity_sizes(attraction, 0.99, 4.0)
    assert count == 3


def test_the_strongest_pixels_carry_the_share_only_with_the_weakest_carrier():
    rng = np.random.default_rng(5)
    for attraction in (rng.random((90, 70)), np.exp(-40 * rng.random((50, 60))), np.ones((9, 9))):
        # carried[k] is the force that the k + 1 strongest pixels carry together.
        carried = np.cumsum(np.sort(attraction, axis=None)[::-1])
        for share in (0.1, 0.5, 0.9):
            weakest = least_carrying_attraction(attraction, share)
            count = (attraction > weakest).sum()
            # In the map of ones all pixels are equal, and none is above the weakest carrier.
            assert carried[count] >= share * carried[-1] * (1 - 1e-12) or weakest == 1
            assert count == 0 or carried[count - 1] < share * carried[-1]


def test_a_single_peak_carries_the_force_of_every_contact():
    heights = np.zeros((200, 200))
    heights[105, 94] = 60.0
    contact = Contact(radius=RADIUS, preload=1e-6, hardness=25e9)
    indices = np.array([(0, 0), (0, 1), (1, 0), (1, 1)])
    bodies = make_bodies(heights, None, 20.0, 200, 2)
    carriers = find_carrying_asperities(bodies, contact, indices, [1.0])
    assert (carriers["asperity_count"] == 1).all()
    assert carriers["largest_share"].values == pytest.approx(np.ones((4, 1)), abs=1e-3)
    assert carriers["contact_y"].values.tolist() == [0, 0, 1, 1]


def test_a_traced_contact_has_the_force_of_its_bodies():
    bodies = make_bodies(periodic_noise(128, 20.0, 1), periodic_noise(128, 0.5, 2), 8.0, 320, 3)
    traced = trace_contact(bodies, (1, 2), CONTACT)
    dataset = pull_off_dataset(bodies, CONTACT, [5.6])
    plastic = dataset["pull_off_force"].sel(contact_model="plastic")
    force = CONTACT.work * plastic.isel(rho=0, contact_y=1, contact_x=2).item()
    assert traced.attrs["pull_off_force"] == pytest.approx(force, rel=1e-9)
    gap, pressure = (traced[name].values for name in ("gap", "adhesive_pressure"))
    assert gap.shape == pressure.shape == (320, 320)
    # Preload over hardness is 400 nm², 6.25 pixels of 8 nm.
    assert np.count_nonzero(gap <= 0) == 7
    # Touching pixels have the largest pressure, W/rho. Pressures add up to the force.
    assert pressure.max() == pytest.approx(CONTACT.work / 5.6e-9)
    assert pressure.sum(dtype=float) * 8e-9**2 == pytest.approx(force, rel=1e-5)
    assert traced["force"].values[0] == -traced.attrs["pull_off_force"]
