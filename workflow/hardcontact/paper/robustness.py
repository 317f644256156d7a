"""Range and work of adhesion and the critical band under every variant of the choices of the study.

The intervals of all variants come from the same random numbers: only the variants make them differ.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.job import progress
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import single_masters, stacked_forces
from hardcontact.inference.edges import edges_of_realizations
from hardcontact.inference.published_fit import fit_model

#: Variables inferred from every variant of the forces.
INFERENCE_VARIABLES = [
    "range_of_adhesion", "range_of_adhesion_interval", "work_of_adhesion",
    "work_of_adhesion_interval", "best_error", "range_at_minimum", "work_at_minimum",
    "error_at_minimum",
]  # fmt: skip

#: Variables computed for every variant of the filtered masters.
BAND_VARIABLES = ["edge", "edge_interval"]

#: Files of masters, each with its surface, variant and probe.
KeyedMasters = Sequence[tuple[Sequence[str], xr.Dataset]]


@dataclass(frozen=True)
class Choices:
    """Choices that all variants share."""

    substrates: list[str]
    basis: dict[str, str]  #: By surface: measured or substitute scans.
    reference_surface: str  #: Surface to which force ratios are taken.
    probe: str  #: Sphere of the study on filtered masters.
    error_threshold: float  #: A mean relative error below it is small.
    tolerance: float  #: Relative change of the force that defines an edge.
    realizations: int  #: Number of masters of each surface.
    sampling: Sampling


def robustness(
    adhesion: Mapping[tuple[Any, ...], xr.Dataset],
    masters: KeyedMasters,
    variants: Sequence[dict[str, Any]],
    published: pd.DataFrame,
    choices: Choices,
) -> xr.Dataset:
    """Return range and work of adhesion and the critical band under every variant.

    adhesion: ``pull_off_force`` (scan, sphere_scan, load, rho) in N, by surface and variant of its
        scans.
    masters: files of masters as for `single_masters`, with their surface, variant and probe.
    variants: ``name``, ``label`` and ``group`` of each variant; ``variant``, the variant of the
        scans by substrate; ``load``, the name of the load; ``probe``, the sphere on filtered
        masters. A variant of the probe has no range and work of adhesion.
    published: from `published.pull_off`.
    choices: choices that all variants share.
    Returns by variant: INFERENCE_VARIABLES, and BAND_VARIABLES (side) pooled over all substrates.
    """
    target = published.mean_force.reindex(choices.substrates).to_numpy()
    forces = {key: scans["pull_off_force"] for key, scans in adhesion.items()}
    variant_datasets = [
        xr.merge(
            [
                _infer_range_and_work(forces, target, variant, choices),
                _pooled_band(masters, variant, choices),
            ]
        )
        for variant in progress(variants, len(variants), "variants")
    ]
    names = pd.Index([variant["name"] for variant in variants], name="variant")
    merged = xr.concat(variant_datasets, names, coords="minimal", join="outer")
    return merged.assign_coords(
        variant_label=("variant", [variant["label"] for variant in variants]),
        variant_kind=("variant", [variant["group"] for variant in variants]),
    ).assign_attrs(
        tolerance=choices.tolerance,
        confidence=choices.sampling.confidence,
        basis=", ".join(f"{name}: {choices.basis[name]}" for name in choices.substrates),
        realizations=choices.realizations,
    )


def _infer_range_and_work(
    forces: Mapping[tuple[Any, ...], xr.DataArray],
    target: np.ndarray,
    variant: dict[str, Any],
    choices: Choices,
) -> xr.Dataset:
    """Return INFERENCE_VARIABLES of one variant; an empty dataset for another probe."""
    if variant["probe"] != choices.probe:
        return xr.Dataset()
    surface_forces = [
        forces[name, variant["variant"][name]].sel(load=variant["load"], drop=True)
        for name in choices.substrates
    ]
    stacked_scans = xr.concat(
        surface_forces, pd.Index(choices.substrates, name="surface"), join="outer"
    )
    fits = fit_model(
        stacked_scans.expand_dims(["contact_y", "contact_x"], [-2, -1]),
        target,
        choices.substrates.index(choices.reference_surface),
        choices.error_threshold,
        choices.sampling,
    )
    return fits[INFERENCE_VARIABLES]


def _pooled_band(masters: KeyedMasters, variant: dict[str, Any], choices: Choices) -> xr.Dataset:
    """Return BAND_VARIABLES (side) of one variant, pooled over all substrates."""
    files = [
        ([surface], file)
        for (surface, scans, probe), file in masters
        if (scans, probe) == (variant["variant"].get(surface), variant["probe"])
    ]
    curves = stacked_forces(single_masters(files, choices.realizations, variant["load"]))
    curves = curves.sel(surface=choices.substrates)
    band = edges_of_realizations(curves, choices.tolerance, choices.sampling)
    return band[BAND_VARIABLES].sel(group="pooled", drop=True)
