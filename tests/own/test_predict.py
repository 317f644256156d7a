"""`hardcontact predict` evaluates the closed form for tables and scans, and names their faults."""

import csv
import json
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import scan_files
from known_spectra import contact_of_area, rough
from measurements import PIXEL, line_of, map_of, measurement, self_affine_heights
from refusals import assert_says, refusal

import hardcontact as hc
from hardcontact.base.random import generator
from hardcontact.contact.smooth_sphere import PAPER_MODULUS, assumed_modulus
from hardcontact.own import request
from hardcontact.own.own_spectrum import own_spectrum, table_spectrum
from hardcontact.own.predict import predict, predict_arguments
from hardcontact.surfaces.extrapolated_spectrum import extrapolate_short_waves, fit_hurst_exponent
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.measured_spectrum import CALIBRATION_SCATTER, isotropic_from_profile
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, smooth_rolloff, spectrum_of_dataset
from hardcontact.theory.closed_form import closed_form, edges
from hardcontact.theory.prediction import trim_spectrum
from hardcontact.theory.validity import nearest_errors, table_coordinates

HEADER = "wavelength,wavelength_unit,c_iso,c_iso_unit"
BY_WAVEVECTOR = "wavevector,wavevector_unit,c_iso,c_iso_unit"
#: The paper's contact, in closed form.
CONTACT = contact_of_area(250e3, 5.6, 0.0463, 400.0)


@pytest.fixture(autouse=True)
def few_cutoffs(monkeypatch):
    """Search edges between a few cutoffs, in a third of the time."""
    monkeypatch.setattr("hardcontact.theory.closed_form.CUTOFFS", 20)


@pytest.fixture
def table(tmp_path):
    """Write lines as a table; return its path."""

    def written(*lines):
        path = tmp_path / "my.csv"
        path.write_text("\n".join(lines) + "\n", "utf-8")
        return str(path)

    return written


def rows_of(spectrum):
    """Return a spectrum as a header and rows of a table in other units."""
    has_roughness = spectrum.density > 0
    columns = (
        spectrum.wavevector[has_roughness].tolist(),
        spectrum.density[has_roughness].tolist(),
    )
    rows = zip(*columns, strict=True)
    return [BY_WAVEVECTOR, *(f"{q * 1000!r},rad/um,{c * 1e-36!r},m^4" for q, c in rows)]


def printed(*arguments):
    return predict(predict_arguments(arguments))


def rolled_off(wavevector):
    """C_iso of a self-affine surface with a roll-off at 1 µm."""
    return smooth_rolloff(wavevector, 1e6, 1000.0, 0.8)


def numbers_of(*arguments):
    """Return the JSON output of the command."""
    return json.loads(printed(*arguments, "--json", "-"))


# Tables


def test_a_table_may_have_any_units_order_and_zeros(table):
    rows = [
        "1,um,2e-30,m4", "500,nm,1e6,nm4", "100,nm,5e4,nm⁴", "0.01,µm,3,nm4", "50,nm,1e4,nm^4",
        "5,nm,0,nm4",
    ]  # fmt: skip
    spectrum = table_spectrum(table(HEADER, *rows))
    assert 2 * np.pi / spectrum.wavevector == pytest.approx([1000, 500, 100, 50, 10, 5])
    assert spectrum.density == pytest.approx([2e6, 1e6, 5e4, 1e4, 3, 0])
    assert spectrum(2 * np.pi / np.array([5, 3])) == pytest.approx(0, abs=1e-90)
    wavevector = np.geomspace(0.01, 1, 9)
    profile = 1e-2 * wavevector**-2.6
    rows = [f"{q:.17g},rad/nm,{c:.17g},nm3" for q, c in zip(wavevector, profile, strict=True)]
    spectrum = table_spectrum(table("wavevector,wavevector_unit,c_1d,c_1d_unit", *rows))
    isotropic_density = isotropic_from_profile(wavevector, profile, np.full(9, 20.0))
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


def test_each_fault_of_a_spectrum_table_has_its_line(table):
    for lines, message_parts in FAULTY:
        assert_says(refusal(printed, table(*lines)), *message_parts)


