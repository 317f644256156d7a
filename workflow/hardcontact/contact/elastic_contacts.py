"""Some contacts of a scan, solved with elasticity: contact area, pressure and pull-off force."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import DatasetsByLabels, stack, variables_of_columns
from hardcontact.base.progress import progress
from hardcontact.base.units import NM, PASCAL
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.elastic import adhesive_pull_off, pressure_at_load
from hardcontact.contact.geometry import (
    Bodies,
    count_window_pixels,
    reference_gap_map,
    square_around_lowest,
)
from hardcontact.contact.hertz_jkr_dmt import hertz_peak_pressure

#: Largest number of pixels per row of the map of the pressure in one contact.
PRESSURE_MAP_PIXELS = 64
#: Width in nm of the window about the lowest gap in which elastic and rigid forces are compared.
PULL_OFF_WINDOW = 2500.0
#: Quantities of each elastic contact, with their units.
ELASTIC_UNITS = {
    "elastic_contact_area": "nm2", "share_above_hardness": "1", "peak_pressure": "Pa",
    "mean_pressure": "Pa", "rigid_pull_off_force": "N", "elastic_pull_off_force": "N",
}  # fmt: skip


def _pressure_around_peak(pressure: Floats, pixel_size: float) -> xr.DataArray:
    """Return the pressure (y, x) in Pa about its peak, at most PRESSURE_MAP_PIXELS wide."""
    pixels = min(PRESSURE_MAP_PIXELS, len(pressure))
    # The highest pressure is the lowest negative pressure.
    around_peak = -square_around_lowest(-pressure, pixels)
    position = (np.arange(pixels) - pixels // 2) * pixel_size
    coordinates = {axis: (axis, position, NM) for axis in ("y", "x")}
    return xr.DataArray(around_peak, coordinates, ("y", "x"), attrs=PASCAL)


def solve_elastic_contacts(
    bodies: Bodies, contact: Contact, contact_indices: NDArray[np.int_], modulus: float
) -> xr.Dataset:
    """Return ELASTIC_UNITS (contact) of contacts, given by row and column in the array.

    ``pressure`` (y, x) in Pa is about the peak of the first contact.
    """
    geometry = bodies.geometry
    pixel_size = geometry.pixel_size
    period_pixels = min(bodies.substrate.pixels, geometry.window_pixels)
    pull_off_pixels = min(count_window_pixels(PULL_OFF_WINDOW, pixel_size), period_pixels)
    metrics = []
    pressures = []
    # More threads take twice the processor time and give the same numbers.
    with threadpool_limits(1, "blas"):
        for index in progress(contact_indices, len(contact_indices), "elastic contacts"):
            gap = reference_gap_map(bodies, index)
            period_gap = square_around_lowest(gap, period_pixels)
            window_gap = square_around_lowest(gap, pull_off_pixels)
            pressure = pressure_at_load(period_gap, pixel_size, modulus, contact.preload)
            forces = adhesive_pull_off(window_gap, pixel_size, modulus, contact.work, contact.rho)
            touching = pressure[pressure > 0]
            area = touching.size * pixel_size**2
            share = float(np.mean(touching > contact.hardness))
            # In the order of ELASTIC_UNITS.
            metrics.append((area, share, touching.max(), touching.mean(), *forces))
            pressures.append(pressure)
    variables = variables_of_columns(np.array(metrics), "contact", ELASTIC_UNITS)
    return xr.Dataset(
        variables | {"pressure": _pressure_around_peak(pressures[0], pixel_size)},
        {axis: ("contact", contact_indices[:, k]) for k, axis in enumerate(CONTACT_AXES)},
        {
            "hardness": contact.hardness,
            "preload": contact.preload,
            "effective_modulus": modulus,
            "rho": contact.rho,
            "work_of_adhesion": contact.work,
            "window": pull_off_pixels * pixel_size,
            "sphere_radius": geometry.radius,
            "hertz_peak_pressure": hertz_peak_pressure(contact.preload, geometry.radius, modulus),
        },
    )


def stack_elastic_contacts(scans: DatasetsByLabels) -> xr.Dataset:
    """Stack results of `solve_elastic_contacts` along ``scan``; keep the first scan's pressure."""
    numbers = {key: scan.drop_vars(["pressure", "y", "x"]) for key, scan in scans.items()}
    return stack(numbers, ["scan"]).assign(pressure=next(iter(scans.values()))["pressure"])
