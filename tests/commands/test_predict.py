"""`hardcontact predict` on tables of spectra: their faults, its numbers and its options."""

import json
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from known_spectra import PAPER_CONTACT, self_affine_spectrum
from measurements import random_line
from prediction_command import predict_json, predict_text
from refusals import assert_says, refusal
from scan_files import write_coordinates
from SurfaceTopography import UniformLineScan

from hardcontact.commands.command_line import join_units
from hardcontact.commands.options import parse_quantities, unit_questions
from hardcontact.commands.predict import predict_arguments
from hardcontact.own.spectrum_table import read_spectrum_table
from hardcontact.scans.extrapolation import extrapolate_short_waves, fit_hurst_exponent
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER, isotropic_from_profile
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.theory.closed_form import closed_form, critical_band
from hardcontact.theory.prediction import trim_spectrum
from hardcontact.theory.validity import nearest_ratios, table_point

pytestmark = pytest.mark.usefixtures("quick_predictions")
HEADER = "wavelength,wavelength_unit,c_iso,c_iso_unit"


def rows_of(spectrum):
    """Return a spectrum as a header and rows of a table in other units."""
    points = zip(spectrum.wavevector.tolist(), spectrum.density.tolist(), strict=True)
    rows = [f"{q * 1000!r},rad/um,{c * 1e-36!r},m^4" for q, c in points if c > 0]
    return ["wavevector,wavevector_unit,c_iso,c_iso_unit", *rows]


# Tables


def test_a_table_may_have_any_units_order_and_zeros(write_table):
    rows = [
        "1,um,2e-30,m4", "500,nm,1e6,nm4", "100,nm,5e4,nm⁴", "0.01,µm,3,nm4", "50,nm,1e4,nm^4",
        "5,nm,0,nm4",
    ]  # fmt: skip
    spectrum = read_spectrum_table(write_table(HEADER, *rows))
    assert spectrum.wavelength == pytest.approx([1000, 500, 100, 50, 10, 5])
    assert spectrum.density == pytest.approx([2e6, 1e6, 5e4, 1e4, 3, 0])
    assert spectrum(2 * np.pi / np.array([5, 3])) == pytest.approx(0, abs=1e-90)
    wavevector = np.geomspace(0.01, 1, 9)
    profile = 1e-2 * wavevector**-2.6
    rows = [f"{q:.17g},rad/nm,{c:.17g},nm3" for q, c in zip(wavevector, profile, strict=True)]
    spectrum = read_spectrum_table(write_table("wavevector,wavevector_unit,c_1d,c_1d_unit", *rows))
    isotropic_density = isotropic_from_profile(wavevector, profile, modes=np.full(9, 20.0))
    assert spectrum.density == pytest.approx(isotropic_density)


#: Lines of a table, and parts of the refusals.
FAULTY = [
    (["wavelength,c_iso", "1,2"], ["found wavelength, c_iso and 1 rows"]),
    (
        ["wavelength,wavevector,c_iso,x", "1,2"],
        ["one of the columns", "found wavelength, wavevector, c_iso, x"],
    ),
    ([HEADER, "1,s,2,nm4", "1,nm,2,nm3"], ["wavelength_unit: expected a length", "power of 4"]),
    ([HEADER, "-1,nm,x,", "1,nm"], ["found -1", "line 3: expect"]),
    ([HEADER, "1,nm,1,nm4", "1e-3,um,1,nm4"], ["line 3: expected each wavelength once"]),
    ([HEADER, "1,nm,1,nm4"], ["at least 5 wavelengths, found 1"]),
    ([""], ["found nothing"]),
    (["wavevector,wavevector_unit,c_1d,c_1d_unit", "1,1/nm,1,nm3"], ["rad/nm", "found 1/nm"]),
    # Wavelengths, and powers, that no surface has.
    (
        [HEADER, *[f"{k},m,{k**4}e-4,nm4" for k in (1, 2, 3, 4, 5)]],
        ["expected wavelengths of 0.1 nm to 1 mm"],
    ),
    ([HEADER, *[f"{k}00,nm,{k**4}e-36,nm4" for k in (1, 2, 3, 4, 5)]], ["rms height of 0.01 nm"]),
    ([HEADER, *[f"{k}00,nm,{k**4}e36,nm4" for k in (1, 2, 3, 4, 5)]], ["is the unit right?"]),
]


