"""Pull-off of a pair of scans: rigid and plastic, at every range, at several loads."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.force_sum import opened_total, pull_off_force
from hardcontact.adhesion.sphere_sums import outside_sums
from hardcontact.contact.bearing_area import (
    Load,
    NamedLoad,
    all_lowest_gaps,
    contact_pixel_count,
    stacked_gaps,
)
from hardcontact.contact.geometry import Bodies

#: Dimension, values and attributes of a coordinate.
Axis = tuple[tuple[str], Any, dict[str, str]]

Floats = NDArray[np.float64]

#: J/m², of all stored forces: they are proportional to it.
WORK_OF_ADHESION = 1.0

#: Attributes of a stored force.
FORCE = {"units": "N", "long_name": "pull-off force at W = 1 J/m2"}


def contact_axes(bodies: Bodies) -> dict[str, Axis]:
    """Return the coordinates of the array of contacts: positions on the substrate in nm."""
    positions = bodies.geometry.positions * bodies.geometry.pixel_size
    return {axis: ((axis,), positions, {"units": "nm"}) for axis in ("contact_y", "contact_x")}


def load_axis(loads: Sequence[NamedLoad]) -> dict[str, Axis]:
    """Return the coordinate of loads, by name."""
    return {"load": (("load",), [load["name"] for load in loads], {"long_name": "load"})}


def range_axis(ranges: Sequence[float]) -> dict[str, Axis]:
    """Return the coordinate of ranges of adhesion."""
    attributes = {"units": "nm", "long_name": "range of adhesion"}
    return {"rho": (("rho",), np.asarray(ranges, float), attributes)}


def plastic_totals(
    bodies: Bodies, contact_pixels: Sequence[int], rho: float, threads: int = 1
) -> Floats:
    """Return the sums (load, contact, contact) of exp(-gap/rho) of an array of plastic contacts.

    The sphere is smooth or rough; the contact pixels are those at each load, and rho, the range of
    adhesion, is in nm. Threads are used for a smooth sphere; the result does not depend on them.
    """
    contacts = all_lowest_gaps(bodies, max(contact_pixels))
    gaps = stacked_gaps(contacts, bodies.geometry)
    (outside,) = outside_sums(bodies, contacts, [rho], threads)
    return np.array([opened_total(outside, gaps, count, rho) for count in contact_pixels])


def pull_off_of_pair(bodies: Bodies, load: Load, ranges: Sequence[float]) -> xr.Dataset:
    """Return the rigid and plastic pull-off of one pair of scans, at every contact and range.

    The ranges of adhesion are in nm. The variables are ``pull_off_force`` (contact_model, rho,
    contact_y, contact_x), ``closest_approach`` (contact_model, contact_y, contact_x),
    ``penetration`` (contact_y, contact_x) and ``contact_pixels`` (contact_model).
    """
    pixel_size, rhos = bodies.geometry.pixel_size, np.asarray(ranges, float)
    contact_pixels = contact_pixel_count(load, pixel_size)
    contacts = all_lowest_gaps(bodies, contact_pixels)
    gaps = stacked_gaps(contacts, bodies.geometry)
    outside = outside_sums(bodies, contacts, rhos)
    rigid = [opened_total(sums, gaps, 1, rho) for sums, rho in zip(outside, rhos, strict=True)]
    totals = np.stack([rigid, outside + contact_pixels])
    forces = pull_off_force(totals, rhos[:, None, None], pixel_size, WORK_OF_ADHESION)
    approaches = np.stack([gaps[..., 0], gaps[..., -1]])
    contact_yx = ("contact_y", "contact_x")
    return xr.Dataset(
        {
            "pull_off_force": (("contact_model", "rho", *contact_yx), forces, FORCE),
            "closest_approach": (
                ("contact_model", *contact_yx),
                approaches,
                {"units": "nm", "long_name": "approach beyond touching mean planes"},
            ),
            "penetration": (
                contact_yx,
                approaches[1] - approaches[0],
                {"units": "nm", "long_name": "approach of plastic beyond rigid contact"},
            ),
            "contact_pixels": (("contact_model",), [1, contact_pixels], {"units": "1"}),
        },
        {"contact_model": (("contact_model",), ["rigid", "plastic"], {})}
        | range_axis(ranges)
        | contact_axes(bodies),
        {
            "work_of_adhesion": WORK_OF_ADHESION,
            "pixel_size": pixel_size,
            "interpolation_stretch": bodies.stretch,
        },
    )


def mean_pull_off_of_pair(
    bodies: Bodies, loads: Sequence[NamedLoad], ranges: Sequence[float]
) -> xr.Dataset:
    """Return ``pull_off_force`` (load, rho) of one pair of scans: plastic, averaged over contacts.

    The ranges of adhesion are in nm.
    """
    pixel_size, rhos = bodies.geometry.pixel_size, np.asarray(ranges, float)
    contact_pixels = [contact_pixel_count(load, pixel_size) for load in loads]
    contacts = all_lowest_gaps(bodies, max(contact_pixels))
    gaps = stacked_gaps(contacts, bodies.geometry)
    outside = outside_sums(bodies, contacts, rhos)
    of_ranges = list(zip(outside, rhos, strict=True))
    totals = np.array(
        [
            [opened_total(sums, gaps, count, rho).mean() for sums, rho in of_ranges]
            for count in contact_pixels
        ]
    )
    forces = pull_off_force(totals, rhos, pixel_size, WORK_OF_ADHESION)
    return xr.Dataset(
        {"pull_off_force": (("load", "rho"), forces, FORCE)},
        load_axis(loads) | range_axis(ranges),
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def window_change(pairs: Iterable[Bodies], load: Load, rho: float) -> xr.Dataset:
    """Return the largest change of the plastic force in a window larger by a period on each side.

    The pairs are one substrate with several rough spheres, rho is in nm; ``window_change`` is that
    over all contacts of all pairs.
    """
    change = max(_window_change(bodies, load, rho) for bodies in pairs)
    attributes: dict[str, Any] = {
        "units": "1",
        "long_name": "change of the force by a further period a side",
    }
    return xr.Dataset({"window_change": ((), change, attributes)}, {}, {"rho": rho})


def _window_change(bodies: Bodies, load: Load, rho: float) -> float:
    """Return the largest change over the contacts of one pair."""
    geometry = bodies.geometry
    contact_pixels = contact_pixel_count(load, geometry.pixel_size)
    contacts = all_lowest_gaps(bodies, contact_pixels)
    wider = replace(geometry, window=geometry.window + 2 * bodies.substrate.pixels)
    narrow, wide = (
        outside_sums(replace(bodies, geometry=windowed), contacts, [rho]) + contact_pixels
        for windowed in (geometry, wider)
    )
    return float(np.abs(wide / narrow - 1).max())
