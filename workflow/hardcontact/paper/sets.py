"""Sets of scans: forces, fit, band and claims of each, computed as for the study, for sets.nc.

A set has as many scans and masters of each substrate as the study. Forces, and with them the fit,
come from the scans, edges from the masters. Both are sampled independently. Masters are sampled
with replacement from masters that all sets share. Scans depend on the substrate:

    substrate                     scans of a set
    substitute without features   sampled from `pool`
    substitute with features      one of `featured_candidates`
    measured                      those of the study, with a mean force sampled by Student's t

Forces on sampled scans are those of a smooth sphere times `sphere_factor`, to save time.
"""

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import generator
from hardcontact.base.progress import progress
from hardcontact.base.statistics import Sampling, student_log_samples
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import mean_over_contacts
from hardcontact.inference.edges import edges_of_independent_masters
from hardcontact.inference.fit import WITHOUT_SURFACE
from hardcontact.inference.published_fit import PublishedForces, fit_published
from hardcontact.paper.claims.judgement import claim_values
from hardcontact.paper.featured_candidates import candidate_of_set
from hardcontact.paper.pool import sample_pool_scans
from hardcontact.surfaces.metrics import TABLE1_METRICS
from hardcontact.surfaces.topography import scan_averages

#: Variables of fit.nc that sets.nc has for each set.
SET_FIT_VARIABLES = [
    "range_of_adhesion", "work_of_adhesion", "best_error", "range_at_minimum", "work_at_minimum",
    "error_at_minimum", "mean_force", "force_over_reference", *WITHOUT_SURFACE.values(),
]  # fmt: skip
#: Variables of edges.nc that sets.nc has for each set.
SET_EDGE_VARIABLES = ["filtered_force_ratio", "filtered_force_change", "edge", "edge_bound"]
#: Sets whose claims are estimated at once; each takes up to 20 MB of memory.
SETS_AT_ONCE = 20


class SetInputs(NamedTuple):
    """Datasets of which sets are made; a substrate without pool or candidates keeps its scans."""

    topography: xr.Dataset  #: topography.nc of the study.
    adhesion: xr.Dataset  #: adhesion.nc of the study.
    pools: Mapping[str, xr.Dataset]  #: From `compute_pool`, by substrate.
    candidates: Mapping[str, Mapping[str, xr.Dataset]]  #: From `candidates_by_surface`.
    sphere_factor: xr.DataArray  #: (contact_model, surface, rho), from the function of this name.
    master_forces: xr.Dataset  #: From `read_master_forces` at one loading.


class SetSettings(NamedTuple):
    """Settings of the sampling, the fit and the edges."""

    seed: int  #: Seed of the study.
    set_count: int
    master_count: int  #: Number of masters of each substrate in a set.
    reference_surface: str  #: Surface whose mean force is the denominator of force ratios.
    tolerance: float  #: Relative change of the force that defines an edge.
    confidence: float


def sphere_factor(adhesion: xr.Dataset, sampled_substrates: Sequence[str]) -> xr.DataArray:
    """Return the mean forces on the rough sphere relative to a smooth sphere.

    They are (contact_model, surface, rho), NaN on other substrates.
    """
    rough = adhesion["pull_off_force"].mean(["scan", "sphere_scan", *CONTACT_AXES])
    smooth = adhesion["smooth_sphere_force"].mean("scan")
    return (rough / smooth).where(rough["surface"].isin(sampled_substrates))


def sample_set_scans(inputs: SetInputs, seed: int, set_number: int) -> dict[str, xr.Dataset]:
    """Return forces on and metrics of a set's scans, by substrate with a pool or candidates."""
    counts = inputs.topography["rms_height"].count("scan").to_series()
    pool_scans = {
        name: sample_pool_scans(
            pool, generator(seed, name, set_number, "set", "scans"), counts[name]
        )
        for name, pool in inputs.pools.items()
    }
    return pool_scans | {
        name: candidate_of_set(candidates, set_number)
        for name, candidates in inputs.candidates.items()
    }


def topography_of_set(
    inputs: SetInputs, sampled_scans: Mapping[str, xr.Dataset], confidence: float
) -> xr.Dataset:
    """Return the topography of a set, with variables of topography.nc."""
    topography = inputs.topography
    metrics = [
        sampled_scans.get(name, topography.sel(surface=name, drop=True))[[*TABLE1_METRICS.values()]]
        for name in topography["surface"].values.tolist()
    ]
    set_scans = xr.concat(metrics, topography["surface"], join="outer")
    # Spectra, not scans, determine roughness of all scales: it is that of the study.
    all_scales_names = [name for name in topography if str(name).startswith("all_scales_")]
    unchanged = topography[[*all_scales_names, "label", "source", "table1_rows_met"]]
    averages = scan_averages(set_scans, confidence)
    return xr.merge([unchanged, set_scans, averages], combine_attrs="override")


