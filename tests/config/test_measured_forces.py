"""The user's own forces: units, both kinds of table, and what is wrong with one, all of it."""

import re

import pytest
from refusals import assert_says, refusal

from hardcontact.config.tables import measured_forces

SURFACES = ["coating", "bare"]


@pytest.fixture
def table(tmp_path):
    def written(*lines):
        path = tmp_path / "my.csv"
        path.write_text("\n".join(lines) + "\n", "utf-8")
        return path

    return written


def problems(path):
    with pytest.raises(ValueError) as caught:
        measured_forces(path, SURFACES)
    return str(caught.value).splitlines()


def test_single_tests_are_read_in_their_units(table):
    forces = measured_forces(
        table("surface,value,unit", "coating,0.5,uN", "coating,400,nN", "", "bare,2e-6,N"), SURFACES
    )
    assert forces.index.tolist() == [2, 3, 5]
    assert forces.surface.tolist() == ["coating", "coating", "bare"]
    assert forces["mean"].tolist() == forces["median"].tolist() == [5e-7, 4e-7, 2e-6]
    assert forces["count"].tolist() == [1, 1, 1]


def test_a_spreadsheet_s_mark_and_line_ends_do_not_matter(tmp_path):
    path = tmp_path / "my.csv"
    path.write_bytes('\ufeffsurface,value,unit\r\n"bare", 1 ,nN\r\n'.encode())
    assert measured_forces(path, SURFACES)["mean"].tolist() == [1e-9]


def test_semicolons_may_stand_between_decimal_commas(table):
    commas = table("surface;median;mean;count;unit", "bare;1,0591e1;11,749;40;µN")
    assert measured_forces(commas, SURFACES).iloc[0].tolist() == ["bare", 1.1749e-5, 1.0591e-5, 40]
    points = table("surface;value;unit", "bare;11.5;uN")
    assert measured_forces(points, SURFACES)["mean"].tolist() == [1.15e-5]
    (said,) = problems(table("surface,value,unit", "bare,11,749,uN"))
    assert_says(said, "line 2", "expected 3 cells, found 4", "semicolons")


def test_all_problems_are_told_at_once_each_with_its_line(table):
    path = table(
        "surface,value,unit",
        "coating,0.5,",
        "coating,0.5,um",
        "other,-1,uN",
        "coating,nan,uN",
        "coating,0.5",
        "coating,1e-3,uN*9**9",
    )
    found = problems(path)
    assert [line.partition(": line ")[2][:1] for line in found] == list("2344567")
    for line, says in zip(
        found,
        ["unit: .* found nothing", "found um", "coating or bare, found other",
         "positive number, found -1", "found nan", "expected 3 cells, found 2", "unit: .* uN"],
        strict=True,
    ):  # fmt: skip
        assert line.startswith(f"{path}: line ")
        assert re.search(says, line), line


@pytest.mark.parametrize("force", ["1e-320,uN", "1e308,kN", "1e-16,N", "2,MN"])
def test_a_force_that_no_contact_has_is_refused_as_it_was_given(table, force):
    (said,) = problems(table("surface,value,unit", f"bare,{force}"))
    assert_says(said, "line 2", "1e-15 to 1000 N", force.replace(",", " "))


def test_a_summary_is_one_row_a_surface_with_a_median_below_its_mean(table):
    found = problems(
        table(
            "surface,mean,median,count,unit",
            "coating,0.4,0.3,40,uN",
            "coating,0.4,0.3,40,uN",
            "bare,0.3,0.4,2.5,uN",
        )
    )
    assert_says(found[0], "line 4", "count", "2.5")
    assert_says(found[1], "line 4", "at most the mean", "0.4 beside 0.3")
    assert_says(found[2], "line 3", "each surface once", "coating")


@pytest.mark.parametrize(
    "lines", [[""], ["surface,value,unit"], ["surface,mean_force", "a,1"], ["1;2;3", "4;5;6"]]
)
def test_another_table_is_refused_in_one_line(table, lines):
    path = table(*lines)
    assert_says(refusal(measured_forces, path, SURFACES), str(path), "surface, value, unit")


def test_no_file_and_no_text_are_refused_in_one_line(tmp_path):
    assert_says(refusal(measured_forces, tmp_path / "none.csv", SURFACES), "forces", "none.csv")
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    assert_says(refusal(measured_forces, tmp_path / "binary.csv", SURFACES), "UTF-8")
