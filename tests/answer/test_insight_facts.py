"""Numbers of the page on what decides the band: those of the datasets, verdicts by intervals."""

import numpy as np
import pytest
from figure_inputs.closed_form import closed_form
from figure_inputs.elastic_limit import elastic_limit
from figure_inputs.laws import laws
from figure_inputs.published_tables import published_constants
from figure_inputs.scales import band
from figure_inputs.scaling import scaling
from figure_inputs.scan_size import scan_size
from figure_inputs.statistics import statistics
from paper_numbers import LABELS

from hardcontact.answer.facts import between, number_of
from hardcontact.answer.insight_facts import (
    band_facts,
    closed_form_facts,
    scaling_facts,
    scan_size_facts,
)
from hardcontact.answer.insight_force_facts import (
    elastic_limit_facts,
    law_facts,
    statistics_facts,
)
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.insight.pull_off_statistics import CHANCE, held_back
from hardcontact.numbers.number import Number, plain


def column(facts, name, rows="rows"):
    """The values of a column of numbers, None where one is not known, or its codes."""
    cells = [row[name] for row in facts[rows]]
    return [plain(one.value) if isinstance(one, Number) else one for one in cells]


def test_an_interval_that_bounds_nothing_is_left_out():
    of_uncd = scaling().sel(side="small", surface="uncd", length="rho")
    of_uncd["exponent"][...] = 0.5
    for low, high, status in (
        (0.4, 0.6, ""), (np.nan, np.nan, "no_interval"), (-4e3, 4e3, "not_bounded"),
    ):  # fmt: skip
        of_uncd["exponent_interval"][:] = [low, high]
        found = number_of(of_uncd, "exponent")
        assert found.status == status
    assert np.isnan(found.low) and found.value == 0.5


def test_ends_that_are_not_known_are_open():
    ends = [(1.0, 2.0), (1.0, np.nan), (np.nan, 2.0), (np.nan, np.nan)]
    statuses = [between("size", *one).status for one in ends]
    assert statuses == ["between", "more_than", "at_most", "not_known"]


def test_the_band_is_computed_of_each_and_of_all_and_published():
    facts = band_facts(band(), published_constants())
    assert column(facts, "surface") == [*LABELS, "", ""]
    assert column(facts, "basis")[-2:] == ["pooled", "published"]
    assert column(facts, "small") == [160, 32, 45, 95, 60, 43]
    assert column(facts, "large")[0] is None and facts["rows"][0]["large"].status == "no_edge"
    assert facts["rows"][4]["small"][3:5] == pytest.approx((42, 90))
    assert facts["range"].value == 5.6


def test_edges_that_change_with_a_length_are_counted():
    data = scaling()
    interval = data["exponent_interval"]
    interval[:] = [-0.1, 0.1]
    assert scaling_facts(data)["verdict"] == "not_seen"
    for ends in ([-0.1, 1.2], [np.nan, np.nan]):
        interval.loc[{"side": "large", "length": "radius", "surface": "ncd"}] = ends
        assert scaling_facts(data)["verdict"] == "open"
    interval.loc[{"side": "small", "length": "rho", "surface": "ncd"}] = [0.2, 0.6]
    facts = scaling_facts(data)
    assert facts["verdict"] == "changes"
    assert facts["counts"] == {"small": [0, 1, 0], "large": [0, 0, 0]}


def test_local_exponents_are_those_at_both_sides_of_the_paper():
    data = scaling()
    place = {"side": "large", "surface": "ncd", "radius": 250e3, "area": 400.0, "rho": 5.6}
    above = place | {"area": 3200.0}
    data["local_bound"].loc[{"length": "contact", **above}] = 1
    row = scaling_facts(data)["rows"][5]
    assert (row["surface"], row["edge"]) == ("NCD", "large")
    local = data["local_exponent"].sel(length="contact")
    assert row["contact"].status == "more_than"
    for name, origin in (("contact", "computed"), ("contact_formula", "formula")):
        of_both = [local.sel(one | {"origin": origin}).item() for one in (place, above)]
        assert row[name].low == pytest.approx(min(of_both), abs=0.01)
    assert row["contact_formula"].high == pytest.approx(max(of_both), abs=0.01)


