"""Hindcasts test whether forces on a scan may be extrapolated to roughness that it does not show.

A hindcast predicts what is known already. It replaces the outermost octave that a scan shows by
artificial roughness: random waves with the spectrum of the surface. If the force changes, random
waves cannot stand for the waves of this surface, so they cannot extrapolate the scan either. On a
Gaussian surface the force changes little.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import SEED_WORDS, Floats, generator
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import as_variables, student_quantile
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import FORCE_ATTRS, ForceFunction
from hardcontact.inference.edges import logarithmic_limits
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap, mirror_scan
from hardcontact.surfaces.spectrum import SpectrumFunction
from hardcontact.surfaces.synthesis import random_surface

#: The shortest and the longest wavelength in nm.
Octave = tuple[float, float]

#: Artificial octaves of a side; each costs a force sum. With six, the outcome depended on the seed
#: on one scan; with twelve, Student's interval is 2.20 sqrt(1 + 1/12)/1.96 = 1.17 times as wide as
#: with many.
ARTIFICIAL_OCTAVE_COUNT = 12


class RandomBody(NamedTuple):
    """What the artificial octaves of a body, substrate or sphere, are made from."""

    spectrum: SpectrumFunction  #: C_iso in nm⁴.
    size: float  #: Width of the scan in nm.
    seed: int  #: Seed of the study.
    random_stream: Sequence[str | int]  #: Name of the surface and number of the scan.


def outermost_octaves(
    measurements: xr.Dataset, transitions: Mapping[str, float]
) -> dict[str, Octave | None]:
    """Return by side the outermost octave of the reliable wavelengths that masters take from scans.

    Masters have artificial roughness beyond the transition (nm) of a side. An octave is None if
    these reliable wavelengths are less than an octave.
    """
    used_measurements = measurements.where(measurements["reliable"].any("bin_wavevector"))
    shortest = float(used_measurements["shortest_reliable"].min())
    longest = float(used_measurements["longest_reliable"].max())
    octaves: dict[str, Octave | None] = {}
    for side, transition in transitions.items():
        low = max(transition, shortest) if side == "short" else min(transition, longest) / 2
        is_reliable = shortest <= low and 2 * low <= longest
        octaves[side] = (low, 2 * low) if is_reliable else None
    return octaves


def hindcast_forces(
    mirrored: HeightMap,
    octaves: Mapping[str, Octave | None],
    bodies: Sequence[RandomBody],
    compute_forces: ForceFunction,
    contacts_per_row: int,
) -> xr.Dataset:
    """Return forces by side, in N at 1 J/m², on a mirrored scan without waves beyond an octave.

    ``scan_octave_force`` (side, contact_y, contact_x) is with the octave of the scan,
    ``artificial_octave_force`` (side, realization, ...) with artificial octaves of all bodies
    instead. Both are NaN for a side without an octave.
    """
    side_forces = {}
    for side, octave in octaves.items():
        if octave is None:
            shape = (1 + ARTIFICIAL_OCTAVE_COUNT, contacts_per_row, contacts_per_row)
            forces = np.full(shape, np.nan)
        else:
            surfaces = _surfaces_with_octaves(mirrored, side, octave, bodies)
            forces = np.array([compute_forces(surface) for surface in surfaces])
        variables = {
            "scan_octave_force": (CONTACT_AXES, forces[0], FORCE_ATTRS),
            "artificial_octave_force": (("realization", *CONTACT_AXES), forces[1:], FORCE_ATTRS),
        }
        side_forces[(side,)] = xr.Dataset(variables)
    return stack(side_forces, ["side"])


def _surfaces_with_octaves(
    mirrored: HeightMap, side: str, octave: Octave, bodies: Sequence[RandomBody]
) -> Iterator[HeightMap]:
    """Yield the mirrored scan without waves beyond an octave, then with each artificial octave."""
    seed_word = SEED_WORDS[side]
    kept_heights, scan_octave = _split_at_octave(mirrored, side, octave)
    yield replace(mirrored, heights=kept_heights + scan_octave)
    for index in range(ARTIFICIAL_OCTAVE_COUNT):
        body_octaves = [
            _artificial_octave(mirrored, octave, body, seed_word, index) for body in bodies
        ]
        yield replace(mirrored, heights=kept_heights + sum(body_octaves))


def _split_at_octave(
    mirrored: HeightMap, side: str, octave: Octave
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the heights of the waves kept on a side, and those of the octave.

    Waves beyond the octave are removed: shorter ones on the short side, longer ones on the long
    side. So the scan is treated as if it ended at the octave.
    """
    series = filtered_series(mirrored, "short", list(octave), mirrored.pixels)
    octave_and_longer, longer = (waves.heights for waves in series)
    kept_heights = longer if side == "short" else mirrored.heights - octave_and_longer
    return kept_heights, octave_and_longer - longer


