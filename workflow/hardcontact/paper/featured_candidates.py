"""Candidates for a surface with features, bumps or pits, and the forces on them (features.nc).

A candidate is one random choice of features, and scans with these features that have the roughness
of Table 1. Each set takes one candidate; measured forces never enter its choice. Surfaces without
features, of the kind ``gaussian``, are computed for comparison.
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
from hardcontact.inference.fit import interpolate_forces
from hardcontact.inference.published_fit import PublishedForces
from hardcontact.paper.pool import smooth_sphere_forces
from hardcontact.surfaces.features import (
    FEATURE_KINDS,
    FEATURE_SIGNS,
    FeaturedSurface,
    alternating_feature_kind,
    sample_featured_scans,
)
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics_dataset

#: Largest factor between computed and published force of a candidate that agrees, for the mean and
#: for the median force, at the published range and work of adhesion. It is only reported.
MAX_FORCE_FACTOR = 2.0
#: Statistics of the forces on a candidate, with their units.
CANDIDATE_STATISTICS = {
    "mean_force_at_pair": NEWTON, "median_force_at_pair": NEWTON, "log_force_std": DIMENSIONLESS,
    "agrees": DIMENSIONLESS,
}  # fmt: skip


def compute_candidates(
    feature_kind: str,
    candidate_numbers: Sequence[int],
    featured: FeaturedSurface,
    scan_count: int,
    contact: Contact,
    ranges: list[float],
) -> xr.Dataset:
    """Return features, roughness and `smooth_sphere_forces` of candidates of a kind of features."""
    candidates = []
    scan_numbers = range(1, scan_count + 1)
    for number in progress(candidate_numbers, len(candidate_numbers), "surfaces with features"):
        features, scans = sample_featured_scans(featured, feature_kind, scan_numbers, number)
        scan_results = {}
        for index, scan in enumerate(map(level_plane, scans), 1):
            forces = smooth_sphere_forces(scan, contact, ranges)
            roughness = metrics_dataset(scan, TABLE1_METRICS.values())
            scan_results[(index,)] = roughness.assign(pull_off_force=forces)
        candidates.append(stack(scan_results, ["scan"]).assign(featured.to_variables(features)))
    return xr.concat(candidates, pd.Index(list(candidate_numbers), name="candidate"))


def candidates_by_surface(
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
) -> dict[str, dict[str, xr.Dataset]]:
    """Return the candidates of each surface and kind of features.

    Chunks come from `compute_candidates`. The key of a chunk is its surface, kind of features,
    first and last candidate.
    """
    surfaces: dict[str, dict[str, xr.Dataset]] = {}
    for (surface, feature_kind), candidates in concatenate(chunks, "candidate", 2).items():
        surfaces.setdefault(surface, {})[feature_kind] = candidates
    return surfaces


def candidate_of_set(candidates: Mapping[str, xr.Dataset], set_number: int) -> xr.Dataset:
    """Return the candidate that no other set has: bumps for odd sets, pits for even sets."""
    index, kind_index = divmod(set_number - 1, len(FEATURE_SIGNS))
    return candidates[alternating_feature_kind(kind_index)].isel(candidate=index, drop=True)


def compare_features(
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
    sphere_factors: xr.DataArray,
    published: PublishedForces,
    labels: Mapping[str, str],
) -> xr.Dataset:
    """Return features.nc: features and CANDIDATE_STATISTICS (features, candidate) of candidates.

    A study has at most one surface with features; without one the dataset is empty. The keys of
    `chunks` are as in `candidates_by_surface`; `sphere_factors` come from `sets.sphere_factor`.
    """
    if not chunks:
        empty = ("features", "candidate"), np.empty((len(FEATURE_KINDS), 0))
        return xr.Dataset(
            {name: (*empty, unit) for name, unit in CANDIDATE_STATISTICS.items()},
            {"features": list(FEATURE_KINDS), "candidate": np.arange(0)},
            {"surface": "", "label": "", "source": "substitute"},
        )
    ((surface, candidates),) = candidates_by_surface(chunks).items()
    sphere_factor = sphere_factors.sel(contact_model=PLASTIC, surface=surface, drop=True)
    targets = published.forces.loc[surface].to_dict()
    statistics = [
        _candidate_statistics(
            kind_candidates.sel(contact_model=PLASTIC), sphere_factor, published.pair, targets
        )
        for kind_candidates in candidates.values()
    ]
    log_std = log_std_of_lognormal(targets["mean_force"], targets["median_force"])
    kinds = pd.Index(list(candidates), name="features")
    return xr.concat(statistics, kinds, join="outer").assign_attrs(
        surface=surface,
        label=labels[surface],
        source="substitute",
        published_mean_force=targets["mean_force"],
        published_median_force=targets["median_force"],
        published_log_force_std=float(log_std),
    )


def _candidate_statistics(
    candidates: xr.Dataset,
    sphere_factor: xr.DataArray,
    pair: tuple[float, float],
    targets: Mapping[Any, float],
) -> xr.Dataset:
    """Return the features and CANDIDATE_STATISTICS (candidate,) of plastic forces at a pair."""
    rho, work = pair
    forces = work * interpolate_forces(candidates["pull_off_force"] * sphere_factor, rho)
    contact_forces = forces.stack(contact=("scan", *CONTACT_AXES)).transpose("candidate", "contact")
    mean = contact_forces.values.mean(axis=1)
    median = np.median(contact_forces, axis=1)
    force_ratios = np.array([mean / targets["mean_force"], median / targets["median_force"]])
    agrees = (np.abs(np.log(force_ratios)) <= np.log(MAX_FORCE_FACTOR)).all(axis=0)
    values = (mean, median, np.log(contact_forces.values).std(axis=1), agrees.astype(float))
    statistics = {
        name: ("candidate", value, unit)
        for (name, unit), value in zip(CANDIDATE_STATISTICS.items(), values, strict=True)
    }
    feature_variables = [name for name in candidates if candidates[name].dims == ("candidate",)]
    return candidates[feature_variables].assign(statistics)
