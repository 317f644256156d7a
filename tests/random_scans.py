"""The published spectrum of UNCD, and random scans that have it."""

import numpy as np

from hardcontact.numbers.random import generator
from hardcontact.surfaces.height_map import level
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, measured_psds, smooth_rolloff
from hardcontact.surfaces.substitute_scans import substitute_scan
from hardcontact.surfaces.synthesis import random_surface

PIXEL = 2500 / 512  # nm, of the paper's scans


def uncd(q):
    """C_iso in nm4 at wavevectors in rad/nm."""
    return smooth_rolloff(q, 6.1e7, 930.0, 0.84)


UNCD = Spectrum(WAVEVECTORS, uncd(WAVEVECTORS))


def levelled_scan(rng, pixels, pixel_size=PIXEL):
    """A scan of UNCD's spectrum, cut out of a surface of twice its size."""
    return level(substitute_scan(random_surface(rng, 2 * pixels, pixel_size, uncd), pixels))


def measured_spectra(count, seed):
    """Wavevectors (bins,) and C_iso (scan, bins) of scans of UNCD's spectrum."""
    measured = [measured_psds(levelled_scan(generator(seed, k), 256)) for k in range(count)]
    return measured[0][0], np.array([isotropic for _, _, isotropic in measured])
