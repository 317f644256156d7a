"""answer.json of your surfaces: one flat list with the numbers of the datasets."""

import json
from functools import cache

import own_answers
import own_datasets as own
import pytest
from jsonschema import Draft202012Validator
from repository import ROOT

SCHEMA = json.loads((ROOT / "workflow/schemas/answer.schema.json").read_text("utf-8"))
CASES = own_answers.CASES | {"no band": own.datasets(edges=own.unresolved_edges())}


@cache
def answer_of(case):
    return own_answers.make_answer(CASES[case])


def quantities(case, surface="my_coating"):
    """The quantities of a surface by name."""
    rows = answer_of(case)["quantities"]
    return {row["name"]: row for row in rows if row["surface"] == surface}


@pytest.mark.parametrize("case", CASES)
def test_the_answer_follows_its_schema(case):
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(answer_of(case))


def test_the_answer_has_the_numbers_of_the_datasets():
    study_rows, surface_rows = quantities("one", ""), quantities("one")
    assert (study_rows["range_of_adhesion"]["value"], study_rows["work_of_adhesion"]["value"]) == (
        own.RANGE, own.WORK,
    )  # fmt: skip
    assert study_rows["range_of_adhesion"]["source"] == "given"
    assert study_rows["work_of_adhesion"]["source"] == "assumed"
    long = own.edges().sel(surface="my_coating", side="long")
    assert surface_rows["long_edge"]["value"] == long["edge"]
    ends = [surface_rows["long_edge"][end] for end in ("low", "high")]
    assert ends == long["edge_interval"].values.tolist()
    plastic = own.force().sel(surface="my_coating", contact_model="plastic", rho=own.RANGE)
    assert surface_rows["mean_force"]["value"] == plastic["force"]
    assert surface_rows["middle_forces"]["high"] == plastic["force_quantile"][-1]
    assert surface_rows["force_of_pair_long_range_range"]["value"] == 10.0
    heights = own.topography().sel(surface="my_coating")["rms_height"].values
    assert surface_rows["scan_2_rms_height"]["value"] == heights[1]
    assert surface_rows["all_scales_rms_height"]["value"] == 6.2
    assert surface_rows["measurement_1_shortest_reliable"]["value"] == 55.0


def test_the_answer_has_the_three_strongest_octaves_that_a_scan_shows():
    rows = quantities("one")
    assert [rows[f"octave_{rank}"]["value"] for rank in (1, 2, 3)] == [80, 160, 40]
    numbers = [rows[f"octave_{rank}_sensitivity"] for rank in (1, 2, 3)]
    assert [number["value"] for number in numbers] == [-0.9, -0.4, -0.2]
    assert (numbers[0]["low"], numbers[0]["high"]) == (-1.4, -0.4)  # -0.9 ± 0.5
    assert "octave_4" not in rows


@pytest.mark.parametrize(("paper_values", "count"), [(["work of adhesion"], 2), (["hardness"], 0)])
def test_forces_at_other_pairs_are_given_only_if_range_or_work_is_assumed(paper_values, count):
    numbers = own_answers.numbers_of(own_answers.setting()._replace(assumed=paper_values))
    pairs = {"force_of_pair_long_range", "force_of_pair_short_range"}
    assert len(pairs & numbers.keys()) == count
