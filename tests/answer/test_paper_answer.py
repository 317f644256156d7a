"""The answer of the paper's study: its numbers are those of the claims and of the datasets."""

import json
import math

import numpy as np
import pytest
from figure_inputs.scales import band
from figure_inputs.scan_size import scan_size
from paper_study import answer, claims, datasets
from refusals import assert_says

from hardcontact.answer.paper_answer import ANSWERS, as_plain
from hardcontact.answer.paper_sentences import answer_sentences, basis_sentences
from hardcontact.claims.verdicts import VERDICTS, summary
from hardcontact.numbers.printing import print_as_paper

#: How many sentences there are not without a number of the answer.
LOST = {
    "shortest_wavelength": 2,
    "longest_wavelength": 2,
    "range_of_adhesion": 1,
    "work_of_adhesion": 1,
    "fit_error": 1,
}


def said(of):
    return " ".join(answer_sentences(of))


def changed(name, **values):
    """The claims with other values of one of them."""
    table = claims()
    for column, value in values.items():
        table.loc[table["id"] == ANSWERS[name], column] = value
    return table


def with_critical(side, wavelength):
    """A band whose edge of all substrates is at a wavelength."""
    of_all = band()
    of_all["critical_wavelength"].loc[{"side": side, "group": "pooled"}] = wavelength
    return of_all


def with_fits(ranges, works):
    """Sets whose best ranges (nm) and works (J/m2) with plastic contact are these."""
    sets = datasets()["sets"].isel(set=slice(len(ranges))).copy(deep=True)
    for name, fitted in (("range_of_adhesion", ranges), ("work_of_adhesion", works)):
        sets[name].loc[{"contact_model": "plastic"}] = fitted
    return sets


def test_numbers_for_machines_are_those_of_the_claims():
    plain = json.loads(json.dumps(as_plain(answer()), allow_nan=False))
    table = claims()
    assert [row["id"] for row in plain["claims"]] == list(table["id"])
    assert all(list(row) == list(table.columns) for row in plain["claims"])
    for row, claim in zip(plain["claims"], table.to_dict("records"), strict=True):
        for column, value in claim.items():
            missing = isinstance(value, float) and math.isnan(value)
            assert row[column] == (None if missing else value), (claim["id"], column)
    assert {name: row["id"] for name, row in plain["answer"].items()} == ANSWERS
    rows = {row["id"]: row for row in plain["claims"]}
    for row in plain["answer"].values():
        assert row == rows[row["id"]] | {"bound": None, "open_end": None}


def test_counts_for_machines_are_those_of_the_summary():
    counts = as_plain(answer())["verdicts"]
    assert list(counts) == list(VERDICTS)
    for row in summary(claims()).itertuples():
        assert counts[row.verdict] == {"independent": row.independent, "claims": row.claims}


def test_settings_for_machines_are_those_of_the_datasets():
    assert as_plain(answer())["settings"] == {
        "rho": 5.6, "tolerance": 0.1, "confidence": 0.9, "sets": 100, "realizations": 5,
        "scan_pixels": 512, "scan_size": 2500.0, "contacts_per_side": 20,
    }  # fmt: skip


@pytest.mark.parametrize("name", sorted(ANSWERS.keys() - {"range_exceeds"}))
def test_the_answer_prints_the_number_computed(name):
    rows = changed(name, computed=0.0377, low=0.0311, high=0.0433)
    unit = rows["unit"][rows["id"] == ANSWERS[name]].item()
    printed = print_as_paper(0.0377, unit, (0.0311, 0.0433), 2)
    alike = with_fits([8.0, 9.0], [0.013, 0.012])
    assert printed in said(answer(rows, sets=alike)) and printed not in said(answer(sets=alike))


@pytest.mark.parametrize("name", sorted(ANSWERS.keys() - {"rigid_over_plastic_error"}))
def test_the_answer_prints_the_number_of_the_paper(name):
    rows = changed(name, published=0.0721)
    unit = rows["unit"][rows["id"] == ANSWERS[name]].item()
    assert print_as_paper(0.0721, unit) in said(answer(rows))


def test_the_change_outside_the_band_is_that_of_the_mean_of_all_coatings():
    assert_says(
        answer_sentences(answer())[1], "averaged over all coatings, stays below 10 %", "of 5.6 nm"
    )


def test_edges_of_single_coatings_span_what_the_band_has():
    """The long edge of polished UNCD is open: it counts as the last cutoff, by its bound."""
    assert answer_sentences(answer())[1].endswith(
        "edges of single coatings run from 32 nm (UNCD) to 160 nm (polished UNCD) and from "
        "at most 500 nm (polished UNCD) to 2.4 µm (NCD)."
    )
    other = band()
    other["critical_wavelength"].loc[{"side": "small", "group": "mcd"}] = np.nan
    assert "to at least 250 nm (MCD) and" in answer_sentences(answer(band=other))[1]


def test_the_answer_says_in_how_many_sets_the_range_is_large():
    assert "37 % of 100 equally good sets" in said(answer(changed("range_exceeds", frequency=0.37)))
    assert "sets" not in said(answer(changed("range_exceeds", frequency=np.nan)))