def test_errors_of_the_formulas_stand_by_regime():
    facts = scaling_facts(scaling())
    assert column(facts, "surfaces", "errors") == [1, 1, 2, 1]
    errors = scaling()["designed_error"].sel(prediction="formula", side="large", designed="2")
    assert facts["errors"][3]["formula"].value == pytest.approx(errors.item())


def test_sizes_of_scans_and_the_error_of_the_rule():
    data = scan_size()
    data["size_needed"].loc[{"surface": "mcd", "rho": 5.6}] = 11.2e3
    facts = scan_size_facts(data)
    assert column(facts, "needed") == [2e3, 4e3, 6e3, 11.2e3]
    assert facts["needed"][3:5] == (2e3, 11.2e3)
    errors = {name: [one.value for one in of.values()] for name, of in facts["errors"].items()}
    assert errors["surfaces"] == pytest.approx([1.2, 2]) and facts["rough"]
    assert errors["random surfaces"] == pytest.approx([1.1, 1.5])
    assert column(facts, "force")[0] == 1.95 and facts["whole"].value == 40e3
    assert column(facts, "from_scan")[1] == 1060 and column(facts, "from_whole")[1] == 1090


def test_forces_on_scans_are_larger_only_where_the_interval_lies_above_one():
    data = scan_size()
    interval = data["force_over_largest_interval"]
    interval.loc[{"edge_size": 2500.0, "bound": "low"}] = [0.9, 1.1, 1.1, np.nan]
    interval.loc[{"surface": "ncd", "edge_size": 20e3}] = [0.8, 0.9]
    facts = scan_size_facts(data)
    assert column(facts, "force_says") == ["open", "above", "above", "open"]
    assert column(facts, "smaller_says")[2] == "below"


def test_intervals_on_windows_refute_sizes_of_the_rule():
    data = scan_size()
    interval = data["force_over_largest_interval"]
    interval.loc[{"bound": "low"}], interval.loc[{"bound": "high"}] = 0.9, 2.0
    interval.loc[{"surface": "ncd", "edge_size": 1250.0, "bound": "low"}] = 1.2
    interval.loc[{"surface": "ncd", "edge_size": 5000.0, "bound": "high"}] = 1.05
    for needed, says in ((4e3, "none"), (6e3, "refuted"), (1e3, "refuted")):
        data["size_needed"].loc[{"surface": "ncd", "rho": 5.6}] = needed
        row = scan_size_facts(data)["rows"][2]
        assert (row["asked"][3:5], row["needed_says"]) == ((1250, 5000), says)


def test_long_edges_differ_where_intervals_do_not_meet_and_open_ones_are_bounds():
    data = scan_size()
    assert scan_size_facts(data)["differ"] == 0
    data["long_edge_interval"].loc[{"surface": "uncd", "edge_size": 2500.0}] = [9e3, 27e3]
    facts = scan_size_facts(data)
    assert (facts["differ"], facts["widest"].value) == (1, 3)
    data.attrs["scan_size"] = 1250.0
    edge = scan_size_facts(data)["rows"][3]["from_scan"]
    assert (edge.value, edge.status) == (2400, "open_above")


def test_a_trend_with_the_range_against_the_rule_is_counted():
    data = scan_size()
    assert scan_size_facts(data)["against"] == 0
    data["predicted_excess"].loc[{"surface": "mcd", "scan_size": 1250.0}] = [3.0, 2.0]
    assert scan_size_facts(data)["against"] == 1


def test_the_closed_form_is_off_by_half_of_its_factors_and_the_largest():
    data = closed_form()
    data["error"][:] = 1
    of_ncd = {"surface": "ncd", "map_size": 20e3, "rho": 5.6, "source": "spectrum"}
    data["error"].loc[of_ncd] = 0.4
    data["predicted_force"].loc[of_ncd] = 0.4 * data["computed_force"].sel(
        {name: of_ncd[name] for name in ("surface", "map_size", "rho")}
    )
    facts = closed_form_facts(data, band())
    assert (facts["half"].value, facts["cases"], facts["size"].value) == (1, 12, 20e3)
    farthest = facts["rows"][2]["farthest"]
    assert (farthest.value, farthest.low) == (0.4, pytest.approx(0.4 / 1.2))
    assert facts["rows"][2]["farthest_at"].value == 5.6


