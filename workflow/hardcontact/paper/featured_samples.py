"""Samples of a surface with features, bumps or pits: forces on their scans (sets.nc, features.nc).

A sample is one random choice of the features of a surface, and of scans with these features that
have the roughness of Table 1. Forces never enter the choice.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.dataset import concatenate, stack
from hardcontact.base.progress import progress
from hardcontact.base.statistics import log_std_of_lognormal
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, Contact
from hardcontact.contact.pull_off import interpolate_to_range
from hardcontact.paper.pool import smooth_sphere_forces
from hardcontact.paper.published_fit import PublishedForces
from hardcontact.surfaces.featured_scans import FeaturedSurface, describe_features, sample_group
from hardcontact.surfaces.features import KINDS, SIGNS
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, measured_metrics

#: Largest factor between computed and published force of a sample that agrees. It holds for the
#: mean and for the median force, at the published range and work of adhesion.
MAX_FORCE_FACTOR = 2.0
#: Statistics of forces on a sample, with their units.
SAMPLE_STATISTICS = {
    "mean_force_at_pair": NEWTON, "median_force_at_pair": NEWTON, "log_force_std": DIMENSIONLESS,
    "agrees": DIMENSIONLESS,
}  # fmt: skip


def compute_samples(
    kind: str,
    numbers: Sequence[int],
    featured: FeaturedSurface,
    scan_count: int,
    contact: Contact,
    ranges: list[float],
) -> xr.Dataset:
    """Return features, roughness and forces of samples of a kind: bumps, pits or gaussian.

    Forces (sample, scan, contact_model, rho, contact_y, contact_x) of a smooth sphere are in N at 1
    J/m², at ranges in nm.
    """
    samples = []
    for number in progress(numbers, len(numbers), "surfaces with features"):
        features, scans = sample_group(featured, kind, range(1, scan_count + 1), number)
        scan_results = {}
        for index, scan in enumerate(map(level_plane, scans), 1):
            forces = smooth_sphere_forces(scan, contact, ranges)
            roughness = measured_metrics(scan, TABLE1_METRICS.values())
            scan_results[(index,)] = roughness.assign(pull_off_force=forces)
        description = describe_features(features, featured.mean_rms_height)
        samples.append(stack(scan_results, ["scan"]).assign(description))
    return xr.concat(samples, pd.Index(list(numbers), name="sample"))


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
    """Return features.nc: `compare_with_published` of the only surface with features.

    `chunks` are those of `samples_by_surface`, `sphere_factors` (surface, contact_model, rho). The
    dataset is empty if no surface has features.
    """
    if not chunks:
        return empty_comparison()
    ((surface, samples),) = samples_by_surface(chunks).items()
    plastic = {kind: forces.sel(contact_model=PLASTIC) for kind, forces in samples.items()}
    factor = sphere_factors.sel(contact_model=PLASTIC, surface=surface, drop=True)
    comparison = compare_with_published(plastic, factor, published, surface)
    return comparison.assign_attrs(label=labels[surface])


def compare_with_published(
    samples: Mapping[str, xr.Dataset],
    sphere_factor: xr.DataArray,
    published: PublishedForces,
    surface: str,
) -> xr.Dataset:
    """Return SAMPLE_STATISTICS (features, sample) of plastic forces at the published pair.

    `sphere_factor` (rho) is the force on the rough sphere relative to a smooth sphere. ``agrees``
    is 1 if mean and median force are within MAX_FORCE_FACTOR of the published forces.
    """
    targets: dict[Any, float] = published.forces.loc[surface].to_dict()
    rho, work = published.pair
    kinds = []
    for kind_samples in samples.values():
        forces = work * interpolate_to_range(kind_samples["pull_off_force"] * sphere_factor, rho)
        contacts = forces.stack(contact=("scan", *CONTACT_AXES)).transpose("sample", "contact")
        mean, median = contacts.values.mean(axis=1), np.median(contacts, axis=1)
        factors = np.array([mean / targets["mean_force"], median / targets["median_force"]])
        agrees = (np.abs(np.log(factors)) <= np.log(MAX_FORCE_FACTOR)).all(axis=0)
        values = (mean, median, np.log(contacts.values).std(axis=1), agrees.astype(float))
        statistics = {
            name: ("sample", value, unit)
            for (name, unit), value in zip(SAMPLE_STATISTICS.items(), values, strict=True)
        }
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
        {name: (*empty, unit) for name, unit in SAMPLE_STATISTICS.items()},
        {"features": list(KINDS), "sample": np.arange(0)},
        {"surface": "", "label": "", "source": "substitute"},
    )
