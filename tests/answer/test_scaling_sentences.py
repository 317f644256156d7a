"""Sentences on the scaling of edges: what they follow, in the words of the dataset."""

import numpy as np
from figure_inputs.scaling import scaling
from refusals import assert_says

from hardcontact.answer.scaling_sentences import scaling_sentences
from hardcontact.insight.closed_form import SMOOTH


def with_found(count):
    data = scaling()
    data["edges_found"].loc[{"side": "large", "surface": "ncd"}] = count
    return data


def test_the_answer_says_of_every_length_which_surfaces_follow_it():
    data = scaling()
    data["dependence"].loc[{"side": "small", "surface": "mcd", "length": "rho"}] = "partly"
    answer, *_ = scaling_sentences(data)
    assert_says(
        answer,
        "How the short edge of the band follows: √R independent on polished UNCD, UNCD, NCD and "
        "MCD; √ρ partly on MCD, independent on polished UNCD, UNCD and NCD;",
        "ranges from 1.4 nm to 11.2 nm",
        "contact areas from 50 nm² to 3200 nm²",
    )


def test_every_exponent_has_its_interval():
    data = scaling()
    sentences = scaling_sentences(data)
    value = data["exponent"].sel(side="large", surface="uncd", part="all", length="contact").item()
    numbers = [float(f"{share * value:.2g}") for share in (1, 0.8, 1.2)]
    expected = "UNCD {:g} [{:g}, {:g}]".format(*numbers)
    assert [expected in one for one in sentences].index(True) == 7


def test_edges_that_are_not_there_are_said():
    assert scaling_sentences(with_found(27))[-1] == "Every combination has both edges."
    assert_says(scaling_sentences(with_found(9))[-1], "the long edge (NCD 33 %)", "say nothing")


def test_every_surface_has_a_regime_and_the_lengths_that_decide_it():
    polished, uncd, _, mcd = (
        one for one in scaling_sentences(scaling()) if "sphere, range and load" in one
    )
    assert_says(
        uncd,
        "the force on UNCD is a",
        "at the transition from many points to single peaks, since σ/ρ = 3.04 and m/σ = 3.53",
        "The contact 2√(F/πH) = 23 nm is narrower than its short edge of 40 nm in the closed form",
        "Of the roll-off at 1 µm and the reach √(2Rρ) = 1.7 µm the first is shorter; ",
    )
    assert_says(
        mcd,
        "frozen to single peaks, since σ/ρ = 18 > m/σ = 3.27",
        "The contact 2√(F/πH) = 23 nm is wider than its short edge of 20 nm in the closed form",
        "Of the reach √(2Rρ) = 1.7 µm and the roll-off at 2.7 µm the first is shorter; ",
    )
    assert_says(polished, "Gaussian average over many points, since σ/ρ = 0.714 < m/σ = 2.5")
    assert_says(polished, "The closed form has no short edge (computed: ")


def test_whether_a_length_stops_the_long_edge_is_what_the_interval_says():
    data = scaling()
    of_uncd = {"side": "large", "surface": "uncd", "radius": 250e3, "area": 400.0, "rho": 5.6}
    for low, high, expected in (
        (1100.0, 2e3, "lies wholly above, so that this length does not stop it."),
        (500.0, 900.0, "lies wholly below, so that the edge ends before this length."),
        (900.0, 1100.0, "does not exclude that this length stops it."),
        (np.nan, np.nan, "does not exclude that this length stops it."),
    ):
        data["edge_interval"].loc[of_uncd] = [low, high]
        (said,) = (one for one in scaling_sentences(data) if "the force on UNCD is" in one)
        assert said.endswith(expected)


def test_a_smooth_surface_has_no_peaks_to_compare():
    data = scaling()
    data["regime"] = data["regime"].where(data["surface"] != "ncd", SMOOTH)
    assert "the force on NCD hardly depends on the roughness. The contact" in " ".join(
        scaling_sentences(data)
    )


def test_exponents_of_all_surfaces_are_judged_by_their_intervals():
    data = scaling()
    data["cause_exponent_interval"].loc[{"cause": "range", "length": "radius"}] = [-0.2, -0.1]
    texts = scaling_sentences(data)
    (said,) = (one for one in texts if "where the contact is wider" in one)
    wider, narrower = said.split("Where it is ")[1:]
    assert wider.startswith("wider (20 edges), √R: partly, 0.1 [0.08, 0.12], √ρ: partly,")
    assert wider.endswith("and √(F/H): proportional, 1 [0.8, 1.2]: not √(F/H) alone. ")
    assert narrower.startswith("narrower (70 edges), √R: against it, 0.1 [-0.2, -0.1], ")
    assert narrower.endswith("[0.72, 1.1] and √(F/H): partly, 0.3 [0.24, 0.36]: not √ρ alone.")
    data["cause_exponent_interval"].loc[{"cause": "range", "length": ["radius", "contact"]}] = [
        -0.1,
        0.1,
    ]
    (said,) = (one for one in scaling_sentences(data) if "where the contact is wider" in one)
    assert said.endswith("and √(F/H): independent, 0.3 [-0.1, 0.1].")
    assert any("a jackknife over 4 surfaces" in one for one in texts)
