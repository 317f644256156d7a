"""The force on your only map, summed over its pixels and compared with the closed form.

`hardcontact predict` and `api.predict` use this module: one map, one range of adhesion, plastic
contact, in seconds. A study computes force.nc (`own.force_dataset`) from contacts on all scans, at
all ranges and in both contact models, and adds artificial roughness. Both sum over pixels by
`contact.pull_off`, so on one map their forces differ only if their contacts do.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from enum import StrEnum

import numpy as np

from hardcontact.base.number import Number, numbers_by_name
from hardcontact.config.study_plan import POSITION_CONTACTS_PER_ROW, SPHERE_POSITIONS
from hardcontact.contact.contact import PLASTIC, Contact
from hardcontact.contact.geometry import join_bodies, spheres_at_positions
from hardcontact.contact.hertz_jkr_dmt import limit_forces
from hardcontact.contact.numerical_limits import LARGE_SIZE_RATIO, finite_scan_ratio
from hardcontact.contact.pull_off import make_force_function, pull_off_on_spheres
from hardcontact.inference.mean_forces import (
    SurfaceForces,
    forces_of_surface,
    mean_intervals,
    position_half_width,
)
from hardcontact.own.own_spectrum import OwnSpectrum
from hardcontact.own.scan_contact import Obstacle, contact_on_scan, find_obstacle
from hardcontact.own.wide_pixels import widen_pixels
from hardcontact.scans.joined_spectrum import ScanSpectrum
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.spectrum import Spectrum, measured_psds
from hardcontact.theory.closed_form import closed_form, smooth_force
from hardcontact.theory.prediction import prediction
from hardcontact.theory.summits import search_size
from hardcontact.theory.validity import Validity, is_validated, nearest_ratios, table_point

#: Names of the forces and edges in closed form, which have intervals, also for the extrapolated
#: spectrum.
CLOSED_FORM_NAMES = {
    "closed_form_force", "short_edge", "long_edge", "extrapolated_force", "extrapolated_short_edge",
    "extrapolated_long_edge",
}  # fmt: skip


class ScanSize(StrEnum):
    """Whether a scan is smaller than `LARGE_SIZE_RATIO` times the search size."""

    SMALL, LARGE = "small", "large"


class ClosedFormStatus(StrEnum):
    """Whether the closed form for the spectrum of a map agrees with the force on the map."""

    AGREES = "agrees"  #: The force lies within the known error of the closed form.
    NOT_GAUSSIAN = "not_gaussian"  #: The intervals of both forces are disjoint.
    OUTSIDE = "outside"  #: Any other case.


def prediction_and_scan_force(
    own_spectrum: OwnSpectrum,
    contact: Contact,
    tolerance: float,
    confidence: float,
    name: str = "spectrum",
) -> dict[str, Number]:
    """Return the numbers of the closed form for a spectrum, and of the force on its only map.

    Messages call the spectrum `name`.
    """
    numbers = prediction(own_spectrum.spectrum, contact, tolerance, name)
    scan_force = scan_force_numbers(own_spectrum, contact, confidence)
    closed_form_on_scan = scan_force.get("closed_form_on_scan")
    # A closed form that fails on the map has no known error for its spectrum, either.
    if closed_form_on_scan is not None and closed_form_on_scan.status != ClosedFormStatus.AGREES:
        for quantity in numbers.keys() & CLOSED_FORM_NAMES:
            number = numbers[quantity]
            status = Validity.OUTSIDE if math.isfinite(number.value) else number.status
            numbers[quantity] = number._replace(low=math.nan, high=math.nan, status=status)
    return scan_force | numbers


def scan_force_numbers(
    own_spectrum: OwnSpectrum, contact: Contact, confidence: float
) -> dict[str, Number]:
    """Return the numbers of the force on the only map, or why it has none; empty for a table."""
    spectrum = own_spectrum.spectrum
    if not (own_spectrum.scans and isinstance(spectrum, ScanSpectrum)):
        return {}
    obstacle, shortest_range = find_obstacle(own_spectrum.scans, contact)
    if obstacle:
        numbers = [Number("force_on_scan", math.nan, "N", status=obstacle)]
        if obstacle == Obstacle.SHORT_RANGE:
            numbers.append(Number("shortest_range", shortest_range, "nm"))
        return numbers_by_name(*numbers)
    scan = own_spectrum.scans[0]  # For two bodies, this is the sum of their maps.
    mirrored_scan = mirror_in_float32(scan)
    contact = contact_on_scan(scan, contact)  # It differs only in its window.
    surface_forces = _plastic_forces(mirrored_scan, own_spectrum.body_maps, contact)
    wide_pixel_ratio = _wide_pixel_ratio(scan, mirrored_scan, contact)
    # Finer pixels would lower forces: the low ends of intervals are divided (`own.wide_pixels`).
    pixel_divisor = float(np.fmax(wide_pixel_ratio, 1.0))
    force = _mean_force(surface_forces, smooth_force(contact), pixel_divisor, confidence)
    search_width = search_size(spectrum.extrapolated(), contact.radius, contact.area)
    size_status = ScanSize.SMALL if scan.size < LARGE_SIZE_RATIO * search_width else ScanSize.LARGE
    _, small_scan_ratio = finite_scan_ratio(scan.size, search_width)
    return numbers_by_name(
        force,
        Number("force_on_scan_over_smooth", force.value / smooth_force(contact)),
        Number("wide_pixel_ratio", wide_pixel_ratio),
        *_scatter_numbers(surface_forces, confidence),
        Number("search_size", search_width, "nm", status=size_status),
        _closed_form_number(mirrored_scan, force, small_scan_ratio, pixel_divisor, contact),
    )


def _plastic_forces(
    mirrored_scan: HeightMap, body_maps: Sequence[HeightMap], contact: Contact
) -> SurfaceForces:
    """Return the plastic forces (N) of a smooth sphere, or of a rough sphere at many positions.

    Index 0 of their arrays is the only range of adhesion, that of the contact. A smooth sphere
    touches the scan. If there are maps of both bodies, these touch instead, at SPHERE_POSITIONS
    positions. Their sum, the scan, has the sphere at one position alone.
    """
    if body_maps:
        substrate, sphere = (mirror_in_float32(body_map) for body_map in body_maps)
        contact = replace(contact, contacts_per_row=POSITION_CONTACTS_PER_ROW)
        spheres = spheres_at_positions(sphere, math.isqrt(SPHERE_POSITIONS))
        joined_bodies = [join_bodies(substrate, moved, contact) for moved in spheres]
    else:
        joined_bodies = [join_bodies(mirrored_scan, None, contact)]
    pull_off = pull_off_on_spheres(dict(enumerate(joined_bodies)), contact, [contact.rho])
    forces = contact.work * pull_off["pull_off_force"].sel(contact_model=PLASTIC, drop=True)
    touched_patches = float(pull_off["touched_patches"].max())
    scan_size = mirrored_scan.size / 2
    return forces_of_surface(forces.expand_dims("scan"), scan_size, contact.radius, touched_patches)


def _mean_force(
    surface_forces: SurfaceForces, bound: float, pixel_divisor: float, confidence: float
) -> Number:
    """Return the mean plastic force (N) and its interval, which allows for finer pixels.

    Both are limited to the bound, the force on a smooth surface.
    """
    values = np.append(surface_forces.mean, mean_intervals(surface_forces, confidence)[0])
    mean, low, high = limit_forces(values, bound).tolist()
    interval_source = surface_forces.scan_parts[0].interval_source
    return Number("force_on_scan", mean, "N", low / pixel_divisor, high, status=interval_source)


def _wide_pixel_ratio(scan: HeightMap, mirrored_scan: HeightMap, contact: Contact) -> float:
    """Return the force on pixels four times as wide relative to that on the scan, usually over 1.

    The sphere is smooth, because the roughness of a rough one is a part of the scan.
    """
    forces_on_map = make_force_function(contact)
    wide_pixel_force = forces_on_map(mirror_in_float32(widen_pixels(scan))).mean()
    return float(wide_pixel_force / forces_on_map(mirrored_scan).mean())


def _scatter_numbers(surface_forces: SurfaceForces, confidence: float) -> Iterator[Number]:
    """Yield the scatter of ln F, the touched patches, and the effect of a sphere's position."""
    yield Number("log_force_std", float(surface_forces.log_force_std[0]))
    yield Number("touched_patches", surface_forces.scan_parts[0].touched_patches)
    log_half_width = position_half_width(surface_forces, confidence)
    if log_half_width is not None:
        yield Number("position_factor", float(np.exp(log_half_width[0])))


