"""Periodic maps and bodies to bring into contact."""

from dataclasses import replace

import numpy as np

from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, ContactGeometry, contact_positions
from hardcontact.surfaces.height_map import HeightMap

RADIUS = 250e3  # nm
#: Lengths in nm, preload in N, hardness in Pa, work in J/m².
CONTACT = Contact(
    radius=RADIUS,
    preload=10e-6,
    hardness=25e9,
    window=4000.0,
    contacts_per_row=3,
    rho=5.6,
    work=46.3e-3,
)
CONTACTS_BY_LOADING = [CONTACT, replace(CONTACT, preload=40e-6)]
#: Pixels, pixel size (nm), rms height (nm), pixels of the sphere's roughness and pixels of the
#: window. Cells of `bearing_area` divide maps and windows, or not.
MAP_CASES = [
    (128, 40.0, 20.0, 128, 320),
    (100, 50.0, 3.0, 100, 250),
    (96, 50.0, 60.0, 70, 200),
    (256, 20.0, 10.0, 256, 200),
]


def periodic_noise(pixels, rms, seed):
    """Return noise (pixels, pixels) of an rms height (nm), smooth below a third of its period."""
    rng = np.random.default_rng(seed)
    noise = np.fft.rfft2(rng.standard_normal((pixels, pixels)))
    order = np.hypot(np.fft.fftfreq(pixels)[:, None], np.fft.rfftfreq(pixels)) * pixels
    heights = np.fft.irfft2(noise / (1 + (order / 3) ** 2), s=(pixels, pixels))
    return heights / heights.std() * rms


def periodic_map(heights, pixel_size):
    """Return a periodic substitute from heights (nm)."""
    return HeightMap(heights, pixel_size, True, "substitute")


def make_bodies(heights, roughness, pixel_size, window, contacts):
    """Return a substrate (n, n) under a sphere of roughness (m, m), or a smooth one (None)."""
    positions = contact_positions(len(heights), contacts)
    return Bodies(
        periodic_map(heights, pixel_size),
        None if roughness is None else periodic_map(roughness, pixel_size),
        ContactGeometry(RADIUS, pixel_size, window, positions),
    )
