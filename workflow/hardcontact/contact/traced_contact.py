"""One contact: its gap, its adhesive pressure at plastic contact, and its force by separation."""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, gap_map, largest_contact_gap
from hardcontact.contact.pull_off import pull_off_force


def traced_contact(bodies: Bodies, index: tuple[int, int], contact: Contact) -> xr.Dataset:
    """Return the gap, the adhesive pressure and the force of one plastic contact of the array.

    bodies: substrate and sphere on common pixels.
    index: row and column of the contact in the array of contacts.
    contact: load, hardness, range and work of adhesion.
    Returns ``gap`` (y, x) in nm before flattening, ``adhesive_pressure`` (y, x) in Pa, ``force``
        (separation) in N.
    """
    geometry = bodies.geometry
    rho = contact.range
    work = contact.work
    gap = gap_map(bodies, index)
    gap -= largest_contact_gap(gap, contact.pixel_count(geometry.pixel_size))
    attraction = np.exp(-np.maximum(gap, 0) / rho)
    pressure = work / (rho * 1e-9) * attraction
    pull_off = float(pull_off_force(attraction.sum(), rho, geometry.pixel_size, work))
    # The bodies keep their deformed shape: all gaps grow by the same length.
    separation = np.linspace(0, 10 * rho, 201)
    position = geometry.offsets() * geometry.pixel_size
    from_apex: dict[str, Any] = {"units": "nm", "long_name": "position from the apex"}
    gap_attributes = {"units": "nm", "long_name": "gap before flattening"}
    return xr.Dataset(
        {
            "gap": (("y", "x"), gap.astype(np.float32), gap_attributes),
            "adhesive_pressure": (("y", "x"), pressure.astype(np.float32), {"units": "Pa"}),
            "force": ("separation", -pull_off * np.exp(-separation / rho), {"units": "N"}),
        },
        {
            "y": ("y", position, from_apex),
            "x": ("x", position, from_apex),
            "separation": ("separation", separation, {"units": "nm"}),
        },
        {"rho": rho, "work_of_adhesion": work, "pull_off_force": pull_off},
    )
