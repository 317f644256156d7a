"""Samples of a surface with features (bumps or pits), and the forces on their scans, for sets.nc.

A sample is one random choice of the features of a surface, and of scans with these features that
have the roughness of Table 1. Forces never enter the choice.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import concatenate, stack
from hardcontact.base.statistics import log_std_of_lognormal
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, Contact
from hardcontact.contact.pull_off import interpolate_to_ranges
from hardcontact.paper.pool import smooth_sphere_forces
from hardcontact.paper.published_fit import PublishedForces
from hardcontact.records.job import progress
from hardcontact.surfaces.featured_scans import FeaturedSurface, describe_features, sample_group
from hardcontact.surfaces.features import KINDS, SIGNS
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level
from hardcontact.surfaces.metrics import TABLE1_METRICS, measured_metrics

#: Largest factor between computed and published force of a sample that agrees. It holds for the
#: mean and for the median force, at the published range and work of adhesion.
MAX_FORCE_FACTOR = 2.0
#: Statistics of forces on a sample, with their units.
SAMPLE_ATTRS = {
    "mean_force_at_pair": NEWTON, "median_force_at_pair": NEWTON, "log_force_std": DIMENSIONLESS,
    "agrees": DIMENSIONLESS,
}  # fmt: skip


class SampleInputs(NamedTuple):
    """Everything from which the forces of samples are computed."""

    featured: FeaturedSurface
    scan_count: int  #: Number of scans of a sample.
    contact: Contact  #: Contact with a smooth sphere.
    ranges: list[float]  #: Ranges of adhesion in nm.


def compute_samples(kind: str, numbers: Sequence[int], inputs: SampleInputs) -> xr.Dataset:
    """Return forces (sample, scan, contact_model, rho, contact_y, contact_x) in N, and metrics.

    Forces are at 1 J/m². The kind of surface is bumps, pits or gaussian.
    """
    samples = [
        _compute_sample(kind, number, inputs)
        for number in progress(numbers, len(numbers), "surfaces with features")
    ]
    return xr.concat(samples, pd.Index(list(numbers), name="sample"))


def _compute_sample(kind: str, number: int, inputs: SampleInputs) -> xr.Dataset:
    """Return forces, roughness and features of one sample."""
    scans = range(1, inputs.scan_count + 1)
    features, group = sample_group(inputs.featured, kind, scans, number)
    forces = {(scan,): _scan_forces(level(group[scan - 1]), inputs) for scan in scans}
    base_rms_height = inputs.featured.mean_rms_height
    return stack(forces, ["scan"]).assign(describe_features(features, base_rms_height))


def _scan_forces(scan: HeightMap, inputs: SampleInputs) -> xr.Dataset:
    """Return the forces of a smooth sphere on a levelled scan, and its metrics of Table 1."""
    roughness = measured_metrics(scan, TABLE1_METRICS.values())
    return roughness.assign(
        pull_off_force=smooth_sphere_forces(scan, inputs.contact, inputs.ranges)
    )


def sample_of_set(samples: Mapping[str, xr.Dataset], set_number: int) -> xr.Dataset:
    """Return the sample of a set: odd sets have bumps, even sets pits.

    Samples are by kind. No sample is in two sets.
    """
    index = set_number - 1
    kind = list(SIGNS)[index % len(SIGNS)]
    return samples[kind].isel(sample=index // len(SIGNS), drop=True)


def samples_by_surface(
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
) -> dict[str, dict[str, xr.Dataset]]:
    """Join chunks of samples, by surface, kind of features, first and last sample."""
    surfaces: dict[str, dict[str, xr.Dataset]] = {}
    for (surface, kind), samples in concatenate(chunks, "sample", 2).items():
        surfaces.setdefault(surface, {})[kind] = samples
    return surfaces


def compare_features(
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
    sphere_factors: xr.DataArray,
    published: PublishedForces,
    labels: Mapping[str, str],
) -> xr.Dataset:
    """Return `compare_with_published` of the surface with features; empty without samples of it.

    `chunks` are those of `samples_by_surface`, `sphere_factors` (surface, contact_model, rho).
    """
    for surface, kinds in samples_by_surface(chunks).items():
        plastic = {kind: samples.sel(contact_model=PLASTIC) for kind, samples in kinds.items()}
        factor = sphere_factors.sel(contact_model=PLASTIC, surface=surface, drop=True)
        comparison = compare_with_published(plastic, factor, published, surface)
        return comparison.assign_attrs(label=labels[surface])
    return empty_comparison()


def compare_with_published(
    samples: Mapping[str, xr.Dataset],
    sphere_factor: xr.DataArray,
    published: PublishedForces,
    surface: str,
) -> xr.Dataset:
    """Return the plastic forces (features, sample) of samples at the published pair.

    `sphere_factor` (rho) is the force on the rough sphere relative to a smooth sphere. ``agrees``
    is 1 if mean and median force are within MAX_FORCE_FACTOR of the published forces.
    """
    targets: dict[Any, float] = published.forces.loc[surface].to_dict()
    rho, work = published.pair
    kinds = []
    for kind_samples in samples.values():
        forces = kind_samples["pull_off_force"] * sphere_factor
        forces = forces.stack(contact=("scan", *CONTACT_AXES))
        values = forces.transpose("sample", "contact", "rho").values
        pair_forces = work * interpolate_to_ranges(values, forces["rho"].values, np.array([rho]))
        statistics = _force_statistics(pair_forces[..., 0], targets)
        descriptions = [name for name in kind_samples if kind_samples[name].dims == ("sample",)]
        kinds.append(kind_samples[descriptions].assign(statistics))
    log_std = log_std_of_lognormal(targets["mean_force"], targets["median_force"])
    return xr.concat(kinds, pd.Index(list(samples), name="features"), join="outer").assign_attrs(
        surface=surface,
        source="substitute",
        published_mean_force=targets["mean_force"],
        published_median_force=targets["median_force"],
        published_log_force_std=float(log_std),
    )


def empty_comparison() -> xr.Dataset:
    """Return an empty dataset like `compare_with_published`, for a study without features."""
    empty = ("features", "sample"), np.empty((len(KINDS), 0))
    return xr.Dataset(
        {name: (*empty, unit) for name, unit in SAMPLE_ATTRS.items()},
        {"features": list(KINDS), "sample": np.arange(0)},
        {"surface": "", "label": "", "source": "substitute"},
    )


def _force_statistics(forces: Floats, targets: Mapping[Any, float]) -> dict[str, Any]:
    """Return the SAMPLE_ATTRS of forces (sample, contact) in N."""
    mean = forces.mean(axis=1)
    median = np.median(forces, axis=1)
    scatter = np.log(forces).std(axis=1)
    errors = [np.log(mean / targets["mean_force"]), np.log(median / targets["median_force"])]
    agrees = np.abs(errors).max(axis=0) <= np.log(MAX_FORCE_FACTOR)
    values = (mean, median, scatter, agrees.astype(float))
    return {
        name: ("sample", value, unit)
        for (name, unit), value in zip(SAMPLE_ATTRS.items(), values, strict=True)
    }
