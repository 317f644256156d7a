"""Draws of a surface with features: forces on a group of scans of each, for the sets.

A draw is one random choice of the features of a surface, and of scans with these features that
have the roughness of Table 1. Forces never enter the choice.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.dataset import concatenate, stack
from hardcontact.base.job import progress
from hardcontact.base.statistics import lognormal_shape
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.contact.contact import Contact
from hardcontact.contact.force_curves import interpolate_to_ranges
from hardcontact.inference.published_fit import PublishedFit
from hardcontact.paper.pool import smooth_sphere_forces
from hardcontact.surfaces.featured_scans import (
    FeaturedSurface,
    describe_features,
    read_featured_surface,
    sample_group,
)
from hardcontact.surfaces.features import KINDS, SIGNS
from hardcontact.surfaces.height_map import TABLE1_METRICS, HeightMap, level
from hardcontact.surfaces.roughness_table import measured_metrics

#: Largest factor between computed and published force of a draw that agrees. It holds for the mean
#: and for the median force, at the published range and work of adhesion.
MAX_FORCE_FACTOR = 2.0
#: Statistics of forces on a draw, with their units.
DRAW_STATISTICS = {
    "mean_force": NEWTON, "median_force": NEWTON, "log_force_std": DIMENSIONLESS,
    "agrees": DIMENSIONLESS,
}  # fmt: skip
Floats = NDArray[np.float64]


class DrawSources(NamedTuple):
    """Everything from which the forces of draws are computed."""

    featured: FeaturedSurface
    scans: int  #: Number of scans of a draw.
    contact: Contact  #: Contact with a smooth sphere.
    ranges: list[float]  #: Ranges of adhesion in nm.


def read_draw_sources(inputs: Any, parameters: Mapping[str, Any]) -> DrawSources:
    """Read the sources of draws: the spectrum, Table 1 and constants at the paths of the inputs."""
    featured = read_featured_surface(inputs, parameters)
    contact = Contact(radius=parameters["radius"], **parameters["contact"])
    return DrawSources(featured, parameters["scans"], contact, parameters["ranges"])


def compute_draws(kind: str, numbers: Sequence[int], sources: DrawSources) -> xr.Dataset:
    """Return forces (draw, scan, contact_model, rho, contact) in N at 1 J/m², and metrics.

    The kind of surface is bumps, pits or gaussian.
    """
    draws = [
        _compute_draw(kind, number, sources)
        for number in progress(numbers, len(numbers), "surfaces with features")
    ]
    return xr.concat(draws, pd.Index(list(numbers), name="draw"))


def _compute_draw(kind: str, number: int, sources: DrawSources) -> xr.Dataset:
    """Return forces, roughness and features of one draw."""
    scans = range(1, sources.scans + 1)
    features, group = sample_group(sources.featured, kind, scans, number)
    forces = {(scan,): _scan_forces(level(group[scan - 1]), sources) for scan in scans}
    base_rms_height = sources.featured.mean_rms_height
    return stack(forces, ["scan"]).assign(describe_features(features, base_rms_height))


def _scan_forces(scan: HeightMap, sources: DrawSources) -> xr.Dataset:
    """Return the forces of a smooth sphere on a levelled scan, and its metrics of Table 1."""
    roughness = measured_metrics(scan, TABLE1_METRICS.values())
    return roughness.assign(
        pull_off_force=smooth_sphere_forces(scan, sources.contact, sources.ranges)
    )


def draw_of_set(draws: Mapping[str, xr.Dataset], set_number: int) -> xr.Dataset:
    """Return the draw of a set: odd sets have bumps, even sets pits.

    Draws are by kind. No draw is in two sets.
    """
    index = set_number - 1
    kind = list(SIGNS)[index % len(SIGNS)]
    return draws[kind].isel(draw=index // len(SIGNS), drop=True)


def draws_by_surface(
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
) -> dict[str, dict[str, xr.Dataset]]:
    """Join chunks of draws, by surface, kind of features, first and last draw."""
    surfaces: dict[str, dict[str, xr.Dataset]] = {}
    for (surface, kind), draws in concatenate(chunks, "draw", 2).items():
        surfaces.setdefault(surface, {})[kind] = draws
    return surfaces


def compare_with_published(
    draws: Mapping[str, xr.Dataset],
    sphere_factor: xr.DataArray,
    published_fit: PublishedFit,
    surface: str,
) -> xr.Dataset:
    """Return the plastic forces (features, draw) of draws at the published pair.

    sphere_factor: (rho) force on the rough sphere relative to a smooth one. ``agrees`` is 1 if mean
    and median force are within MAX_FORCE_FACTOR of the published ones.
    """
    targets: dict[Any, float] = published_fit.forces.loc[surface].to_dict()
    rho, work = published_fit.pair
    kinds = []
    for kind_draws in draws.values():
        forces = kind_draws["pull_off_force"] * sphere_factor
        forces = forces.stack(contact=("scan", "contact_y", "contact_x"))
        values = forces.transpose("draw", "contact", "rho").values
        pair_forces = work * interpolate_to_ranges(values, forces["rho"].values, np.array([rho]))
        statistics = _force_statistics(pair_forces[..., 0], targets)
        descriptions = [name for name in kind_draws if kind_draws[name].dims == ("draw",)]
        kinds.append(kind_draws[descriptions].assign(statistics))
    shape = lognormal_shape(targets["mean_force"], targets["median_force"])
    return xr.concat(kinds, pd.Index(list(draws), name="features"), join="outer").assign_attrs(
        surface=surface,
        basis="substitute",
        published_mean_force=targets["mean_force"],
        published_median_force=targets["median_force"],
        published_log_force_std=float(shape),
    )


def no_draws() -> xr.Dataset:
    """Return the dataset of `compare_with_published` of a study without such a surface."""
    empty = ("features", "draw"), np.empty((len(KINDS), 0))
    return xr.Dataset(
        {name: (*empty, unit) for name, unit in DRAW_STATISTICS.items()},
        {"features": list(KINDS), "draw": np.arange(0)},
        {"surface": "", "label": "", "basis": "substitute"},
    )


def _force_statistics(forces: Floats, targets: Mapping[Any, float]) -> dict[str, Any]:
    """Return the DRAW_STATISTICS of forces (draw, contact) in N."""
    mean = forces.mean(axis=1)
    median = np.median(forces, axis=1)
    scatter = np.log(forces).std(axis=1)
    errors = [np.log(mean / targets["mean_force"]), np.log(median / targets["median_force"])]
    agrees = np.abs(errors).max(axis=0) <= np.log(MAX_FORCE_FACTOR)
    values = (mean, median, scatter, agrees.astype(float))
    return {
        name: ("draw", value, unit)
        for (name, unit), value in zip(DRAW_STATISTICS.items(), values, strict=True)
    }
