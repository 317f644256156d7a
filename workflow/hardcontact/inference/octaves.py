"""Octaves of wavelengths: how the pull-off force follows the amplitude of each, for sensitivity.nc.

The waves of one octave are amplified and attenuated on the same surface. Both forces share all
other waves, so that their ratio scatters little. F is the mean force over contacts.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import with_interval
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import FORCE, pull_off_forces
from hardcontact.inference.scan_parts import (
    ScanParts,
    delete_one_logarithms,
    half_width,
    jackknife_variance,
    parts_of_scans,
    quarters_of_contacts,
)
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.synthesis import SIDES

Floats = NDArray[np.float64]
#: Forces on one surface, of any shape.
ForcesOnSurface = Callable[[HeightMap], Floats]

#: Limits of all octaves in nm: from below the pixels of the paper to above its surfaces.
OCTAVE_LIMITS: Floats = np.ldexp(10.0, np.arange(12))
#: Relative change of an amplitude. A trade: smaller steps let single contact pixels decide, larger
#: ones leave the central difference in error by their square.
STEP = 0.05
#: Factors on the amplitude of an octave.
FACTORS = (1 - STEP, 1 + STEP)
#: Parts of the roughness whose forces are compared with the force on all of it.
BAND_PARTS = ("only the band", "no shorter waves", "no longer waves")

OCTAVE = NM | {"long_name": "shortest wavelength of the octave, which ends at twice this length"}
FACTOR = DIMENSIONLESS | {"long_name": "factor on the amplitude of the octave"}
SENSITIVITY = DIMENSIONLESS | {
    "long_name": "d ln F / d ln a: relative change of the mean pull-off force per relative change "
    "of the amplitude of one octave"
}
BAND_END = NM | {"long_name": "wavelength at which the band begins and ends"}
BAND_RATIO = DIMENSIONLESS | {
    "long_name": "mean pull-off force with only a part of the roughness, relative to the force "
    "with all roughness"
}


def octave_limits(shortest: float, longest: float) -> Floats:
    """Return the limits (nm) of the octaves that lie between two wavelengths (nm)."""
    inside = (OCTAVE_LIMITS >= shortest) & (OCTAVE_LIMITS <= longest)
    return OCTAVE_LIMITS[inside]


def octaves(surface: HeightMap, limits: Sequence[float] | Floats) -> Iterator[HeightMap]:
    """Yield the waves of a periodic surface from each limit (nm, ascending) to the next."""
    kept = filtered_series(surface, "small", list(limits), surface.pixels)
    longer_than_limit = next(kept).heights.copy()
    for longer_than_next in kept:
        yield replace(surface, heights=longer_than_limit - longer_than_next.heights)
        longer_than_limit = longer_than_next.heights.copy()


def octave_forces(
    surface: HeightMap, limits: Sequence[float] | Floats, forces: ForcesOnSurface
) -> Floats:
    """Return the forces (octave, factor, ...) with each octave times each of FACTORS."""
    return np.array(
        [
            [
                forces(replace(surface, heights=surface.heights + (factor - 1) * waves.heights))
                for factor in FACTORS
            ]
            for waves in octaves(surface, limits)
        ]
    )


def sensitivity(mean_forces: Floats) -> Floats:
    """Return d ln F / d ln a (...) from mean forces (..., factor): the central difference."""
    attenuated, amplified = np.moveaxis(np.log(mean_forces), -1, 0)
    return np.asarray((amplified - attenuated) / (2 * STEP))


def surface_within(surface: HeightMap, shortest: float | None, longest: float | None) -> HeightMap:
    """Return the waves of a periodic surface that are at least `shortest` and below `longest`.

    Wavelengths are in nm; None removes nothing on its side.
    """
    heights = surface.heights
    if shortest is not None:
        heights = _waves_from(surface, shortest)
    if longest is not None:
        heights = heights - _waves_from(surface, longest)
    return replace(surface, heights=heights)


def _waves_from(surface: HeightMap, cutoff: float) -> NDArray[np.float32]:
    """Return the heights without all wavelengths below a cutoff (nm)."""
    return next(filtered_series(surface, "small", [cutoff], surface.pixels)).heights


def octaves_of_surface(
    surface: HeightMap, limits: Sequence[float] | Floats, forces: ForcesOnSurface
) -> xr.Dataset:
    """Return ``octave_force`` (octave, factor, contact_y, contact_x) in N at 1 J/m²."""
    dimensions = ("octave", "factor", *CONTACT_AXES)
    return xr.Dataset(
        {"octave_force": (dimensions, octave_forces(surface, limits, forces), FORCE)},
        {
            "octave": ("octave", np.asarray(limits[:-1]), OCTAVE),
            "factor": ("factor", list(FACTORS), FACTOR),
        },
    )


def log_force_ratio(
    changed: xr.DataArray, reference: xr.DataArray, parts: ScanParts, confidence: float
) -> tuple[Floats, Floats]:
    """Return the logarithm (...) of a ratio of mean forces, and the half width of its interval.

    Forces are over (map, ..., contact_y, contact_x); the means are over maps and contacts. The
    interval comes from the jackknife over the parts of the maps.
    """
    dimensions = ["map", *CONTACT_AXES]

    def ratio(kept: xr.DataArray) -> xr.DataArray:
        """Return the ratio of mean forces over the kept contacts."""
        return changed.where(kept).mean(dimensions) / reference.where(kept).mean(dimensions)

    logarithms = delete_one_logarithms(parts, "map", ratio)
    half = half_width([jackknife_variance(logarithms, parts)], confidence)
    return np.log(ratio(xr.DataArray(True)).values), half


def forces_with(contact: Contact, sphere: HeightMap | None = None) -> ForcesOnSurface:
    """Return the function of a surface that gives its forces (contact, contact) in N at 1 J/m²."""

    def forces(surface: HeightMap) -> Floats:
        pair = bodies(surface, sphere, contact)
        return np.asarray(pull_off_forces(pair, [contact], [contact.range])[0, 0])

    return forces


def join_maps(files: Mapping[tuple[Any, ...], xr.Dataset]) -> dict[str, xr.Dataset]:
    """Return the forces on all maps of each surface; the surface is the first part of a key."""
    surfaces: dict[str, list[xr.Dataset]] = {}
    for (surface, *_), file in files.items():
        surfaces.setdefault(surface, []).append(file)
    return {surface: xr.concat(parts, "map") for surface, parts in surfaces.items()}


def _parts_of_maps(forces: xr.Dataset, weight_deviation: float, places: float) -> ScanParts:
    """Return the parts of the maps: the maps if there are three, otherwise their quarters."""
    quarters = quarters_of_contacts(forces.sizes["contact_y"], 1)
    size = float(forces.attrs["map_size"])
    return parts_of_scans(np.arange(forces.sizes["map"]), quarters, size, weight_deviation, places)


def all_sensitivities(
    maps: Mapping[str, xr.Dataset],
    radius: float,
    rho: float,
    places: Mapping[str, float],
    confidence: float,
) -> xr.Dataset:
    """Return ``octave_sensitivity`` (surface, octave), NaN for an octave that a map lacks.

    Radius and range are in nm; `places` comes from `mean_forces.fewest_places`.
    """
    deviation = float(np.sqrt(radius * rho))
    surfaces = {}
    for surface, forces in maps.items():
        parts = _parts_of_maps(forces, deviation, places.get(surface, np.inf))
        surfaces[(surface,)] = sensitivities(forces["octave_force"], parts, confidence)
    return stack(surfaces, ["surface"]).sortby("octave")


def all_band_ratios(
    bands: Mapping[str, xr.Dataset], radius: float, rho: float, confidence: float
) -> xr.Dataset:
    """Return ``band_force_ratio`` (surface, band, band_part) and ``band_end`` (band, side)."""
    deviation = float(np.sqrt(radius * rho))
    surfaces = {}
    for surface, forces in bands.items():
        parts = _parts_of_maps(forces, deviation, np.inf)
        for name in forces["band"].values.tolist():
            band_force = forces["band_force"].sel(band=name, drop=True)
            surfaces[surface, name] = band_ratios(band_force, parts, confidence)
    first = next(iter(bands.values()))
    ends = first["band_end"].isel(map=0, drop=True)
    return stack(surfaces, ["surface", "band"]).assign(band_end=ends)


def sensitivities(octave_force: xr.DataArray, parts: ScanParts, confidence: float) -> xr.Dataset:
    """Return ``octave_sensitivity`` (octave), d ln F / d ln a, from forces on all maps.

    `octave_force` (map, octave, factor, contact_y, contact_x) is that of `octaves_of_surface`. The
    derivative is the central difference of the logarithms of the mean forces.
    """
    attenuated, amplified = (octave_force.sel(factor=factor, drop=True) for factor in FACTORS)
    log_ratio, half = log_force_ratio(amplified, attenuated, parts, confidence)
    interval = np.stack([log_ratio - half, log_ratio + half], axis=-1) / (2 * STEP)
    variables = with_interval(
        "octave_sensitivity", "octave", log_ratio / (2 * STEP), interval, SENSITIVITY, confidence
    )
    return xr.Dataset(variables, {"octave": octave_force["octave"]})


def band_ratios(band_force: xr.DataArray, parts: ScanParts, confidence: float) -> xr.Dataset:
    """Return ``band_force_ratio`` (band_part), the force on parts of the roughness over all of it.

    `band_force` (map, band_part, contact_y, contact_x) has the parts ``"all"`` and BAND_PARTS.
    """
    changed = band_force.sel(band_part=list(BAND_PARTS))
    reference = band_force.sel(band_part="all", drop=True)
    log_ratio, half = log_force_ratio(changed, reference, parts, confidence)
    interval = np.exp(np.stack([log_ratio - half, log_ratio + half], axis=-1))
    variables = with_interval(
        "band_force_ratio", "band_part", np.exp(log_ratio), interval, BAND_RATIO, confidence
    )
    return xr.Dataset(variables, {"band_part": list(BAND_PARTS)})


def band_of_surface(
    surface: HeightMap, shortest: float, longest: float, forces: ForcesOnSurface
) -> xr.Dataset:
    """Return ``band_force`` (band_part, contact_y, contact_x) in N at 1 J/m², and ``band_end``.

    The band is from a shortest to a longest wavelength in nm.
    """
    limits = {
        "all": (None, None),
        "only the band": (shortest, longest),
        "no shorter waves": (shortest, None),
        "no longer waves": (None, longest),
    }
    part_forces = [forces(surface_within(surface, *ends)) for ends in limits.values()]
    dimensions = ("band_part", *CONTACT_AXES)
    return xr.Dataset(
        {
            "band_force": (dimensions, np.array(part_forces), FORCE),
            "band_end": ("side", [shortest, longest], BAND_END),
        },
        {"band_part": list(limits), "side": list(SIDES)},
    )
