"""Descriptions of substitutes: accepted, or refused in one line per fault."""

import pytest
from refusals import assert_says, refusal
from repository import DESCRIPTION_HEADER, ROOT

from hardcontact.config.descriptions import refuse_description, refuse_in_own_study
from hardcontact.surfaces.substitute_spectra import AFM_ROWS, TAIL_ROWS

SPECTRA = ROOT / "resources/spectra"
TABLE_1 = {*AFM_ROWS, *TAIL_ROWS}


def test_all_spectra_of_the_repository_are_accepted():
    descriptions = [
        path for path in SPECTRA.glob("*.csv") if path.read_text().startswith(DESCRIPTION_HEADER)
    ]
    assert len(descriptions) > 10
    for path in descriptions:
        refuse_description(path, TABLE_1)


@pytest.mark.parametrize(
    ("segment", "message_parts"),
    [
        ("inf,20,varying Hurst,,,,,,assumed,none", ["rolloff_nm", "found none"]),
        ("inf,20,varying Hurst,1e9,-3,1,-1,,assumed,none", ["rolloff_nm", "equal to 0", "-3"]),
        ("inf,20,self-affine,inf,2000,1,,,assumed,none", ["plateau_nm4", "inf"]),
        ("inf,20,varying Hurst,1e9,2000,1,-inf,,assumed,none", ["hurst_change", "-inf"]),
        ("inf,twenty,self-affine,1e9,2000,1,,,assumed,none", ["shortest_nm", "twenty"]),
        ("inf,20,self-affine,1e9,2000,1,,", ["10 cells", "found 8"]),
        ("inf,20,fractal,1e9,2000,1,,,assumed,none", ["varying Hurst", "fractal"]),
        ("inf,20,power law,,,1,,,assumed,none", ["model", "power law"]),
        ("inf,20,self-affine,1e9,2000,-1.1,,,assumed,none", ["hurst", "-1.1"]),
    ],
)
def test_faulty_descriptions_are_refused(tmp_path, segment, message_parts):
    path = tmp_path / "surface.csv"
    path.write_text(f"{DESCRIPTION_HEADER}{segment}\n")
    assert_says(
        refusal(refuse_description, path, TABLE_1), "surface.csv", "expected", *message_parts
    )


def test_a_blank_hurst_exponent_needs_rows_of_table_1(tmp_path):
    path = tmp_path / "surface.csv"
    path.write_text(f"{DESCRIPTION_HEADER}inf,6.5,varying Hurst,,2000,,,,assumed,none\n")
    assert_says(refusal(refuse_description, path, set()), "line 2", "afm_rms_height", "neither")
    refuse_description(path, TABLE_1)


def test_own_studies_refuse_substitutes_for_the_paper_and_substitutes_without_data():
    for path in SPECTRA.glob("crn_*.csv"):
        refuse_in_own_study(path, path.stem, {"uncd", "ncd"})
    for name, surface, message_parts in (
        ("uncd", "my_uncd", ["config key published", "my_uncd", "none"]),
        ("crn_smoother", "uncd", ["config key published", "uncd", "none"]),
        ("ruby", "other", ["ruby.csv", "measured", "assumed"]),
    ):
        message = refusal(refuse_in_own_study, SPECTRA / f"{name}.csv", surface, {"uncd", "ncd"})
        assert_says(message, "expected", *message_parts)
