"""`hardcontact predict`: what it tells, and all that is wrong with a table at once."""

import sys

import numpy as np
import pytest
from known_spectra import rough
from refusals import assert_says, refusal

from hardcontact.commands import new
from hardcontact.commands.predict import (
    AREA,
    RADIUS,
    RANGES,
    TRIED,
    own_spectrum,
    predict,
    predict_arguments,
)
from hardcontact.config.configuration import read_yaml
from hardcontact.insight.closed_form import Contact, closed_form, contact_area
from hardcontact.numbers.units import magnitude
from hardcontact.surfaces.measured_spectrum import isotropic_from_profile

HEADER = "wavelength,wavelength_unit,c_iso,c_iso_unit"


@pytest.fixture
def table(tmp_path):
    def written(*lines):
        path = tmp_path / "my.csv"
        path.write_text("\n".join(lines) + "\n", "utf-8")
        return str(path)

    return written


def of(spectrum):
    """Return a spectrum as rows of a table in other units."""
    known = spectrum.density > 0
    return [
        f"{q * 1000!r},rad/um,{c * 1e-36!r},m^4"
        for q, c in zip(
            spectrum.wavevector[known].tolist(), spectrum.density[known].tolist(), strict=True
        )
    ]


def test_units_and_order_do_not_matter(table):
    rows = ["1,um,2e-30,m4", "500,nm,1e6,nm4", "100,nm,5e4,nm⁴", "0.01,µm,3,nm4", "50,nm,1e4,nm^4"]
    found = own_spectrum(table(HEADER, *rows))
    assert 2 * np.pi / found.wavevector == pytest.approx([1000, 500, 100, 50, 10])
    assert found.density == pytest.approx([2e6, 1e6, 5e4, 1e4, 3])


def test_profiles_are_converted(table):
    wavevector = np.geomspace(0.01, 1, 9)
    rows = [f"{q!r},rad/nm,{1e-2 * q**-2.6!r},nm3" for q in wavevector.tolist()]
    found = own_spectrum(table("wavevector,wavevector_unit,c_1d,c_1d_unit", *rows))
    expected = isotropic_from_profile(wavevector, 1e-2 * wavevector**-2.6, np.full(9, 20.0))
    assert found.density == pytest.approx(expected)


def test_zeros_say_no_roughness(table):
    rows = [f"{length},nm,{density},nm4" for length, density in zip(
        [1000, 500, 200, 100, 50, 20, 10], [0, 1e6, 1e5, 1e4, 1e3, 1e2, 0], strict=True
    )]  # fmt: skip
    found = own_spectrum(table(HEADER, *rows))
    assert (found.density == [0, 1e6, 1e5, 1e4, 1e3, 1e2, 0]).all()
    assert found(2 * np.pi / np.array([1000, 15, 5])) == pytest.approx(0, abs=1e-90)


def test_a_fault_of_every_line_is_told_once(table):
    message = refusal(own_spectrum, table(HEADER, *[f"{n},s,1,nm4" for n in range(1, 8)]))
    assert_says(message, "line 2 and 6 more: wavelength_unit: expected a length", "found s")
    assert len(message.splitlines()) == 1


@pytest.mark.parametrize(
    ("lines", "parts"),
    [
        (["wavelength,c_iso", "1,2"], ["wavelength_unit beside", "c_iso_unit beside"]),
        (["wavelength,wavevector,c_iso,x", "1,2"], ["wavelength, found both", "c_iso_unit"]),
        ([HEADER, "1,s,2,nm3"], ["wavelength_unit: expected a length", "power of 4"]),
        ([HEADER, "-1,nm,x,", "1,nm"], ["found -1", "found x", "found nothing", "line 3: expect"]),
        ([HEADER, "1,nm,1,nm4", "1e-3,um,1,nm4"], ["line 3: expected each wavelength once"]),
        ([HEADER, "1,nm,1,nm4"], ["at least 5 wavelengths, found 1"]),
        ([""], ["found no column"]),
        (["wavevector,wavevector_unit,c_1d,c_1d_unit", "1,1/nm,1,nm3"], ["rad/nm", "found 1/nm"]),
    ],
)
def test_every_fault_of_a_table_is_told(table, lines, parts):
    message = refusal(own_spectrum, table(*lines))
    # A wavevector beside a wavelength is told with both names.
    assert_says(message.replace("wavevector and wavelength", "wavelength"), *parts)


def test_faults_of_options_and_table_are_told_together(tmp_path):
    arguments = predict_arguments([str(tmp_path / "none.csv"), "--range", "5", "--work", "1 nm"])
    message = refusal(predict, arguments)
    assert_says(message, "--range", "--work", "none.csv", "found no file")
    assert len(message.splitlines()) == 3


def test_the_prediction_is_that_of_the_closed_form(table, monkeypatch, capsys):
    spectrum = rough(17, 1000, 0.8, 20)
    path = table("wavevector,wavevector_unit,c_iso,c_iso_unit", *of(spectrum))
    line = ["hardcontact", "predict", path, "--radius", "250 um", "--range", "8nm"]
    monkeypatch.setattr(sys, "argv", [*line, "--work", "50 mJ/m2"])
    assert new.main() == 0
    told = capsys.readouterr().out
    expected = closed_form(spectrum, Contact(250e3, 8.0, 0.05, 400.0))
    assert_says(
        told, f"pull-off force: {round(1e9 * expected.force, -1):g} nN,",
        f"regime: {expected.regime}",
        "range: 8nm (range of adhesion: as given)", "the paper's; --preload", "short edge",
        "long edge", f"({TRIED})",
    )  # fmt: skip
    assert "left out" not in told


