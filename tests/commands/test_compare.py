"""`hardcontact compare` says which inputs and which numbers of two studies differ."""

import json
from copy import deepcopy

import pytest
from html_page import Page
from paper_study import answer
from refusals import assert_says, refusal
from repository import PAPER

from hardcontact.base.number import Number
from hardcontact.commands.compare import compare, compare_arguments
from hardcontact.config.configuration import merge_overlay
from hardcontact.report.study_comparison import ComparedNumber, compare_answers

HARDER = merge_overlay(PAPER, {"study": "harder", "contact": {"hardness": "30 GPa"}})


@pytest.fixture(scope="module")
def paper():
    return answer()


@pytest.fixture
def studies(tmp_path, monkeypatch, paper):
    """Write the answers of both studies below the folder `results`; return it."""
    monkeypatch.chdir(tmp_path)
    for name, content in {"paper": paper, "harder": answer(configuration=HARDER)}.items():
        (tmp_path / "results" / name).mkdir(parents=True)
        (tmp_path / "results" / name / "answer.json").write_text(json.dumps(content), "utf-8")
    return tmp_path / "results"


def comparison(*words):
    return compare(compare_arguments([str(word) for word in words]))


def own_answer(study, label, effort="full"):
    """Return the answer of a study of one surface of the user, with a single number."""
    number = {"surface": label, **Number("mean_force", 1e-6, "N", 0.9e-6, 1.1e-6)._asdict()}
    return {
        "study": study, "kind": "own surfaces", "effort": effort,
        "contact": {"hardness": "25 GPa"},
        "surfaces": [{"name": label, "label": label}], "quantities": [number],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("factor", "name", "surface", "changes"),
    [
        (1 + 1e-10, "octave_1_sensitivity", "", []),
        (1.01, "octave_1_sensitivity", "", [("", "no_interval", 1.01)]),
        (1.01, "short_edge", "mcd", [("MCD", "same", 1.01)]),
    ],
)
def test_a_moved_number_is_not_equal(paper, factor, name, surface, changes):
    """Processors move numbers by 1e-10, and such numbers are equal."""
    moved_answer = deepcopy(paper)
    for row in moved_answer["quantities"]:
        if (row["surface"], row["name"]) == (surface, name):
            row["value"] *= factor
    _, rows = compare_answers(paper, moved_answer)
    moved = [
        (row.surface, row.agreement, pytest.approx(row.change.value))
        for row in rows
        if row.agreement != "equal"
    ]
    assert moved == changes


@pytest.mark.parametrize(("first", "second", "agreement"), [
    (Number("n", 5, low=4, high=6), Number("n", 7, low=5.9, high=8), "same"),
    (Number("n", 5, low=4, high=6), Number("n", 7, low=6.1, high=8), "different"),
    (Number("n", 5, low=4, high=6), Number("n", 5.5), "same"),
    (Number("n", 5, status="open_above"), Number("n", 7), "same"),
    (Number("n", 5, status="open_above"), Number("n", 4), "different"),
    (Number("n", 5, low=4, high=6, status="interval_open_high"), Number("n", 7), "same"),
    (Number("n", 5, status="no_interval"), Number("n", 7), "same"),
    (Number("n", float("nan"), high=6), Number("n", 7), "different"),
    (Number("n", float("nan"), status="no_band"), Number("n", 7), "unknown"),
    (Number("n", 5, status="hard"), Number("n", 7, status="hard"), "no_interval"),
])  # fmt: skip
def test_numbers_are_the_same_if_their_intervals_overlap(first, second, agreement):
    for pair in ((first, second), (second, first)):
        assert ComparedNumber("", "n", *pair).agreement == agreement


def test_the_largest_resolved_changes_of_the_answer_come_first():
    """Minor numbers of an answer, such as forces on bumps, come last."""
    interval = {"low": 0.9, "high": 1.1}
    rows = [
        ComparedNumber("", "bumps_mean_force", Number("n", 1, **interval), Number("n", 9)),
        ComparedNumber("", "equal", Number("n", 1), Number("n", 1)),
        ComparedNumber("", "unknown", Number("n", 1), Number("n", float("nan"))),
        ComparedNumber("", "unresolved", Number("n", 1, low=0.1, high=9), Number("n", 4)),
        ComparedNumber("", "small", Number("n", 1, **interval), Number("n", 1.2)),
        ComparedNumber("", "large", Number("n", 1, **interval), Number("n", 0.5)),
    ]
    names = [row.name for row in sorted(rows, key=lambda row: row.sort_key)]
    assert names == ["large", "small", "unresolved", "unknown", "equal", "bumps_mean_force"]


def test_all_edges_of_the_answer_come_before_other_numbers(paper):
    edges = {row["name"] for row in paper["quantities"] if row["name"].endswith("_edge")}
    assert {"outermost_short_edge", "averaged_long_edge", "short_edge"} <= edges
    for name in edges:
        rows = [ComparedNumber("", key, Number(key, 1), Number(key, 2)) for key in ("other", name)]
        assert min(rows, key=lambda row: row.sort_key).name == name


def test_the_table_begins_with_the_inputs_that_differ(studies):
    lines = comparison(studies / "paper", "harder").splitlines()
    assert [line.split() for line in lines[:2]] == [
        ["input", "paper", "harder"], ["hardness", "25", "GPa", "30", "GPa"],
    ]  # fmt: skip
    # No number differs, so none has a row.
    assert lines[2].startswith("number") and len(lines) == 5
    assert_says(lines[3], "not paired", "same scans")
    assert "0 differ" in lines[4]
    assert {path.name for path in studies.rglob("*")} == {"paper", "harder", "answer.json"}


def test_the_page_has_the_bands_and_the_numbers_of_both(studies):
    page = studies / "both.html"
    words = [studies / "paper", studies / "harder/answer.json", "--html", page]
    comparison(*words)
    comparison_page = Page(page.read_text("utf-8"))
    assert ["hardness", "25 GPa", "30 GPa"] in [
        [cell.replace("\N{NO-BREAK SPACE}", " ").strip() for cell in row]
        for row in comparison_page.rows
    ]
    labels = [text for text in comparison_page.texts["span"] if "MCD" in text]
    assert [label.split(",")[0].strip() for label in labels] == ["paper", "harder"]
    assert_says(refusal(comparison, *words), "--html: expected a new file", "--overwrite")
    comparison(*words, "--overwrite")


def test_single_surfaces_of_two_own_studies_are_compared_whatever_their_names():
    inputs, numbers = compare_answers(own_answer("a", "bare"), own_answer("b", "coated", "quick"))
    assert [row.agreement for row in numbers] == ["equal"]
    assert [(row.name, row.first, row.second) for row in inputs] == [
        ("surfaces", "bare", "coated"), ("effort", "full", "quick"),
    ]  # fmt: skip


def test_what_cannot_be_compared_is_refused_in_a_line(studies):
    message = refusal(comparison, studies / "paper", studies)
    assert message.count("\n") == 0
    assert_says(message, "results/answer.json", "snakemake answer")
    assert_says(
        refusal(comparison, "paper", "absent"), "absent/answer.json: expected", "no such folder"
    )
    (studies / "answer.json").write_text("[]")
    assert_says(refusal(comparison, studies, "paper"), "expected the answer of a study")
    (studies / "answer.json").write_text(json.dumps(own_answer("mine", "bare")))
    assert_says(refusal(comparison, "paper", studies), "mine: expected", "one of your surfaces")
