"""Forces of the study's own scans on a smooth sphere, beside those on the rough one.

The forces of a pool are those on a smooth sphere. What its roughness changes is measured on the
study's own scans, and applied to all sets.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION, pull_off_of_pair
from hardcontact.contact.bearing_area import ContactSettings
from hardcontact.contact.geometry import bodies
from hardcontact.records.log import progress
from hardcontact.records.netcdf import Arrays
from hardcontact.surfaces.height_map import HeightMap

__all__ = ["on_smooth_sphere"]


def on_smooth_sphere(
    stitched: Mapping[int, HeightMap],
    contact: ContactSettings,
    radius: float,
    ranges: Sequence[float],
) -> Arrays:
    """Return the mean forces of some scans of one substrate on a smooth sphere.

    Parameters
    ----------
    stitched : mapping of int to HeightMap
        Periodic, by the number of the scan.
    contact : ContactSettings
        Array of contacts and load.
    radius : float
        Of the sphere, in nm.
    ranges : sequence of float
        Ranges of adhesion in nm.

    Returns
    -------
    Arrays
        ``pull_off_force`` (scan, contact_model, rho), averaged over contacts.
    """
    pairs = [
        pull_off_of_pair(bodies(surface, None, radius, contact), contact, ranges)
        for surface in progress(stitched.values(), len(stitched), "scans on a smooth sphere")
    ]
    forces = [pair.variables["pull_off_force"][1].mean(axis=(-2, -1)) for pair in pairs]
    scans = (("scan",), np.array(list(stitched)), {"long_name": "number of the scan"})
    kept = {name: pairs[0].coordinates[name] for name in ("contact_model", "rho")}
    return Arrays(
        {"pull_off_force": (("scan", "contact_model", "rho"), np.array(forces), FORCE)},
        {"scan": scans} | kept,
        {"work_of_adhesion": WORK_OF_ADHESION},
    )
