"""The parts that the data of a study allow, and its contacts in words."""

import pytest
from repository import PAPER

from hardcontact.config.configuration import contact_words, left_out, made, of_paper
from hardcontact.config.model import configuration

OWN = configuration(
    {
        "sphere": {"surface": "smooth", "radius": "0.25mm"},
        "contact": {"hardness": "5GPa", "preload": "10 uN"},
        "adhesion": {"work": "46mJ/m2"},
    }
)


def test_quantities_are_printed_with_the_fitting_prefix():
    assert contact_words(OWN) == {
        "sphere": "smooth", "radius of the sphere": "250 µm", "hardness": "5 GPa",
        "preload": "10 µN", "range of adhesion": "5.6 nm", "work of adhesion": "46 mJ/m²",
    }  # fmt: skip


def test_what_is_the_papers_is_so_in_whatever_unit_it_is_written():
    assert of_paper(OWN) == ["radius of the sphere", "preload", "range of adhesion"]


def study(published, forces="none"):
    return PAPER | {"published": published, "forces": forces}


@pytest.mark.parametrize(("forces", "fits"), [("none", False), ("my.csv", True)])
def test_own_surfaces_have_a_fit_if_they_have_forces(forces, fits):
    own = study("none", forces)
    assert ("fit" in made(own), "fit" in left_out(own)) == (fits, not fits)
    assert {"topography", "adhesion", "scales", "force", "answer"} <= set(made(own))


def test_every_target_is_made_or_left_out_with_a_reason():
    own, paper = study("none"), study("paper")
    assert left_out(paper) == {}
    assert not set(made(own)) & set(left_out(own))
    assert set(made(paper)) <= set(made(own)) | set(left_out(own))
    assert all(left_out(own).values())
