"""The numbers of two studies side by side, and the intervals of their changes.

If both studies have the same sets of scans, their scatter cancels from the change in each set.
"""

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from enum import StrEnum
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, NumberStatus
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.edges import EDGE_NAMES, EdgeStatus
from hardcontact.paper.claims.verdicts import sets_interval, stretch_interval
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS, FORCE_UNITS, PAIR_UNITS
from hardcontact.report.quantities import NO_INTERVAL_WORDS, numbers_of_answer
from hardcontact.surfaces.metrics import TABLE1_METRICS

#: Digits to which equal numbers agree. Other processors cause relative changes up to 1.7e-10.
EQUAL_DIGITS = 8
#: What a study is of, by its kind.
STUDIED = {"paper": "the paper", "own surfaces": "your surfaces"}
INPUT_SOURCES = ("given", "assumed", "file")
#: Statuses of numbers whose interval has no low end.
NO_LOW_END = (EdgeStatus.OPEN_BELOW, NumberStatus.INTERVAL_OPEN_LOW, *NO_INTERVAL_WORDS)
#: Statuses of numbers whose interval has no high end.
NO_HIGH_END = (EdgeStatus.OPEN_ABOVE, NumberStatus.INTERVAL_OPEN_HIGH, *NO_INTERVAL_WORDS)
#: Names of the numbers that stand first in a comparison, and of those that stand last.
MAIN_NUMBERS = re.compile(
    "((outermost|averaged)_)?(short|long)_edge|mean_force|(range|work)_of_adhesion"
)
MINOR_NUMBERS = re.compile("(bumps|pits|gaussian|verdicts)_.*|.*_(scatter|agreeing_share)")

SET_DATASETS = ("sets", "topography", "filtered_forces", "features")
#: Parameters of sets.nc that decide which scans and masters a set has.
SAMPLING_PARAMETERS = ("pool_chunks", "candidate_chunks", "master_surfaces", "master_pool_size")
SAMPLING_SETTINGS = ("seed", "master_count")
#: Largest relative difference of equal surfaces. Other processors cause up to 7e-16.
SURFACE_TOLERANCE = 1e-6


class Agreement(StrEnum):
    """How the numbers of two studies agree."""

    CHANGED = "changed"  #: The interval of a ratio excludes 1, or that of a difference 0.
    DIFFERENT = "different"  #: The intervals of both numbers do not overlap.
    UNCHANGED = "unchanged"  #: The interval of a ratio includes 1, or that of a difference 0.
    SAME = "same"  #: The intervals of both numbers overlap.
    NO_INTERVAL = "no_interval"  #: Neither number has an interval.
    UNKNOWN = "unknown"  #: One of the numbers is not known.
    EQUAL = "equal"  #: Equal to EQUAL_DIGITS.


#: Order of rows by agreement; the others, which resolve no change, have rank 2.
AGREEMENT_RANKS = {Agreement.CHANGED: 0, Agreement.DIFFERENT: 1, Agreement.EQUAL: 3}


class DifferingInput(NamedTuple):
    """An input that differs: its name, and the values of both studies, texts or Numbers."""

    surface: str  #: Label; empty for the whole study.
    name: str
    first: Any
    second: Any


