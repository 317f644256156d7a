"""Forces on wider pixels: blocks with their mean height hide summits."""

from dataclasses import replace

import numpy as np
import pytest
from measurements import PIXEL, UNCD

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.own.wide_pixels import forces_by_pixel_width, widen_pixels
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.synthesis import random_surface

CONTACT = Contact(
    radius=5e3, rho=5.6, hardness=25e9, preload=1e-6, window=600.0, contacts_per_row=6
)
SCAN = random_surface(generator(5), 128, PIXEL, UNCD)


def test_wide_pixels_have_the_mean_heights_of_their_blocks():
    heights = np.arange(100.0).reshape(10, 10)
    wide = widen_pixels(replace(SCAN, heights=heights)).heights
    for block in (np.s_[:4, :4], np.s_[4:8, 8:], np.s_[8:, 8:]):
        np.testing.assert_allclose(wide[block], heights[block].mean())


def test_wide_pixels_hide_summits():
    """On a smooth map they change nothing; the sphere's pixels count, too."""
    flat = replace(SCAN, heights=SCAN.heights * 0)
    rough = mirror_scan(SCAN)
    ratios = [
        float(forces["wide_pixel_force"].mean() / forces["scan_force"].mean())
        for forces in (
            forces_by_pixel_width(mirror_scan(flat), None, CONTACT),
            forces_by_pixel_width(rough, None, CONTACT),
            forces_by_pixel_width(mirror_scan(flat), rough, CONTACT),
        )
    ]
    assert ratios[0] == pytest.approx(1) and min(ratios[1:]) > 1.02
