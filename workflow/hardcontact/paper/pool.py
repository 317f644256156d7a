"""Pool of substitute scans from which sets are sampled: forces of each scan at several rms heights.

A set multiplies the heights of each of its scans by a factor. Forces on a smooth sphere are
computed at a few rms heights, which span all heights of sets, and are interpolated between them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypedDict

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base import dataset, published
from hardcontact.base.job import progress
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_of_pair
from hardcontact.surfaces.conditioning import Targets, scan_targets
from hardcontact.surfaces.height_map import METRICS, HeightMap, level, metrics, mirror_stitch
from hardcontact.surfaces.spectrum import Floats, Spectrum, spectrum_of_dataset
from hardcontact.surfaces.substitute_scans import ScanGrid, sample_scan
from hardcontact.surfaces.substitute_spectra import rows_of_surface

#: Smallest height of a pool relative to the mean height: no set of a few scans has a smoother scan.
MIN_HEIGHT_RATIO = 0.05


class PoolSettings(TypedDict):
    """Settings of the scans of a pool and of their contacts."""

    seed: int  #: Seed of the study.
    surface: str  #: Name of the substrate.
    scan: ScanGrid
    contact: Contact  #: Contact with a smooth sphere.
    ranges: list[float]  #: Ranges of adhesion in nm.


class PoolSources(NamedTuple):
    """Spectrum, targets, rms heights and settings of the scans of a pool."""

    spectrum: Spectrum  #: C_iso of the substrate.
    targets: Targets
    rms_heights: Floats  #: From `pool_heights`.
    settings: PoolSettings


def read_pool_sources(inputs: Any, parameters: Mapping[str, Any]) -> PoolSources:
    """Read spectrum, targets, rms heights and settings of the scans of a pool.

    inputs: paths as attributes: ``spectrum``, ``published_table1`` and ``published_constants``.
    Returns everything from which scans of the pool are made.
    Raises ValueError if the paper has no rms height of the surface.
    """
    spectrum = dataset.read(inputs.spectrum)
    table1 = published.table1(inputs.published_table1)
    constants = published.constants(inputs.published_constants)
    surface = parameters["surface"]
    grid = ScanGrid(**parameters["scan"])
    rows = rows_of_surface(table1, surface)
    targets = scan_targets(spectrum, rows, constants, grid)
    if targets is None:
        raise ValueError(f"{surface}: expected a published rms height, found none")
    return PoolSources(
        spectrum_of_dataset(spectrum),
        targets,
        pool_heights(targets, parameters["scans"], parameters["rms_heights"]),
        PoolSettings(
            seed=parameters["seed"],
            surface=surface,
            scan=grid,
            contact=Contact(radius=parameters["radius"], **parameters["contact"]),
            ranges=parameters["ranges"],
        ),
    )


def pool_heights(targets: Targets, scans: int, count: int) -> Floats:
    """Return the rms heights at which the forces of a pool are computed.

    No value of a sample of n is farther from its mean than (n - 1)/sqrt(n) of its standard
    deviations. The heights are evenly spaced in their root, because forces change faster at small
    heights. A set of one scan has no deviation and needs a single height.

    targets: mean and deviation of the rms heights of a set.
    Returns ascending heights (count,) in nm.
    """
    mean = targets.means["rms_height"]
    if scans == 1:
        return np.array([mean])
    reach = targets.rms_height_std * (scans - 1) / np.sqrt(scans)
    lowest = max(mean - reach, MIN_HEIGHT_RATIO * mean)
    return np.asarray(np.linspace(lowest**0.5, (mean + reach) ** 0.5, count) ** 2)


def height_weights(heights: Floats, targets: Floats) -> Floats:
    """Return the weights that interpolate between heights by a cubic spline in their root.

    heights: ascending heights (rms_height_of_force,) in nm.
    targets: heights (target,) in nm of the interpolation.
    Returns weights (target, rms_height_of_force).
    """
    from scipy.interpolate import make_interp_spline

    if len(heights) == 1:
        return np.ones((len(targets), 1))
    degree = min(3, len(heights) - 1)
    spline = make_interp_spline(np.sqrt(heights), np.eye(len(heights)), k=degree)
    return np.asarray(spline(np.sqrt(targets)))


def compute_pool(numbers: Sequence[int], sources: PoolSources) -> xr.Dataset:
    """Return the forces of some scans of a pool on a smooth sphere, and their roughness.

    numbers: numbers of the scans in the pool.
    sources: from `read_pool_sources`. Mean and deviation of its targets become attributes.
    Returns by scan: ``log_force`` (rms_height_of_force, contact_model, rho, contact_y, contact_x),
        the logarithm of forces in N, and METRICS of the unscaled scan.
    """
    scans = [
        _pool_scan(number, sources)
        for number in progress(numbers, len(numbers), "scans of the pool")
    ]
    targets = sources.targets
    return xr.concat(scans, pd.Index(list(numbers), name="scan")).assign_attrs(
        mean_rms_height=targets.means["rms_height"], rms_height_deviation=targets.rms_height_std
    )


def _pool_scan(number: int, sources: PoolSources) -> xr.Dataset:
    """Return the forces and the roughness of one scan."""
    spectrum, _, rms_heights, settings = sources
    rng = generator(settings["seed"], settings["surface"], number, "pool")
    scan = level(sample_scan(rng, spectrum, settings["scan"]))
    return forces_at_heights(scan, rms_heights, settings["contact"], settings["ranges"])


def forces_at_heights(
    scan: HeightMap, rms_heights: Floats, contact: Contact, ranges: Sequence[float]
) -> xr.Dataset:
    """Return the forces on a levelled scan at several rms heights, and its roughness.

    rms_heights: rms heights in nm.
    contact: contact with a smooth sphere.
    ranges: ranges of adhesion in nm.
    Returns METRICS of the unscaled scan, and ``log_force`` (rms_height_of_force, contact_model,
        rho, contact_y, contact_x), the logarithm of forces in N.
    """
    roughness = metrics(scan)
    forces = []
    for rms_height in rms_heights:
        scaled = replace(scan, heights=rms_height / roughness["rms_height"] * scan.heights)
        contact_bodies = bodies(mirror_stitch(scaled), None, contact)
        forces.append(pull_off_of_pair(contact_bodies, contact, ranges)["pull_off_force"])
    axis = xr.DataArray(rms_heights, dims="rms_height_of_force", name="rms_height_of_force")
    height_forces = xr.concat(forces, axis).drop_vars(["contact_y", "contact_x"])
    log_force: xr.DataArray = xr.apply_ufunc(np.log, height_forces).astype("float32")
    return xr.Dataset(
        {
            "log_force": log_force.assign_attrs(
                units="1", long_name="logarithm of the pull-off force in N at W = 1 J/m2"
            )
        }
        | {
            name: ((), roughness[name], {"units": unit, "long_name": long_name})
            for name, (unit, long_name) in METRICS.items()
        },
        {
            "rms_height_of_force": ("rms_height_of_force", rms_heights, {"units": "nm"}),
            "contact_y": range(contact.count),
            "contact_x": range(contact.count),
        },
    )
