"""Pull-off of filtered masters over radii of the sphere, ranges of adhesion and contact areas."""

from typing import TypedDict

import numpy as np
import xarray as xr

from hardcontact.adhesion.pull_off import Axis, mean_pull_off_of_pair
from hardcontact.contact.bearing_area import NamedLoad, contact_pixel_count
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.scales.filtered_masters import forces_at_cutoffs
from hardcontact.surfaces.height_map import HeightMap


class ScaledContacts(TypedDict):
    """A master, filtered at several cutoffs, in all combinations of sphere, range and area.

    The side ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above; `pixels`
    lie along an edge of a filtered surface, `count` contacts along an edge of the array. Cutoffs,
    the edge of the window, radii of the sphere and ranges of adhesion are in nm, the hardness of
    the softer body in Pa and preloads in N; the contact area is the preload over the hardness.
    """

    side: str
    pixels: int
    cutoffs: list[float]
    window: float
    count: int
    radii: list[float]
    ranges: list[float]
    hardness: float
    preloads: list[float]


def scaled_pull_off(master: HeightMap, parameters: ScaledContacts) -> xr.Dataset:
    """Return the plastic pull-off from filtered masters in all combinations, meaned over contacts.

    The sphere is smooth, the master periodic. Where a pixel is not small against the contact area,
    the area is that of the pixels that touch: the smallest whole number of them that carries the
    preload.

    ``pull_off_force`` (cutoff_wavelength, radius, area, rho) and ``unfiltered_pull_off_force``
    (radius, area, rho) are in N at 1 J/m²; ``contact_area`` (area), in nm², is that of the pixels
    that touch, and the coordinate area the preload over the hardness in nm²;
    ``unfiltered_wavelength`` is the end of the unfiltered spectrum.
    """
    nm = {"units": "nm"}
    areas = np.asarray(parameters["preloads"]) / parameters["hardness"] * 1e18
    axes: dict[str, Axis] = {
        "radius": (("radius",), np.array(parameters["radii"]), nm),
        "area": (("area",), areas, {"units": "nm2", "long_name": "preload over hardness"}),
        "rho": (("rho",), np.array(parameters["ranges"]), nm),
    }
    curves = forces_at_cutoffs(
        master, parameters["side"], parameters, lambda surface: _forces(surface, parameters), axes
    )
    pixel_size = master.size / parameters["pixels"]
    touching = [
        contact_pixel_count(load, pixel_size) * pixel_size**2 for load in _loads(parameters)
    ]
    contact_area = (("area",), touching, {"units": "nm2", "long_name": "touching pixels"})
    return curves.assign(contact_area=contact_area)


def _loads(parameters: ScaledContacts) -> list[NamedLoad]:
    """Return the loads, named by the preload."""
    return [
        {"name": f"{preload:g}", "preload": preload, "hardness": parameters["hardness"]}
        for preload in parameters["preloads"]
    ]


def _forces(surface: HeightMap, parameters: ScaledContacts) -> np.ndarray:
    """Return the mean forces (radius, area, rho) in N on one filtered surface."""
    array: ContactArray = {"window": parameters["window"], "count": parameters["count"]}
    return np.array(
        [
            mean_pull_off_of_pair(
                bodies(surface, None, radius, array), _loads(parameters), parameters["ranges"]
            )["pull_off_force"].values
            for radius in parameters["radii"]
        ]
    )