def test_faulty_options_are_reported_with_the_faults_of_the_table(tmp_path):
    missing_file = str(tmp_path / "none.csv")
    for options, message_parts in (
        (["--range", "5", "--work", "1 nm"], ["--range", "--work"]),
        # A contact wider than the attraction of a smooth sphere.
        (["--preload", "10mN", "--hardness", "100MPa"], ["--preload: expected less than 880 µN"]),
        # Both are suspected: the hardness was meant to be in GPa.
        (["--hardness", "25kPa"], ["like a smooth sphere; --hardness 25kPa: is the unit right?"]),
        (
            ["--json", "-", "--csv", "-"],
            ["--csv: expected another file"],
        ),
        (["--json", str(tmp_path / "new/x.json")], ["--json: expected a file in a folder"]),
    ):
        message = refusal(printed, missing_file, *options)
        assert_says(message, "none.csv", "found no file", *message_parts)
        assert len(message.splitlines()) == 1 + len(message_parts)
    assert not any(tmp_path.iterdir())


def test_nothing_is_replaced_unasked(table, tmp_path):
    path = table(*rows_of(rough(17, 1000, 0.8, 20)))
    numbers = tmp_path / "numbers.json"
    numbers.write_text("{}")
    assert_says(refusal(printed, path, "--json", path, "--overwrite"), "than that of the surface")
    assert_says(refusal(printed, path, "--json", str(numbers)), "new file", "add --overwrite")
    assert numbers.read_text() == "{}"
    printed(path, "--json", str(numbers), "--overwrite")
    assert "pull_off_force" in json.loads(numbers.read_text())
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with ThreadPoolExecutor() as reader:
        text = reader.submit(pipe.read_text)
        printed(path, "--csv", str(pipe))
        assert text.result(timeout=10).startswith("quantity,") and pipe.is_fifo()


# Numbers


def test_every_format_has_the_numbers_of_the_closed_form(table, tmp_path):
    spectrum = rough(17, 1000, 0.8, 20)
    rows = tmp_path / "numbers.csv"
    options = ["--range", "8nm", "--work", "50 mJ/m2", "--csv", str(rows)]
    numbers = numbers_of(table(*rows_of(spectrum)), *options)
    contact = contact_of_area(250e3, 8.0, 0.05, 400.0)
    prediction = closed_form(spectrum, contact)
    force = numbers["pull_off_force"]
    assert force["value"] == pytest.approx(prediction.force, rel=1e-6)
    assert force["unit"] == "N" and force["status"] == "inside"
    coordinates = table_coordinates(trim_spectrum(spectrum), contact, prediction)
    force_interval = prediction.force * np.array(nearest_errors(coordinates, "force"))
    assert force["interval"] == pytest.approx(force_interval, rel=1e-5)
    for name, edge in zip(("short_edge", "long_edge"), edges(spectrum, contact, 0.1), strict=True):
        assert numbers[name]["value"] == pytest.approx(edge)
        assert numbers[name]["interval"][0] < edge
    with rows.open(newline="") as file:
        table_rows = {row["quantity"]: row for row in csv.DictReader(file)}
    assert list(table_rows) == list(numbers)
    for name, number in numbers.items():
        assert float(table_rows[name]["value"]) == number["value"]
        assert table_rows[name]["unit"] == number["unit"]
    words = printed(table(*rows_of(spectrum)), *options[:4])
    assert_says(words, f"closed form, for the spectrum: {round(1e9 * prediction.force, -1):g} nN")
    assert len(words.splitlines()) <= 5


def test_unknown_quantities_have_a_status_and_no_number(table):
    """An almost smooth surface has no edge; the prediction reports where its error is unknown."""
    numbers = numbers_of(table(*rows_of(rough(0.02, 1000, 0.8, 20))), "--radius", "5um")
    assert numbers["short_edge"] == {"value": None, "unit": "nm", "status": "none"}
    assert numbers["freezing"]["status"] == "smooth"
    assert numbers["pull_off_force"]["status"] == "outside"
    assert "interval" not in numbers["pull_off_force"]


