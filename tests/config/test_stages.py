"""The parts that the data of a study allow."""

import pytest
from repository import PAPER

from hardcontact.config.configuration import left_out, made


def study(published, forces="none"):
    return PAPER | {"published": published, "forces": forces}


def test_the_study_of_the_paper_leaves_nothing_out():
    assert left_out(study("paper")) == {}
    assert {"claims", "robustness", "answer"} < set(made(study("paper")))


@pytest.mark.parametrize(("forces", "fits"), [("none", False), ("my.csv", True)])
def test_own_surfaces_have_a_fit_if_they_have_forces(forces, fits):
    own = study("none", forces)
    assert ("fit" in made(own), "fit" in left_out(own)) == (fits, not fits)
    assert {"topography", "adhesion", "scales", "force", "answer"} <= set(made(own))


def test_every_target_is_made_or_left_out_with_a_reason():
    own, paper = study("none"), study("paper")
    assert not set(made(own)) & set(left_out(own))
    assert set(made(paper)) <= set(made(own)) | set(left_out(own))
    assert all(left_out(own).values())
