"""Sets of scans, drawn from a pool and judged as the study is.

A set takes scans of a pool and gives each its height, from which its forces follow.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.band.critical_band import critical_band
from hardcontact.base.job import progress
from hardcontact.base.random import generator
from hardcontact.base.statistics import Sampling, student_log_samples
from hardcontact.paper.evaluation import claim_values
from hardcontact.paper.inference import Published, infer
from hardcontact.paper.pool import height_weights
from hardcontact.surfaces.conditioning import group_heights
from hardcontact.surfaces.height_map import METRICS
from hardcontact.surfaces.roughness_table import averages

Floats = NDArray[np.float64]

#: Scans of one set, by substrate.
Drawn = Mapping[str, xr.Dataset]

#: How often a set is drawn in search of one with the heights asked for.
TRIES = 1000
#: Metrics that do not change with the height of a scan.
SHAPES = ("skewness", "kurtosis")
#: Variables of the inference of a set that are kept.
INFERRED = [
    "range_of_adhesion", "work_of_adhesion", "best_error", "minimum_range", "minimum_work",
    "minimum_error", "mean_force", "ratio",
]  # fmt: skip
#: Variables of the critical band of a set that are kept.
BAND = ["scale_ratio", "scale_change", "critical_wavelength"]


class Sources(NamedTuple):
    """What all sets are made from."""

    topography: xr.Dataset  #: Of the study.
    adhesion: xr.Dataset  #: Of the study.
    pools: Mapping[str, xr.Dataset]  #: By substrate; a substrate without one keeps its scans.
    #: (contact_model, surface, rho) force on the rough sphere relative to a smooth one.
    sphere_factor: xr.DataArray
    masters: xr.Dataset  #: Of `all_surfaces.stacked_forces` at one load.


class SetSettings(NamedTuple):
    """How sets are drawn and judged."""

    seed: int  #: The seed of the study.
    replicates: int  #: Sets drawn.
    realizations: int  #: Masters of each substrate in a set.
    reference_surface: str  #: The surface that ratios are taken to.
    tolerance: float  #: Relative change of the force that ends the critical band.
    confidence: float  #: Of the intervals.


def gathered_sources(
    study: Mapping[str, xr.Dataset],
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
    smooth: Mapping[str, xr.Dataset],
    masters: xr.Dataset,
) -> Sources:
    """Return what sets are made from.

    Parameters
    ----------
    study : mapping of str to xarray.Dataset
        ``topography`` and ``adhesion`` of the study.
    chunks : mapping of tuple to xarray.Dataset
        Of `pool.compute_pool`, by substrate, first and last scan.
    smooth : mapping of str to xarray.Dataset
        Mean forces of the study's scans on a smooth sphere, by substrate.
    masters : xarray.Dataset
        Of `all_surfaces.stacked_forces` at one load.
    """
    pools: dict[str, list[xr.Dataset]] = {}
    for (surface, *_), chunk in chunks.items():
        pools.setdefault(surface, []).append(chunk)
    forces = study["adhesion"]["pull_off_force"]
    rough = forces.mean(["scan", "sphere_scan", "contact_y", "contact_x"])
    factor = xr.full_like(rough, np.nan)
    for surface, scans in smooth.items():
        plastic = scans["pull_off_force"].squeeze("load", drop=True)
        by_model = xr.concat([scans["rigid_pull_off_force"], plastic], rough["contact_model"])
        change = rough.sel(surface=surface, drop=True) / by_model.mean(["scan", "sphere_scan"])
        factor.loc[{"surface": surface}] = change
    return Sources(
        study["topography"],
        study["adhesion"],
        {surface: xr.concat(parts, "scan") for surface, parts in pools.items()},
        factor,
        masters,
    )


def draw_scans(pool: xr.Dataset, rng: np.random.Generator, scans: int) -> xr.Dataset:
    """Draw a set of scans of one substrate from its pool, without replacement.

    With six scans or more a height could be negative: a set with a height below those of the pool
    is drawn again. Returns METRICS and ``number`` in the pool over scan, which counts from 1, and
    ``pull_off_force`` (scan, contact_model, rho, contact_y, contact_x) in N on a smooth sphere.
    Raises ValueError if no set is found.
    """
    least = pool["rms_height_of_force"].values.min()
    mean, deviation = pool.attrs["mean_rms_height"], pool.attrs["rms_height_deviation"]
    for _ in range(TRIES):
        drawn = pool.isel(scan=rng.choice(pool.sizes["scan"], scans, replace=False))
        heights = group_heights(drawn["rms_height"].values, mean, deviation)
        if heights.min() >= least * (1 - 1e-9):
            return _at_heights(drawn, heights)
    raise ValueError(
        f"expected sets of {scans} scans with rms heights of {mean:.3g} +- {deviation:.3g} nm, "
        f"found none above {least:.3g} nm in {TRIES} tries"
    )


def _at_heights(drawn: xr.Dataset, heights: Floats) -> xr.Dataset:
    """Return scans of a pool with their forces and metrics at other rms heights (scan,) in nm."""
    factor = heights / drawn["rms_height"].values
    weights = height_weights(drawn["rms_height_of_force"].values, heights)
    log_forces = np.einsum("na,na...->n...", weights, drawn["log_force"].values)
    axes = ("scan", "contact_model", "rho", "contact_y", "contact_x")
    variables = {
        name: ("scan", drawn[name].values * (1.0 if name in SHAPES else factor), drawn[name].attrs)
        for name in METRICS
    } | {
        "pull_off_force": (axes, np.exp(log_forces), {"units": "N"}),
        "number": ("scan", drawn["scan"].values),
    }
    coordinates = {"scan": np.arange(1, len(heights) + 1)}
    return xr.Dataset(variables, coordinates | {name: drawn[name] for name in axes[1:]})


def with_sampled_mean(forces: xr.DataArray, rng: np.random.Generator) -> xr.DataArray:
    """Return the forces of measured scans times one sample of what their mean may be.

    Other scans of the surface would have another mean force; the scans that there are keep their
    distribution over contacts, and a single scan is left as it is. Forces (scan, sphere_scan,
    contact_model, rho, contact_y, contact_x) are in N.
    """
    axes = ("scan", "contact_model", "rho")
    means = forces.mean([dim for dim in forces.dims if dim not in axes]).transpose(*axes)
    if means.sizes["scan"] < 2:
        return forces
    sample = student_log_samples(rng, means.values, 1)[0]
    factor = xr.DataArray(sample, dims=axes[1:]) / means.mean("scan").drop_vars(axes[1:])
    return (forces * factor).transpose(*forces.dims)


def drawn_scans(sources: Sources, seed: int, number: int) -> dict[str, xr.Dataset]:
    """Return the scans of a set by substrate, of those with a pool; as many as the study has."""
    counts = sources.topography["rms_height"].count("scan").to_series()
    return {
        name: draw_scans(pool, generator(seed, name, number, "set", "scans"), counts[name])
        for name, pool in sources.pools.items()
    }


def set_topography(study: xr.Dataset, drawn: Drawn, confidence: float) -> xr.Dataset:
    """Return METRICS, their averages and what depends on no scan, as topography.nc has them."""
    parts = [
        drawn[name] if name in drawn else study.sel(surface=name, drop=True)
        for name in study["surface"].values
    ]
    scans = xr.concat([part[list(METRICS)] for part in parts], study["surface"], join="outer")
    constant = [name for name in study if str(name).startswith("all_scales_")]
    named = study[[*constant, "label", "basis", "calibrated_to_table1"]]
    return xr.merge([named, scans, averages(scans, confidence)], combine_attrs="override")


def set_adhesion(sources: Sources, drawn: Drawn, seed: int, number: int) -> xr.Dataset:
    """Return the pull-off forces of a set, as adhesion.nc has them.

    Forces of drawn scans are those on a smooth sphere times what its roughness changes. Other
    substrates keep their scans and get another mean.
    """
    study, parts = sources.adhesion, []
    for surface in study["surface"].values.tolist():
        if surface in drawn:
            factor = sources.sphere_factor.sel(surface=surface, drop=True)
            forces = (drawn[surface]["pull_off_force"] * factor).expand_dims(sphere_scan=[1])
        else:
            own = study["pull_off_force"].sel(surface=surface, drop=True)
            own = own.dropna("scan", how="all").dropna("sphere_scan", how="all")
            rng = generator(seed, surface, number, "set", "mean force")
            forces = with_sampled_mean(own, rng)
        parts.append(forces)
    stacked = xr.concat(parts, study["surface"], join="outer")
    return study[["label", "basis", "contact_pixels"]].assign(
        pull_off_force=stacked.transpose(*study["pull_off_force"].dims)
    )


def set_band(
    masters: xr.Dataset, realizations: int, tolerance: float, sampling: Sampling, number: int
) -> xr.Dataset:
    """Return the critical band of some masters of each substrate, drawn with replacement."""
    parts = []
    for surface in masters["surface"].values.tolist():
        known = masters["ratio"].sel(surface=surface).dropna("realization", how="all")
        rng = generator(sampling.seed, surface, number, "set", "masters")
        chosen = rng.choice(known.realization, realizations)
        ratio = known.sel(realization=chosen).assign_coords(realization=range(realizations))
        parts.append(ratio.drop_vars("surface"))
    ratio = xr.concat(parts, masters["surface"])
    return critical_band(masters.drop_dims("realization").assign(ratio=ratio), tolerance, sampling)


def judge_sets(
    sources: Sources,
    statements: pd.DataFrame,
    constants: pd.DataFrame,
    measured: Published,
    settings: SetSettings,
) -> xr.Dataset:
    """Draw all sets and compute the numbers of each.

    Parameters
    ----------
    sources : Sources
        What sets are made from.
    statements, constants : pandas.DataFrame
        Of `evaluation.replicated_statements` and `published.constants`.
    measured : Published
        Published forces, range and work of adhesion.
    settings : SetSettings
        How sets are drawn and judged.

    Returns
    -------
    xarray.Dataset
        Over set: ``value`` (claim), INFERRED (contact_model, ...) and BAND (side, ...). Over
        (contact_model, surface, rho) ``sphere_factor``, NaN of a surface without a pool.
    """
    numbers = range(1, settings.replicates + 1)
    sets = []
    for number in progress(numbers, len(numbers), "sets"):
        datasets = _set_datasets(sources, constants["value"], measured, settings, number)
        value = claim_values(statements, datasets, constants)
        claims = xr.Dataset({"value": ("claim", value)}, {"claim": value.index.to_list()})
        kept = [claims, datasets["inference"][INFERRED], datasets["band"][BAND]]
        sets.append(xr.merge(kept, join="exact", combine_attrs="drop_conflicts"))
    return xr.concat(sets, pd.Index(numbers, name="set")).assign(
        sphere_factor=sources.sphere_factor.assign_attrs(
            units="1", long_name="pull-off force on the rough sphere over that on a smooth one"
        )
    )


def _set_datasets(
    sources: Sources,
    constants: "pd.Series[float]",
    measured: Published,
    settings: SetSettings,
    number: int,
) -> dict[str, xr.Dataset]:
    """Return the datasets of one set by the names that claims give them."""
    sampling = Sampling(settings.seed, 0, settings.confidence)
    drawn = drawn_scans(sources, settings.seed, number)
    adhesion = set_adhesion(sources, drawn, settings.seed, number)
    band = set_band(sources.masters, settings.realizations, settings.tolerance, sampling, number)
    return {
        "topography": set_topography(sources.topography, drawn, settings.confidence),
        "adhesion": adhesion,
        "inference": infer(
            adhesion,
            measured,
            settings.reference_surface,
            constants["error_threshold"],
            constants["force_floor"],
            sampling,
        ),
        "band": band.assign_attrs(sphere_radius=adhesion.attrs["sphere_radius"]),
    }