def test_a_surface_whose_ratio_is_near_one_is_at_the_transition():
    """The largest maps have m/sigma = sqrt(90 / (0.9 * 5.6)) = 4.2."""
    data = closed_form()
    data["whole_freezing"].loc[{"rho": 5.6}] = [0.7, 0.8, 1.2, 1.3]
    data["regime"].loc[{"rho": 5.6}] = [MANY_POINTS, MANY_POINTS, SINGLE_PEAKS, SINGLE_PEAKS]
    facts = closed_form_facts(data, band())
    assert column(facts, "regime") == [MANY_POINTS, "transition", "transition", SINGLE_PEAKS]
    assert column(facts, "freezing") == [0.7, 0.8, 1.2, 1.3]


def test_predicted_edges_are_compared_with_intervals_of_computed_ones():
    data = closed_form()
    for surface, edges in (("uncd", [32.0, 1e5]), ("mcd", [1.0, 1860.0])):
        data["edge"].loc[{"surface": surface}] = edges
    for surface in ("polished_uncd", "ncd"):
        data["edge"].loc[{"surface": surface}] = np.nan
    facts = closed_form_facts(data, band())
    assert column(facts, "small_says") == ["outside", "within", "outside", "outside"]
    assert column(facts, "large_says") == ["outside", "outside", "outside", "within"]
    assert facts["within"] == {"small": 1, "large": 1}
    assert {facts["rows"][0][f"large_{one}"].status for one in ("predicted", "computed")} == {
        "no_edge"
    }


@pytest.mark.parametrize(
    ("value", "ends", "verdict", "answer"),
    [
        (0.05, (0.03, 0.08), "reproduced", "yes"),
        (0.09, (0.03, 0.2), "undecided", "open"),
        (0.3, (0.2, 0.4), "not reproduced", "no"),
    ],
)
def test_the_verdict_on_other_laws_follows_from_the_interval(value, ends, verdict, answer):
    data = laws()
    data["fit_error"][:] = value
    data["fit_error_interval"][:] = np.broadcast_to(ends, data["fit_error_interval"].shape)
    facts = law_facts(data)
    assert column(facts, "verdict") == ["", *[verdict] * 3] and facts["verdict"] == answer
    assert column(facts, "error") == pytest.approx([100 * value] * 4)


def test_the_scatter_beyond_the_law_is_what_is_left_of_the_published():
    data = statistics()
    data["published_spread"][:] = [1.8, np.nan, 0.1, 0.9]
    facts = statistics_facts(data)
    total = data["total_shape"].sel(rho=5.6).values
    assert column(facts, "total_shape") == pytest.approx(total)
    left = [(1.8**2 - total[0] ** 2) ** 0.5, None, None, (0.9**2 - total[3] ** 2) ** 0.5]
    assert column(facts, "rest") == [pytest.approx(one) if one else one for one in left]
    assert facts["rows"][1]["published_spread"].status == "not_printed"


def test_errors_of_the_law_are_of_gaussian_surfaces_that_were_not_looked_at():
    data = statistics()
    unfair = (data["designed_held_back"] == 0) | (data["designed_skewed"] != 0)
    data["designed_spread"] = data["designed_predicted_spread"].where(~unfair, np.nan) * 1.1
    below, above = statistics_facts(data)["validated"]
    assert below["error"].value == pytest.approx(10) == above["error"].value
    cases = held_back(data)
    assert below["cases"].value + above["cases"].value == cases.sizes["case"] > 20
    rejected = sum(row["weibull_rejected"].value * row["cases"].value for row in (below, above))
    assert rejected == pytest.approx(100 * (cases["designed_distance_weibull"] > CHANCE).sum())


def test_surfaces_yield_with_waves_down_to_where_the_index_is_one():
    facts = elastic_limit_facts(elastic_limit())
    assert column(facts, "below") == [None, 1, 1, 10]  # of (0.1, 1, 2, 4)/√λ at decades of λ
    assert column(facts, "all_scales") == pytest.approx(np.array([0.1, 1, 2, 4]) * 10**0.5)
    assert facts["verdict"] == "no"
    assert elastic_limit_facts(elastic_limit().isel(surface=[1, 2, 3]))["verdict"] == "yes"
