"""Expected moments are those of scans that are cut out and levelled."""

import numpy as np
from random_scans import PIXEL, uncd

from hardcontact.numbers.random import generator
from hardcontact.surfaces import substitute_spectra as scan_moments
from hardcontact.surfaces.height_map import level, metrics
from hardcontact.surfaces.substitute_scans import substitute_scan
from hardcontact.surfaces.synthesis import random_surface

MOMENTS = ("rms_height", "rms_gradient", "rms_half_laplacian")


def test_expected_moments_are_those_of_scans():
    weights = scan_moments.transfer_weights(1024, PIXEL, 256)
    expected = scan_moments.expected_moments(uncd, weights)
    squares = []
    for k in range(6):
        surface = random_surface(generator(4, k), 1024, PIXEL, uncd)
        for start in range(0, 1024, 256):
            strip = type(surface)(surface.heights[start:], PIXEL, True, "substitute")
            values = metrics(level(substitute_scan(strip, 256)))
            squares.append([values[name] ** 2 for name in MOMENTS])
    error = np.std(squares, axis=0) / np.sqrt(len(squares))
    assert (np.abs(np.mean(squares, axis=0) - expected**2) < 4 * error).all()


def test_weights_do_not_depend_on_how_many_rows_are_added_up_at_a_time(monkeypatch):
    whole = scan_moments.transfer_weights(64, PIXEL, 16)
    monkeypatch.setattr(scan_moments, "ROWS", 7)
    for one, other in zip(whole, scan_moments.transfer_weights(64, PIXEL, 16), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12)
