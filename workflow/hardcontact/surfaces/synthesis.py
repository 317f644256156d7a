"""Random surfaces from a spectrum, substitute scans cut out of them, and masters (Fig. 6).

A master is a mirrored scan with artificial roughness: random waves in place of those beyond a
wavelength, the transition. Random surfaces and masters are periodic, scans are not.

A random surface begins as white noise, an independent height at each pixel. Its Fourier transform
is multiplied by the square root of the spectrum, and transformed back. So one array of noise gives
similar surfaces for similar spectra.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import scipy

from hardcontact.base.arrays import SEED_WORDS, Floats, generator
from hardcontact.surfaces.filters import BLOCK_ROWS, Transform, interpolate, lowpass
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import SpectrumFunction


class ScanGrid(NamedTuple):
    """The pixels and size of substitute scans."""

    pixels: int  #: Pixels per row of a scan.
    size: float  #: Width of a scan in nm.
    surface_pixels: int  #: Pixels per row of the surface around a scan.

    @property
    def pixel_size(self) -> float:
        """Width of a pixel in nm."""
        return self.size / self.pixels


def white_noise_transform(rng: np.random.Generator, pixels: int) -> Transform:
    """Return the transform (pixels, pixels/2 + 1) of white noise of unit variance."""
    return np.asarray(scipy.fft.rfft2(rng.standard_normal((pixels, pixels), dtype=np.float32)))


def _set_psd(transform: Transform, pixel_size: float, spectrum: SpectrumFunction) -> None:
    """Multiply the transform of white noise, in place, to that of a surface with a spectrum.

    The surface has the mean height zero.
    """
    pixels = len(transform)
    row_count = pixels // 2 + 1  # Other rows have the opposite wavevector along y.
    q = 2 * np.pi * np.fft.rfftfreq(pixels, pixel_size)
    for start in range(0, row_count, BLOCK_ROWS):
        rows = np.arange(start, min(start + BLOCK_ROWS, row_count))
        # White noise of unit variance has C_iso = pixel area.
        amplitudes = np.sqrt(spectrum(np.hypot(q[rows, None], q))) / pixel_size
        transform[rows] *= amplitudes
        is_paired = (rows > 0) & (2 * rows < pixels)
        transform[pixels - rows[is_paired]] *= amplitudes[is_paired]
    transform[0, 0] = 0


def random_surface(
    rng: np.random.Generator, pixels: int, pixel_size: float, spectrum: SpectrumFunction
) -> HeightMap:
    """Return a periodic Gaussian random surface with a spectrum, of mean zero, in float32."""
    transform = white_noise_transform(rng, pixels)
    _set_psd(transform, pixel_size, spectrum)
    heights = scipy.fft.irfft2(transform, s=(pixels, pixels), overwrite_x=True)
    return HeightMap(heights, pixel_size, periodic=True, source="substitute")


def sample_scan(
    rng: np.random.Generator, spectrum: SpectrumFunction, grid: ScanGrid, factor: float = 1.0
) -> HeightMap:
    """Sample a scan with a spectrum, its heights times a factor."""
    return scan_of_noise(white_noise_transform(rng, grid.surface_pixels), spectrum, grid, factor)


def scan_of_noise(
    transform: Transform, spectrum: SpectrumFunction, grid: ScanGrid, factor: float = 1.0
) -> HeightMap:
    """Return the corner of the random surface from a transform of white noise, as a scan."""
    scaled = transform.copy()
    _set_psd(scaled, grid.pixel_size, spectrum)
    # Only rows of the corner are transformed along x, to save time.
    rows = scipy.fft.ifft(scaled, axis=0, overwrite_x=True)[: grid.pixels]
    heights = scipy.fft.irfft(rows, len(transform), axis=1)[:, : grid.pixels]
    return HeightMap(factor * heights.astype(float), grid.pixel_size, source="substitute")


def add_sphere_shape(rng: np.random.Generator, roughness: HeightMap, radius: float) -> HeightMap:
    """Return a scan of a rough sphere (radius in nm), its apex in the middle half of x and y."""
    apex = rng.uniform(-0.25, 0.25, 2) * roughness.size
    position = (np.arange(roughness.pixels) + 0.5) * roughness.pixel_size - roughness.size / 2
    y, x = position - apex[0], position - apex[1]
    return replace(roughness, heights=roughness.heights - (y[:, None] ** 2 + x**2) / (2 * radius))


def master_scan_index(realization: int, scan_count: int) -> int:
    """Return the index of the scan of a master: realizations from 1 take scans from 0 in turn.

    With three scans, realizations 1 to 4 take the scans 0, 1, 2 and 0.
    """
    return (realization - 1) % scan_count


def short_edge_master(
    rng: np.random.Generator,
    mirrored: HeightMap,
    pixels: int,
    transition: float,
    spectrum: SpectrumFunction,
) -> HeightMap:
    """Return a mirrored scan with artificial roughness below the transition (nm).

    The scan keeps its waves longer than the transition. The artificial roughness is not cut off
    there: at longer waves its C_iso is constant. This adds some long waves, as in the paper,
    section Determining the Most Relevant Length-scales of Roughness.
    """
    long_waves = lowpass(mirrored, transition)
    transition_q = 2 * np.pi / transition
    master = random_surface(
        rng, pixels, mirrored.size / pixels, lambda q: spectrum(np.maximum(q, transition_q))
    )
    master.heights[...] += interpolate(long_waves, pixels).heights
    return replace(master, source=mirrored.source)


def long_edge_master(
    rng: np.random.Generator,
    mirrored: HeightMap,
    tiles: int,
    transition: float,
    spectrum: SpectrumFunction,
) -> HeightMap:
    """Return (tiles, tiles) mirrored scans with artificial roughness above the transition (nm).

    Waves shorter than the transition are those of the scans, all others are artificial.
    """
    repeated = replace(mirrored, heights=np.tile(mirrored.heights, (tiles, tiles)))
    long_waves = lowpass(repeated, transition)
    # The margin keeps waves exactly at the transition artificial in spite of rounding.
    transition_q = 2 * np.pi / transition * (1 + 1e-12)

    def long_wave_spectrum(wavevector: Floats) -> Floats:
        return np.where(wavevector <= transition_q, spectrum(wavevector), 0.0)

    artificial = random_surface(rng, long_waves.pixels, long_waves.pixel_size, long_wave_spectrum)
    change = replace(long_waves, heights=artificial.heights - long_waves.heights)
    heights = repeated.heights + interpolate(change, repeated.pixels).heights
    return replace(repeated, heights=heights.astype(np.float32))


#: Sides of the band, at its short and at its long edge.
SIDES = ("short", "long")
#: Streams of random numbers, for masters of the study and of sets: two masters of the same scan and
#: side have different random waves if their streams differ.
STUDY_STREAM = SEED_WORDS["masters of the study"]
SETS_STREAM = SEED_WORDS["masters of the sets"]


def master_generator(
    seed: int, surface: str, realization: int, side: str, stream: str
) -> np.random.Generator:
    """Return the random generator of a master; `stream` is STUDY_STREAM or SETS_STREAM."""
    return generator(seed, surface, realization, f"{SEED_WORDS[side]}-scale {stream}")


def synthesize_master(
    side: str,
    rng: np.random.Generator,
    mirrored: HeightMap,
    settings: Mapping[str, Any],
    spectrum: SpectrumFunction,
) -> HeightMap:
    """Return the master of a side from a mirrored scan and the settings of the side."""
    transition = settings["transition"]
    if side == "short":
        return short_edge_master(rng, mirrored, settings["pixels"], transition, spectrum)
    return long_edge_master(rng, mirrored, settings["tiles"], transition, spectrum)
