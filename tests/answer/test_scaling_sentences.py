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
        "Gaussian average over many points, since σ/ρ = 3.04 < m/σ = 3.53",
        "short edge is set by ρ: the contact 2√(F/πH) = 23 nm is narrower than the 40 nm",
        "Of the roll-off at 1 µm and the reach √(2Rρ) = 1.7 µm the first is shorter; ",
    )
    assert_says(
        mcd,
        "frozen to single peaks, since σ/ρ = 18 > m/σ = 3.27",
        "is set by the size of the contact: the contact 2√(F/πH) = 23 nm is wider than the 20 nm",
        "Of the reach √(2Rρ) = 1.7 µm and the roll-off at 2.7 µm the first is shorter; ",
    )
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
    assert "the force on NCD hardly depends on the roughness. Its" in " ".join(
        scaling_sentences(data)
    )


def test_exponents_stand_by_what_should_set_the_edge():
    (said,) = (one for one in scaling_sentences(scaling()) if "should set the edge" in one)
    wider, narrower = said.split(": ")[1].split("; ")
    assert "1 [0.8, 1.2] where it is wider (20 edges)" in wider
    assert "0.9 [0.72, 1.1] and 0.3 [0.24, 0.36] where it is narrower (70 edges)" in narrower