def adhesion_of_set(
    inputs: SetInputs, sampled_scans: Mapping[str, xr.Dataset], seed: int, set_number: int
) -> xr.Dataset:
    """Return the pull-off forces of a set, as in adhesion.nc.

    Substrates without `sampled_scans` keep their scans and get a sampled mean.
    """
    adhesion = inputs.adhesion
    surface_forces = []
    for surface in adhesion["surface"].values.tolist():
        if surface in sampled_scans:
            factor = inputs.sphere_factor.sel(surface=surface, drop=True)
            rough_sphere_forces = sampled_scans[surface]["pull_off_force"] * factor
            forces = rough_sphere_forces.expand_dims(sphere_scan=[1])
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


def scale_to_sampled_mean(forces: xr.DataArray, rng: np.random.Generator) -> xr.DataArray:
    """Return forces scaled to means that other scans might have; unchanged for a single scan."""
    axes = ("scan", "contact_model", "rho")
    means = mean_over_contacts(forces).transpose(*axes)
    if means.sizes["scan"] < 2:
        return forces
    sampled_means = student_log_samples(rng, means.values, 1)[0]
    factor = xr.DataArray(sampled_means, dims=axes[1:]) / means.mean("scan").drop_vars(axes[1:])
    return (forces * factor).transpose(*forces.dims)


def sample_masters(
    values: xr.DataArray, master_count: int, seed: int, set_number: int
) -> xr.DataArray:
    """Return values (surface, realization, ...) of masters that are sampled with replacement."""
    samples = []
    for surface in values["surface"].values.tolist():
        masters = values.sel(surface=surface, drop=True).dropna("realization", how="all")
        rng = generator(seed, surface, set_number, "set", "masters")
        sample = masters.sel(realization=rng.choice(masters["realization"], master_count))
        samples.append(sample.assign_coords(realization=range(master_count)))
    return xr.concat(samples, values["surface"])


def sample_sets(
    inputs: SetInputs,
    claims: pd.DataFrame,
    constants: pd.DataFrame,
    published: PublishedForces,
    settings: SetSettings,
) -> xr.Dataset:
    """Return sets.nc: values (set, claim) of claims, fit and edges of each set, sphere factor."""
    set_numbers = range(1, settings.set_count + 1)
    datasets_of_sets = (
        _set_datasets(inputs, published, settings, set_number)
        for set_number in progress(set_numbers, len(set_numbers), "sets")
    )
    results = [
        _estimate_sets(list(islice(datasets_of_sets, SETS_AT_ONCE)), claims, constants)
        for _ in range(0, settings.set_count, SETS_AT_ONCE)
    ]
    return (
        xr.concat(results, "set")
        .assign_coords(set=set_numbers)
        .assign(sphere_factor=inputs.sphere_factor.assign_attrs(DIMENSIONLESS))
    )


def _estimate_sets(
    datasets_of_sets: Sequence[Mapping[str, xr.Dataset]],
    claims: pd.DataFrame,
    constants: pd.DataFrame,
) -> xr.Dataset:
    """Return values (set, claim) of claims, the fit and the edges of some sets."""
    datasets = {
        name: xr.concat([set_datasets[name] for set_datasets in datasets_of_sets], "set")
        for name in datasets_of_sets[0]
    }
    variables = [
        claim_values(claims, datasets, constants).to_dataset(name="value"),
        datasets["fit"][SET_FIT_VARIABLES],
        datasets["edges"][SET_EDGE_VARIABLES],
    ]
    return xr.merge(variables, join="exact", combine_attrs="drop_conflicts")


def _set_datasets(
    inputs: SetInputs, published: PublishedForces, settings: SetSettings, set_number: int
) -> dict[str, xr.Dataset]:
    """Return the datasets of one set by the names that claims give them."""
    # No random samples, because all sets together give the intervals.
    sampling = Sampling(settings.seed, 0, settings.confidence)
    sampled_scans = sample_set_scans(inputs, settings.seed, set_number)
    adhesion = adhesion_of_set(inputs, sampled_scans, settings.seed, set_number)
    fit = fit_published(adhesion, published, settings.reference_surface, sampling)
    masters = inputs.master_forces
    ratio = sample_masters(
        masters["filtered_force_ratio"], settings.master_count, settings.seed, set_number
    )
    set_masters = masters.drop_dims("realization").assign(filtered_force_ratio=ratio)
    edges, _ = edges_of_independent_masters(set_masters, settings.tolerance, sampling)
    return {
        "topography": topography_of_set(inputs, sampled_scans, settings.confidence),
        "adhesion": adhesion,
        "fit": fit.drop_vars("mean_relative_error"),  # a large map, which no claim needs
        "edges": edges.assign_attrs(sphere_radius=adhesion.attrs["sphere_radius"]),
    }
