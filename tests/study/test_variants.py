"""The table of robustness: one other choice at a time, and nothing where it changes nothing."""

import pytest
from small_study import configuration, selection

from hardcontact.study.variants import named_load, surface_variants, variants

pytestmark = pytest.mark.usefixtures("at_root")
STUDY = {"name": "H25GPa-F10uN", "preload": 1e-5, "hardness": 25e9}


def by_name(made):
    return {variant.name: variant for variant in made}


def test_the_variants_of_the_paper():
    made = variants(configuration(), selection())
    assert [variant.name for variant in made] == [
        "baseline", "laplacian", "skewness-0", "skewness-0.54", "rough_sphere",
        "preload-5uN", "preload-20uN", "hardness-16GPa", "hardness-47GPa",
    ]  # fmt: skip
    assert made[0].load == STUDY
    assert set(made[0].variant.values()) == {"study"}


def test_each_variant_differs_from_the_study_in_one_choice():
    baseline, *others = variants(configuration(), selection())
    for other in others:
        changed = [
            name
            for name in ("variant", "load", "probe")
            if getattr(other, name) != getattr(baseline, name)
        ]
        assert len(changed) == 1, other


def test_loads_are_values_with_the_names_of_paths():
    assert named_load("10 uN", "25 GPa") == named_load("0.01 mN", "25000 MPa") == STUDY
    made = by_name(variants(configuration(), selection()))
    twice = STUDY | {"name": "H25GPa-F20uN", "preload": 2e-5}
    soft = STUDY | {"name": "H16GPa-F10uN", "hardness": 16e9}
    assert made["preload-20uN"].load == twice
    assert made["hardness-16GPa"].load == soft
    assert made["preload-20uN"].label == "preload 20 µN"


def test_a_surface_that_a_choice_leaves_alone_is_that_of_the_study():
    made = by_name(variants(configuration(), selection()))
    # Nothing of ncd is read from the curvature of Table 1; only the heights of uncd are skewed.
    assert made["laplacian"].variant["ncd"] == "study"
    assert made["laplacian"].variant["uncd"] == "laplacian"
    assert made["skewness-0"].variant == {
        "polished_uncd": "study", "uncd": "skewness-0", "ncd": "study", "mcd": "study",
    }  # fmt: skip
    assert made["skewness-0.54"].variant["uncd"] == "study"
    assert made["skewness-0.54"].variant["mcd"] == "skewness-0.54"


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
    made = surface_variants(configuration())
    definitions = {"slope": "gradient", "curvature": "half_laplacian"}
    assert list(made) == ["study", "laplacian", "skewness-0", "skewness-0.54"]
    assert made["study"].parameters(definitions, 0.5) == {"table1": definitions, "skewness": 0.5}
    assert made["skewness-0"].parameters(definitions, 0.5) == {
        "table1": definitions,
        "skewness": 0.0,
    }
    other = definitions | {"curvature": "laplacian"}
    assert made["laplacian"].parameters(definitions, 0.5) == {"table1": other, "skewness": 0.5}


def test_parameters_name_the_load():
    _, other, *_ = variants(configuration(), selection())
    assert other.parameters() == {
        "name": "laplacian",
        "label": "curvature of Table 1: laplacian",
        "group": "curvature",
        "variant": {
            "polished_uncd": "laplacian",
            "uncd": "laplacian",
            "ncd": "study",
            "mcd": "laplacian",
        },
        "load": "H25GPa-F10uN",
        "probe": "smooth",
    }
