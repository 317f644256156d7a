"""Forces on mirrored scans, against those on the large surfaces from which scans are cut."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from measurements import cut_scan

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.numerical_limits import (
    FINITE_SCAN_RATIOS,
    LARGE_SIZE_RATIO,
    finite_scan_ratio,
)
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, spectral_moment
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.summits import search_size, spectrum_between

RADIUS, PIXEL = 250e3, 10e3 / 256
DENSITY = partial(smooth_rolloff, plateau=1.0, rolloff=930.0, hurst=0.84)


def mean_force(surface):
    contact = Contact(radius=RADIUS, preload=10e-6, hardness=25e9, window=10e3, contacts_per_row=4)
    bodies = join_bodies(surface, None, contact)
    forces = pull_off_dataset(bodies, contact, [5.6])["pull_off_force"]
    return forces.sel(contact_model="plastic").values.mean()


def scan_over_surface_force(rms_height, pixels):
    """Return the mean force on scans relative to the surfaces of 10 µm from which they are cut."""
    surface_forces, scan_forces = [], []
    for trial in range(20):
        surface = random_surface(generator(5, trial), 256, PIXEL, DENSITY)
        factor = rms_height / surface.heights.std()
        surface = replace(surface, heights=factor * surface.heights)
        surface_forces.append(mean_force(surface))
        scan_forces.append(mean_force(mirror_scan(level_plane(cut_scan(surface, pixels)))))
    return np.mean(scan_forces) / np.mean(surface_forces)


@pytest.mark.parametrize("rms_height, pixels", [(17.0, 32), (17.0, 64), (2.0, 64), (0.3, 64)])
def test_forces_on_scans_exceed_those_on_large_surfaces_as_measured(rms_height, pixels):
    spectrum = Spectrum(WAVEVECTORS, DENSITY(WAVEVECTORS))
    sampled_spectrum = spectrum_between(spectrum, 2 * np.pi / 10e3, np.pi / PIXEL)
    density = sampled_spectrum.density * rms_height**2 / spectral_moment(sampled_spectrum, 0)
    scaled = Spectrum(sampled_spectrum.wavevector, density)
    # 400 nm² of 25 GPa carry 10 µN.
    minimum, maximum = finite_scan_ratio(pixels * PIXEL, search_size(scaled, RADIUS, 400.0))
    # Forces on the twenty scans scatter by a factor of two about their mean.
    assert 0.75 * minimum < scan_over_surface_force(rms_height, pixels) < 1.25 * maximum


def test_a_large_scan_is_large_enough():
    assert finite_scan_ratio(LARGE_SIZE_RATIO * 3e3, 3e3) == finite_scan_ratio(100.0, 0) == (1, 1)
    assert finite_scan_ratio(0.9 * LARGE_SIZE_RATIO * 3e3, 3e3) == FINITE_SCAN_RATIOS[-1][1]