def test_the_help_states_the_error_that_a_prediction_states(capsys):
    with pytest.raises(SystemExit):
        predict_arguments(["--help"])
    assert_says(capsys.readouterr().out, TRIED, "four diamond coatings")


def test_rows_without_roughness_are_left_out_and_counted(table):
    header, rows = "wavevector,wavevector_unit,c_iso,c_iso_unit", of(rough(17, 1000, 0.8, 20))
    zeros = [f"{q},rad/nm,0,nm4" for q in (1e-7, 2e-7, 1e3)]
    first, ends, *_ = predict(predict_arguments([table(header, *rows, *zeros)])).splitlines()
    assert first == "left out: 3 rows of the table with a density of 0, no roughness there"
    shortest = 2 * np.pi / own_spectrum(table(header, *rows)).wavevector[-1]
    assert ends.startswith(f"spectrum: {shortest:.3g} nm to ")


def test_waves_that_the_table_lacks_are_told(table):
    header = "wavevector,wavevector_unit,c_iso,c_iso_unit"
    short = rough(60, 2e4, 0.8, 20)  # it rolls off beyond the table
    kept = short.wavevector > 2 * np.pi / 3000
    cut = type(short)(short.wavevector[kept], short.density[kept])
    told = predict(predict_arguments([table(header, *of(cut))]))
    assert_says(told, "take care: waves longer than", "less sure than a factor of two")
    assert TRIED not in told


@pytest.mark.parametrize(
    ("options", "parts"),
    [
        (["--range", "0.3nm"], ["ranges of 0.5 nm to 20 nm, not at 0.3 nm"]),
        (["--radius", "5um", "--preload", "100nN"], ["a sphere of 250 µm, not of 5 µm"]),
        (["--radius", "100um"], ["a sphere of 250 µm, not of 100 µm"]),
        (["--range", "0.5nm"], ["a freezing of 84 at most"]),
        (["--preload", "20uN"], ["with 400 nm² in contact, not 800 nm²"]),
    ],
)
def test_what_lies_outside_of_what_was_tried_is_told(table, options, parts):
    path = table("wavevector,wavevector_unit,c_iso,c_iso_unit", *of(rough(200, 1000, 0.8, 20)))
    told = predict(predict_arguments([path, *options]))
    assert_says(told, "less sure than a factor of two", *parts)
    assert TRIED not in told


def test_what_was_tried_is_what_the_default_study_computes(at_root):
    """The error itself is in its closed_form.nc, which takes the whole study."""
    paper = read_yaml("config/config.yaml")
    lengths = [magnitude(text, "nm") for text in paper["insight"]["ranges"]]
    assert RANGES == (min(lengths), max(lengths))
    assert RADIUS == pytest.approx(magnitude(paper["sphere"]["radius"], "nm"))
    preload, hardness = (
        magnitude(paper["contact"][name], unit)
        for name, unit in (("preload", "N"), ("hardness", "Pa"))
    )
    assert AREA == pytest.approx(contact_area({"preload": preload, "hardness": hardness}))


def test_faults_of_contact_and_table_are_told_together(tmp_path):
    arguments = [str(tmp_path / "none.csv"), "--preload", "10mN", "--hardness", "100MPa"]
    message = refusal(predict, predict_arguments(arguments))
    assert_says(message, "--preload: expected less than", "none.csv", "found no file")
    assert len(message.splitlines()) == 2


def test_a_contact_that_is_wider_than_the_attraction_is_refused(table):
    path = table("wavevector,wavevector_unit,c_iso,c_iso_unit", *of(rough(17, 1000, 0.8, 20)))
    options = ["--preload", "10mN", "--hardness", "100MPa"]
    message = refusal(predict, predict_arguments([path, *options]))
    assert_says(message, "--preload: expected less than 880 µN", "found 10mN", "smooth sphere")


def test_a_wide_contact_counts_on_the_smooth_surface_too(table):
    """Of a surface that is all but smooth nothing is lost, whatever the contact."""
    path = table("wavevector,wavevector_unit,c_iso,c_iso_unit", *of(rough(0.02, 1000, 0.8, 20)))
    options = ["--radius", "5um", "--hardness", "100MPa"]
    told = predict(predict_arguments([path, *options]))
    assert_says(told, "1 of the 2.", "µN of a smooth surface", "regime: smooth")
    rougher = table("wavevector,wavevector_unit,c_iso,c_iso_unit", *of(rough(4, 1000, 0.8, 20)))
    wider = predict(predict_arguments([rougher, *options, "--preload", "15uN"]))
    assert_says(wider, "no band: all roughness on")


@pytest.mark.parametrize("factor", [1e-36, 1e36])
def test_a_power_in_a_wrong_unit_is_refused(table, factor):
    spectrum = rough(17, 1000, 0.8, 20)
    wrong = type(spectrum)(spectrum.wavevector, factor * spectrum.density)
    path = table("wavevector,wavevector_unit,c_iso,c_iso_unit", *of(wrong))
    message = refusal(predict, predict_arguments([path]))
    assert_says(message, "rms height of 0.01 nm", "is the unit right?")


def test_faults_end_the_command_with_a_line_each(table, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["hardcontact", "predict", table(HEADER, "1,s,2,nm3")])
    assert new.main() == 1
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2 and all(line.startswith("error: ") for line in lines)
