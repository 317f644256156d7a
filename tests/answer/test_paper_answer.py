"""The answer of the paper's study: its numbers are those of the claims and of the datasets."""

import json
import math

import numpy as np
import pytest
from figure_inputs.scales import CUTOFFS, LARGE_CUTOFFS, SMALL_CUTOFFS, band
from figure_inputs.scan_size import scan_size
from jsonschema import Draft202012Validator
from paper_numbers import SUBSTRATES
from paper_study import answer, claims, datasets
from repository import ROOT

from hardcontact.answer.paper_answer import ANSWERS, MAIN_FINDINGS, as_plain, cutoff_curves
from hardcontact.claims.verdicts import VERDICTS, summary
from hardcontact.figures.style import colours
from hardcontact.numbers.number import Number

SCHEMA = json.loads((ROOT / "workflow/schemas/answer_paper.schema.json").read_text("utf-8"))


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


def test_numbers_for_machines_are_as_their_schema_says():
    Draft202012Validator.check_schema(SCHEMA)
    beyond = with_critical("large", np.nan)
    split = with_fits([9.0, 1.2, 8.0], [0.012, 0.09, 0.014])
    for made in (answer(), answer(band=beyond, sets=split), answer(changed("fit_error", low=1.0))):
        plain = json.loads(json.dumps(as_plain(made), allow_nan=False))
        assert list(Draft202012Validator(SCHEMA).iter_errors(plain)) == []
    assert set(SCHEMA["properties"]["answer"]["properties"]) == set(ANSWERS)


def test_every_key_of_the_schema_is_described():
    pending = [SCHEMA, *SCHEMA["$defs"].values()]
    while pending:
        inner = pending.pop()
        assert inner["description"].endswith("."), inner
        pending += [*inner.get("properties", {}).values()]
        below = (inner.get(name) for name in ("items", "additionalProperties"))
        pending += [one for one in below if isinstance(one, dict) and "properties" in one]


def test_main_findings_are_statements_of_the_paper():
    assert len(set(MAIN_FINDINGS)) == 12 and set(MAIN_FINDINGS) <= set(claims()["id"])


def test_grids_coarser_than_the_papers_are_known():
    assert not answer().coarse
    assert answer(**datasets(contacts=6)).coarse and answer(**datasets(pixels=128)).coarse


def test_fits_of_sets_are_grouped_by_the_statement_on_the_range():
    """The paper's statement is that the range exceeds 5 nm."""
    both = with_fits([9.0, 1.2, 8.0, 0.8, 10.0], [0.012, 0.09, 0.014, 0.14, 0.011])
    short, long = as_plain(answer(sets=both))["fit_groups"]
    assert long["exceeds"] is True and short["exceeds"] is False
    assert long["range_of_adhesion"] == {"count": 3, "median": 9, "min": 8, "max": 10}
    assert short["work_of_adhesion"] == pytest.approx(
        {"count": 2, "median": 0.115, "min": 0.09, "max": 0.14}
    )
    assert list(answer(sets=with_fits([9.0, 8.0], [0.01, 0.02])).fit_groups) == [True]
    assert answer(changed("range_exceeds", frequency=np.nan), sets=both).fit_groups == {}


@pytest.mark.parametrize(
    ("side", "name", "bound"),
    [
        ("small", "shortest_wavelength", "at least"),
        ("large", "longest_wavelength", "at most"),
    ],
)
def test_an_edge_beyond_the_cutoffs_is_a_bound(side, name, bound):
    beyond = answer(band=with_critical(side, np.nan))
    assert beyond.open_edges == {name: bound} and answer().open_edges == {}
    assert as_plain(beyond)["answer"][name]["bound"] == bound


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
    at_end = as_plain(answer(changed(name, **{end: last}), sets=fewer))
    assert at_end["answer"][name]["open_end"] == end
    assert at_end["open_ends"] == {ANSWERS[name]: end}
    assert as_plain(answer(changed(name, **{end: inside}), sets=fewer))["open_ends"] == {}


@pytest.mark.parametrize("name", ANSWERS)
def test_a_claim_without_a_number_is_not_in_the_answer(name):
    for rows in (claims()[claims()["id"] != ANSWERS[name]], changed(name, computed=np.nan)):
        assert as_plain(answer(rows))["answer"].keys() == ANSWERS.keys() - {name}


def test_forces_on_scans_are_those_on_mirrored_windows_of_their_size():
    data = scan_size()
    place = {"surface": "mcd", "edge_size": 2500.0}
    data["force_over_largest"].loc[place] = 2.24
    data["force_over_largest_interval"].loc[place] = [1.48, 3.39]
    made = answer(scan_size=data)
    assert (made.size_of_scans, made.size_of_surfaces) == (2500, 40e3)
    assert list(made.forces_on_scans) == SUBSTRATES
    assert made.forces_on_scans["mcd"] == Number("mcd", 2.24, "1", 1.48, 3.39)


def test_curves_are_the_ratios_of_each_side_with_their_intervals():
    curves = cutoff_curves(band())
    for side, cutoffs in (("small", SMALL_CUTOFFS), ("large", LARGE_CUTOFFS)):
        assert curves[side]["cutoffs"] == list(cutoffs)
        shown = curves[side]["surfaces"]
        assert {one["name"]: one["colour"] for one in shown} == colours(SUBSTRATES)
        for one in shown:
            of_side = band().sel(side=side, surface=one["name"])
            of_side = of_side.sel(cutoff_wavelength=np.isin(CUTOFFS, cutoffs))
            assert one["ratios"] == of_side["scale_ratio"].values.tolist()
            ends = of_side["scale_ratio_interval"].values.T.tolist()
            assert [one["low"], one["high"]] == ends
            assert one["basis"] == of_side["basis"].item()


def test_limits_of_curves_do_not_follow_what_is_unbounded():
    wide = band()
    wide["scale_ratio_interval"].loc[{"surface": "mcd", "bound": "high"}] = 1e20
    low, high = cutoff_curves(wide)["small"]["limits"]
    assert high == pytest.approx(10 * wide["scale_ratio"].sel(side="small").max().item())
    wide["scale_ratio_interval"][:] = np.nan
    bare = cutoff_curves(wide)["small"]
    assert all(np.isfinite(bare["limits"])) and set(bare["surfaces"][0]["low"]) == {None}
