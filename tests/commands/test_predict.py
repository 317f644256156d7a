"""`hardcontact predict`: what it tells, and all that is wrong with a table at once."""

import csv
import json
import sys

import numpy as np
import pytest
import scan_files
from known_spectra import rough
from measurements import line_of, map_of, measurement
from random_scans import PIXEL
from refusals import assert_says, refusal

from hardcontact.commands import new
from hardcontact.commands.predict import predict, predict_arguments
from hardcontact.config.own_spectrum import own_spectrum, table_spectrum
from hardcontact.insight.closed_form import Contact, closed_form, edges
from hardcontact.insight.prediction import coordinates, nearest_errors, rough_part
from hardcontact.numbers.random import generator
from hardcontact.surfaces.extrapolated_spectrum import continued_spectrum
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.measured_spectrum import CALIBRATION, isotropic_from_profile
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, spectrum_from

#: How an interval is told.
LIKELY = "of ten surfaces like this nine lie between"
HEADER = "wavelength,wavelength_unit,c_iso,c_iso_unit"
BY_WAVEVECTOR = "wavevector,wavevector_unit,c_iso,c_iso_unit"


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
    found = table_spectrum(table(HEADER, *rows))
    assert 2 * np.pi / found.wavevector == pytest.approx([1000, 500, 100, 50, 10])
    assert found.density == pytest.approx([2e6, 1e6, 5e4, 1e4, 3])


def test_profiles_are_converted(table):
    wavevector = np.geomspace(0.01, 1, 9)
    rows = [f"{q!r},rad/nm,{1e-2 * q**-2.6!r},nm3" for q in wavevector.tolist()]
    found = table_spectrum(table("wavevector,wavevector_unit,c_1d,c_1d_unit", *rows))
    expected = isotropic_from_profile(wavevector, 1e-2 * wavevector**-2.6, np.full(9, 20.0))
    assert found.density == pytest.approx(expected)


def test_zeros_say_no_roughness(table):
    rows = [f"{length},nm,{density},nm4" for length, density in zip(
        [1000, 500, 200, 100, 50, 20, 10], [0, 1e6, 1e5, 1e4, 1e3, 1e2, 0], strict=True
    )]  # fmt: skip
    found = table_spectrum(table(HEADER, *rows))
    assert (found.density == [0, 1e6, 1e5, 1e4, 1e3, 1e2, 0]).all()
    assert found(2 * np.pi / np.array([1000, 15, 5])) == pytest.approx(0, abs=1e-90)


def test_a_fault_of_every_line_is_told_once(table):
    message = refusal(table_spectrum, table(HEADER, *[f"{n},s,1,nm4" for n in range(1, 8)]))
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
    message = refusal(table_spectrum, table(*lines))
    # A wavevector beside a wavelength is told with both names.
    assert_says(message.replace("wavevector and wavelength", "wavelength"), *parts)


@pytest.mark.parametrize(
    ("options", "parts"),
    [
        (["--range", "5", "--work", "1 nm"], ["--range", "--work"]),
        (["--preload", "10mN", "--hardness", "100MPa"], ["--preload: expected less than"]),
        (["--json", "-", "--csv", "-"], ["--csv: expected a file"]),
    ],
)
def test_faults_of_options_and_table_are_told_together(tmp_path, options, parts):
    message = refusal(predict, predict_arguments([str(tmp_path / "none.csv"), *options]))
    assert_says(message, "none.csv", "found no file", *parts)
    assert len(message.splitlines()) == 1 + len(parts)


def test_the_prediction_is_that_of_the_closed_form(table, monkeypatch, capsys):
    spectrum = rough(17, 1000, 0.8, 20)
    path = table(BY_WAVEVECTOR, *of(spectrum))
    line = ["hardcontact", "predict", path, "--radius", "250 um", "--range", "8nm"]
    monkeypatch.setattr(sys, "argv", [*line, "--work", "50 mJ/m2"])
    assert new.main() == 0
    told = capsys.readouterr().out
    expected = closed_form(spectrum, Contact(250e3, 8.0, 0.05, 400.0))
    assert_says(
        told, f"pull-off force: {round(1e9 * expected.force, -1):g} nN ({LIKELY}",
        f"regime: {expected.regime}",
        "range: 8nm (range of adhesion: as given)", "the paper's; --preload", "short edge",
        "long edge", "Tabor parameter: 0.02",
    )  # fmt: skip
    assert "left out" not in told


