"""Pool of substitute scans from which sets are sampled: forces of each scan at several rms heights.

A set multiplies the heights of each of its scans by a factor. Forces on a smooth sphere are
computed at a few rms heights, which span all heights of sets, and are interpolated between them.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.records.job import progress
from hardcontact.surfaces.height_map import HeightMap, mirror_scan
from hardcontact.surfaces.levelling import level
from hardcontact.surfaces.metrics import TABLE1_METRICS, measured_metrics
from hardcontact.surfaces.substitutes import Substitute, Targets, required_targets
from hardcontact.surfaces.synthesis import sample_scan

#: Smallest rms height of a pool relative to the mean: sets with smoother scans are sampled again.
MIN_HEIGHT_RATIO = 0.05


def pool_heights(targets: Targets, scan_count: int, count: int) -> Floats:
    """Return the ascending rms heights (count,) in nm at which the forces of a pool are computed.

    They reach as far as a scan of a set can: (n - 1)/sqrt(n) standard deviations of a sample of n
    from its mean. The heights are evenly spaced in their root, because forces change faster at
    small heights. A set of one scan has no deviation and needs a single height.
    """
    mean = targets.means["rms_height"]
    if scan_count == 1:
        return np.array([mean])
    reach = targets.rms_height_std * (scan_count - 1) / np.sqrt(scan_count)
    lowest = max(mean - reach, MIN_HEIGHT_RATIO * mean)
    return np.asarray(np.linspace(lowest**0.5, (mean + reach) ** 0.5, count) ** 2)


def compute_pool(
    numbers: Sequence[int],
    substitute: Substitute,
    rms_heights: Floats,
    contact: Contact,
    ranges: list[float],
) -> xr.Dataset:
    """Return the `forces_at_heights` of some scans of a pool, by number of the scan."""
    scans = [
        forces_at_heights(pool_scan(number, substitute), rms_heights, contact, ranges)
        for number in progress(numbers, len(numbers), "scans of the pool")
    ]
    targets = required_targets(substitute)
    return xr.concat(scans, pd.Index(list(numbers), name="scan")).assign_attrs(
        mean_rms_height=targets.means["rms_height"], rms_height_deviation=targets.rms_height_std
    )


def pool_scan(number: int, substitute: Substitute) -> HeightMap:
    """Return a levelled scan of the pool, with the rms height of its sample."""
    rng = substitute.generator(number, "pool")
    return level(sample_scan(rng, substitute.spectrum, substitute.grid))


def smooth_sphere_forces(scan: HeightMap, contact: Contact, ranges: list[float]) -> xr.DataArray:
    """Return the pull-off forces of a smooth sphere on a levelled scan, mirrored."""
    bodies = join_bodies(mirror_scan(scan), None, contact)
    return pull_off_dataset(bodies, contact, ranges)["pull_off_force"]


def forces_at_heights(
    scan: HeightMap, rms_heights: Floats, contact: Contact, ranges: list[float]
) -> xr.Dataset:
    """Return the forces on a levelled scan at several rms heights, and its unscaled metrics.

    ``log_force`` (rms_height_of_force, contact_model, rho, contact_y, contact_x) is ln(force in N).
    Rms heights and ranges of adhesion are in nm.
    """
    roughness = measured_metrics(scan, TABLE1_METRICS.values())
    forces = []
    for rms_height in rms_heights:
        factor = rms_height / roughness["rms_height"].item()
        scaled = replace(scan, heights=factor * scan.heights)
        forces.append(smooth_sphere_forces(scaled, contact, ranges))
    axis = xr.Variable("rms_height_of_force", rms_heights, NM)
    height_forces = xr.concat(forces, xr.DataArray(axis, name="rms_height_of_force"))
    log_force: xr.DataArray = xr.apply_ufunc(np.log, height_forces).astype("float32")
    log_force.attrs = DIMENSIONLESS
    contacts = range(contact.contacts_per_row)
    coordinates = {"rms_height_of_force": axis, "contact_y": contacts, "contact_x": contacts}
    return roughness.assign(log_force=log_force.drop_vars(coordinates)).assign_coords(coordinates)
