"""Numbers of many sets: every claim that the sets hold, range and work of adhesion, the band."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.claims.evaluation import values
from hardcontact.inference.inference import Published, infer
from hardcontact.numbers.statistics import Sampling
from hardcontact.records.log import progress
from hardcontact.sets.set_datasets import (
    Draw,
    Sources,
    drawn_scans,
    set_adhesion,
    set_band,
    set_topography,
)

#: Of the inference of a set.
INFERRED = [
    "range_of_adhesion", "work_of_adhesion", "best_error", "minimum_range", "minimum_work",
    "minimum_error", "mean_force", "ratio",
]  # fmt: skip
#: Of the critical band of a set.
OF_BAND = ["scale_ratio", "scale_change", "critical_wavelength"]
#: What may move the range of adhesion: facts of topography, means and deviations over scans.
FACTS = ["rms_height", "rms_gradient", "rms_half_laplacian"]


class SetSettings(NamedTuple):
    """How sets are drawn and judged."""

    seed: int  #: The seed of the study.
    replicates: int  #: Sets drawn.
    realizations: int  #: Masters of each substrate in a set.
    reference_surface: str  #: The surface that ratios are taken to.
    error_threshold: float  #: Of `inference.infer`.
    force_floor: float  #: In N, of `inference.infer`.
    tolerance: float  #: Relative change of the force that ends the critical band.
    confidence: float  #: Of the intervals.


class Paper(NamedTuple):
    """What sets are compared with."""

    #: Of `evaluation.read_statements`; those that are replicated are judged.
    statements: pd.DataFrame
    constants: pd.DataFrame  #: Of `published.constants`.
    published: Published  #: Measured forces, and the pair of the paper.


def gathered_sources(
    study: Mapping[str, xr.Dataset],
    chunks: Mapping[tuple[Any, ...], xr.Dataset],
    smooth: Mapping[str, xr.Dataset],
    masters: xr.Dataset,
) -> Sources:
    """Return what sets are made from, of the files of the study and of the pools.

    The study gives `topography` and `adhesion`; the chunks are of `pool.compute_pool`, by
    substrate, first and last scan, the smooth ones of `pool.on_smooth_sphere`, by substrate, and
    the masters of `all_surfaces.stacked_forces` at one load.
    """
    pools: dict[str, list[xr.Dataset]] = {}
    for (surface, *_), chunk in chunks.items():
        pools.setdefault(surface, []).append(chunk)
    forces = study["adhesion"]["pull_off_force"]
    rough = forces.mean(["scan", "sphere_scan", "contact_y", "contact_x"])
    factor = xr.full_like(rough, np.nan)
    for surface, scans in smooth.items():
        change = rough.sel(surface=surface, drop=True) / scans["pull_off_force"].mean("scan")
        factor.loc[{"surface": surface}] = change
    return Sources(
        study["topography"],
        study["adhesion"],
        {surface: xr.concat(parts, "scan") for surface, parts in pools.items()},
        factor,
        masters,
    )


def judge_sets(sources: Sources, paper: Paper, settings: SetSettings) -> xr.Dataset:
    """Draw all sets and compute the numbers of each.

    They are over set: `value` (claim), INFERRED (contact_model, ...), OF_BAND (side, ...), the
    FACTS `<metric>` and `<metric>_std` (surface); `sphere_factor` and `interpolation_error`
    (contact_model, surface, rho), the latter the root mean square over the pool; NaN of a surface
    without one.
    """
    replicated = paper.statements[paper.statements["replicated"] == "yes"]
    paper = paper._replace(statements=replicated)
    numbers = range(1, settings.replicates + 1)
    sets = [
        _judged_set(sources, paper, settings, Draw(settings.seed, number))
        for number in progress(numbers, len(numbers), "sets")
    ]
    errors = xr.full_like(sources.sphere_factor, np.nan)
    for surface, pool in sources.pools.items():
        errors.loc[{"surface": surface}] = (pool["interpolation_error"] ** 2).mean("scan") ** 0.5
    one, long_name = {"units": "1"}, "long_name"
    return xr.concat(sets, pd.Index(numbers, name="set")).assign(
        sphere_factor=sources.sphere_factor.assign_attrs(
            one | {long_name: "pull-off force on the rough sphere over that on a smooth one"}
        ),
        interpolation_error=errors.assign_attrs(
            one | {long_name: "root mean square error of an interpolated mean force of one scan"}
        ),
    )


def _judged_set(sources: Sources, paper: Paper, settings: SetSettings, draw: Draw) -> xr.Dataset:
    """Return the numbers of one set."""
    datasets = _datasets(sources, paper.published, settings, draw)
    substrates = datasets["adhesion"]["surface"].values
    topography = datasets["topography"].sel(surface=substrates).assign_coords(surface=substrates)
    facts: dict[str, Any] = {}
    for name in FACTS:
        facts |= {name: topography[f"{name}_mean"], f"{name}_std": topography[f"{name}_std"]}
    value = values(paper.statements, datasets, paper.constants)
    return xr.merge(
        [
            xr.Dataset({"value": ("claim", value.to_numpy())}, {"claim": value.index.to_list()}),
            datasets["inference"][INFERRED],
            datasets["band"][OF_BAND],
            xr.Dataset(facts),
        ],
        join="exact",
        combine_attrs="drop",
    )


def _datasets(
    sources: Sources, published: Published, settings: SetSettings, draw: Draw
) -> dict[str, xr.Dataset]:
    """Return the datasets of one set, by the names that claims give them."""
    sampling = Sampling(settings.seed, 0, settings.confidence)
    drawn = drawn_scans(sources, draw)
    adhesion = set_adhesion(sources, drawn, draw)
    inference = infer(
        adhesion,
        published,
        settings.reference_surface,
        settings.error_threshold,
        settings.force_floor,
        sampling,
    )
    return {
        "topography": set_topography(sources.topography, drawn, settings.confidence),
        "adhesion": adhesion,
        "inference": inference,
        "band": set_band(
            sources.masters, settings.realizations, settings.tolerance, sampling, draw
        ).assign_attrs(sphere_radius=adhesion.attrs["sphere_radius"]),
    }