def test_rows_without_roughness_are_left_out_and_counted(table):
    rows = of(rough(17, 1000, 0.8, 20))
    zeros = [f"{q},rad/nm,0,nm4" for q in (1e-7, 2e-7, 1e3)]
    first, ends, *_ = predict(predict_arguments([table(BY_WAVEVECTOR, *rows, *zeros)])).splitlines()
    assert first == "left out: 3 rows of the table with a density of 0, no roughness there"
    shortest = 2 * np.pi / table_spectrum(table(BY_WAVEVECTOR, *rows)).wavevector[-1]
    assert ends.startswith(f"spectrum: {shortest:.3g} nm to ")


def test_short_waves_that_the_table_lacks_are_continued(table, monkeypatch, capsys):
    """A spectrum of optical resolution: what it lacks changes the force, unless it ends with 0."""
    rows = of(rough(17, 4000, 0.8, 1500))
    told = numbers_of(capsys, monkeypatch, table(BY_WAVEVECTOR, *rows))
    spectrum = table_spectrum(table(BY_WAVEVECTOR, *rows))
    variance = np.full(spectrum.density.shape, CALIBRATION**2)
    density, _ = continued_spectrum(spectrum.wavevector, spectrum.density, variance)
    whole = Spectrum(WAVEVECTORS, density)
    expected = closed_form(whole, Contact(250e3, 5.6, 0.0463, 400.0)).force
    assert told["continued_force"]["value"] == pytest.approx(expected, rel=1e-6)
    assert told["continued_change"]["status"] == "matters"
    assert told["pull_off_force"]["status"] == "outside"
    atoms = of(rough(17, 1000, 0.8, 0.1))
    for whole in ([*rows, "1,rad/nm,0,nm4"], atoms):
        ended = numbers_of(capsys, monkeypatch, table(BY_WAVEVECTOR, *whole))
        assert "continued_force" not in ended
        assert ended["continued_change"]["status"] == "negligible"


def without(spectrum, kept):
    """Return a spectrum without some of its wavelengths."""
    return Spectrum(spectrum.wavevector[kept], spectrum.density[kept])


KNOWN = rough(17, 1000, 0.8, 20)
GAP = np.abs(np.log(KNOWN.wavevector * 200 / 2 / np.pi)) > np.log(2.5)
LONG = rough(60, 2e4, 0.8, 20)  # it rolls off beyond 3 um
SHORT = 2 * np.pi / np.array([100.0, 90, 80, 70, 60])
SHORT = Spectrum(SHORT, 1e-4 * (2 * np.pi / SHORT) ** 4)


@pytest.mark.parametrize(
    ("spectrum", "options", "parts"),
    [
        (rough(17, 300, 0.8, 20), ["--range", "0.3nm"], ["ranges of 0.5", "not at 0.3 nm"]),
        (
            rough(17, 300, 0.8, 20), ["--radius", "1um", "--preload", "100nN"],
            ["radii of 5.", "not at 1 µm"],
        ),
        (rough(17, 300, 0.8, 20), ["--preload", "500uN"], ["contact area over the roll-off"]),
        (without(LONG, LONG.wavevector > 2 * np.pi / 3000), [], ["take care: waves longer than"]),
        (SHORT, [], ["waves longer than 100 nm", "cannot tell"]),
        (without(KNOWN, GAP), [], ["a factor of 6.3 apart"]),
    ],
)  # fmt: skip
def test_where_the_error_is_not_known_is_told(table, spectrum, options, parts):
    path = table(BY_WAVEVECTOR, *of(spectrum))
    told = predict(predict_arguments([path, *options]))
    assert_says(told, "error not known", *parts)
    assert LIKELY not in told


def test_a_compliant_sphere_is_no_hard_contact(table):
    """Tabor's number of a smooth sphere, by hand: (R W²/(E*² rho³))^(1/3)."""
    path = table(BY_WAVEVECTOR, *of(rough(17, 1000, 0.8, 20)))
    hard, soft = (
        predict(predict_arguments([path, "--modulus", text])) for text in ("290GPa", "1MPa")
    )
    number = (250e-6 * 0.0463**2 / (1e6**2 * 5.6e-9**3)) ** (1 / 3)
    assert_says(soft, f"Tabor parameter: {number:.2g}", "no hard contact", "0.001 GPa (as given)")
    assert "no hard contact" not in hard