class ComparedNumber(NamedTuple):
    """A result that both studies have."""

    surface: str  #: Label; empty for the whole study.
    name: str
    first: Number
    second: Number
    #: Ends of the interval of `change`, from sets of scans that both studies share.
    change_interval: tuple[float, float] = (math.nan, math.nan)

    @property
    def change(self) -> Number:
        """The `ratio` second / first; if it is not positive, the `difference` second - first."""
        first, second = self.first.value, self.second.value
        if first * second > 0:
            return Number("ratio", second / first, "1", *self.change_interval)
        return Number("difference", second - first, self.first.unit, *self.change_interval)

    @property
    def is_equal(self) -> bool:
        """Whether values, ends and status of both numbers are equal, to EQUAL_DIGITS."""
        first = [self.first.value, self.first.low, self.first.high]
        second = [self.second.value, self.second.low, self.second.high]
        is_close = np.isclose(first, second, rtol=10.0**-EQUAL_DIGITS, atol=0, equal_nan=True)
        return bool(is_close.all()) and self.first.status == self.second.status

    @property
    def agreement(self) -> Agreement:
        """How both numbers agree; an interval of the change comes before their own intervals."""
        if self.is_equal:
            return Agreement.EQUAL
        if not (is_known(self.first) and is_known(self.second)):
            return Agreement.UNKNOWN
        low_change, high_change = self.change_interval
        if math.isfinite(low_change):
            no_change = 1 if self.change.name == "ratio" else 0
            includes_no_change = low_change <= no_change <= high_change
            return Agreement.UNCHANGED if includes_no_change else Agreement.CHANGED
        if lacks_interval(self.first) and lacks_interval(self.second):
            return Agreement.NO_INTERVAL
        lows, highs = zip(bounds(self.first), bounds(self.second), strict=True)
        return Agreement.SAME if max(lows) <= min(highs) else Agreement.DIFFERENT

    @property
    def sort_key(self) -> tuple[bool, bool, int, float]:
        """Key that sorts rows: main numbers first, minor last; then resolved, large changes."""
        largest = max(abs(self.first.value), abs(self.second.value)) or 1.0
        relative_change = np.nan_to_num(abs(self.second.value - self.first.value) / largest)
        is_minor = bool(MINOR_NUMBERS.fullmatch(self.name))
        is_main = bool(MAIN_NUMBERS.fullmatch(self.name))
        return is_minor, not is_main, AGREEMENT_RANKS.get(self.agreement, 2), -relative_change


def compare_answers(
    first: Mapping[str, Any], second: Mapping[str, Any]
) -> tuple[list[DifferingInput], list[ComparedNumber]]:
    """Return the inputs that differ between two answers, and the results that both have.

    Raises ValueError if the studies are not of the same kind.
    """
    if first["kind"] != second["kind"]:
        raise ValueError(
            f"{second['study']}: expected a study of {STUDIED[first['kind']]}, as "
            f"{first['study']} is, found one of {STUDIED[second['kind']]}"
        )
    inputs = [*_differing_inputs(first, second)]
    results = []
    for number in _numbers_of_both(first, second):
        if number.first.source not in INPUT_SOURCES:
            results.append(number)
        # `_changed_contact` compares the inputs of contacts.
        elif number.name.replace("_", " ") not in first["contact"] and not number.is_equal:
            inputs.append(DifferingInput(number.surface, number.name, number.first, number.second))
    return inputs, results


def _differing_inputs(
    first: Mapping[str, Any], second: Mapping[str, Any]
) -> Iterator[DifferingInput]:
    """Yield the inputs of contacts, the surfaces and the effort that differ between two answers."""
    first_texts, second_texts = map(_input_texts, (first, second))
    for name in first_texts | second_texts:
        first_text, second_text = first_texts.get(name, ""), second_texts.get(name, "")
        if first_text != second_text:
            yield DifferingInput("", name, first_text, second_text)


def _input_texts(answer: Mapping[str, Any]) -> dict[str, str]:
    """Return the inputs of contacts, the surfaces and the effort of an answer by name."""
    surfaces = ", ".join(row["label"] for row in answer["surfaces"])
    return {**answer["contact"], "surfaces": surfaces, "effort": answer["effort"]}


def _numbers_of_both(
    first: Mapping[str, Any], second: Mapping[str, Any]
) -> Iterator[ComparedNumber]:
    """Yield the numbers of the whole study, then of each surface, that both answers have.

    Published numbers, and numbers that neither study knows, are left out. Two studies of one
    surface each are compared whatever their surfaces are called.
    """
    first_labels = {surface["name"]: surface["label"] for surface in first["surfaces"]}
    second_labels = {surface["name"]: surface["label"] for surface in second["surfaces"]}
    surfaces = {name: name for name in first_labels if name in second_labels}
    if len(first_labels) == len(second_labels) == 1:
        surfaces = dict(zip(first_labels, second_labels, strict=True))
    for first_surface, second_surface in {"": "", **surfaces}.items():
        both_labels = (first_labels.get(first_surface, ""), second_labels.get(second_surface, ""))
        label = " / ".join(dict.fromkeys(both_labels))
        second_numbers = numbers_of_answer(second, second_surface)
        for name, first_number in numbers_of_answer(first, first_surface).items():
            second_number = second_numbers.get(name)
            if second_number is None or first_number.source == "published":
                continue
            if is_known(first_number) or is_known(second_number):
                yield ComparedNumber(label, name, first_number, second_number)


def is_known(number: Number) -> bool:
    """Return whether the value of a number or an end of its interval is known."""
    return any(map(math.isfinite, (number.value, number.low, number.high)))


