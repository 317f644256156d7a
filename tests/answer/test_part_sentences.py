"""Sentences of the parts: their numbers are those of the datasets, their verdicts follow."""

import numpy as np
from figure_inputs.closed_form import closed_form
from figure_inputs.elastic_limit import elastic_limit
from figure_inputs.laws import laws
from figure_inputs.maps import maps
from figure_inputs.repeated_contact import repeated_contact
from figure_inputs.scales import band
from refusals import assert_says

from hardcontact.answer.contact_sentences import (
    elastic_limit_sentences,
    map_sentences,
    repeated_contact_sentences,
)
from hardcontact.answer.law_sentences import closed_form_sentences, law_sentences
from hardcontact.answer.part_text import listed
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.numbers.printing import print_percent, print_within


def test_lists_and_shares():
    assert [listed(one) for one in (["a"], ["a", "b"], ["a", "b", "c"])] == [
        "a",
        "a and b",
        "a, b and c",
    ]
    assert print_percent(0.16, 0.12, 0.67) == "16 [12, 67] %" and print_percent(0.05) == "5 %"


def test_the_closed_form_says_half_of_its_factors_and_the_largest():
    data = closed_form()
    data["error"] = xr_ones(data["error"])
    data["error"].loc[{"surface": "ncd", "map_size": 20000.0, "rho": 5.6}] = 0.4
    accuracy, *_ = closed_form_sentences(data, band())
    assert_says(accuracy, "within a factor of 1 of", "in half of 12 cases", "20 µm")
    assert_says(accuracy, "farthest off on NCD at 5.6 nm: 0.4 [", "no bound")


def xr_ones(values):
    """Return the same array with ones."""
    return values.copy(data=np.ones(values.shape))


def test_the_closed_form_names_every_surface_in_its_regime():
    data = closed_form()
    data["regime"] = data["regime"].copy(data=np.full(data["regime"].shape, SINGLE_PEAKS))
    data["whole_freezing"] = 2 * xr_ones(data["whole_freezing"])
    regimes = [one for one in closed_form_sentences(data, band()) if "single peaks decide" in one]
    assert len(regimes) == 1
    assert_says(regimes[0], "summits carry the force on", *data["label"].values)


def test_a_surface_whose_ratio_is_near_one_is_at_the_transition():
    """The largest maps have m/sigma = sqrt(90 / (0.9 * 5.6)) = 4.2."""
    data = closed_form()
    data["whole_freezing"].loc[{"rho": 5.6}] = [0.7, 0.8, 1.2, 1.3]
    data["regime"].loc[{"rho": 5.6}] = [MANY_POINTS, MANY_POINTS, SINGLE_PEAKS, SINGLE_PEAKS]
    many, between, single = closed_form_sentences(data, band())[2:-1]
    assert_says(many, "the whole surface attracts", "on polished UNCD ((σ/ρ)/(m/σ) = 0.7; single")
    assert_says(between, "is at the transition", "on UNCD and NCD ((σ/ρ)/(m/σ) = 0.8 and 1.2;")
    assert_says(single, "summits carry the force on MCD")


def test_predicted_edges_stand_beside_computed_ones_and_missing_ones_are_said():
    edges = closed_form_sentences(closed_form(), band())[-1]
    assert_says(edges, "UNCD no edge (computed: 32 [", "and 1.8 µm (computed: 1.9 [")
    assert_says(edges, "polished UNCD 40 nm (computed: 160 [", "and 1.5 µm (computed: no edge)")


def of_error(value, low, high):
    """Return laws whose forces differ so much from those of Eq. 1."""
    data = laws()
    data["fit_error"] = data["fit_error"].copy(data=np.full(data["fit_error"].shape, value))
    ends = data["fit_error_interval"]
    data["fit_error_interval"] = ends.copy(data=np.broadcast_to([low, high], ends.shape))
    return data


def test_the_verdict_on_other_laws_follows_from_the_interval():
    for interval, expected in (
        ((0.05, 0.03, 0.08), "reproduced"),
        ((0.09, 0.03, 0.2), "undecided"),
        ((0.3, 0.2, 0.4), "not reproduced"),
    ):
        first = law_sentences(of_error(*interval))[0]
        assert first.endswith(f"; electrostatic, {expected}.")


def test_laws_are_ranked_by_their_error_to_measured_forces():
    data = laws()
    fitted = law_sentences(data)[4]
    order = data["law_label"].values[np.argsort(data["fit_error"].sel(case="fitted").values)]
    places = [fitted.index(str(label)) for label in order]
    assert places == sorted(places)


def test_edges_of_laws_keep_their_direction_and_cutoffs_are_named():
    data = laws()
    data["edge_factor"].loc[{"law": "retarded", "side": "small", "group": "pooled"}] = 0.8
    assert_says(
        law_sentences(data)[2],
        "over those of Eq. 1: van der Waals 1.2 [",
        "retarded (Casimir) 0.8 [",
        "3 at the short edge, neighbours factors of 2 to 2.5 apart",
        "3 at the long edge, neighbours factors of 2 to 3 apart",
    )
    one = data.sel(cutoff_wavelength=[40.0, 1000.0])
    assert "(1 at the short edge; 1 at the long edge)" in law_sentences(one)[2]


def test_strengths_are_said_in_terms_of_what_is_known():
    data = laws()
    data["implied_over_known"].loc[{"law": "van_der_waals"}] = 20.0
    data["implied_over_known"].loc[{"law": "electrostatic"}] = 4.0
    assert_says(
        law_sentences(data)[3],
        "20 times that for a Hamaker constant of 5e-19 J",
        "one of 1e-17 J",
        "between perfect conductors",
        "electrostatic 4 times that for a contact potential of 1 V: one of 2 V.",
    )


