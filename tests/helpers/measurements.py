"""Maps and line scans of known surfaces, most with the measured spectrum of UNCD."""

from dataclasses import replace
from functools import cache, partial

import numpy as np

from hardcontact.base.arrays import generator
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.synthesis import random_surface

PIXEL = 2500 / 512  # nm, of the paper's scans


def uncd_density(q):
    """Return C_iso (nm⁴) at q in rad/nm: the first row of resources/spectra/uncd-measured.csv."""
    return 6.1e7 * (1 + (q * 930.0 / (2 * np.pi)) ** 2) ** -1.84


def gentle_density(q):
    """Return C_iso (nm⁴) of a surface whose slopes are small."""
    return 0.05 * uncd_density(q)


UNCD = Spectrum(WAVEVECTORS, uncd_density(WAVEVECTORS))


def cut_scan(surface, pixels):
    """Return the corner (pixels, pixels) of a periodic surface, in double precision."""
    heights = surface.heights[:pixels, :pixels].astype(float)
    return replace(surface, heights=heights, periodic=False)


def levelled_scan(rng, pixels, pixel_size=PIXEL):
    """Return a levelled scan of UNCD's spectrum, cut out of a surface of twice its size."""
    return level_plane(cut_scan(random_surface(rng, 2 * pixels, pixel_size, uncd_density), pixels))


def measurement(heights, pixel_size, tip_radius=None, path="a.spm"):
    """Return a map or a line scan, by the dimensions of its heights (nm)."""
    return HeightMap(heights, pixel_size, path=path, channel="Height", tip_radius=tip_radius)


def random_map(rng, pixels, pixel_size, spectrum=uncd_density, **stated):
    """Return a map, cut out of a random surface of twice its size; the file states `stated`."""
    surface = random_surface(rng, 2 * pixels, pixel_size, spectrum)
    return measurement(cut_scan(surface, pixels).heights, pixel_size, **stated)


def self_affine_heights(rng, pixels, pixel_size, rms_height, hurst=0.8, rolloff=800.0):
    """Return heights (y, x) of a self-affine map with an rms height; all lengths in nm."""
    spectrum = partial(smooth_rolloff, plateau=1e6, rolloff=rolloff, hurst=hurst)
    heights = random_map(rng, pixels, pixel_size, spectrum).heights
    return heights * (rms_height / heights.std())


def random_line(rng, points, spacing, spectrum=uncd_density, **stated):
    """Return a line scan, cut out of a random profile of four times its length.

    The profile is a sum of waves of random amplitudes and phases with the C_1D of the surface.
    """
    count, length = 4 * points, 4 * points * spacing
    density = periodic_profile_density(spectrum, count, spacing)
    amplitudes = rng.normal(size=(2, len(density))) / np.sqrt(2)
    waves = (amplitudes[0] + 1j * amplitudes[1]) * np.sqrt(density * length) / spacing
    coefficients = np.append(0, waves)
    return measurement(np.fft.irfft(coefficients, count)[:points], spacing, **stated)


def two_sizes_and_a_line(seed):
    """Return a map of 10 µm, a map of 1 µm and a line of 40 µm of the same surface."""
    return [
        random_map(generator(seed, 0), 256, 40.0, gentle_density, path="large.spm"),
        random_map(generator(seed, 1), 256, 4.0, gentle_density, path="small.spm"),
        random_line(generator(seed, 2), 2000, 20.0, gentle_density, path="line.txt"),
    ]


@cache
def periodic_profile_density(spectrum, count, spacing):
    """Return C_1D (nm³) at the wavevectors of a periodic profile, without zero."""
    return profile_density(spectrum, 2 * np.pi * np.fft.rfftfreq(count, spacing)[1:])


def profile_density(spectrum, wavevector):
    """Return C_1D (nm³) by numerical integration of (1/pi) ∫ C_iso dq_y."""
    ratio = np.logspace(-5, 4, 1001)
    q_y = wavevector[:, None] * ratio
    values = spectrum(np.hypot(wavevector[:, None], q_y)) * q_y
    return np.trapezoid(values, np.log(ratio), axis=1) / np.pi
