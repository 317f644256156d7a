"""The pool that sets of substitute scans are drawn from: forces of each scan at several heights.

A set multiplies the heights of each of its scans by a factor. Forces are computed at a few rms
heights that span what a set may ask for, and interpolated between them. They are those on a smooth
sphere; what its roughness changes is measured on the study's own scans, and applied to all sets.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypedDict

import numpy as np
import pandas as pd
import xarray as xr
from scipy.interpolate import make_interp_spline

from hardcontact.adhesion.pull_off import pull_off_of_pair
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.numbers.random import generator
from hardcontact.records.job import progress
from hardcontact.surfaces.conditioning import Targets
from hardcontact.surfaces.height_map import METRICS, HeightMap, level, metrics, mirror_stitch
from hardcontact.surfaces.spectrum import Density, Floats
from hardcontact.surfaces.substitute_scans import ScanGrid, drawn_scan

#: Least height of a pool, over the mean height: no set of a few scans has a smoother one.
LEAST = 0.05


class PoolSettings(TypedDict):
    """What the scans of a pool and their contacts are made with."""

    seed: int  #: The seed of the study.
    surface: str  #: Name of the substrate.
    scan: ScanGrid
    contact: Contact  #: With a smooth sphere.
    ranges: list[float]  #: Of adhesion, in nm.


def pool_heights(targets: Targets, scans: int, amplitudes: int) -> Floats:
    """Return the rms heights (amplitudes,), in nm and ascending, that forces are computed at.

    No value of a sample of n lies farther from its mean than (n - 1)/sqrt(n) of its standard
    deviations. The heights are evenly spaced in their root: forces change faster where heights are
    small. A set of one scan has no deviation, so that a single height is enough.
    """
    mean = targets.means["rms_height"]
    if scans == 1:
        return np.array([mean])
    reach = targets.deviation * (scans - 1) / np.sqrt(scans)
    least = max(mean - reach, LEAST * mean)
    return np.asarray(np.linspace(least**0.5, (mean + reach) ** 0.5, amplitudes) ** 2)


def height_weights(heights: Floats, at: Floats) -> Floats:
    """Return the weights (at, amplitude) of logarithms of forces at `heights`, all in nm.

    Those of a cubic spline in the root of the height.
    """
    if len(heights) == 1:
        return np.ones((len(at), 1))
    degree = min(3, len(heights) - 1)
    spline = make_interp_spline(np.sqrt(heights), np.eye(len(heights)), k=degree)
    return np.asarray(spline(np.sqrt(at)))


def compute_pool(
    numbers: Sequence[int],
    density: Density,
    targets: Targets,
    heights: Floats,
    settings: PoolSettings,
) -> xr.Dataset:
    """Return the forces of some scans of a pool on a smooth sphere, and their roughness.

    The density is C_iso in nm⁴ as a function of the wavevector in rad/nm, `heights` (amplitude,)
    are those of `pool_heights`; mean and deviation of the targets are kept as attributes. Over scan
    follow `log_force` (scan, rms_height_of_force, contact_model, rho, contact_y, contact_x), the
    logarithm of forces in N; METRICS of the scan as it was drawn; and `interpolation_error` (scan,
    contact_model, rho) of the logarithm of the mean force, at one height drawn at random.
    """
    parts = [
        _pool_scan(number, density, heights, settings)
        for number in progress(numbers, len(numbers), "scans of the pool")
    ]
    return xr.concat(parts, pd.Index(list(numbers), name="scan")).assign_attrs(
        mean_rms_height=targets.means["rms_height"], rms_height_deviation=targets.deviation
    )


def _pool_scan(
    number: int, density: Density, heights: Floats, settings: PoolSettings
) -> xr.Dataset:
    """Return the forces and the roughness of one scan."""
    rng = generator(settings["seed"], settings["surface"], number, "pool")
    scan = level(drawn_scan(rng, density, settings["scan"]))
    roughness = metrics(scan)
    between = rng.uniform(*np.sqrt(heights[[0, -1]])) ** 2
    *computed, direct = (
        _log_forces(scan, height / roughness["rms_height"], settings)
        for height in (*heights, between)
    )
    log_forces = np.array(computed)
    interpolated = np.tensordot(height_weights(heights, np.array([between]))[0], log_forces, 1)
    error = np.log(np.exp(interpolated).mean(axis=(-2, -1)) / np.exp(direct).mean(axis=(-2, -1)))
    axes = ("contact_model", "rho")
    variables: dict[str, Any] = {
        "log_force": (
            ("rms_height_of_force", *axes, "contact_y", "contact_x"),
            log_forces.astype("float32"),
            {"units": "1", "long_name": "logarithm of the pull-off force in N at W = 1 J/m2"},
        ),
        "interpolation_error": (
            axes,
            error,
            {"units": "1", "long_name": "relative error of the interpolated mean force"},
        ),
    } | {
        name: ((), roughness[name], {"units": unit, "long_name": long_name})
        for name, (unit, long_name) in METRICS.items()
    }
    coordinates: dict[str, Any] = {
        "rms_height_of_force": ("rms_height_of_force", heights, {"units": "nm"}),
        "contact_model": ["rigid", "plastic"],
        **{axis: range(log_forces.shape[-1]) for axis in ("contact_y", "contact_x")},
        "rho": ("rho", np.asarray(settings["ranges"], float), {"units": "nm"}),
    }
    return xr.Dataset(variables, coordinates)


def _log_forces(scan: HeightMap, factor: float, settings: PoolSettings) -> Floats:
    """Return the logarithms of the forces (contact_model, rho, contact_y, contact_x) in N.

    Those of a scan whose heights are multiplied by a factor, on a smooth sphere.
    """
    stitched = mirror_stitch(replace(scan, heights=factor * scan.heights))
    contact = settings["contact"]
    pair = bodies(stitched, None, contact)
    forces = pull_off_of_pair(pair, contact, settings["ranges"])["pull_off_force"].values
    return np.asarray(np.log(forces))
