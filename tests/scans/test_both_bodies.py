"""Both bodies give the force of a rough sphere, and the wavelengths of the rougher body."""

import numpy as np
import pytest
from direct_sum import direct_force, gap_to_sphere, mirror
from measurements import random_map

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import forces_at_loadings
from hardcontact.scans.both_bodies import combine_maps, combine_spectra
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.surfaces.height_map import mirror_scan

PIXELS, PIXEL_SIZE = 128, 10.0  # nm
CONTACT = Contact(
    radius=5e3, preload=2e-6, hardness=5e9, window=600.0, contacts_per_row=4, rho=2.0, work=1.0
)


def scan(body, rms_height):
    surface = random_map(generator(5, body), PIXELS, PIXEL_SIZE)
    surface.heights[...] *= rms_height / surface.heights.std()
    return surface


@pytest.fixture(scope="module")
def wafer():
    return scan("wafer", 0.2)


@pytest.fixture(scope="module")
def sphere():
    return scan("sphere", 10.0)


def force_of_rough_sphere(wafer, sphere, contact_pixel, position):
    """Sum Eq. 3 over every pixel of mirrored maps, the sphere at a position of its map."""
    window = round(CONTACT.window / PIXEL_SIZE), PIXEL_SIZE
    gap = gap_to_sphere(mirror(wafer.heights), contact_pixel, *window, CONTACT.radius)
    gap += gap_to_sphere(mirror(sphere.heights), position, *window, np.inf)
    # The preload over the hardness is 400 nm², four pixels.
    return direct_force(gap, 4, CONTACT.rho, PIXEL_SIZE)


def test_a_smooth_sphere_on_the_sum_of_both_touches_like_the_rough_one(wafer, sphere):
    combined = combine_maps(generator(1), mirror_scan(wafer), mirror_scan(sphere))
    start = generator(1).integers(2 * PIXELS, size=2)  # as `combine_maps` samples it
    bodies = join_bodies(combined, None, CONTACT)  # None for a smooth sphere
    forces = forces_at_loadings(bodies, [CONTACT], [CONTACT.rho])[0, 0]
    # The window, 30 pixels to each side of this contact, has no mirror image of the sum.
    contact_pixel = bodies.geometry.contact_positions[[1, 1]]
    assert (30 <= contact_pixel).all() and (contact_pixel < PIXELS - 30).all()
    direct = force_of_rough_sphere(wafer, sphere, contact_pixel, start + contact_pixel)
    assert forces[1, 1] == pytest.approx(direct, rel=1e-4)


def test_only_the_rougher_body_tells_which_waves_were_measured(wafer, sphere):
    spectra = [joined_spectrum([body], [5.0]) for body in (wafer, sphere)]
    combined = combine_spectra(*spectra)
    densities = [spectrum["spectrum"].values for spectrum in spectra]
    np.testing.assert_allclose(combined["spectrum"], np.sum(densities, axis=0))
    is_measured = combined["joined_psd"].notnull()
    assert is_measured.any() and (combined["sphere_share"][is_measured] > 0.99).all()
    assert combined["limited_by"].values.tolist() == ["other_body", spectra[1]["limited_by"].item()]
    assert combined["reliable"].any("bin_wavevector").values.tolist() == [False, True]
    for name in ("shortest_measured", "longest_measured", "rolloff", "tail_hurst"):
        assert combined.attrs[name] == spectra[1].attrs[name]
