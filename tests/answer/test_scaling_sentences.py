"""Sentences on the scaling of edges: what they follow, in the words of the dataset."""

from figure_inputs.scaling import scaling
from refusals import assert_says

from hardcontact.answer.scaling_sentences import scaling_sentences


def with_found(count):
    data = scaling()
    data["edges_found"].loc[{"side": "large", "surface": "ncd"}] = count
    return data


def test_the_answer_says_of_every_length_which_surfaces_follow_it():
    data = scaling()
    data["dependence"].loc[{"side": "small", "surface": "mcd", "length": "rho"}] = "yes"
    answer, *_ = scaling_sentences(data)
    assert_says(
        answer,
        "short edge of the band follows: √R no on polished UNCD, UNCD, NCD and MCD; "
        "√ρ yes on MCD, no on polished UNCD, UNCD and NCD;",
        "ranges from 1.4 nm to 11.2 nm",
        "contact areas from 50 nm² to 3200 nm²",
    )


def test_every_exponent_has_its_interval():
    data = scaling()
    sentences = scaling_sentences(data)
    value = data["exponent"].sel(side="large", surface="uncd", part="all", length="contact").item()
    numbers = [float(f"{share * value:.2g}") for share in (1, 0.8, 1.2)]
    expected = "UNCD {:g} [{:g}, {:g}]".format(*numbers)
    assert [expected in one for one in sentences].index(True) == 6


def test_edges_that_are_not_there_are_said():
    assert scaling_sentences(with_found(27))[-1] == "Every combination has both edges."
    assert_says(scaling_sentences(with_found(9))[-1], "the long edge (NCD 33 %)", "say nothing")
