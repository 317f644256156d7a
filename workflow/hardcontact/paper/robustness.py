"""Range and work of adhesion and the critical band under every variant of the study's choices.

The intervals of all variants come from the same random numbers, so that only what they vary makes
them differ.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.band.critical_band import critical_band
from hardcontact.base.job import progress
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import single_masters, stacked_forces
from hardcontact.paper.inference import infer_model

#: What is inferred of every variant of the forces.
INFERRED = [
    "range_of_adhesion", "range_of_adhesion_interval", "work_of_adhesion",
    "work_of_adhesion_interval", "best_error", "minimum_range", "minimum_work", "minimum_error",
]  # fmt: skip

#: What is computed for every variant of the filtered masters.
CRITICAL = ["critical_wavelength", "critical_wavelength_interval"]

#: Files of masters, each with its surface, variant and probe.
Masters = Sequence[tuple[Sequence[str], xr.Dataset]]


@dataclass(frozen=True)
class Choices:
    """What all variants share."""

    substrates: list[str]
    basis: dict[str, str]  #: Of surfaces, whether their scans are measured or substitutes.
    reference_surface: str  #: The surface whose force divides the others.
    probe: str  #: The study's sphere of the filtered masters.
    error_threshold: float  #: Of the mean relative error.
    tolerance: float  #: Relative change of the force that ends the critical band.
    realizations: int  #: Masters that count.
    sampling: Sampling


def robustness(
    adhesion: Mapping[tuple[Any, ...], xr.Dataset],
    masters: Masters,
    variants: Sequence[dict[str, Any]],
    published: pd.DataFrame,
    choices: Choices,
) -> xr.Dataset:
    """Return range and work of adhesion and the critical band under every variant.

    Parameters
    ----------
    adhesion : mapping of tuple to xarray.Dataset
        ``pull_off_force`` (scan, sphere_scan, load, rho) in N, by surface and variant of its scans.
    masters : sequence of (keys, xarray.Dataset)
        Files of masters as of `single_masters`, with their surface, variant and probe.
    variants : sequence of dict
        The ``name``, ``label`` and ``group`` of each, the ``variant`` of each substrate's scans,
        the ``load`` by its name, and the ``probe`` of the filtered masters; another probe than the
        study's leaves range and work as they are.
    published : pandas.DataFrame
        Of `published.pull_off`.
    choices : Choices
        What all variants share.

    Returns
    -------
    xarray.Dataset
        Over variant: INFERRED, and CRITICAL (side) of all substrates pooled.
    """
    target = published.mean_force.reindex(choices.substrates).to_numpy()
    forces = {key: scans["pull_off_force"] for key, scans in adhesion.items()}
    parts = [
        xr.merge(
            [_range_and_work(forces, target, variant, choices), _band(masters, variant, choices)]
        )
        for variant in progress(variants, len(variants), "variants")
    ]
    names = pd.Index([variant["name"] for variant in variants], name="variant")
    varied = xr.concat(parts, names, coords="minimal", join="outer")
    return varied.assign_coords(
        variant_label=("variant", [variant["label"] for variant in variants]),
        group=("variant", [variant["group"] for variant in variants]),
    ).assign_attrs(
        tolerance=choices.tolerance,
        confidence=choices.sampling.confidence,
        basis=", ".join(f"{name}: {choices.basis[name]}" for name in choices.substrates),
        realizations=choices.realizations,
    )


def _range_and_work(
    forces: Mapping[tuple[Any, ...], xr.DataArray],
    target: np.ndarray,
    variant: dict[str, Any],
    choices: Choices,
) -> xr.Dataset:
    """Return what forces on scans say of one variant; nothing of another probe."""
    if variant["probe"] != choices.probe:
        return xr.Dataset()
    parts = [
        forces[name, variant["variant"][name]].sel(load=variant["load"], drop=True)
        for name in choices.substrates
    ]
    stacked = xr.concat(parts, pd.Index(choices.substrates, name="surface"), join="outer")
    inferred = infer_model(
        stacked.expand_dims(["contact_y", "contact_x"], [-2, -1]),
        target,
        choices.substrates.index(choices.reference_surface),
        choices.error_threshold,
        choices.sampling,
    )
    return inferred[INFERRED]


def _band(masters: Masters, variant: dict[str, Any], choices: Choices) -> xr.Dataset:
    """Return CRITICAL (side) of all substrates of one variant pooled."""
    files = [
        ([surface], file)
        for (surface, scans, probe), file in masters
        if (scans, probe) == (variant["variant"].get(surface), variant["probe"])
    ]
    curves = stacked_forces(single_masters(files, choices.realizations, variant["load"]))
    curves = curves.sel(surface=choices.substrates)
    band = critical_band(curves, choices.tolerance, choices.sampling)
    return band[CRITICAL].sel(group="pooled", drop=True)