@pytest.mark.parametrize(("factor", "unit"), [(1, "m"), (1e69, "mm"), (1e-9, "nm")])
def test_wavelengths_of_a_wrong_unit_are_refused(table, factor, unit):
    path = table(HEADER, *[f"{factor * k!r},{unit},{k**4}e-4,nm4" for k in (1, 2, 3, 4, 5)])
    message = refusal(predict, predict_arguments([path]))
    assert_says(message, "expected wavelengths of 0.1 nm to 1 mm", "is the unit right?")
    assert len(message.splitlines()) == 1


def test_a_contact_that_is_wider_than_the_attraction_is_refused(table):
    path = table(BY_WAVEVECTOR, *of(rough(17, 1000, 0.8, 20)))
    options = ["--preload", "10mN", "--hardness", "100MPa"]
    message = refusal(predict, predict_arguments([path, *options]))
    assert_says(message, "--preload: expected less than 880 µN", "found 10 mN", "smooth sphere")


def test_a_wide_contact_counts_on_the_smooth_surface_too(table):
    """Of a surface that is all but smooth nothing is lost, whatever the contact."""
    path = table(BY_WAVEVECTOR, *of(rough(0.02, 1000, 0.8, 20)))
    options = ["--radius", "5um", "--hardness", "100MPa"]
    told = predict(predict_arguments([path, *options]))
    assert_says(told, "1 of the 2.", "µN of a smooth surface", "regime: smooth")
    rougher = table(BY_WAVEVECTOR, *of(rough(4, 1000, 0.8, 20)))
    wider = predict(predict_arguments([rougher, *options, "--preload", "15uN"]))
    assert_says(wider, "closest approach: -", "regime: smooth", "long edge: no wavelength")


@pytest.mark.parametrize("factor", [1e-36, 1e36])
def test_a_power_in_a_wrong_unit_is_refused(table, factor):
    spectrum = rough(17, 1000, 0.8, 20)
    wrong = type(spectrum)(spectrum.wavevector, factor * spectrum.density)
    path = table(BY_WAVEVECTOR, *of(wrong))
    message = refusal(predict, predict_arguments([path]))
    assert_says(message, "rms height of 0.01 nm", "is the unit right?")


def numbers_of(capsys, monkeypatch, *arguments):
    """Return what the command writes to stdout as JSON."""
    monkeypatch.setattr(sys, "argv", ["hardcontact", "predict", *arguments, "--json", "-"])
    assert new.main() == 0
    return json.loads(capsys.readouterr().out)


def test_files_of_numbers_hold_those_of_the_closed_form(table, tmp_path, monkeypatch, capsys):
    spectrum = rough(17, 1000, 0.8, 20)
    path = table(BY_WAVEVECTOR, *of(spectrum))
    rows = tmp_path / "new/numbers.csv"
    given = ["--range", "8nm", "--work", "50 mJ/m2", "--csv", str(rows)]
    told = numbers_of(capsys, monkeypatch, path, *given)
    contact = Contact(250e3, 8.0, 0.05, 400.0)
    force = closed_form(spectrum, contact).force
    assert told["pull_off_force"]["value"] == pytest.approx(force, rel=1e-6)
    waves, found = rough_part(spectrum), closed_form(spectrum, contact)
    errors = nearest_errors(coordinates(waves, contact, found), "force")
    assert told["pull_off_force"]["interval"] == pytest.approx(force * np.array(errors), rel=1e-5)
    assert told["pull_off_force"]["unit"] == "N" and told["pull_off_force"]["status"] == "inside"
    for name, edge in zip(("short_edge", "long_edge"), edges(spectrum, contact, 0.1), strict=True):
        assert told[name].pop("interval")[0] < edge
        assert told[name] == {"value": pytest.approx(edge), "unit": "nm", "status": "found"}
    assert told["work"] == {"value": 0.05, "unit": "J/m2", "status": "given"}
    assert told["preload"] == {"value": 1e-5, "unit": "N", "status": "paper"}
    assert "sentence" not in told and all("value" in one for one in told.values())
    with rows.open(newline="") as file:
        in_table = {row["quantity"]: row for row in csv.DictReader(file)}
    assert list(in_table) == list(told)
    for name, one in told.items():
        row = in_table[name]
        assert float(row["value"]) == one["value"] and row["unit"] == one["unit"]
        assert row["status"] == one.get("status", "")
        assert [row["low"], row["high"]] == list(map(repr, one.get("interval", []))) or ["", ""]