def _artificial_octave(
    mirrored: HeightMap, octave: Octave, body: RandomBody, seed_word: str, index: int
) -> NDArray[np.float32]:
    """Return the heights of a random, mirrored scan of a body, with waves of one octave only."""
    highest_q, lowest_q = 2 * np.pi / np.array(octave)

    def octave_spectrum(wavevector: Floats) -> Floats:
        """Return C_iso (nm⁴) within the octave, zero outside."""
        is_inside = (lowest_q < wavevector) & (wavevector <= highest_q)
        return np.where(is_inside, body.spectrum(wavevector), 0.0)

    rng = generator(body.seed, *body.random_stream, "hindcast", seed_word, index)
    scan_pixels = round(body.size / mirrored.pixel_size)
    random_map = random_surface(rng, 2 * scan_pixels, mirrored.pixel_size, octave_spectrum)
    # Like a scan, a quarter of the periodic surface is not periodic. If the scan of a sphere is
    # smaller than that of the substrate, its mirror images continue it.
    positions = np.arange(mirrored.pixels // 2) % (2 * scan_pixels)
    reflected = np.minimum(positions, 2 * scan_pixels - 1 - positions)
    random_scan = replace(random_map, heights=random_map.heights[np.ix_(reflected, reflected)])
    return np.asarray(mirror_scan(random_scan).heights)


def hindcast_ratios(forces: xr.Dataset, tolerance: float, confidence: float) -> xr.Dataset:
    """Return ``hindcast_ratio`` and ``hindcast_fails`` (side) from the forces on a surface's scans.

    The ratio is the mean force with artificial octaves relative to the mean force with the octave
    of the scans. Its interval contains the ratio with one more artificial octave, not only the mean
    ratio, so the variances of one octave and of the mean over `count` octaves add. The hindcast
    fails if the whole interval lies outside the tolerance, or if there is no octave.
    """
    dimensions = ["map", *CONTACT_AXES]
    log_scan_force = xr.DataArray(np.log(forces["scan_octave_force"].mean(dimensions)))
    log_forces = xr.DataArray(np.log(forces["artificial_octave_force"].mean(dimensions)))
    count = log_forces.sizes["realization"]
    quantile = student_quantile(count - 1, confidence)
    half_width = quantile * log_forces.std("realization", ddof=1) * np.sqrt(1 + 1 / count)
    log_ratio = log_forces.mean("realization") - log_scan_force
    interval = np.exp(np.stack([log_ratio - half_width, log_ratio + half_width], axis=-1))
    lowest, highest = logarithmic_limits(tolerance)
    passes = (log_ratio - half_width <= highest) & (log_ratio + half_width >= lowest)
    variables = as_variables(
        "hindcast_ratio", "side", np.exp(log_ratio.values), interval, DIMENSIONLESS, confidence
    )
    return xr.Dataset(
        variables | {"hindcast_fails": ("side", (~passes).values.astype(int), DIMENSIONLESS)},
        {"side": forces["side"]},
    )


def hindcast_dataset(forces: xr.Dataset, tolerance: float, confidence: float) -> xr.Dataset:
    """Return `hindcast_ratios`, and two other mean forces relative to the force on the scans.

    ``filtered_scan_ratio`` is for scans without the waves shorter than the octave of the short
    side, ``wide_pixel_ratio`` for scans with wider pixels.
    """
    mean_forces = forces.mean(["map", *CONTACT_AXES])
    ratios = mean_forces / mean_forces["scan_force"]
    filtered_scan_ratio = ratios["scan_octave_force"].sel(side="short", drop=True)
    return hindcast_ratios(forces, tolerance, confidence).assign(
        filtered_scan_ratio=filtered_scan_ratio.assign_attrs(DIMENSIONLESS),
        wide_pixel_ratio=ratios["wide_pixel_force"].assign_attrs(DIMENSIONLESS),
    )
