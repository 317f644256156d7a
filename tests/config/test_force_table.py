"""Your tables of forces: accepted, or refused in one line per fault."""

import pytest
from refusals import assert_says, refusal

from hardcontact.config.force_table import read_forces

SURFACES = ["coating", "bare"]
RADIUS = 250e3  # nm


def test_a_table_may_have_decimal_commas_between_semicolons(write_table):
    summaries = write_table("surface;median;mean;count;unit", "bare;1,0591e1;11,749;40;µN")
    (row,) = read_forces(summaries, SURFACES, RADIUS).itertuples(index=False)
    assert row == ("bare", 1.1749e-5, 1.0591e-5, 40, "")
    single_forces = write_table("surface;value;unit", "bare;11.5;uN")
    assert read_forces(single_forces, SURFACES, RADIUS)["mean"].tolist() == [1.15e-5]


@pytest.mark.parametrize(
    ("header", "row"),
    [
        ("surface,value,unit", "bare,0.00101971621,gf"),  # 10 µN over 9.80665 m/s²
        ("surface,value,unit", "bare,1.01971621,mgf"),
        ("surface,value,unit", "bare,40,mN/m"),  # a force over the radius of 250 µm
        ("surface,pull-off [nN]", "bare,10000"),
        ("surface,site,value (µN)", "bare,,10"),
        ("Surface\tValue [nN]", "bare\t1,0e4"),
        ("surface,value (nN),error (nN)", "bare,10000,30"),
        ("surface,operator,value,unit", "bare,a,10,uN"),
    ],
)
def test_forces_are_read_in_the_units_that_people_have(tmp_path, header, row):
    path = tmp_path / "my.csv"
    path.write_text(f"{header}\n{row}\n", "latin-1")
    _, *columns = read_forces(path, SURFACES, RADIUS).iloc[0]  # mean, median, count, site
    assert columns == pytest.approx([1e-5, 1e-5, 1, ""], rel=1e-8)


def test_a_table_of_one_surface_needs_no_name(write_table):
    path = write_table("Adhesion (nN)", "400")
    assert read_forces(path, ["bare"], RADIUS).iloc[0].tolist() == ["bare", 4e-7, 4e-7, 1, ""]
    assert_says(refusal(read_forces, path, SURFACES, RADIUS), "surface, value, unit")


def test_each_kind_of_fault_of_a_table_of_forces_has_its_line(write_table):
    # The first line, the rows and parts of the message of each kind of fault.
    faults = [
        (
            2,
            ["coating,0.5,", "coating,0.5,um", "bare,nan,uN", "bare,1e-3,uN*9**9", "bare,1e308,kN"],
            ["and 4 more: expected a force with a unit, such as 10uN, found '0.5 '"],
        ),
        (7, ["other,1,uN"], [": surface: expected coating or bare, found other"]),
        (8, ["bare,-1,uN", "bare,-2,uN"], ["and 1 more", "found -1: ", "take off the sign"]),
        (
            10,
            ["bare,0,uN", "bare,<5,nN"],
            ["value: expected a force above zero, found 0", "below the noise write"],
        ),
        (12, ["bare,0.5"], ["expected 3 cells, found 2"]),
        (13, ["bare,1e-320,uN"], ["1 fN to 1 kN", "1e-320 uN"]),
    ]
    path = write_table("surface,value,unit", *(row for _, rows, _ in faults for row in rows))
    message = refusal(read_forces, path, SURFACES, RADIUS)
    for line, (number, _, parts) in zip(message.splitlines(), faults, strict=True):
        assert_says(line, f"{path}: line {number}", *parts)


@pytest.mark.parametrize(
    ("row", "message_parts"),
    [
        ("coating,0.4,0.3,40,uN", ["each surface once", "coating"]),
        ("bare,0.3,0.2,2.5,uN", ["count", "2.5"]),
        ("bare,0.3,0.4,9,uN", ["at most the mean", "0.4 beside 0.3"]),
    ],
)
def test_a_summary_needs_one_row_per_surface_and_a_median_below_the_mean(
    write_table, row, message_parts
):
    path = write_table("surface,mean,median,count,unit", "coating,0.4,0.3,40,uN", row)
    assert_says(refusal(read_forces, path, SURFACES, RADIUS), "line 3", *message_parts)


@pytest.mark.parametrize(
    ("content", "message_part"),
    [
        (b"", "surface, value, unit"),
        (b"surface,value,unit", "surface, value, unit"),
        (b"surface,mean_force\na,1", "surface, value, unit"),
        (b"surface,adhesion (nN),error (nN)\nbare,400,30", "adhesion, error"),
        (b"surface,value,unit,count\nbare,5,nN,40", "median, found 40"),
        (b"surface,value,unit,place\nbare,1,uN,a", "did you mean site?"),
        (b"surface,sites,value,unit\nbare,a,1,uN", "found sites (did you mean site?)"),
        (b"\xff\xfe\x00", "UTF-8"),
        (None, "forces"),
    ],
)
def test_a_file_that_is_no_table_of_forces_is_refused_in_one_line(tmp_path, content, message_part):
    path = tmp_path / "my.csv"
    if content is not None:
        path.write_bytes(content)
    message = refusal(read_forces, path, SURFACES, RADIUS)
    assert_says(message, "my.csv", message_part)
    assert len(message.splitlines()) == 1


def test_a_table_of_200_mb_is_not_read(tmp_path):
    path = tmp_path / "my.csv"
    with open(path, "wb") as file:
        file.truncate(200_000_000)
    message = refusal(read_forces, path, SURFACES, RADIUS)
    assert_says(message, "my.csv", "of at most 10 MB, found 200 MB")