def test_laws_say_which_contacts_they_stand_on():
    assert "3 scans a surface with 64 contacts each" in law_sentences(laws())[4]


def test_maps_say_what_a_mean_needs():
    data = maps()
    contacts, array, scans, *_ = map_sentences(data)
    needed = data["contacts_needed"].sel(rho=5.6, sampling="random", surface="mcd").item()
    assert_says(contacts, f"MCD {float(f'{needed:.2g}'):g}", "within 5 %")
    assert_says(array, "16 contacts")
    assert_says(scans, *data["label"].values)


def test_one_scan_a_surface_tells_nothing_of_others():
    data = maps()
    data["scans_needed"] = data["scans_needed"] * np.nan
    assert any("cannot be told" in sentence for sentence in map_sentences(data))


def test_intervals_that_bound_nothing_are_said_in_words():
    assert print_within(5.9, 2.2, 350) == "5.9 [2.2, 350]"
    for low, high in ((1e-9, 1e6), (-4e3, 4e3), (0.01, 7)):
        assert print_within(5.9, low, high) == "5.9 (not bounded by so few scans)"
    assert print_percent(0.2, 1e-9, 1e6) == "20 % (not bounded by so few scans)"
    assert print_within(0.0, 0.0, 0.0) == "0 [0, 0]"


def test_an_interval_about_a_number_near_zero_bounds_it():
    assert print_within(0.005, -0.6, 0.6) == "0.005 [-0.6, 0.6]"
    assert print_within(0.0, -0.6, 0.6) == "0 [-0.6, 0.6]"
    assert print_percent(0.0005, -0.06, 0.06) == "0.05 [-6, 6] %"
    # A length has a unit and a sign: zero within its interval says that it is not bounded.
    assert print_within(5.0, -1e3, 1e3, "nm") == "5 nm (not bounded by so few scans)"


def test_repeated_contact_is_judged_by_the_sizes_in_the_image():
    data = repeated_contact()
    force, depth, width, growth, _ = repeated_contact_sentences(data)
    assert_says(force, "of 400 contacts", *data["label"].values)
    assert_says(depth, "20 µN on NCD", "8 [6.4, 9.6] nm deep", "2 nm to 10 nm")
    assert_says(depth, "the first contact reaches them already (2 [1.6, 2.4] nm)")
    assert_says(width, "120 [96, 140] nm wide", "is not decided", "lattice", "hardly overlap")
    assert_says(growth, "from 2 nm deep and 30 nm wide", "to 8 nm deep and 120 nm wide")


def test_widths_beside_the_image_follow_from_value_and_interval():
    for factor, expected in (
        (1.1, "the largest is smaller, but its interval reaches them"),
        (2.0, "contact reaches them"),
        (4.0, "goes beyond them"),
    ):
        data = repeated_contact()
        for name in ("lateral_size", "lateral_size_interval"):
            data[name] = factor * data[name]
        assert expected in repeated_contact_sentences(data)[2]


def test_sizes_without_an_interval_are_not_judged():
    data = repeated_contact()
    data["lateral_size_interval"] = data["lateral_size_interval"] * np.nan
    assert_says(repeated_contact_sentences(data)[2], "wide: without an interval nothing is known")


def test_depths_that_the_first_contact_does_not_have_are_those_of_repeated_contact():
    data = repeated_contact()
    data["depth"].loc[{"stage": 1}] = 1.5
    assert repeated_contact_sentences(data)[1].endswith("deep: repeated contact reaches them.")


def test_the_bearing_area_is_wrong_by_the_largest_ratios():
    data = elastic_limit()
    answer, shares, largest, larger, recovered, left_open, areas = elastic_limit_sentences(data)
    assert answer.startswith("No. ")
    assert answer.endswith(
        "none on polished UNCD; some on UNCD and NCD; not decided on MCD, where both disagree."
    )
    assert_says(shares, "polished UNCD 0 [0, 0]", "MCD 1 [")
    assert_says(largest, "at most 200 [140, 260] % above (on polished UNCD)")
    assert_says(largest, "at most 100 [100, 100] % below (on polished UNCD)")
    assert_says(larger, "larger, elastic area", "UNCD 2 [")
    assert_says(recovered, "recovered before pull-off", "UNCD 0.5 [")
    most = data["solved_area"].sel(surface="mcd").max().item() / 405
    assert_says(
        left_open, "On MCD, where", "fall to MCD 0.5 [0.4, 0.6], where", f"reach {most:.2g} times"
    )
    assert_says(areas, "0.5 times the solved one", "24 contacts")


def test_whether_all_contacts_yield_is_what_index_and_solved_pressures_say():
    data = elastic_limit()
    for by_index, solved, expected in (
        ([1, 1, 1, 1], [1, 1, 1, 1], "Yes."),
        ([1, 1, 1, 1], [1, 1, 1, 0.5], "Not decided."),
        ([0, 1, 1, 1], [0, 1, 1, 0.5], "No."),
        ([1, 1, 1, 1], [np.nan, 1, 1, 1], "Yes."),
    ):
        data["plastic_share"][:], data["solved_plastic_share"][:] = by_index, solved
        texts = elastic_limit_sentences(data)
        assert texts[0].startswith(expected)
        assert any("contradict" in one for one in texts) == (0.5 in solved)
