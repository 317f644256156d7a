"""Random surfaces from a PSD, substitute scans, and the multi-scale masters of Fig. 6.

Surfaces are periodic, square arrays (y, x) in nm; scans are cut out of them and are not periodic.
"""

import hashlib

import numpy as np
from scipy import fft
from scipy.stats import pearson3

from hardcontact import spectrum
from hardcontact.fourier import ROWS, interpolate, lowpass
from hardcontact.topography import level

__all__ = [
    "generator",
    "large_scale_master",
    "random_surface",
    "scan_to_scan_spread",
    "skewed",
    "small_scale_master",
    "sphere_scan",
    "substitute_scan",
]


def generator(seed, *names):
    """Random generator for one purpose, e.g. ``generator(seed, "uncd", 3, "scan")``.

    It depends on the seed and the names alone, never on the order of execution.
    """
    text = "/".join(str(name) for name in names).encode()
    words = np.frombuffer(hashlib.sha256(text).digest(), dtype="<u4")
    return np.random.default_rng([seed, *words.tolist()])


def random_surface(rng, pixels, pixel_size, density):
    """Gaussian random surface (pixels, pixels) in nm, float32, with C_iso = density(q).

    White noise of unit variance has C_iso = pixel area; its transform is scaled by the root of
    the ratio. The mean is zero. density: function of wavevector (rad/nm) to nm⁴.
    """
    transform = fft.rfft2(rng.standard_normal((pixels, pixels), dtype=np.float32))
    wave_y = 2 * np.pi * np.fft.fftfreq(pixels, pixel_size)
    wave_x = 2 * np.pi * np.fft.rfftfreq(pixels, pixel_size)
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        wavevector = np.hypot(wave_y[rows, None], wave_x)
        transform[rows] *= np.sqrt(density(wavevector)) / pixel_size
    transform[0, 0] = 0
    return fft.irfft2(transform, s=(pixels, pixels), overwrite_x=True)


def skewed(surface, skewness, iterations=20):
    """The surface with a Pearson III height distribution of that skewness and its own spectrum.

    Heights are remapped by rank and the Fourier amplitudes restored, in turn, until both hold
    (amplitude-adjusted surrogate; Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635). The
    last step restores the amplitudes, so the spectrum is exact and the distribution nearly so.
    """
    amplitude = np.abs(fft.rfft2(surface.astype(float)))
    probability = np.linspace(0, 1, 4097)[1:-1]
    rank = (np.arange(surface.size) + 0.5) / surface.size
    quantiles = np.interp(rank, probability, pearson3.ppf(probability, skewness)) * surface.std()
    heights = surface.astype(float)
    for _ in range(iterations):
        remapped = np.empty(surface.size)
        remapped[np.argsort(heights, axis=None)] = quantiles
        transform = fft.rfft2(remapped.reshape(surface.shape))
        size = np.abs(transform)
        transform *= np.divide(amplitude, size, out=np.zeros_like(size), where=size > 0)
        heights = fft.irfft2(transform, s=surface.shape)
    return heights


def _levelled_windows(surface, pixel_size, pixels):
    """All windows of a surface that do not overlap, each levelled."""
    count = surface.shape[0] // pixels
    return [
        level(surface[i * pixels : (i + 1) * pixels, j * pixels : (j + 1) * pixels], pixel_size)
        for i in range(count)
        for j in range(count)
    ]


def scan_to_scan_spread(
    rng, pixels, pixel_size, window_pixels, density, relative_uncertainty, realizations=4
):
    """Log-normal shape of the amplitude factor that widens the spread of scans to a published one.

    Windows of one random surface already differ; the factor adds what is missing to the published
    relative uncertainty of the rms height. Zero if they differ enough.
    """
    heights = [
        window.std()
        for _ in range(realizations)
        for window in _levelled_windows(
            random_surface(rng, pixels, pixel_size, density), pixel_size, window_pixels
        )
    ]
    missing = np.log1p(relative_uncertainty**2) - np.log(heights).var(ddof=1)
    return float(np.sqrt(max(missing, 0.0)))


def substitute_scan(rng, pixels, pixel_size, realization_pixels, density, skewness, spread):
    """Heights (pixels, pixels) in nm of a scan cut out of a larger random surface.

    spread: log-normal shape of the amplitude factor, whose mean is one.
    """
    surface = random_surface(rng, realization_pixels, pixel_size, density)
    if skewness:
        surface = skewed(surface, skewness)
    factor = np.exp(spread * rng.standard_normal() - spread**2 / 2)
    return factor * surface[:pixels, :pixels]


def sphere_scan(rng, roughness, pixel_size, radius):
    """What the microscope sees of the top of a sphere (radius in nm): shape and roughness.

    The apex lies somewhere within the middle half of the scan.
    """
    size = roughness.shape[0] * pixel_size
    apex = rng.uniform(-0.25, 0.25, 2) * size
    y, x = ((np.arange(roughness.shape[0]) + 0.5) * pixel_size - size / 2 - shift for shift in apex)
    return roughness - (y[:, None] ** 2 + x**2) / (2 * radius)


def small_scale_master(rng, stitched, pixel_size, pixels, transition, table):
    """The scan with artificial roughness below the `transition` wavelength (nm).

    The mirror-stitched scan is freed of wavelengths below the transition and interpolated on
    (pixels, pixels); a random surface is added that follows C_iso below the transition and is
    constant above it. table: (wavevector, C_iso). Returns heights (float32) and pixel size.
    Source: the paper, section Determining the Most Relevant Length-scales of Roughness.
    """
    band, _ = lowpass(stitched, pixel_size, transition)
    fine = stitched.shape[0] * pixel_size / pixels
    limit = 2 * np.pi / transition
    heights = random_surface(rng, pixels, fine, lambda q: spectrum.at(np.maximum(q, limit), *table))
    heights += interpolate(band, pixels)
    return heights, fine


def large_scale_master(rng, stitched, pixel_size, tiles, transition, table):
    """The scan, repeated, with artificial roughness above the `transition` wavelength (nm).

    The mirror-stitched scan is laid `tiles` times along each edge and freed of wavelengths above
    the transition; a random surface is added that follows C_iso there and is zero below. The
    result holds nothing finer than the scan's pixels and is kept on them. table: (wavevector,
    C_iso). Returns heights (float32) and pixel size. Source: as `small_scale_master`.
    """
    repeated = np.tile(stitched, (tiles, tiles))
    band, coarse = lowpass(repeated, pixel_size, transition)
    limit = 2 * np.pi / transition * (1 + 1e-12)
    added = random_surface(
        rng, band.shape[0], coarse, lambda q: np.where(q <= limit, spectrum.at(q, *table), 0.0)
    )
    return (repeated + interpolate(added - band, repeated.shape[0])).astype(np.float32), pixel_size