def test_each_fault_of_a_spectrum_table_has_its_line(write_table):
    for lines, message_parts in FAULTY:
        assert_says(refusal(predict_text, write_table(*lines)), *message_parts)


def test_faulty_options_are_reported_with_the_faults_of_the_table(tmp_path):
    missing_file = str(tmp_path / "none.csv")
    for options, message_parts in (
        (["--range", "5", "--work", "1 nm"], ["--range", "--work"]),
        # A contact wider than the attraction of a smooth sphere, 2 pi R rho: 880 uN at 100 MPa.
        (["--preload", "10mN", "--hardness", "100MPa"], ["--preload: expected less than 880 µN"]),
        # Both are suspected: the hardness was meant to be in GPa.
        (["--hardness", "25kPa"], ["like a smooth sphere; --hardness 25kPa: is the unit right?"]),
        (["--json", str(tmp_path / "new/x.json")], ["--json: expected a file in a folder"]),
    ):
        message = refusal(predict_text, missing_file, *options)
        assert_says(message, "none.csv", "found no such file", *message_parts)
        assert len(message.splitlines()) == 1 + len(message_parts)
    assert not any(tmp_path.iterdir())


def test_nothing_is_replaced_unasked(write_table, tmp_path):
    path = write_table(*rows_of(self_affine_spectrum(rms=17)))
    numbers = tmp_path / "numbers.json"
    numbers.write_text("{}")
    assert_says(
        refusal(predict_text, path, "--json", path, "--overwrite"), "than that of the surface"
    )
    assert_says(refusal(predict_text, path, "--json", str(numbers)), "new file", "add --overwrite")
    assert numbers.read_text() == "{}"
    predict_text(path, "--json", str(numbers), "--overwrite")
    assert "closed_form_force" in json.loads(numbers.read_text())
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with ThreadPoolExecutor() as reader:
        text = reader.submit(pipe.read_text)
        predict_text(path, "--json", str(pipe))
        assert "closed_form_force" in json.loads(text.result(timeout=10)) and pipe.is_fifo()


# Numbers


def test_numbers_and_words_are_those_of_the_closed_form(write_table):
    spectrum = self_affine_spectrum(rms=17)
    options = ["--range", "8nm", "--work", "50 mJ/m2"]
    numbers = predict_json(write_table(*rows_of(spectrum)), *options)
    contact = replace(PAPER_CONTACT, rho=8.0, work=0.05)
    prediction = closed_form(spectrum, contact)
    force = numbers["closed_form_force"]
    assert force["value"] == pytest.approx(prediction.force, rel=1e-6)
    assert force["unit"] == "N" and force["status"] == "inside"
    coordinates = table_point(trim_spectrum(spectrum), contact, prediction)
    force_interval = prediction.force * np.array(nearest_ratios(coordinates, "force"))
    assert force["interval"] == pytest.approx(force_interval, rel=1e-5)
    band = critical_band(spectrum, contact, 0.1)
    for name, edge in zip(("short_edge", "long_edge"), band, strict=True):
        assert numbers[name]["value"] == pytest.approx(edge)
        assert numbers[name]["interval"][0] < edge
    words = predict_text(write_table(*rows_of(spectrum)), *options)
    assert_says(words, f"closed form, for the spectrum: {round(1e9 * prediction.force, -1):g} nN")
    assert len(words.splitlines()) <= 5


def test_unknown_quantities_have_a_status_and_no_number(write_table):
    """An almost smooth surface has no edge; the prediction reports where its error is unknown."""
    numbers = predict_json(write_table(*rows_of(self_affine_spectrum(rms=0.02))), "--radius", "5um")
    assert numbers["short_edge"] == {"value": None, "unit": "nm", "status": "none"}
    assert numbers["weibull_modulus"]["status"] == "smooth"
    assert numbers["closed_form_force"]["status"] == "outside"
    assert "interval" not in numbers["closed_form_force"]