def test_short_waves_missing_from_the_table_are_extrapolated(table):
    """The missing waves of an optical spectrum change the force, unless the table ends with 0."""
    rows = rows_of(rough(17, 4000, 0.8, 1500))
    numbers, spectrum = numbers_of(table(*rows)), table_spectrum(table(*rows))
    variance = np.full(spectrum.density.shape, CALIBRATION_SCATTER**2)
    fit = fit_hurst_exponent(spectrum.wavevector, spectrum.density, variance)
    density, _ = extrapolate_short_waves(spectrum.wavevector, spectrum.density, fit)
    extrapolated_force = closed_form(Spectrum(WAVEVECTORS, density), CONTACT).force
    assert numbers["extrapolated_force"]["value"] == pytest.approx(extrapolated_force, rel=1e-6)
    assert numbers["extrapolated_change"]["status"] == "matters"
    for ended in ([*rows, "1,rad/nm,0,nm4"], rows_of(rough(17, 1000, 0.8, 0.1))):
        numbers = numbers_of(table(*ended))
        assert "extrapolated_force" not in numbers
        assert numbers["extrapolated_change"]["status"] == "negligible"


def remove_bins(spectrum, kept_bins):
    """Return a spectrum without some of its wavelengths."""
    return Spectrum(spectrum.wavevector[kept_bins], spectrum.density[kept_bins])


KNOWN, SMOOTHER = rough(17, 1000, 0.8, 20), rough(17, 300, 0.8, 20)
GAP = np.abs(np.log(KNOWN.wavevector * 200 / 2 / np.pi)) > np.log(2.5)
LONG = rough(60, 2e4, 0.8, 20)  # it rolls off beyond 3 um
SHORT = 2 * np.pi / np.array([100.0, 90, 80, 70, 60])


@pytest.mark.parametrize(
    ("spectrum", "options", "cause"),
    [
        (SMOOTHER, ["--range", "0.3nm"], "not at 0.3 nm"),
        (SMOOTHER, ["--radius", "1um", "--preload", "100nN"], "not at 1 µm"),
        (SMOOTHER, ["--preload", "500uN"], "contact area over the roll-off"),
        (remove_bins(LONG, LONG.wavevector > 2 * np.pi / 3000), [], "take care: waves longer than"),
        (Spectrum(SHORT, 1e-4 * (2 * np.pi / SHORT) ** 4), [], "waves longer than 100 nm"),
        (remove_bins(KNOWN, GAP), [], "a factor of 6.3 apart"),
    ],
)
def test_an_unknown_error_has_a_stated_cause(table, spectrum, options, cause):
    report = printed(table(*rows_of(spectrum)), *options, "--work", "25 N/m", "--verbose")
    assert_says(report, "error is not known", cause)
    # The work scales the force alone.
    assert_says(report, "take care: --work 25 N/m: is the unit right? 0.1 mJ/m2 to 10.6 J/m2 are")


@pytest.mark.parametrize(
    ("name", "usual", "questioned"),
    [
        ("radius", ["1um", "25mm"], ["250nm", "250mm"]),
        ("hardness", ["5MPa", "120GPa"], ["0.9MPa", "0.25TPa"]),
        ("preload", ["1nN", "1mN"], ["10pN", "10.1mN"]),
        ("range", ["0.3nm", "22nm"], ["0.15nm", "56nm"]),
        ("work", ["1mJ/m2", "900mJ/m2"], ["46uJ/m2", "46.3J/m2"]),
    ],
)
def test_implausible_quantities_are_questioned(name, usual, questioned):
    for texts, count in ((usual, 0), (questioned, 1)):
        for text in texts:
            quantities, faults = request.parse_quantities(
                predict_arguments(["a.csv", f"--{name}", text])
            )
            lines = list(request.implausible_quantities(quantities))
            assert not faults and len(lines) == count, lines
            assert all(line.startswith(f"--{name} {text}: is the unit right?") for line in lines)


def test_a_compliant_sphere_has_a_large_tabor_parameter(table):
    """A smooth sphere has the Tabor parameter (R W²/(E*² rho³))^(1/3)."""
    path = table(*rows_of(rough(17, 1000, 0.8, 20)))
    hard, soft = (numbers_of(path, "--modulus", modulus) for modulus in ("290GPa", "1MPa"))
    number = (250e-6 * 0.0463**2 / (1e6**2 * 5.6e-9**3)) ** (1 / 3)
    assert soft["tabor_parameter"]["value"] == pytest.approx(number, rel=1e-3)
    assert soft["tabor_parameter"]["status"] == "soft"
    assert hard["tabor_parameter"].get("status", "") != "soft"