def lacks_interval(number: Number) -> bool:
    """Return whether a number has no interval, not even an unbounded one, and is no bound."""
    has_no_end = math.isnan(number.low) and math.isnan(number.high)
    return has_no_end and number.status not in (*NO_LOW_END, *NO_HIGH_END)


def bounds(number: Number) -> tuple[float, float]:
    """Return both ends, infinite if open, of the interval of a known number, or twice its value."""
    low, high = number.low, number.high
    if math.isnan(low) and math.isnan(high):
        low = high = number.value
    no_low_end = math.isnan(low) or number.status in NO_LOW_END
    no_high_end = math.isnan(high) or number.status in NO_HIGH_END
    return -math.inf if no_low_end else low, math.inf if no_high_end else high


def pairing(first_study: Mapping[str, xr.Dataset], second_study: Mapping[str, xr.Dataset]) -> str:
    """Return "paired" if two studies have the same sets of scans, otherwise why not.

    A study is its SET_DATASETS by name, empty if one is missing.
    """
    if not (first_study and second_study):
        return "no_sets"
    first, second = _recorded_surfaces(first_study), _recorded_surfaces(second_study)
    same_sampling = _sampling(first_study["sets"]) == _sampling(second_study["sets"])
    if not same_sampling or first.sizes != second.sizes:
        return "other_scans"
    same_surfaces = all(
        np.allclose(first[name], second[name], rtol=SURFACE_TOLERANCE, atol=0, equal_nan=True)
        for name in first
    )
    return "paired" if same_surfaces else "other_scans"


def _sampling(sets: xr.Dataset) -> list[Any]:
    """Return the parameters of sets.nc that decide which scans and masters a set has."""
    parameters = json.loads(sets.attrs["parameters"])
    settings = [parameters["settings"][name] for name in SAMPLING_SETTINGS]
    return [parameters[name] for name in SAMPLING_PARAMETERS] + settings


def _recorded_surfaces(datasets: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the roughness of a study's scans, and transitions and spectrum ends of its masters."""
    scans = datasets["topography"][list(TABLE1_METRICS.values())]
    return xr.merge(
        [scans, datasets["filtered_forces"][["spectrum_end", "transition"]]], join="outer"
    )


def add_paired_intervals(
    numbers: Iterable[ComparedNumber],
    first_study: Mapping[str, xr.Dataset],
    second_study: Mapping[str, xr.Dataset],
) -> list[ComparedNumber]:
    """Add the intervals of changes between paired studies to the numbers that sets have."""
    first_numbers, second_numbers = _set_numbers(first_study), _set_numbers(second_study)
    paired_numbers = []
    for number in numbers:
        key = number.surface, number.name
        if key in first_numbers and key in second_numbers:
            first, second = first_numbers[key], second_numbers[key]
            changes = second / first if number.change.name == "ratio" else second - first
            interval = sets_interval(changes.values, first_study["sets"].attrs["confidence"])
            low, high = stretch_interval(interval, number.change.value)
            number = number._replace(change_interval=(float(low), float(high)))
        paired_numbers.append(number)
    return paired_numbers


def _set_numbers(datasets: Mapping[str, xr.Dataset]) -> dict[tuple[str, str], xr.DataArray]:
    """Return the numbers (set,) or (candidate,) by the label of the surface and their name."""
    sets, features = datasets["sets"], datasets["features"]
    labels = datasets["topography"]["label"].to_series()[sets["surface"].values]
    claims = {("", name): claim for name, claim in ANSWER_CLAIMS.items()}
    claims |= {(label, "mean_force"): f"mean_force_{surface}" for surface, label in labels.items()}
    numbers = {
        key: sets["value"].sel(claim=claim)
        for key, claim in claims.items()
        if claim in sets["claim"].values
    }
    for name in PAIR_UNITS:
        fit = sets[name].sel(contact_model=PLASTIC)
        numbers |= {("", name): fit, ("", f"all_surfaces_{name}"): fit}
    for side, name in EDGE_NAMES.items():
        for surface, label in labels.items():
            numbers[label, name] = sets["edge"].sel(side=side, group=surface)
    for feature_kind, name in product(features["features"].values, FORCE_UNITS):
        key = "", f"{feature_kind}_{name.removesuffix('_at_pair')}"
        numbers[key] = features[name].sel(features=feature_kind)
    return numbers