def test_short_waves_missing_from_the_table_are_extrapolated(write_table):
    """The missing waves of an optical spectrum change the force, unless the table ends with 0."""
    rows = rows_of(self_affine_spectrum(rms=17, rolloff=4000, shortest=1500))
    numbers, spectrum = predict_json(write_table(*rows)), read_spectrum_table(write_table(*rows))
    variance = np.full(spectrum.density.shape, CALIBRATION_SCATTER**2)
    fit = fit_hurst_exponent(spectrum.wavevector, spectrum.density, variance)
    density, _ = extrapolate_short_waves(spectrum.wavevector, spectrum.density, fit)
    extrapolated_force = closed_form(Spectrum(WAVEVECTORS, density), PAPER_CONTACT).force
    assert numbers["extrapolated_force"]["value"] == pytest.approx(extrapolated_force, rel=1e-6)
    assert numbers["extrapolated_change"]["status"] == "matters"
    complete_rows = rows_of(self_affine_spectrum(rms=17, shortest=0.1))
    for table_rows in ([*rows, "1,rad/nm,0,nm4"], complete_rows):
        numbers = predict_json(write_table(*table_rows))
        assert "extrapolated_force" not in numbers
        assert numbers["extrapolated_change"]["status"] == "negligible"


def test_the_word_after_a_number_is_its_unit():
    words = ["a.txt", "--size", "5e+3", "nm", "--range=1E-1", "nm", "--work", "1.5", "J/m^2"]
    joined_words = ["a.txt", "--size", "5e+3nm", "--range=1E-1nm", "--work", "1.5J/m^2"]
    assert join_units(words) == joined_words
    for words in (["scan1", "nm"], ["5ex", "nm"], ["5e", "nm"]):
        assert join_units(words) == words


@pytest.mark.parametrize(
    ("name", "usual", "questioned"),
    [
        ("radius", ["1um", "25mm"], ["250nm", "250mm"]),
        ("hardness", ["150MPa", "120GPa"], ["30MPa", "0.25TPa"]),
        ("preload", ["1nN", "1mN"], ["10pN", "10mN"]),
        ("range", ["0.3nm", "22nm"], ["0.15nm", "56nm"]),
        ("work", ["1mJ/m2", "900mJ/m2"], ["46uJ/m2", "46.3J/m2"]),
    ],
)
def test_implausible_quantities_are_questioned(name, usual, questioned):
    for texts, count in ((usual, 0), (questioned, 1)):
        for text in texts:
            quantities, faults = parse_quantities(predict_arguments(["a.csv", f"--{name}", text]))
            lines = list(unit_questions(quantities))
            assert not faults and len(lines) == count, lines
            assert all(line.startswith(f"--{name} {text}: is the unit right?") for line in lines)


def test_a_compliant_sphere_has_a_large_tabor_parameter(write_table):
    """A smooth sphere has the Tabor parameter (R W²/(E*² rho³))^(1/3)."""
    path = write_table(*rows_of(self_affine_spectrum(rms=17)))
    hard, soft = (predict_json(path, "--modulus", modulus) for modulus in ("290GPa", "1MPa"))
    tabor_parameter = (250e-6 * 0.0463**2 / (1e6**2 * 5.6e-9**3)) ** (1 / 3)
    assert soft["tabor_parameter"]["value"] == pytest.approx(tabor_parameter, rel=1e-3)
    assert soft["tabor_parameter"]["status"] == "soft"
    assert hard["tabor_parameter"].get("status", "") != "soft"


def test_the_spacing_of_a_line_scan_is_no_pixel_in_contact(tmp_path):
    """The contact area of the paper, 400 nm², is less than the square of 100 nm."""
    path = tmp_path / "line.txt"
    scan = random_line(np.random.default_rng(5), 4096, 100.0)
    write_coordinates(UniformLineScan(scan.heights, scan.size, unit="nm"), path)
    assert "less than a pixel" not in predict_text(str(path))
