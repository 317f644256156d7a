"""The table of robustness: one other choice at a time, and nothing where it changes nothing."""

from dataclasses import replace

import pytest
from small_study import configuration, selection

from hardcontact.config.variants import study_contact, surface_variants, variants

pytestmark = pytest.mark.usefixtures("at_root")
STUDY = "H25GPa-F10uN"


def by_name(made):
    return {variant.name: variant for variant in made}


def test_the_variants_of_the_paper():
    made = variants(configuration(), selection())
    assert [variant.name for variant in made] == [
        "baseline", "laplacian", "skewness-1", "skewness-0.5", "skewness+0.5", "skewness+1",
        "tip-10nm", "tip-17nm", "tip-26nm", "rough_sphere",
        "preload-5uN", "preload-20uN", "hardness-16GPa", "hardness-47GPa",
    ]  # fmt: skip
    assert made[0].contact.load == STUDY
    assert set(made[0].variant.values()) == {"study"}


def test_each_variant_differs_from_the_study_in_one_choice():
    baseline, *others = variants(configuration(), selection())
    for other in others:
        changed = [
            name
            for name in ("variant", "contact", "probe")
            if getattr(other, name) != getattr(baseline, name)
        ]
        assert len(changed) == 1, other


def test_loads_have_names_that_do_not_depend_on_units():
    for preload, hardness in (("10 uN", "25 GPa"), ("0.01 mN", "25000 MPa")):
        changed = configuration(contact__preload=preload, contact__hardness=hardness)
        assert study_contact(changed).load == STUDY
    made = by_name(variants(configuration(), selection()))
    assert made["preload-20uN"].contact == replace(made["laplacian"].contact, preload=2e-5)
    assert made["hardness-16GPa"].contact.load == "H16GPa-F10uN"
    assert made["preload-20uN"].label == "preload 20 µN"


def test_other_heights_and_the_tip_concern_one_surface():
    made = by_name(variants(configuration(), selection()))
    study = dict.fromkeys(selection().substrates, "study")
    assert made["skewness-1"].variant == study | {"polished_uncd": "skewness-1"}
    assert made["tip-17nm"].variant == study | {"uncd": "tip-17nm"}
    assert (made["skewness-1"].label, made["skewness-1"].group) == (
        "polished UNCD: skewness -1", "heights",
    )  # fmt: skip
    assert (made["tip-17nm"].label, made["tip-17nm"].group) == ("UNCD: tip of 17 nm", "tip")


def test_heights_that_a_surface_has_already_are_not_made_again():
    heights = {"surface": "mcd", "skewness": [0, 0.3]}
    made = by_name(variants(configuration(robustness__heights=heights), selection()))
    assert set(made["skewness+0"].variant.values()) == {"study"}
    assert made["skewness+0.3"].variant["mcd"] == "skewness+0.3"


def test_measured_surfaces_have_no_variants():
    for variant in variants(configuration(), selection(measured=["uncd", "mcd"])):
        assert variant.variant["uncd"] == variant.variant["mcd"] == "study"


def test_the_other_curvature_and_the_other_sphere_follow_from_the_study():
    changed = configuration(topography__curvature="laplacian", scales__sphere_roughness=True)
    made = by_name(variants(changed, selection()))
    assert made["baseline"].probe == "rough"
    assert made["smooth_sphere"].probe == "smooth"
    assert "half_laplacian" in made and "laplacian" not in made


def test_what_a_variant_of_a_surface_is_made_with():
    made = surface_variants(configuration(robustness__tip_radii=["0.017 um"]))
    definitions = {"slope": "gradient", "curvature": "half_laplacian"}
    assert list(made)[:3] == ["study", "laplacian", "skewness-1"]
    assert made["study"].table1(definitions) == definitions
    assert made["laplacian"].table1(definitions) == definitions | {"curvature": "laplacian"}
    assert made["study"].heights(0.1) == {"skewness": 0.1, "tip_radius": None}
    assert made["skewness-1"].heights(0.1) == {"skewness": -1.0, "tip_radius": None}
    assert made["tip-17nm"].heights(0.1) == {"skewness": 0.1, "tip_radius": 17.0}
    spectra = [made[name].spectrum for name in ("laplacian", "skewness-1", "tip-17nm")]
    assert spectra == ["laplacian", "study", "study"]
