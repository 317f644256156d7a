"""The force sum against the direct sum over every pixel."""

from itertools import product

import numpy as np
import pytest
from direct_sum import direct_total, gap_of_bodies
from periodic_maps import MAP_CASES, make_bodies, periodic_noise

from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.force_sum.outside_sums import MAX_PENETRATION, outside_sums
from hardcontact.contact.numerical_limits import DEPTH_OVER_RANGE
from hardcontact.contact.pull_off import attraction_sums

#: Relative error of sums by subtraction over heights in single precision.
SINGLE_PRECISION_ERROR = 1e-6


def bodies_of(case, rough):
    pixels, pixel_size, rms, period, window = case
    roughness = periodic_noise(period, 0.7, 4) if rough else None
    return make_bodies(periodic_noise(pixels, rms, 3), roughness, pixel_size, window, 3)


@pytest.mark.parametrize("case", MAP_CASES)
@pytest.mark.parametrize("contact_pixel_count", [1, 17])
@pytest.mark.parametrize("rough", [False, True])
def test_the_sum_at_every_range_is_the_direct_sum(case, contact_pixel_count, rough):
    bodies, ranges = bodies_of(case, rough), [0.5, 2.0, 10.0]
    contact_pixels = all_contact_pixels(bodies, contact_pixel_count)
    counts = [contact_pixel_count, 1]
    totals = attraction_sums(bodies, contact_pixels, counts, ranges)
    for index in np.ndindex(contact_pixels.reference_gaps.shape[:2]):
        gap = gap_of_bodies(bodies, index)
        sums = totals[..., *index].flat
        for (count, rho), total in zip(product(counts, ranges), sums, strict=True):
            assert total == pytest.approx(direct_total(gap, count, rho), rel=1e-9)


@pytest.mark.parametrize("case", MAP_CASES)
@pytest.mark.parametrize("rough", [False, True])
def test_the_sum_keeps_its_digits_if_little_attracts_outside_contact(case, rough):
    # At a small range the other pixels attract many orders less than the contact pixels.
    bodies, rho = bodies_of(case, rough), 0.1
    contact_pixels = all_contact_pixels(bodies, 17)
    (sums,) = outside_sums(bodies, contact_pixels, [rho])
    for index in np.ndindex(sums.shape):
        ordered = np.sort(gap_of_bodies(bodies, index), axis=None)
        direct_sum = np.exp((ordered[16] - ordered[17:]) / rho).sum()
        assert sums[index] == pytest.approx(direct_sum, rel=1e-9)


@pytest.mark.parametrize(
    ("depth_share", "penetration_share"), [(0.99, 0.5), (0.5, 0.99), (0.99, 0.99)]
)
@pytest.mark.parametrize(("dtype", "error"), [(np.float32, SINGLE_PRECISION_ERROR), (float, 1e-9)])
def test_subtracted_contact_pixels_leave_enough_digits_up_to_both_limits(
    dtype, error, depth_share, penetration_share
):
    # A spike outside the window of the contact, and one in it that sinks in.
    rho, pixel_size = 2.0, 50.0
    precision = np.dtype(dtype).type
    max_depth, max_penetration = DEPTH_OVER_RANGE[precision], MAX_PENETRATION[precision]
    heights = periodic_noise(96, 0.1, 5).astype(dtype)
    heights[60, 60] = heights.max() + dtype(depth_share * max_depth * rho)
    heights[12, 12] = heights[8:16, 8:16].max() + dtype(penetration_share * max_penetration * rho)
    bodies = make_bodies(heights, None, pixel_size, 40, 1)
    (position,) = bodies.geometry.contact_positions
    heights[:] = np.roll(heights, position - 12, axis=(0, 1))
    contact_pixels = all_contact_pixels(bodies, 4)
    gaps = contact_pixels.reference_gaps[0, 0]
    assert gaps[-1] - gaps[0] > 0.9 * penetration_share * max_penetration * rho
    assert gaps[-1] + heights.max() > 0.9 * depth_share * max_depth * rho
    total = attraction_sums(bodies, contact_pixels, [4], [rho]).item()
    assert total == pytest.approx(direct_total(gap_of_bodies(bodies, (0, 0)), 4, rho), rel=error)
