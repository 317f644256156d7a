"""The answer of the paper's study has the numbers of the claims and of the datasets."""

import json

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from paper_datasets import published_table1, scan_size, topography
from paper_numbers import LABELS, SUBSTRATES
from paper_study import answer, claims, datasets
from repository import PAPER, ROOT

from hardcontact.base.number import Number
from hardcontact.config.configuration import merge_overlay
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS
from hardcontact.report.paper_study.tables import table1_rows
from hardcontact.report.quantities import numbers_of_answer

SCHEMA = json.loads((ROOT / "workflow/schemas/answer.schema.json").read_text("utf-8"))


def change_claim(name, **values):
    """The claims, with other values of a single claim."""
    table = claims()
    for column, value in values.items():
        table.loc[table["id"] == ANSWER_CLAIMS[name], column] = value
    return table


def test_the_answer_follows_its_schema_and_has_the_numbers_of_the_claims():
    content = answer()
    Draft202012Validator(SCHEMA).validate(content)
    rows = {(row["surface"], row["name"]): row for row in content["quantities"]}
    table = claims().set_index("id")
    for name, claim in ANSWER_CLAIMS.items():
        low = table["low"][claim]
        assert rows["", name]["value"] == table["computed"][claim]
        assert rows["", name]["low"] == (None if np.isnan(low) else low)
    for surface in SUBSTRATES:
        edge = rows[surface, "short_edge"]
        # The central 90 % of the edges of sets, which lie evenly from 0.9 to 1.3 times 60 nm.
        assert [edge["value"], edge["low"], edge["high"]] == pytest.approx([60, 55.2, 76.8])


@pytest.mark.parametrize(("grid", "effort"), [
    ({}, "full"), ({"contacts": 6}, "quick"), ({"pixels": 128}, "quick"),
])  # fmt: skip
def test_grids_coarser_than_the_paper_s_are_recognized(grid, effort):
    assert answer(**datasets(**grid))["effort"] == effort


@pytest.mark.parametrize(("overlay", "inputs"), [
    ({"sphere": {"radius": "62.5 um"}}, ["radius of the sphere"]),
    ({"contact": {"hardness": "30 GPa", "preload": "5 uN"}}, ["hardness", "preload"]),
    ({"adhesion": {"range": "4 nm"}, "band": {"sphere_roughness": True}},
     ["range of adhesion", "sphere in computations of the band"]),
    ({"adhesion": {"work": "60 mJ/m2"}}, []),
    ({"study": "again", "seed": 1,
      "contact": {"contacts_per_row": 6, "hardness": "25000 MPa"}}, []),
])  # fmt: skip
def test_a_study_of_other_contacts_names_what_is_not_the_paper_s(overlay, inputs):
    """Other names, seeds, grids and units are no other contacts; the work is fitted."""
    content = answer(configuration=merge_overlay(PAPER, overlay))
    assert [row["input"] for row in content["changed"]] == inputs
    assert all(row["study"] == content["contact"][row["input"]] for row in content["changed"])
    judgements = [
        row["name"]
        for row in content["quantities"]
        if "verdicts_" in row["name"] or "_agreeing_share" in row["name"]
    ]
    assert bool(judgements) == (inputs == [])


def test_an_edge_at_wavelengths_of_artificial_roughness_says_so():
    """Roughness is artificial below the short transition and above the long one.

    Without plasticity, and at a short range, the edge is at 50 nm.
    """
    sources = {}
    for short, long in ((20.0, 5000.0), (80.0, 1000.0)):
        filtered_forces = datasets()["filtered_forces"].assign(transition=("side", [short, long]))
        rows = change_claim("outermost_short_edge", computed=50.0)
        rows.loc[rows["id"] == ANSWER_CLAIMS["outermost_long_edge"], "computed"] = 2000.0
        content = answer(rows, filtered_forces=filtered_forces)
        numbers = numbers_of_answer(content)
        names = ("outermost_short_edge", "outermost_long_edge", "plasticity_shift", "range_shift")
        sources[short] = [numbers[name].source for name in names]
        mcd = numbers_of_answer(content, "mcd")
        assert mcd["short_edge"].source == sources[short][0]
    assert sources == {20.0: ["computed"] * 4, 80.0: ["artificial"] * 4}


@pytest.mark.parametrize(("verdict", "edge", "explained"), [
    ("undecided", 2000.0, True), ("undecided", 900.0, False), ("reproduced", 2000.0, False),
])  # fmt: skip
def test_the_headline_explains_an_undecided_long_edge_of_artificial_roughness(
    verdict, edge, explained
):
    rows = change_claim("outermost_long_edge", verdict=verdict, computed=edge)
    (line,) = [line for line in answer(rows)["headline"] if line.startswith("Long edge")]
    assert line.startswith(f"Long edge, {verdict}: ")
    assert ("This edge rests on chance" in line) == explained
    assert ("is likely too long" in line) == explained


def test_the_headline_names_the_coatings_with_the_outermost_edges():
    edges = datasets()["edges"].copy(deep=True)
    for side, values in {"short": [53, 37, 66, 60], "long": [2000, 1800, 2800, 1900]}.items():
        edges["edge"].loc[{"side": side, "group": list(SUBSTRATES)}] = values
    headline = answer(edges=edges)["headline"]
    for side, label in (("Short", LABELS[1]), ("Long", LABELS[2])):
        (line,) = [line for line in headline if line.startswith(f"{side} edge")]
        assert f", on {label}" in line


@pytest.mark.parametrize(("published", "nearer"), [(1.8, "bumps"), (0.3, "pits")])
def test_features_are_those_with_the_nearer_scatter(published, nearer):
    """The scatter of ln F is 1.9 with bumps and 0.25 with pits."""
    features = datasets()["features"].assign_attrs(published_log_force_std=published)
    assert f"{nearer} come closer to it" in answer(features=features)["notes"][-1]["text"]


def test_the_small_scan_ratio_is_that_of_scans_of_the_same_size():
    forces = scan_size()
    labels = {"surface": "mcd", "map_size": 2500.0}
    forces["force_over_largest"].loc[labels] = 2.24
    forces["force_over_largest_interval"].loc[labels] = [1.48, 3.39]
    ratio = Number("small_scan_ratio", 2.24, "1", 1.48, 3.39)
    assert numbers_of_answer(answer(scan_size=forces), "mcd")["small_scan_ratio"] == ratio


def test_table_1_compares_values_and_marks_those_by_construction():
    rows = table1_rows(topography(), published_table1())
    # Height has two rows and slope three, so that curvature begins with the sixth.
    height, curvature = rows[0], rows[5:8]
    assert height[0] == "AFM scans: rms height (nm), published" and height[4] == "107.1 ± 12.0"
    assert [row[3].split()[0] for row in curvature] == ["39", "39.0", "78.0"]
    marked = [row[0] for row in rows if "†" in row[1]]
    assert marked == ["computed", "computed, gradient", "computed, half the Laplacian"]


def test_forces_on_features_are_medians_over_candidates():
    numbers = numbers_of_answer(answer())
    number = numbers["bumps_mean_force"]
    # Two candidates have 8 µN and 20 µN; one of them agrees.
    assert number.value == pytest.approx(14e-6)
    assert 8e-6 < number.low < number.value < number.high < 20e-6
    assert numbers["bumps_candidates_that_agree"].value == 0.5
    assert numbers["pits_candidates_that_agree"].value == 0
    assert numbers["featured_mean_force_published"].value == 8.8e-6
