"""One contact: its gap, its adhesive pressure at plastic contact, and its force by separation."""

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.adhesion.pull_off import pull_off_force
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import Bodies, gap_map, plastic_approach


def force_separation(pull_off: float, rho: float, separation: ArrayLike) -> NDArray[np.float64]:
    """Return the force (N, negative: attractive) at separations (nm) beyond closest approach.

    The bodies keep their deformed shape, so that all gaps grow alike and Eq. 3 decays with rho.
    """
    return -pull_off * np.exp(-np.asarray(separation) / rho)


def traced_contact(
    bodies: Bodies, place: tuple[int, int], load: Load, rho: float, work_of_adhesion: float
) -> xr.Dataset:
    """Return the gap, the adhesive pressure and the force of one plastic contact of the array.

    rho, the range of adhesion, is in nm and the work of adhesion in J/m². ``gap`` (y, x) is in nm
    before flattening, ``adhesive_pressure`` (y, x) in Pa, ``force`` (separation) in N, with the
    pull-off force as an attribute.
    """
    geometry = bodies.geometry
    gap = gap_map(bodies, place)
    gap -= plastic_approach(gap, contact_pixel_count(load, geometry.pixel_size))
    attraction = np.exp(-np.maximum(gap, 0) / rho)
    pressure = work_of_adhesion / (rho * 1e-9) * attraction
    pull_off = float(pull_off_force(attraction.sum(), rho, geometry.pixel_size, work_of_adhesion))
    separation = np.linspace(0, 10 * rho, 201)
    position = geometry.offsets() * geometry.pixel_size
    from_apex: dict[str, Any] = {"units": "nm", "long_name": "position from the apex"}
    before = {"units": "nm", "long_name": "gap before flattening"}
    return xr.Dataset(
        {
            "gap": (("y", "x"), gap.astype(np.float32), before),
            "adhesive_pressure": (("y", "x"), pressure.astype(np.float32), {"units": "Pa"}),
            "force": ("separation", force_separation(pull_off, rho, separation), {"units": "N"}),
        },
        {
            "y": ("y", position, from_apex),
            "x": ("x", position, from_apex),
            "separation": ("separation", separation, {"units": "nm"}),
        },
        {"rho": rho, "work_of_adhesion": work_of_adhesion, "pull_off_force": pull_off},
    )
