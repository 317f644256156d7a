"""The published spectrum of UNCD, and random scans that have it."""

from hardcontact.surfaces.height_map import level
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, smooth_rolloff
from hardcontact.surfaces.synthesis import cut_scan, random_surface

PIXEL = 2500 / 512  # nm, of the paper's scans


def uncd(q):
    """C_iso in nm4 at wavevectors in rad/nm."""
    return smooth_rolloff(q, 6.1e7, 930.0, 0.84)


def gentle(q):
    """C_iso in nm4 of a surface whose slopes are small."""
    return 0.05 * uncd(q)


UNCD = Spectrum(WAVEVECTORS, uncd(WAVEVECTORS))


def levelled_scan(rng, pixels, pixel_size=PIXEL):
    """A scan of UNCD's spectrum, cut out of a surface of twice its size."""
    return level(cut_scan(random_surface(rng, 2 * pixels, pixel_size, uncd), pixels))
