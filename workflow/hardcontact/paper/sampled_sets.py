"""Sets of scans: forces, fit, band and claims of each, computed as for the study, for sets.nc.

A set has as many scans of each substrate as the study: `sampled_scans` of its pool, or for a
surface with features a sample that no other set has. Its numbers show how much the numbers of the
study depend on its scans.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd
import xarray as xr

from hardcontact.base.arrays import generator
from hardcontact.base.dataset import concatenate
from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.inference.fit import WITHOUT_SURFACE
from hardcontact.paper.edges_of_masters import edges_of_masters
from hardcontact.paper.evaluation import claim_values
from hardcontact.paper.featured_samples import sample_of_set, samples_by_surface
from hardcontact.paper.published_fit import PublishedForces, fit_published
from hardcontact.paper.sampled_scans import sample_scans, scale_to_sampled_mean
from hardcontact.records.job import progress
from hardcontact.surfaces.metrics import TABLE1_METRICS, scan_averages

#: Scans of one set, by substrate.
SampledScans = Mapping[str, xr.Dataset]

#: Variables of the fit of a set that sets.nc contains.
SET_FIT_VARIABLES = [
    "range_of_adhesion", "work_of_adhesion", "best_error", "range_at_minimum", "work_at_minimum",
    "error_at_minimum", "mean_force", "force_over_reference", *WITHOUT_SURFACE.values(),
]  # fmt: skip
#: Variables of the edges of a set that sets.nc contains.
SET_EDGE_VARIABLES = ["filtered_force_ratio", "filtered_force_change", "edge", "edge_bound"]


class SetInputs(NamedTuple):
    """Datasets from which all sets are made."""

    topography: xr.Dataset  #: topography.nc of the study.
    adhesion: xr.Dataset  #: adhesion.nc of the study.
    #: By substrate; a substrate without a pool or samples keeps its scans.
    pools: Mapping[str, xr.Dataset]
    samples: Mapping[str, Mapping[str, xr.Dataset]]  #: By substrate with features and their kind.
    #: (contact_model, surface, rho) force on the rough sphere relative to a smooth one.
    sphere_factor: xr.DataArray
    masters: xr.Dataset  #: From `stack_masters` at one load.


class SetSettings(NamedTuple):
    """Settings of the sampling and of the judgement."""

    seed: int  #: Seed of the study.
    set_count: int  #: Number of sets.
    realizations: int  #: Number of masters of each substrate in a set.
    reference_surface: str  #: Surface whose mean force is the denominator of force ratios.
    tolerance: float  #: Relative change of the force that defines an edge.
    confidence: float  #: Confidence of the intervals.


def gather_inputs(
    *,
    topography: xr.Dataset,
    adhesion: xr.Dataset,
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
    sample_chunks: Mapping[tuple[Any, ...], xr.Dataset],
    sampled_substrates: Sequence[str],
    masters: xr.Dataset,
) -> SetInputs:
    """Join the chunks of pools and samples, and compute the factor of the rough sphere.

    `chunks` come from `pool.compute_pool`, by substrate, first and last scan; `sample_chunks` from
    `featured_samples.compute_samples`, by substrate, kind, first and last sample. The
    `sampled_substrates` have a pool or samples.
    """
    pools = concatenate(chunks, "scan", 1)
    forces = adhesion["pull_off_force"]
    rough = forces.mean(["scan", "sphere_scan", *CONTACT_AXES])
    smooth = adhesion["smooth_sphere_force"].mean("scan")
    factor = (rough / smooth).where(rough["surface"].isin(list(sampled_substrates)))
    return SetInputs(
        topography,
        adhesion,
        {surface: pool for (surface,), pool in pools.items()},
        samples_by_surface(sample_chunks),
        factor,
        masters,
    )


def sample_set_scans(inputs: SetInputs, seed: int, set_number: int) -> dict[str, xr.Dataset]:
    """Sample as many scans as the study has, for each substrate with a pool or samples."""
    counts = inputs.topography["rms_height"].count("scan").to_series()
    sampled_scans = {
        name: sample_scans(pool, generator(seed, name, set_number, "set", "scans"), counts[name])
        for name, pool in inputs.pools.items()
    }
    return sampled_scans | {
        name: sample_of_set(samples, set_number) for name, samples in inputs.samples.items()
    }


def topography_of_set(
    inputs: SetInputs, sampled_scans: SampledScans, confidence: float
) -> xr.Dataset:
    """Return the topography of a set, as in topography.nc: metrics, their averages and labels."""
    topography = inputs.topography
    surface_scans = [
        sampled_scans[name] if name in sampled_scans else topography.sel(surface=name, drop=True)
        for name in topography["surface"].values
    ]
    metrics = [scans[list(TABLE1_METRICS.values())] for scans in surface_scans]
    set_scans = xr.concat(metrics, topography["surface"], join="outer")
    # Spectra, not scans, determine roughness of all scales: it is that of the study.
    all_scales = [name for name in topography if str(name).startswith("all_scales_")]
    unchanged = topography[[*all_scales, "label", "source", "table1_rows_met"]]
    return xr.merge(
        [unchanged, set_scans, scan_averages(set_scans, confidence)], combine_attrs="override"
    )


def adhesion_of_set(
    inputs: SetInputs, sampled_scans: SampledScans, seed: int, set_number: int
) -> xr.Dataset:
    """Return the pull-off forces of a set, as in adhesion.nc.

    Forces of sampled scans are their forces on a smooth sphere times the factor of the rough
    sphere. Other substrates keep their scans and get a sampled mean.
    """
    adhesion = inputs.adhesion
    surface_forces = []
    for surface in adhesion["surface"].values.tolist():
        if surface in sampled_scans:
            factor = inputs.sphere_factor.sel(surface=surface, drop=True)
            scaled_forces = sampled_scans[surface]["pull_off_force"] * factor
            forces = scaled_forces.expand_dims(sphere_scan=[1])
        else:
            study_forces = adhesion["pull_off_force"].sel(surface=surface, drop=True)
            study_forces = study_forces.dropna("scan", how="all").dropna("sphere_scan", how="all")
            rng = generator(seed, surface, set_number, "set", "mean force")
            forces = scale_to_sampled_mean(study_forces, rng)
        surface_forces.append(forces)
    stacked_forces = xr.concat(surface_forces, adhesion["surface"], join="outer")
    return adhesion[["label", "source", "contact_pixel_count"]].assign(
        pull_off_force=stacked_forces.transpose(*adhesion["pull_off_force"].dims)
    )


def edges_of_set(
    masters: xr.Dataset, realizations: int, tolerance: float, sampling: Sampling, set_number: int
) -> xr.Dataset:
    """Return the critical band of masters of each substrate, sampled with replacement."""
    surface_ratios = []
    for surface in masters["surface"].values.tolist():
        study_ratio = (
            masters["filtered_force_ratio"].sel(surface=surface).dropna("realization", how="all")
        )
        rng = generator(sampling.seed, surface, set_number, "set", "masters")
        sampled_masters = rng.choice(study_ratio.realization, realizations)
        ratio = study_ratio.sel(realization=sampled_masters)
        ratio = ratio.assign_coords(realization=range(realizations))
        surface_ratios.append(ratio.drop_vars("surface"))
    ratio = xr.concat(surface_ratios, masters["surface"])
    set_masters = masters.drop_dims("realization").assign(filtered_force_ratio=ratio)
    return edges_of_masters(set_masters, tolerance, sampling)[0]


def sample_sets(
    inputs: SetInputs,
    claims: pd.DataFrame,
    constants: pd.DataFrame,
    published: PublishedForces,
    settings: SetSettings,
) -> xr.Dataset:
    """Sample all sets and compute the numbers of each.

    By set: ``value`` (claim), SET_FIT_VARIABLES (contact_model, ...) and SET_EDGE_VARIABLES (side,
    ...). ``sphere_factor`` (contact_model, surface, rho) is NaN for a surface without a pool.
    """
    numbers = range(1, settings.set_count + 1)
    sets = []
    for set_number in progress(numbers, len(numbers), "sets"):
        datasets = _set_datasets(inputs, published, settings, set_number)
        values = claim_values(claims, datasets, constants)
        claim_dataset = xr.Dataset({"value": ("claim", values)}, {"claim": values.index.to_list()})
        variables = [
            claim_dataset,
            datasets["fit"][SET_FIT_VARIABLES],
            datasets["edges"][SET_EDGE_VARIABLES],
        ]
        sets.append(xr.merge(variables, join="exact", combine_attrs="drop_conflicts"))
    return xr.concat(sets, pd.Index(numbers, name="set")).assign(
        sphere_factor=inputs.sphere_factor.assign_attrs(DIMENSIONLESS)
    )


def _set_datasets(
    inputs: SetInputs, published: PublishedForces, settings: SetSettings, set_number: int
) -> dict[str, xr.Dataset]:
    """Return the datasets of one set by the names that claims give them."""
    # A set needs no intervals, since all sets together give them: no samples.
    sampling = Sampling(settings.seed, 0, settings.confidence)
    sampled_scans = sample_set_scans(inputs, settings.seed, set_number)
    adhesion = adhesion_of_set(inputs, sampled_scans, settings.seed, set_number)
    edges = edges_of_set(
        inputs.masters, settings.realizations, settings.tolerance, sampling, set_number
    )
    return {
        "topography": topography_of_set(inputs, sampled_scans, settings.confidence),
        "adhesion": adhesion,
        "fit": fit_published(adhesion, published, settings.reference_surface, sampling),
        "edges": edges.assign_attrs(sphere_radius=adhesion.attrs["sphere_radius"]),
    }
