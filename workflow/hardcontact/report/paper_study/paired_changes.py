"""Changes between two studies with the same sets of scans, set by set: their scatter cancels.

Random numbers of a set depend on the seed, the surface and the number of the set alone, not on the
contacts. The datasets of a study are its SET_DATASETS.
"""

import json
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.claims.verdicts import sets_interval, stretch_interval
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS, FORCE_UNITS, PAIR_UNITS
from hardcontact.report.quantities import EDGE_NAMES
from hardcontact.report.study_comparison import ComparedNumber
from hardcontact.surfaces.metrics import TABLE1_METRICS

SET_DATASETS = ("sets", "topography", "scales", "features")
#: Parameters of sets.nc that decide which scans and masters a set has.
SAMPLING_PARAMETERS = (
    "pool_chunks", "candidate_chunks", "master_surfaces", "realizations",
)  # fmt: skip
SAMPLING_SETTINGS = ("seed", "realizations")
#: Relative difference of equal surfaces: far more than other processors cause, 7e-16.
TOLERANCE = 1e-6


def pairing(first_study: Mapping[str, xr.Dataset], second_study: Mapping[str, xr.Dataset]) -> str:
    """Return "paired" if two studies have the same sets of scans, otherwise why not.

    "no_sets": a study has no datasets. "other_scans": seeds or recorded surfaces differ.
    """
    if not (first_study and second_study):
        return "no_sets"
    surfaces = [_recorded_surfaces(study) for study in (first_study, second_study)]
    same_seeds = _sampling(first_study["sets"]) == _sampling(second_study["sets"])
    if not same_seeds or surfaces[0].sizes != surfaces[1].sizes:
        return "other_scans"
    same_surfaces = all(
        np.allclose(surfaces[0][name], surfaces[1][name], TOLERANCE, 0, equal_nan=True)
        for name in surfaces[0]
    )
    return "paired" if same_surfaces else "other_scans"


def _sampling(sets: xr.Dataset) -> list[Any]:
    """Return the parameters of sets.nc that decide which scans and masters a set has."""
    parameters = json.loads(sets.attrs["parameters"])
    settings = parameters["settings"]
    return [
        *(parameters[name] for name in SAMPLING_PARAMETERS),
        *(settings[name] for name in SAMPLING_SETTINGS),
    ]


def _recorded_surfaces(study: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return what a study records of its scans, and of its masters."""
    scans = study["topography"][list(TABLE1_METRICS.values())]
    return xr.merge([scans, study["scales"][["unfiltered_wavelength", "transition"]]], join="outer")


def add_paired_intervals(
    numbers: Iterable[ComparedNumber],
    first_study: Mapping[str, xr.Dataset],
    second_study: Mapping[str, xr.Dataset],
) -> list[ComparedNumber]:
    """Add the intervals of changes between paired studies to the numbers that sets have."""
    first_values, second_values = _set_numbers(first_study), _set_numbers(second_study)
    confidence = first_study["sets"].attrs["confidence"]
    return [
        _add_change_interval(number, first_values[key], second_values[key], confidence)
        if (key := (number.surface, number.name)) in first_values and key in second_values
        else number
        for number in numbers
    ]


def _set_numbers(study: Mapping[str, xr.Dataset]) -> dict[tuple[str, str], xr.DataArray]:
    """Return the numbers (set,) or (sample,) by the label of the surface and their name.

    The label is empty for the whole study, and names are as in answer.json.
    """
    sets = study["sets"]
    labels = study["topography"]["label"].to_series()[sets["surface"].values]
    claim_names = {("", name): claim for name, claim in ANSWER_CLAIMS.items()}
    claim_names |= {
        (label, "mean_force"): f"mean_force_{surface}" for surface, label in labels.items()
    }
    claims = {
        key: sets["value"].sel(claim=claim)
        for key, claim in claim_names.items()
        if claim in sets["claim"].values
    }
    fits = {
        ("", prefix + name): sets[name].sel(contact_model=PLASTIC)
        for name in PAIR_UNITS
        for prefix in ("", "all_surfaces_")
    }
    edges = {
        (label, name): sets["edge"].sel(side=side, group=surface)
        for side, name in EDGE_NAMES.items()
        for surface, label in labels.items()
    }
    forces = {
        ("", f"{kind}_{name.removesuffix('_at_pair')}"): study["features"][name].sel(features=kind)
        for kind in study["features"]["features"].values
        for name in FORCE_UNITS
    }
    return claims | fits | edges | forces


def _add_change_interval(
    number: ComparedNumber, first: xr.DataArray, second: xr.DataArray, confidence: float
) -> ComparedNumber:
    """Return a number with the interval of its change, from both numbers (set,) of each set."""
    changes = second / first if number.change.name == "ratio" else second - first
    interval = sets_interval(changes.values, confidence)
    low, high = stretch_interval(interval, number.change.value)
    return number._replace(change_interval=(float(low), float(high)))
