"""One contact: its gap, its adhesive pressure at plastic contact, and its force by separation."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.force_sum import force_separation, pull_off_force
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import Bodies, gap_map, plastic_approach


def traced_contact(
    bodies: Bodies, place: tuple[int, int], load: Load, rho: float, work_of_adhesion: float
) -> xr.Dataset:
    """Return the gap, the adhesive pressure and the force of one plastic contact of the array.

    rho, the range of adhesion, is in nm and the work of adhesion in J/m². ``gap`` (y, x) is in nm
    before flattening, ``adhesive_pressure`` (y, x) in Pa, ``force`` (separation) in N, with the
    pull-off force as an attribute.
    """
    geometry = bodies.geometry
    contact_pixels = contact_pixel_count(load, geometry.pixel_size)
    gap = gap_map(bodies, place)
    gap -= plastic_approach(gap, contact_pixels)
    attraction = np.exp(-np.maximum(gap, 0) / rho)
    pressure = work_of_adhesion / (rho * 1e-9) * attraction
    pull_off = float(pull_off_force(attraction.sum(), rho, geometry.pixel_size, work_of_adhesion))
    separation = np.linspace(0, 10 * rho, 201)
    position = geometry.offsets() * geometry.pixel_size
    from_apex: dict[str, Any] = {"units": "nm", "long_name": "position from the apex"}
    before = {"units": "nm", "long_name": "gap before flattening"}
    force = force_separation(pull_off, rho, separation)
    return xr.Dataset(
        {
            "gap": (("y", "x"), gap.astype(np.float32), before),
            "adhesive_pressure": (("y", "x"), pressure.astype(np.float32), {"units": "Pa"}),
            "force": (("separation",), force, {"units": "N"}),
        },
        {
            "y": (("y",), position, from_apex),
            "x": (("x",), position, from_apex),
            "separation": (("separation",), separation, {"units": "nm"}),
        },
        {"rho": rho, "work_of_adhesion": work_of_adhesion, "pull_off_force": pull_off},
    )