def test_the_modulus_of_soft_bodies_is_not_taken_from_the_paper(table):
    path = table(*rows_of(rough(17, 1000, 0.8, 20)))
    assert_says(printed(path, "--hardness", "1GPa"), "may be too soft", "--modulus tells")
    assert assumed_modulus(5e9) == PAPER_MODULUS and np.isnan(assumed_modulus(1e9))


# Scans


def test_a_profile_under_headings_is_a_scan(tmp_path):
    path = tmp_path / "profile.csv"
    positions, heights = np.arange(1024) * 5e-4, line_of(generator(3), 1024, PIXEL).heights
    headings = "x [mm],z [nm]"
    np.savetxt(
        path, np.column_stack([positions, heights]), delimiter=",", header=headings, comments=""
    )
    (scan_note,) = own_spectrum([path], unit="mm,nm").notes
    assert_says(scan_note, "reliable from 2 µm (4 pixels)")
    # The range of the spectrum differs from that of the scan, and says why.
    assert_says(
        printed(str(path), "--unit", "mm,nm", "--verbose"),
        "spectrum used: 2.24 µm to 89.1 µm (the bins, ten a decade, with centres at reliable",
    )


@pytest.mark.parametrize("kind", ["map", "line"])
def test_a_scan_is_predicted_from_its_reliable_wavelengths(kind, tmp_path, capsys):
    make, points = (map_of, 128) if kind == "map" else (line_of, 1024)
    heights = make(generator(3), points, PIXEL).heights
    path, size = tmp_path / ("scan.nc" if kind == "map" else "scan.xyz"), points * PIXEL
    if kind == "map":
        scan_files.scan(path, heights.T, (size, size))
    else:
        scan_files.write_coordinates(scan_files.line(heights, size), path)
    joined_scans = joined_spectrum([measurement(heights, PIXEL)], [None])
    spectrum = own_spectrum([path]).spectrum
    has_roughness = np.isfinite(joined_scans.joined_psd.values)
    assert spectrum.density == pytest.approx(
        joined_scans.joined_psd.values[has_roughness], rel=1e-4
    )
    assert 2 * np.pi / spectrum.wavevector[-1] >= 4 * PIXEL
    numbers = numbers_of(str(path))
    assert f"{path}: reliable from" in capsys.readouterr().err
    force = closed_form(spectrum, CONTACT).force
    assert numbers["pull_off_force"]["value"] == pytest.approx(force)
    # It is extrapolated like the masters of the study, up to a roll-off beyond the scan.
    force = closed_form(spectrum_of_dataset(joined_scans), CONTACT).force
    assert numbers["extrapolated_force"]["value"] == pytest.approx(force, rel=1e-3)
    rolloff = joined_scans.attrs["rolloff"]
    assert numbers["extrapolated_rolloff"]["value"] == pytest.approx(rolloff, rel=1e-3)


def test_the_force_on_pillars_is_not_predicted(tmp_path):
    """Gaussian heights of their spectrum give a hundredth of the sum over the pixels."""
    y, x = np.indices((128, 128)) % 32 - 15.5
    heights = 200.0 * (np.hypot(x, y) < 8) + generator(1).normal(0, 0.3, x.shape)
    path = scan_files.scan(tmp_path / "pillars.nc", heights, (5120.0, 5120.0))
    report = printed(str(path), "--json", str(tmp_path / "numbers.json"))
    assert_says(
        report, "closed form: no number: the heights are not those of an isotropic Gaussian"
    )
    assert "edge:" not in report and "error was measured" not in report
    numbers = json.loads((tmp_path / "numbers.json").read_text())
    assert numbers["pull_off_force"] == {"value": None, "unit": "N", "status": "steep_edges"}
    smooth = 2 * np.pi * 250e-6 * 0.0463
    assert numbers["smooth_force"]["value"] == pytest.approx(smooth, rel=0.01)
    assert "short_edge" not in numbers and "extrapolated_force" not in numbers


def test_a_defect_is_a_caution_and_levelling_is_an_option(tmp_path):
    heights = self_affine_heights(generator(1), 128, 40.0, 8.0)
    y, x = np.indices(heights.shape) - 64
    path, size = tmp_path / "a.nc", (5120.0, 5120.0)

    def report(heights, *options):
        return printed(str(scan_files.scan(path, heights.T, size)), *options)

    assert f"take care: {path}" not in report(heights)
    clipped = np.minimum(heights, np.quantile(heights, 0.9))
    assert_says(report(clipped), f"take care: {path}: 10 % of its pixels have the highest value")
    bowed = heights - (x**2 + y**2 / 2) * 0.02
    assert "curvature" in report(bowed)
    assert "curvature" not in report(bowed, "--levelling", "quadratic")


