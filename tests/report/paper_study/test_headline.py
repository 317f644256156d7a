"""The facts of the headline follow from numbers and verdicts."""

import pytest

from hardcontact.base.number import Number, numbers_by_name
from hardcontact.report.paper_study.headline import (
    agreeing_sets,
    crossed_limits,
    headline_facts,
    outermost_coatings,
)


def facts(*changed_numbers, verdict="undecided", judged=True):
    """Facts of a study with five masters, whose long edge lies in artificial roughness."""
    numbers = numbers_by_name(
        Number("masters", 5),
        Number("outermost_short_edge", 37.0, "nm"),
        Number("outermost_long_edge", 2700.0, "nm", source="artificial"),
        Number("band_force_ratio", 1.09, "1", 1.02, 1.18),
        Number("plasticity_shift", 3.3, "1", 1.8, 4.2),
        Number("range_shift", 1.9, "1", 1.2, 3.2),
        *(Number(f"octave_{rank}_sensitivity", -0.5) for rank in (1, 2, 3)),
    )
    claim = {
        "verdict": verdict, "agreeing_share": 0.27, "accepted_low": 0.9, "accepted_high": 1.1,
    }  # fmt: skip
    claims = dict.fromkeys(["outermost_long_edge", "band_is_sufficient"], claim) if judged else {}
    return headline_facts(numbers | numbers_by_name(*changed_numbers), coatings(), claims, 100)


def coatings():
    """Edges (nm) of two coatings by label."""
    edges = {"UNCD": (37.0, 1800.0), "NCD": (60.0, 2700.0)}
    return {
        label: numbers_by_name(Number("short_edge", short), Number("long_edge", long))
        for label, (short, long) in edges.items()
    }


@pytest.mark.parametrize(("changed", "options", "rests_on_chance"), [
    ([], {}, True),
    ([], {"verdict": "reproduced"}, False),
    ([], {"judged": False}, False),
    ([Number("masters", 3)], {}, False),
    ([Number("outermost_long_edge", 900.0, "nm")], {}, False),
])  # fmt: skip
def test_an_undecided_long_edge_of_random_waves_rests_on_chance(changed, options, rests_on_chance):
    assert facts(*changed, **options)["rests_on_chance"] == rests_on_chance


@pytest.mark.parametrize(("masters", "few"), [(3, True), (4, False)])
def test_repetitions_are_few_below_four_masters(masters, few):
    assert facts(Number("masters", masters))["has_few_masters"] == few


def test_sets_agree_with_claims_that_they_judge():
    claims = {"judged": {"agreeing_share": 0.29}, "not judged": {"agreeing_share": None}}
    assert agreeing_sets(claims, 100) == {"judged": 29}


@pytest.mark.parametrize(("low", "high", "crossed"), [
    (0.8, 1.3, [0.9, 1.1]), (1.02, 1.18, [1.1]), (0.95, 1.05, []), (1.1, 1.3, []),
])  # fmt: skip
def test_an_interval_crosses_the_limits_within_it(low, high, crossed):
    claim = {"accepted_low": 0.9, "accepted_high": 1.1}
    assert crossed_limits(Number("band_force_ratio", 1.0, "1", low, high), claim) == crossed


def test_limits_are_crossed_only_by_an_undecided_number():
    assert facts()["crossed_limits"] == [1.1]
    assert facts(verdict="not reproduced")["crossed_limits"] == []
    assert facts(judged=False)["crossed_limits"] == []


@pytest.mark.parametrize("shift", ["plasticity_shift", "range_shift"])
def test_both_reasons_hold_if_both_shifts_exceed_one(shift):
    assert facts()["both_reasons_hold"]
    assert not facts(Number(shift, 3.0, "1", 0.9, 7.7))["both_reasons_hold"]


def test_roughness_lowers_the_force_if_it_does_in_each_of_the_strongest_octaves():
    assert facts()["roughness_lowers_force"]
    assert not facts(Number("octave_3_sensitivity", 0.1))["roughness_lowers_force"]


def test_the_outermost_edges_are_the_shortest_short_and_the_longest_long_edge():
    labels = {"outermost_short_edge": "UNCD", "outermost_long_edge": "NCD"}
    assert outermost_coatings(coatings()) == labels