def _closed_form_number(
    mirrored_scan: HeightMap,
    force: Number,
    small_scan_ratio: float,
    pixel_divisor: float,
    contact: Contact,
) -> Number:
    """Return the force in closed form for all wavelengths of the mirrored scan.

    The closed form assumes Gaussian heights, and here it has the waves of `force`, the sum over the
    pixels. So both must agree within the error of the closed form, if the heights are Gaussian.
    Errors come from the nearest designed surfaces. On a small scan the sum is too large, so
    `small_scan_ratio` raises the high end of the interval. Finer pixels may lower the force, so the
    low end is divided by `pixel_divisor`, but not before the comparison. The interval is NaN unless
    both forces agree.
    """
    wavevector, _, density = measured_psds(mirrored_scan)
    has_waves = np.isfinite(density)
    spectrum = Spectrum(wavevector[has_waves], density[has_waves])
    form = closed_form(spectrum, contact)
    point = table_point(spectrum, contact, form)
    lowest, highest = nearest_ratios(point, "force")
    low, high = lowest * form.force, highest * small_scan_ratio * form.force
    # A force without an interval is compared itself.
    is_bounded = math.isfinite(force.low + force.high)
    force_low, force_high = (force.low, force.high) if is_bounded else (force.value, force.value)
    if low > force_high or high < force_low:
        status = ClosedFormStatus.NOT_GAUSSIAN
    elif low <= force.value <= high and is_validated(point):
        status = ClosedFormStatus.AGREES
    else:
        status = ClosedFormStatus.OUTSIDE
    if status != ClosedFormStatus.AGREES:
        low, high = math.nan, math.nan
    return Number("closed_form_on_scan", form.force, "N", low / pixel_divisor, high, status)
