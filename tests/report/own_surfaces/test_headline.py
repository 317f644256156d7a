"""The facts of the headline follow from numbers and cautions."""

import numpy as np
import pytest

from hardcontact.base.number import Number, numbers_by_name
from hardcontact.report.own_surfaces.cautions import Caution
from hardcontact.report.own_surfaces.headline import edges_overlap, known_pairs, surface_facts

EDGES = numbers_by_name(
    Number("short_edge", 300.0, "nm", 250.0, 400.0), Number("long_edge", 900.0, "nm", 500.0, 2e3)
)
PAIR_FORCES = {"long_range": 3e-7, "short_range": np.nan}


def facts(*cautions, band_status="found", source="measured"):
    """Facts of a surface whose edges are known."""
    return surface_facts(EDGES, cautions, band_status, source)


@pytest.mark.parametrize(("numbers", "overlap"), [
    ([], False),
    ([Number("short_edge", 300.0, "nm", 250.0, 600.0)], True),
    ([Number("short_edge_cutoffs", np.nan, "nm", 160.0, 320.0)], False),
    ([Number("long_edge_cutoffs", np.nan, "nm", 320.0, 640.0)], True),
    ([Number("short_edge", 300.0, "nm")], False),
])  # fmt: skip
def test_edges_overlap_if_their_intervals_or_cutoffs_do(numbers, overlap):
    assert edges_overlap(EDGES | numbers_by_name(*numbers)) == overlap


def test_pairs_without_a_force_are_not_shown():
    numbers = numbers_by_name(
        *(Number(f"force_of_pair_{name}", force, "N") for name, force in PAIR_FORCES.items()),
        *(Number(f"force_of_pair_{name}_share", 0.5) for name in PAIR_FORCES),
    )
    assert known_pairs(numbers) == ["force_of_pair_long_range"]


@pytest.mark.parametrize(("ratio", "grave", "fails"), [
    (0.3, True, True), (np.nan, True, False), (1.0, False, False),
])  # fmt: skip
def test_only_a_grave_hindcast_that_tested_an_octave_fails(ratio, grave, fails):
    caution = Caution("hindcast_short", Number("ratio", ratio), grave=grave)
    assert facts(caution)["failed_hindcasts"] == [caution] * fails


def test_only_a_small_scan_has_a_ratio_of_forces():
    ratio = Number("ratio", np.nan, "1", 1.2, 1.6)
    assert facts(Caution("small_scan", ratio))["small_scan_ratio"] == ratio
    assert facts(Caution("ripples"))["small_scan_ratio"] is None


@pytest.mark.parametrize(("options", "says"), [
    ({}, False), ({"band_status": "unknown"}, True),
    ({"band_status": "unknown", "source": "substitute"}, False),
])  # fmt: skip
def test_scans_without_a_band_say_whether_they_answer_the_question(options, says):
    assert facts(**options)["says_if_answered"] == says