def test_fits_that_differ_in_kind_are_not_printed_as_one_interval():
    """The paper's statement is that the range exceeds 5 nm."""
    rows = changed("range_of_adhesion", computed=8.9, low=0.7, high=10.6)
    both = with_fits([9.0, 1.2, 8.0, 0.8, 10.0], [0.012, 0.09, 0.014, 0.14, 0.011])
    split = answer(rows, sets=both)
    assert_says(
        answer_sentences(split)[2],
        "a range of adhesion of 8.9 nm and",
        "58 % of 5 equally good sets of scans. In these it is 9 [8, 10] nm with 12 [11, 14] mJ/m², "
        "in the others 1 [0.8, 1.2] nm with 120 [90, 140] mJ/m² (medians, and in brackets all sets "
        "of a group); no set has a range between 1.2 nm and 8 nm.",
    )
    assert "[0.7" not in said(split)
    short, long = as_plain(split)["fit_groups"]
    assert long["exceeds"] is True and short["exceeds"] is False
    assert long["range_of_adhesion"] == {"count": 3, "median": 9, "min": 8, "max": 10}
    assert short["work_of_adhesion"] == pytest.approx(
        {"count": 2, "median": 0.115, "min": 0.09, "max": 0.14}
    )


@pytest.mark.parametrize("ranges", [[9.0, 8.0], [1.2, 0.8]])
def test_fits_of_one_kind_have_their_interval(ranges):
    rows = changed("range_of_adhesion", computed=8.9, low=0.7, high=10.6)
    alike = said(answer(rows, sets=with_fits(ranges, [0.01, 0.02])))
    assert "8.9 [0.7, 11] nm" in alike and "in the others" not in alike


def test_the_answer_counts_independent_findings():
    counts = summary(claims()).set_index("verdict")["independent"]
    last = answer_sentences(answer())[-1]
    assert_says(last, f"Of {counts.sum()} independent", f"{counts['undecided']} undecided")
    reproduced = answer(claims().assign(verdict="reproduced"))
    assert "undecided" not in said(reproduced)


@pytest.mark.parametrize(
    ("side", "name", "bound"),
    [
        ("small", "shortest_wavelength", "at least"),
        ("large", "longest_wavelength", "at most"),
    ],
)
def test_an_edge_beyond_the_cutoffs_is_a_bound(side, name, bound):
    rows = changed(name, computed=432.0, low=321.0, high=432.0)
    beyond = answer(rows, band=with_critical(side, np.nan))
    assert f"{bound} 430 nm" in said(beyond) and "[320" not in said(beyond)
    assert as_plain(beyond)["answer"][name]["bound"] == bound
    found = band()
    found["critical_wavelength"] = found["critical_wavelength"].fillna(400.0)  # of one coating
    known = said(answer(rows, band=found))
    assert "at least" not in known and "at most" not in known


@pytest.mark.parametrize(
    ("name", "end", "last", "inside"),
    [
        ("shortest_wavelength", "high", 250.0, 249.0),  # of the band
        ("shortest_wavelength", "high", 120.0, 500.0),  # of the sets, whose cutoffs are fewer
        ("longest_wavelength", "low", 500.0, 501.0),
        ("longest_wavelength", "low", 800.0, 250.0),
    ],
)
def test_an_end_at_the_last_cutoff_is_open(name, end, last, inside):
    sets = datasets()["sets"]
    fewer = sets.sel(cutoff_wavelength=slice(30, 2700)).drop_sel(cutoff_wavelength=[250, 500])
    at_end = answer(changed(name, **{end: last}), sets=fewer)
    assert f"its {end} end is the last cutoff" in said(at_end)
    assert as_plain(at_end)["answer"][name]["open_end"] == end
    assert as_plain(at_end)["open_ends"] == {ANSWERS[name]: end}
    assert "open" not in said(answer(changed(name, **{end: inside}), sets=fewer))


@pytest.mark.parametrize("name", ANSWERS)
def test_a_sentence_without_its_number_is_left_out(name):
    for rows in (claims()[claims()["id"] != ANSWERS[name]], changed(name, computed=np.nan)):
        text = said(answer(rows))
        assert "nan" not in text and "  " not in text
        assert name not in as_plain(answer(rows))["answer"]
        lost = LOST.get(name, 0)
        assert len(answer_sentences(answer(rows))) == len(answer_sentences(answer())) - lost


def test_substitutes_are_named_and_only_they():
    topography = datasets()["topography"]
    one = ["measured", "substitute", "measured", "measured", "measured"]
    some = basis_sentences(answer(topography=topography.assign(basis=("surface", one))))[0]
    assert "Substitute surfaces: UNCD." in some
    measured = topography.assign(basis=("surface", ["measured"] * 5))
    assert basis_sentences(answer(topography=measured))[0] == "All surfaces are measured."


def test_the_error_of_forces_on_scans_is_said_of_each_coating():
    data = scan_size()
    place = {"surface": "mcd", "edge_size": 2500.0}
    data["force_over_largest"].loc[place] = 2.24
    data["force_over_largest_interval"].loc[place] = [1.48, 3.39]
    assert_says(
        basis_sentences(answer(scan_size=data))[1],
        "mirrored scans of 2.5 µm over that on surfaces of 40 µm", "a range of 5.6 nm, is: "
        "polished UNCD 1.9 [", "; NCD ", "; MCD 2.2 [1.5, 3.4] (90 % intervals",
        "none is corrected",
    )  # fmt: skip


def test_grids_coarser_than_the_papers_are_said_to_be():
    assert "coarser" not in " ".join(basis_sentences(answer()))
    for coarse in (datasets(contacts=6), datasets(pixels=128)):
        assert_says(
            " ".join(basis_sentences(answer(**coarse))),
            "coarser", "512 x 512 pixels over 2.5 µm, 20 x 20 contacts",
        )  # fmt: skip


def test_intervals_are_named_by_their_confidence():
    assert_says(basis_sentences(answer())[-1], "90 %", "100 equally good sets")
