"""Descriptions of substitutes: those of the repository are accepted, others in one line refused."""

import pytest
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.config.tables import refuse_description, refuse_of_paper
from hardcontact.surfaces.spectrum import AFM_ROWS, TAIL_ROWS

SPECTRA = ROOT / "resources/spectra"
HEADER = (
    "longest_nm,shortest_nm,model,plateau_nm4,rolloff_nm,hurst,hurst_change,table,basis,source\n"
)
COATINGS = sorted(path.stem for path in SPECTRA.glob("crn_*.csv"))
ROWS = {*AFM_ROWS, *TAIL_ROWS}


@pytest.mark.parametrize(
    "name",
    [COATINGS[0], "polished_uncd", "uncd", "mcd", "ruby", "uncd-measured", "ncd-published"],
)
def test_descriptions_of_the_repository_are_accepted(name):
    refuse_description(SPECTRA / f"{name}.csv", ROWS)


@pytest.mark.parametrize(
    ("band", "parts"),
    [
        ("inf,20,varying Hurst,,,,,,assumed,none", ["line 2", "roll-off wavelength", "none"]),
        ("inf,20,varying Hurst,1e9,-3,1,-1,,assumed,none", ["below zero"]),
        (
            "inf,twenty,self-affine,1e9,2000,1,,,assumed,none",
            ["line 2", "shortest_nm", "twenty"],
        ),
        ("inf,20,self-affine,1e9,2000,1,,", ["line 2", "10 cells", "found 8"]),
        ("inf,20,fractal,1e9,2000,1,,,assumed,none", ["line 2", "varying Hurst", "fractal"]),
        ("inf,20,power law,,,1,,,assumed,none", ["line 2", "model", "power law"]),
        ("inf,20,self-affine,1e9,2000,-1.1,,,assumed,none", ["line 2", "Hurst", "-1.1"]),
    ],
)
def test_other_descriptions_are_refused(tmp_path, band, parts):
    path = tmp_path / "surface.csv"
    path.write_text(f"{HEADER}{band}\n")
    assert_says(refusal(refuse_description, path, ROWS), "surface.csv", "expected", *parts)


def test_a_blank_exponent_needs_the_rows_of_table_1(tmp_path):
    path = tmp_path / "surface.csv"
    path.write_text(f"{HEADER}inf,6.5,varying Hurst,,2000,,,,assumed,none\n")
    assert_says(refusal(refuse_description, path, set()), "line 2", "afm_rms_height", "neither")
    refuse_description(path, ROWS)


def test_a_changing_exponent_may_fall(tmp_path):
    path = tmp_path / "surface.csv"
    path.write_text(f"{HEADER}inf,20,varying Hurst,1e10,2000,1.7,-0.5,,assumed,none\n")
    refuse_description(path, set())


def test_coatings_stand_for_no_surface_of_the_paper():
    for name in COATINGS:
        refuse_of_paper(SPECTRA / f"{name}.csv", name, {"uncd", "ncd"})


@pytest.mark.parametrize(
    ("name", "surface", "parts"),
    [
        ("uncd", "my_uncd", ["config key published", "my_uncd", "none"]),
        ("crn_smoother", "uncd", ["config key published", "uncd", "none"]),
        ("ruby", "other", ["ruby.csv", "measured", "assumed"]),
    ],
)
def test_own_studies_refuse_substitutes_for_the_paper(name, surface, parts):
    message = refusal(refuse_of_paper, SPECTRA / f"{name}.csv", surface, {"uncd", "ncd"})
    assert_says(message, "expected", *parts)
