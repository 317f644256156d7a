"""Range and work of adhesion and the critical band under every variant of the study's choices.

A variant is a dict of its `name`, `label` and `group`, of `variant` (the variant of each
substrate's scans, by the substrate), of `load` (the name of hardness and preload) and of `probe`
(the sphere of the filtered masters). The intervals of all variants come from the same random
numbers, so that only what they vary makes them differ.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.all_surfaces import single_masters, stacked_forces
from hardcontact.adhesion.force_curves import at_range
from hardcontact.inference.inference import Pair, infer_model
from hardcontact.numbers.statistics import Sampling
from hardcontact.records.job import progress
from hardcontact.scales.critical_band import critical_band

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
    """What all variants share.

    The basis of a surface says whether its scans are measured or substitutes; forces are divided by
    those of the reference surface. The probe is the study's sphere of the filtered masters; another
    one leaves range and work as they are. The threshold is of the mean relative error, the
    tolerance the relative change of the force that ends the critical band. Of the masters so many
    realizations count, and the published pair
    the range and work of adhesion that mean forces are given at.
    """

    substrates: list[str]
    basis: dict[str, str]
    reference_surface: str
    probe: str
    error_threshold: float
    tolerance: float
    realizations: int
    published_pair: Pair
    sampling: Sampling


def robustness(
    adhesion: Mapping[tuple[Any, ...], xr.Dataset],
    masters: Masters,
    variants: Sequence[dict[str, Any]],
    published: pd.DataFrame,
    choices: Choices,
) -> xr.Dataset:
    """Return range and work of adhesion and the critical band under every variant.

    Forces pull_off_force (scan, sphere_scan, load, rho), in N, are by surface and variant; files
    of masters, as of `single_masters`, by surface, variant and probe; published are those of
    `published.pull_off`. Returned are INFERRED, `mean_force` (variant, surface) in N at the
    published pair, and CRITICAL of all substrates pooled.
    """
    target = published.mean_force.reindex(choices.substrates).to_numpy()
    forces = {key: one["pull_off_force"] for key, one in adhesion.items()}
    parts = [
        xr.merge([_range_and_work(forces, target, one, choices), _band(masters, one, choices)])
        for one in progress(variants, len(variants), "variants")
    ]
    names = pd.Index([one["name"] for one in variants], name="variant")
    varied = xr.concat(parts, names, coords="minimal", join="outer")
    return varied.assign_coords(
        variant_label=("variant", [one["label"] for one in variants]),
        group=("variant", [one["group"] for one in variants]),
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
    rho, work = choices.published_pair
    force = work * at_range(inferred.mean_force, rho)
    return inferred[INFERRED].assign(mean_force=force.assign_attrs(units="N"))


def _band(masters: Masters, variant: dict[str, Any], choices: Choices) -> xr.Dataset:
    """Return CRITICAL (side) of all substrates of one variant pooled."""
    files = [
        ([surface], file)
        for (surface, made, probe), file in masters
        if (made, probe) == (variant["variant"].get(surface), variant["probe"])
    ]
    curves = stacked_forces(single_masters(files, choices.realizations, variant["load"]))
    curves = curves.sel(surface=choices.substrates)
    band = critical_band(curves, choices.tolerance, choices.sampling)
    return band[CRITICAL].sel(group="pooled", drop=True)
