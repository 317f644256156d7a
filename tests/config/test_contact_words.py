"""What contacts are computed for, in words."""

from hardcontact.config.configuration import contact_words, of_paper
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