@pytest.mark.parametrize("sign", [1, -1])
def test_heights_that_are_not_gaussian_are_a_caution_without_a_known_error(tmp_path, sign):
    """The sum over pixels is less than half the closed form on bumps, above twice it on pores."""
    base, second_map = (map_of(generator(seed), 128, 40.0, rolled_off).heights for seed in (3, 4))
    base, second_map = 4 * base / base.std(), second_map / second_map.std()
    heights = base + sign * 10 * np.maximum(second_map - 0.3, 0) ** 2
    contact = {"radius": 250e3, "preload": 10e-6, "hardness": 25e9}
    forces = hc.pull_off_forces(
        hc.HeightMap(heights, 40.0), ranges=[5.6], work=0.0463, count=6, **contact
    )
    summed = forces.pull_off_force.sel(contact_model="plastic").mean().item()
    path = scan_files.scan(tmp_path / "skewed.nc", heights.T, (5120.0, 5120.0))
    numbers = numbers_of(str(path))
    predicted = numbers["pull_off_force"]
    assert (summed / predicted["value"]) ** sign < 0.5
    assert predicted["status"] == "outside" and numbers["skewness"]["value"] * sign > 1
    assert_says(printed(str(path), "--verbose"), "take care: heights have a skewness of")
    scan_files.scan(path, base.T, (5120.0, 5120.0))
    assert "skewness" not in printed(str(path), "--verbose")


def test_a_csv_of_heights_is_read_as_a_scan(tmp_path):
    heights = map_of(generator(3), 64, 10.0).heights
    scan_files.scan(tmp_path / "scan.nc", heights.T, (640.0, 640.0))
    np.savetxt(tmp_path / "scan.csv", heights, delimiter=",")
    spectra = [own_spectrum([tmp_path / "scan.nc"])]
    spectra.append(own_spectrum([tmp_path / "scan.csv"], unit="nm", map_size=640.0))
    assert spectra[1].spectrum.density == pytest.approx(spectra[0].spectrum.density)


def test_members_of_a_container_are_joined_or_chosen(tmp_path):
    files = {}
    for number in (1, 2):
        heights, path = map_of(generator(number), 64, 10.0).heights, tmp_path / f"{number}.nc"
        files[path.name] = scan_files.scan(path, heights, (640.0, 640.0))
    members = [{"name": f"scan {file}", "datafile": {"original": file}} for file in files]
    path = scan_files.container(tmp_path / "twin.zip", members, files)
    joined_members, second_member = own_spectrum([path]), own_spectrum([path], dataset="scan 2.nc")
    densities = [own_spectrum([file]).spectrum.density for file in files.values()]
    assert second_member.spectrum.density == pytest.approx(densities[1])
    assert joined_members.spectrum.density == pytest.approx(
        np.sqrt(densities[0] * densities[1]), rel=0.05
    )


def test_files_without_a_spectrum_are_refused_in_one_line(tmp_path):
    scan_files.scan(tmp_path / "flat.nc", np.zeros((32, 32)))
    message = refusal(printed, str(tmp_path / "flat.nc"))
    assert_says(message, "flat.nc", "expected a rough surface, found constant height")
    # Pixels of 50 µm: no wavelength of the spectrum is known, in a line scan or a map.
    rng = np.random.default_rng(3)
    positions = 50.0 * np.arange(64)
    np.savetxt(tmp_path / "line.txt", np.column_stack([positions, rng.normal(0, 0.05, 64)]))
    scan_files.scan(tmp_path / "map.nc", rng.normal(0, 50, (64, 64)), (3.2e6, 3.2e6))
    for name in ("line.txt", "map.nc"):
        message = refusal(printed, str(tmp_path / name), "--unit", "um")
        assert_says(message, "from 0.1 nm to 100 µm", "found 0", f"{name} from 200 µm (4 pixels)")
        assert message.endswith("is the unit of length right?")
        assert len(message.splitlines()) == 1, message
    message = refusal(own_spectrum, [tmp_path / "flat.nc", tmp_path / "none.csv"])
    assert_says(message, "none.csv: expected one table, or scans alone")
