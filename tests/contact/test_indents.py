"""The indents of one contact that is made by hand."""

import numpy as np
import pytest

from hardcontact.contact.bearing_area import LowestGaps
from hardcontact.contact.indents import indent_sizes, penetration_map


def test_indents_drawn_by_hand_have_known_sizes():
    # A row of three pixels with one more at a corner, and a lone pixel: 0 is the deepest.
    offsets = np.array([[10, 10], [10, 11], [40, 40], [10, 12], [11, 13]])
    contact = LowestGaps(np.array([-3.0, -2.5, -2.0, -1.5, -1.0]), offsets)
    depth, equal_area_side, longer_side, count = indent_sizes(contact, 5.0)
    assert (depth, count) == (2.0, 2)
    assert equal_area_side == pytest.approx(2 * 5.0)  # four pixels
    assert longer_side == 4 * 5.0
    depth = penetration_map(contact, 3)
    assert depth.shape == (7, 7)
    assert depth[3, 3:6].tolist() == [2.0, 1.5, 0.5]
    assert depth.sum() == 4.0  # the lone pixel lies outside, the last one is not flattened