def test_what_is_unknown_is_no_number(table, monkeypatch, capsys):
    """Of an all but smooth surface no edge is found; where the error was not measured is said."""
    path = table(BY_WAVEVECTOR, *of(rough(0.02, 1000, 0.8, 20)))
    told = numbers_of(capsys, monkeypatch, path, "--radius", "5um")
    assert told["short_edge"] == {"value": None, "unit": "nm", "status": "none"}
    assert told["freezing"]["status"] == "smooth"
    assert told["pull_off_force"]["status"] == "outside"
    assert "interval" not in told["pull_off_force"]
    assert told["tried_modulus"]["status"] == "outside"


@pytest.mark.parametrize("kind", ["map", "line"])
def test_scans_are_measured_where_they_are_reliable(kind, tmp_path, monkeypatch, capsys):
    one = (map_of if kind == "map" else line_of)(generator(3), 128, PIXEL)
    path = tmp_path / "scan.nc"
    size = 128 * PIXEL
    if kind == "map":
        scan_files.scan(path, one.heights.T, (size, size))
    else:
        path = path.with_suffix(".xyz")
        scan_files.write_coordinates(scan_files.line(one.heights, size), path)
    joined = joined_spectrum([measurement(one.heights, PIXEL)], [None])
    spectrum, (note,), _ = own_spectrum([path])
    known = np.isfinite(joined.joined.values)
    assert spectrum.density == pytest.approx(joined.joined.values[known], rel=1e-4)
    assert 2 * np.pi / spectrum.wavevector[-1] >= 4 * PIXEL
    assert_says(note, f"scan{path.suffix}", "reliable from", "a third of the size")
    told = numbers_of(capsys, monkeypatch, str(path))
    contact = Contact(250e3, 5.6, 0.0463, 400.0)
    assert told["pull_off_force"]["value"] == pytest.approx(closed_form(spectrum, contact).force)
    # It is continued as the masters of the study are, up to a roll-off beyond the scan.
    force = closed_form(spectrum_from(joined), contact).force
    assert told["continued_force"]["value"] == pytest.approx(force, rel=1e-3)
    assert told["continued_rolloff"]["value"] == pytest.approx(joined.attrs["rolloff"], rel=1e-3)


def test_members_of_a_container_are_joined_or_chosen(tmp_path):
    files = {}
    for number in (1, 2):
        heights, path = map_of(generator(number), 64, 10.0).heights, tmp_path / f"{number}.nc"
        files[path.name] = scan_files.scan(path, heights, (640.0, 640.0))
    entries = [{"name": f"scan {file}", "datafile": {"original": file}} for file in files]
    path = scan_files.container(tmp_path / "twin.zip", entries, files)
    both, second = own_spectrum([path]), own_spectrum([path], dataset="scan 2.nc")
    assert len(both.notes) == 2 and len(second.notes) == 1
    apart = [own_spectrum([file]).spectrum.density for file in files.values()]
    assert second.spectrum.density == pytest.approx(apart[1])
    assert both.spectrum.density == pytest.approx(np.sqrt(apart[0] * apart[1]), rel=0.05)


def test_files_that_are_no_spectrum_are_refused_in_a_line(tmp_path):
    scan = scan_files.scan(tmp_path / "scan.nc")
    cases = {
        "none.nc": "expected a scan, found no such file",
        "none.csv": "expected a table of a power spectral density, found no file",
        "text.txt": "expected a whole file in a format that SurfaceTopography reads",
        "flat.nc": "expected a rough surface, found constant height",
        "empty.csv": "expected the columns",
    }
    (tmp_path / "text.txt").write_text("hello\n" * 9)
    (tmp_path / "empty.csv").write_text("")
    scan_files.scan(tmp_path / "flat.nc", np.zeros((32, 32)))
    for name, expected in cases.items():
        message = refusal(predict, predict_arguments([str(tmp_path / name)]))
        assert_says(message, name, expected)
        assert len(message.splitlines()) == 1, message
    both = refusal(own_spectrum, [scan, tmp_path / "none.csv"])
    assert_says(both, "none.csv: expected one table, or scans alone")
