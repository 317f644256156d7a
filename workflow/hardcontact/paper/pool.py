"""Pool of substitute scans: their forces at several rms heights, and the scans that a set takes.

A set is a random choice of scans, whose rms heights are scaled to Table 1. Forces on a set are
interpolated between the forces at a few rms heights, which span all heights that sets need.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.progress import progress
from hardcontact.base.units import DIMENSIONLESS, NEWTON, NM
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.inference.fit import spline_weights
from hardcontact.surfaces.height_map import HeightMap, mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics_dataset
from hardcontact.surfaces.substitutes import (
    Substitute,
    Targets,
    required_targets,
    scale_rms_heights,
)
from hardcontact.surfaces.synthesis import sample_scan

#: Smallest rms height of a pool relative to the mean: sets with smoother scans are sampled again.
MIN_HEIGHT_RATIO = 0.05
#: Largest number of tries to find a set without smoother scans.
MAX_TRIES = 1000


def pool_rms_heights(targets: Targets, scan_count: int, height_count: int) -> Floats:
    """Return the ascending rms heights (n,) in nm at which the forces of a pool are computed.

    In a set of k scans none is more than (k - 1)/sqrt(k) standard deviations from their mean, so
    the heights reach that far, but not below MIN_HEIGHT_RATIO. Their square roots are evenly
    spaced, because forces change faster at small heights. A single scan needs only the mean.
    """
    mean = targets.means["rms_height"]
    if scan_count == 1:
        return np.array([mean])
    reach = targets.rms_height_std * (scan_count - 1) / np.sqrt(scan_count)
    lowest = max(mean - reach, MIN_HEIGHT_RATIO * mean)
    return np.asarray(np.linspace(lowest**0.5, (mean + reach) ** 0.5, height_count) ** 2)


def compute_pool(
    scan_numbers: Sequence[int],
    substitute: Substitute,
    rms_heights: Floats,
    contact: Contact,
    ranges: list[float],
) -> xr.Dataset:
    """Return the metrics of Table 1 of some scans of a pool, by number, and the forces on them.

    ``log_force`` (scan, rms_height_of_force, contact_model, rho, contact_y, contact_x) is ln(force
    in N) at 1 J/m².
    """
    scan_datasets = []
    for scan_number in progress(scan_numbers, len(scan_numbers), "scans of the pool"):
        rng = substitute.generator(scan_number, "pool")
        scan = level_plane(sample_scan(rng, substitute.spectrum, substitute.grid))
        scan_datasets.append(_forces_at_heights(scan, rms_heights, contact, ranges))
    targets = required_targets(substitute)
    return xr.concat(scan_datasets, pd.Index(list(scan_numbers), name="scan")).assign_attrs(
        mean_rms_height=targets.means["rms_height"], rms_height_deviation=targets.rms_height_std
    )


def _forces_at_heights(
    scan: HeightMap, rms_heights: Floats, contact: Contact, ranges: list[float]
) -> xr.Dataset:
    """Return the metrics of a levelled scan, and ``log_force`` on it at other rms heights."""
    roughness = metrics_dataset(scan, TABLE1_METRICS.values())
    factors = rms_heights / roughness["rms_height"].item()
    forces = [
        smooth_sphere_forces(replace(scan, heights=factor * scan.heights), contact, ranges)
        for factor in factors
    ]
    height_axis = xr.Variable("rms_height_of_force", rms_heights, NM)
    log_force: xr.DataArray = xr.apply_ufunc(np.log, xr.concat(forces, "rms_height_of_force"))
    contact_numbers = range(contact.contacts_per_row)
    log_force = log_force.astype("float32").assign_attrs(DIMENSIONLESS)
    return roughness.assign(log_force=log_force).assign_coords(
        rms_height_of_force=height_axis, contact_y=contact_numbers, contact_x=contact_numbers
    )


def smooth_sphere_forces(scan: HeightMap, contact: Contact, ranges: list[float]) -> xr.DataArray:
    """Return the pull-off forces in N at 1 J/m² of a smooth sphere on the mirrored scan."""
    bodies = join_bodies(mirror_scan(scan), None, contact)
    return pull_off_dataset(bodies, contact, ranges)["pull_off_force"]


def sample_pool_scans(pool: xr.Dataset, rng: np.random.Generator, scan_count: int) -> xr.Dataset:
    """Return the scans of one substrate in a set, sampled from its pool without replacement.

    Their rms heights have the mean and the standard deviation of Table 1. Raises ValueError if each
    try has a smoother scan than the pool.
    """
    lowest = pool["rms_height_of_force"].values.min()
    mean = pool.attrs["mean_rms_height"]
    deviation = pool.attrs["rms_height_deviation"]
    for _ in range(MAX_TRIES):
        scans = pool.isel(scan=rng.choice(pool.sizes["scan"], scan_count, replace=False))
        heights = scale_rms_heights(scans["rms_height"].values, mean, deviation)
        if heights.min() >= lowest * (1 - 1e-9):
            return _scale_scans(scans, heights)
    raise ValueError(
        f"expected sets of {scan_count} scans with rms heights of {mean:.3g} +- {deviation:.3g} "
        f"nm, found none above {lowest:.3g} nm in {MAX_TRIES} tries"
    )


def _scale_scans(scans: xr.Dataset, heights: Floats) -> xr.Dataset:
    """Return the forces and metrics of scans of a pool at other rms heights (scan,) in nm.

    Metrics grow in proportion to heights. Logarithms of forces are interpolated over the square
    roots of the rms heights at which they were computed.
    """
    factor = heights / scans["rms_height"].values
    # Extrapolated, because rounding may take a height slightly beyond the computed heights.
    computed_roots = np.sqrt(scans["rms_height_of_force"].values)
    weights = spline_weights(computed_roots, np.sqrt(heights), extrapolate=True)
    log_forces = np.einsum("na,na...->n...", weights, scans["log_force"].values)
    axes = ("scan", "contact_model", "rho", *CONTACT_AXES)
    variables = {
        name: ("scan", scans[name].values * factor, scans[name].attrs)
        for name in TABLE1_METRICS.values()
    } | {
        "pull_off_force": (axes, np.exp(log_forces), NEWTON),
        "number": ("scan", scans["scan"].values),
    }
    coordinates = {"scan": np.arange(1, len(heights) + 1)}
    return xr.Dataset(variables, coordinates | {name: scans[name] for name in axes[1:]})
