"""Pull-off on mirrored windows of a large surface, against that on the surface itself."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION, mean_pull_off_of_pair
from hardcontact.contact.bearing_area import NamedLoad
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.records.netcdf import Arrays
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.substitute_scans import substitute_scan
from hardcontact.surfaces.topography import level, mirror_stitch

__all__ = ["WindowContacts", "mean_forces", "mirrored_windows", "window_forces"]


class WindowContacts(TypedDict):
    """Windows that are cut out of a surface, and the contacts on them.

    Attributes
    ----------
    sizes : list of float
        Edges of the windows in nm.
    each : int
        Windows of every size, along the diagonal of the surface.
    radius : float
        Of the sphere in nm.
    ranges : list of float
        Ranges of adhesion in nm.
    window : float
        Edge of the analysis window in nm.
    count : int
        Contacts along an edge of the array.
    load : NamedLoad
        Preload and hardness.
    """

    sizes: list[float]
    each: int
    radius: float
    ranges: list[float]
    window: float
    count: int
    load: NamedLoad


def window_forces(surface: HeightMap, parameters: WindowContacts) -> Arrays:
    """Return the plastic pull-off of a smooth sphere on a surface and on windows cut out of it.

    A window is levelled and mirrored, as the paper does with its scans.

    Parameters
    ----------
    surface : HeightMap
        Periodic, the largest there is.
    parameters : WindowContacts
        Windows and contacts.

    Returns
    -------
    Arrays
        ``pull_off_force`` (scan_size, rho) in N at 1 J/m², means over contacts and windows. The
        last scan size is that of the surface itself, which is not mirrored.
    """
    forces = [
        np.mean(
            [
                mean_forces(one, parameters)
                for one in mirrored_windows(surface, size, parameters["each"])
            ],
            axis=0,
        )
        for size in parameters["sizes"]
    ]
    nm = {"units": "nm"}
    return Arrays(
        {
            "pull_off_force": (
                ("scan_size", "rho"),
                np.array([*forces, mean_forces(surface, parameters)]),
                FORCE,
            )
        },
        {
            "scan_size": (("scan_size",), np.array([*parameters["sizes"], surface.size]), nm),
            "rho": (("rho",), np.array(parameters["ranges"]), nm),
        },
        {"work_of_adhesion": WORK_OF_ADHESION, "sphere_radius": parameters["radius"]},
    )


def mirrored_windows(surface: HeightMap, size: float, count: int) -> Iterator[HeightMap]:
    """Yield windows of a surface, levelled and mirrored as the paper does with its scans.

    Parameters
    ----------
    surface : HeightMap
        Periodic.
    size : float
        Edge of a window in nm.
    count : int
        Of the windows, evenly along the diagonal of the surface.

    Yields
    ------
    HeightMap
        Periodic over twice the size.
    """
    pixels = round(size / surface.pixel_size)
    for start in np.arange(count) * (surface.pixels // count):
        shifted = replace(surface, heights=np.roll(surface.heights, (-start, -start), (0, 1)))
        yield mirror_stitch(level(substitute_scan(shifted, pixels)))


def mean_forces(surface: HeightMap, parameters: WindowContacts) -> NDArray[np.float64]:
    """Return the plastic pull-off of a smooth sphere on a surface, averaged over contacts.

    Parameters
    ----------
    surface : HeightMap
        Periodic.
    parameters : WindowContacts
        Contacts; the windows do not matter.

    Returns
    -------
    numpy.ndarray
        (rho,) in N at 1 J/m².
    """
    array: ContactArray = {"window": parameters["window"], "count": parameters["count"]}
    pair = bodies(surface, None, parameters["radius"], array)
    found = mean_pull_off_of_pair(pair, [parameters["load"]], parameters["ranges"])
    return np.asarray(found.variables["pull_off_force"][1][0])
