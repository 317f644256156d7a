"""The user's scans of a sphere, added to scans of a surface: one rough and one smooth body."""

from dataclasses import replace

from hardcontact.base.arrays import generator
from hardcontact.own.own_spectrum import OwnSpectrum
from hardcontact.scans.both_bodies import combine_maps, combine_spectra
from hardcontact.scans.joined_spectrum import ScanSpectrum, reliable_spectrum
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.metrics import metrics


def combined_spectrum(surface: OwnSpectrum, sphere: OwnSpectrum, seed: int) -> OwnSpectrum:
    """Return the sum of both spectra, and of both maps if each body has a single one.

    The seed decides which positions of the maps meet. Raises ValueError for a table.
    """
    substrate_spectrum, sphere_spectrum = surface.spectrum, sphere.spectrum
    if not isinstance(substrate_spectrum, ScanSpectrum) or not isinstance(
        sphere_spectrum, ScanSpectrum
    ):
        raise ValueError("--sphere: expected scans of both bodies, found a table of a spectrum")
    joined = combine_spectra(substrate_spectrum.joined, sphere_spectrum.joined)
    notes = surface.notes + sphere.notes
    scans = surface.scans + sphere.scans
    if len(scans) > 2 or any(scan.kind != "map" for scan in scans):
        skewness = max(substrate_spectrum.skewness, sphere_spectrum.skewness, key=abs)
        return OwnSpectrum(reliable_spectrum(joined, skewness), notes, scans)
    combined_map = _sum_of_maps(*scans, seed=seed)
    spectrum = reliable_spectrum(joined, metrics(combined_map)["skewness"])
    return OwnSpectrum(spectrum, notes, (combined_map,), scans)


def _sum_of_maps(substrate: HeightMap, sphere: HeightMap, *, seed: int) -> HeightMap:
    """Return the levelled map of a substrate with the roughness of the sphere."""
    rng = generator(seed, "both bodies")
    mirrored = combine_maps(rng, mirror_in_float32(substrate), mirror_in_float32(sphere))
    heights = mirrored.heights[: substrate.pixels, : substrate.pixels]
    return replace(substrate, heights=heights, defects={**sphere.defects, **substrate.defects})
