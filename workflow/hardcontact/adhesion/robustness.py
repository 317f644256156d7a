"""Range and work of adhesion and the critical band under every variant of the study's choices.

A variant is a dict of its `name`, `label` and `group`, of `variant` (the variant of each
substrate's scans, by the substrate), of `load` (the name of hardness and preload) and of `probe`
(the sphere of the filtered masters). The intervals of all variants come from the same random
numbers, so that only what they vary makes them differ.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.adhesion.critical_band import critical_band
from hardcontact.adhesion.inference import infer_model
from hardcontact.records import log
from hardcontact.records.dataset import stack

__all__ = ["Choices", "robustness"]

Forces = TypeVar("Forces", xr.DataArray, xr.Dataset)

#: What is computed for every variant of the forces.
INFERRED = [
    "range_of_adhesion",
    "range_of_adhesion_interval",
    "work_of_adhesion",
    "work_of_adhesion_interval",
    "best_error",
]

#: What is computed for every variant of the filtered masters.
CRITICAL = ["critical_wavelength", "critical_wavelength_interval"]


@dataclass(frozen=True)
class Choices:
    """What all variants share.

    Attributes
    ----------
    substrates : list of str
        The surfaces, in their order.
    basis : dict of str
        Whether the scans of each surface are measured or substitutes.
    reference_surface : str
        The one that forces are divided by.
    probe : str
        The study's sphere of the filtered masters; another one leaves range and work as they are.
    error_threshold : float
        Of the mean relative error.
    tolerance : float
        Relative change of the force that ends the critical band.
    bootstrap : Bootstrap
        Of all intervals.
    """

    substrates: list[str]
    basis: dict[str, str]
    reference_surface: str
    probe: str
    error_threshold: float
    tolerance: float
    bootstrap: Bootstrap


def robustness(
    pairs: Mapping[tuple[Any, ...], xr.Dataset],
    masters: Mapping[tuple[Any, ...], xr.Dataset],
    variants: Sequence[dict[str, Any]],
    published: pd.DataFrame,
    choices: Choices,
) -> xr.Dataset:
    """Return range and work of adhesion and the critical band under every variant.

    Parameters
    ----------
    pairs : mapping of tuple to xarray.Dataset
        pull_off_force (load, rho) in N by surface, variant, scan and sphere_scan.
    masters : mapping of tuple to xarray.Dataset
        pull_off_force (cutoff_wavelength, load), unfiltered_pull_off_force (load) in N and
        unfiltered_wavelength in nm by surface, variant, realization, side and probe.
    variants : sequence of dict
        As this module describes them.
    published : pandas.DataFrame
        Measured forces, as from `published.pull_off`.
    choices : Choices
        What all variants share.

    Returns
    -------
    xarray.Dataset
        Over variant and side; critical wavelengths are those of all substrates pooled.
    """
    target = published.mean_force.reindex(choices.substrates).to_numpy()
    forces = _stacked_forces(pairs)
    parts = [
        xr.merge([_range_and_work(forces, target, one, choices), _band(masters, one, choices)])
        for one in log.progress(variants, len(variants), "variants")
    ]
    varied = xr.concat(parts, pd.Index([one["name"] for one in variants], name="variant"))
    return varied.assign_coords(
        variant_label=("variant", [one["label"] for one in variants]),
        group=("variant", [one["group"] for one in variants]),
    ).assign_attrs(
        tolerance=choices.tolerance,
        confidence=choices.bootstrap.confidence,
        basis=", ".join(f"{name}: {choices.basis[name]}" for name in choices.substrates),
        realizations=len({realization for _, _, realization, _, _ in masters}),
    )


def _stacked_forces(
    pairs: Mapping[tuple[Any, ...], xr.Dataset],
) -> dict[tuple[str, str], xr.DataArray]:
    """Return forces (scan, sphere_scan, load, rho) by surface and variant."""
    parts: dict[tuple[str, str], dict[tuple[Any, ...], xr.Dataset]] = {}
    for (surface, variant, *scans), pair in pairs.items():
        parts.setdefault((surface, variant), {})[tuple(scans)] = pair
    return {
        key: stack(group, ["scan", "sphere_scan"]).pull_off_force for key, group in parts.items()
    }


def _at_load(forces: Forces, load: str) -> Forces:
    """Return the forces at one load, by its name."""
    known = forces["load"].values.tolist()
    if load not in known:
        raise ValueError(f"expected forces at the load {load}, found those at {', '.join(known)}")
    return forces.sel(load=load, drop=True)


def _range_and_work(
    forces: Mapping[tuple[str, str], xr.DataArray],
    target: np.ndarray,
    variant: dict[str, Any],
    choices: Choices,
) -> xr.Dataset:
    """Return INFERRED of one variant; none for another probe, which does not affect them."""
    if variant["probe"] != choices.probe:
        return xr.Dataset()
    stacked = xr.concat(
        [
            _at_load(forces[name, variant["variant"][name]], variant["load"])
            for name in choices.substrates
        ],
        pd.Index(choices.substrates, name="surface"),
        join="outer",
    )
    return infer_model(
        stacked.expand_dims(["contact_y", "contact_x"], [-2, -1]),
        target,
        choices.substrates.index(choices.reference_surface),
        choices.error_threshold,
        choices.bootstrap,
    )[INFERRED]


def _band(
    masters: Mapping[tuple[Any, ...], xr.Dataset], variant: dict[str, Any], choices: Choices
) -> xr.Dataset:
    """Return CRITICAL (side) of all substrates of one variant pooled."""
    parts = {}
    for name in choices.substrates:
        of_substrate = name, variant["variant"][name]
        for (*surface, realization, side, probe), master in masters.items():
            if (*surface, probe) == (*of_substrate, variant["probe"]):
                chosen = _at_load(master, variant["load"])
                ratio = chosen.pull_off_force / chosen.unfiltered_pull_off_force
                chosen = chosen.assign(ratio=ratio)[["ratio", "unfiltered_wavelength"]]
                parts[name, realization, side] = chosen
    curves = stack(parts, ["surface", "realization", "side"]).sortby("cutoff_wavelength")
    curves["unfiltered_wavelength"] = curves.unfiltered_wavelength.isel(realization=0, drop=True)
    band = critical_band(curves, choices.tolerance, choices.bootstrap)
    return band[CRITICAL].sel(group="pooled", drop=True)
