"""The functions for programs give direct sums and the numbers of the command; examples run."""

import ast
import doctest
import inspect
import json
import re
import subprocess
import sys
from dataclasses import replace
from functools import partial

import matplotlib
import numpy as np
import pytest
import scan_files
import xarray as xr
from direct_sum import direct_force, gap_to_sphere, mirror
from known_spectra import self_affine_spectrum
from measurements import random_map
from prediction_command import predict_json
from refusals import assert_says, refusal
from repository import ROOT
from SurfaceTopography import Topography

import hardcontact as hc
from hardcontact import api
from hardcontact.base.arrays import generator
from hardcontact.surfaces.spectral_models import smooth_rolloff

DOCS = ROOT / "resources/docs"
FUNCTIONS = [name for name in hc.API if inspect.isfunction(getattr(hc, name))]
PIXEL_SIZE = 10.0  # nm
LOAD = {"preload": 10e-6, "hardness": 25e9}
ARRAY = {"window": 1600.0, "contacts_per_row": 3}
SPHERE = {"radius": 50e3}


@pytest.fixture
def files(tmp_path, monkeypatch, quick_predictions):
    """Work in a folder with a scan and a table of a spectrum."""
    monkeypatch.chdir(tmp_path)
    heights = random_map(generator(3), 128, PIXEL_SIZE).heights / 4
    scan_files.write_scan(tmp_path / "scan.nc", heights.T, (1280.0, 1280.0))
    spectrum = self_affine_spectrum(rms=17)
    rows = ["wavevector,wavevector_unit,c_iso,c_iso_unit"]
    rows += [
        f"{q!r},rad/nm,{c!r},nm4"
        for q, c in zip(spectrum.wavevector.tolist(), spectrum.density.tolist(), strict=True)
    ]
    (tmp_path / "my-psd.csv").write_text("\n".join(rows))
    return tmp_path


def test_the_library_lists_its_names_and_loads_them_when_they_are_used():
    assert set(hc.API) <= set(dir(hc)) & set(dir(api)) and len(FUNCTIONS) <= 10
    assert hc.__version__ in (ROOT / "pyproject.toml").read_text()
    assert "api" not in hc.API and not hasattr(hc, "read")
    program = "import sys, hardcontact; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    names = {name for name in run.stdout.split() if name.startswith(("hardcontact", "numpy"))}
    assert names == {"hardcontact"}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_example_of_every_function_runs(name, files):
    names = {"hc": hc, "np": np}
    examples = doctest.DocTestParser().get_examples(inspect.getdoc(getattr(hc, name)))
    assert examples
    for example in examples:
        exec(example.source, names)


def test_roughness_that_is_neither_a_map_nor_a_spectrum_is_refused_in_one_line(files):
    scan = hc.read_scan("scan.nc")
    assert_says(refusal(hc.read_spectrum, ["scan.nc"]), "expected a path", "['scan.nc']")
    call = partial(hc.predict, rho=1, work=1, **SPHERE, **LOAD)
    assert_says(refusal(call, scan.heights), "hc.read_spectrum(FILE)", "hc.read_scan", "ndarray")
    undefined = np.where(scan.heights == scan.heights.max(), np.nan, scan.heights)
    for heights, found in (
        (scan.heights[1:], "127 x 128 pixels"),
        (undefined, "1 undefined heights"),
        (scan.heights.tolist(), "list"),
    ):
        message = refusal(call, replace(scan, heights=heights))
        assert_says(message, "expected a square map of finite heights", f"found {found}")


@pytest.mark.study
def test_the_page_runs_in_order_and_shows_what_it_prints(files, monkeypatch, capsys):
    monkeypatch.undo()  # The page has predictions at full effort.
    monkeypatch.chdir(files)
    (files / "resources").symlink_to(ROOT / "resources")
    page = (DOCS / "api.md").read_text("utf-8")
    functions_table = page.split("\n## ")[0]
    assert sorted(re.findall(r"^\| `(\w+)` \|", functions_table, re.M)) == FUNCTIONS
    names = {}
    for block in re.findall(r"^```python\n(.*?)^```", page, re.M | re.S):
        exec(block, names)
        shown = re.findall("^# (.*)$", block, re.M)
        assert capsys.readouterr().out.splitlines() == shown


@pytest.mark.study
def test_the_notebook_shows_what_its_cells_return(monkeypatch, capsys):
    """The texts match the current code, and the figures exist."""
    matplotlib.use("agg")
    monkeypatch.chdir(DOCS)
    cells = json.loads((DOCS / "example.ipynb").read_text("utf-8"))["cells"]
    names = {}
    for cell in (cell for cell in cells if cell["cell_type"] == "code"):
        source = "".join(cell["source"])
        *statements, last_statement = ast.parse(source).body
        exec(compile(ast.Module(statements, []), "cell", "exec"), names)
        value = eval(ast.unparse(last_statement), names)
        printed = capsys.readouterr().out
        if value is not None and not source.endswith(";"):
            printed += repr(value)
        documented, figures = "", 0
        for output in cell["outputs"]:
            content = output.get("data", {"text/plain": output.get("text")})
            figures += "image/png" in content
            if "image/png" not in content:
                documented += "".join(content["text/plain"])
        assert "".join(documented.split()) == "".join(printed.split()), source
        assert figures == source.endswith(";")
    matplotlib.pyplot.close("all")


def test_forces_are_the_direct_sum_over_every_pixel(files):
    scan, work, rho = hc.read_scan("scan.nc"), 0.05, 5.6
    forces = hc.pull_off_forces(scan, rho=[2.0, rho], work=work, **SPHERE, **LOAD, **ARRAY)
    pixels, window = 256, 160  # of the mirrored scan and of the window of ARRAY
    mirrored = mirror(scan.heights)
    positions = np.floor((np.arange(3) + 0.25) * pixels / 3).astype(int)
    for i, j in np.ndindex(3, 3):
        gap = gap_to_sphere(mirrored, positions[[i, j]], window, PIXEL_SIZE, SPHERE["radius"])
        # The preload over the hardness is 400 nm², four pixels.
        for model, count in (("rigid", 1), ("plastic", 4)):
            direct_sum = direct_force(gap, count, rho, PIXEL_SIZE, work)
            force = forces.pull_off_force.sel(contact_model=model, rho=rho)[i, j].item()
            assert force == pytest.approx(direct_sum, rel=1e-6)
    assert forces.pull_off_force.units == "N" and forces.work_of_adhesion == work


def test_a_periodic_map_gives_the_forces_of_its_scan_but_no_patches(files):
    scan = hc.read_scan("scan.nc")
    forces_at = partial(hc.pull_off_forces, rho=5.6, work=0.05, **SPHERE, **LOAD, **ARRAY)
    scan_forces = forces_at(scan)
    periodic_map = replace(scan, heights=mirror(scan.heights), periodic=True)
    xr.testing.assert_allclose(forces_at(periodic_map), scan_forces.drop_vars("touched_patches"))


@pytest.mark.parametrize("rho", [np.int64(5), np.float64(5), np.float32(5)])
def test_a_range_may_be_a_scalar_of_numpy(rho, files):
    scan = hc.read_scan("scan.nc")
    forces_at = partial(hc.pull_off_forces, scan, work=0.05, **SPHERE, **LOAD, **ARRAY)
    xr.testing.assert_identical(forces_at(rho=rho), forces_at(rho=5.0))


def test_plots_show_the_heights_and_densities(files):
    matplotlib.use("agg")
    scan, spectrum = hc.read_scan("scan.nc"), hc.read_spectrum("scan.nc")
    axes = scan.plot()
    np.testing.assert_array_equal(axes.images[0].get_array(), scan.heights)
    assert axes.get_xlim() == (0, 1.28) and axes.images[0].origin == "lower"
    (line,) = spectrum.plot(matplotlib.pyplot.subplots()[1]).lines
    np.testing.assert_allclose(2 * np.pi / line.get_xdata(), spectrum.wavevector)
    np.testing.assert_array_equal(line.get_ydata(), spectrum.density)
    matplotlib.pyplot.close("all")


def test_a_topography_is_prepared_like_its_file(files):
    from SurfaceTopography import UniformLineScan, open_topography

    topography = open_topography("scan.nc").topography()
    file_scan, object_scan = hc.read_scan("scan.nc"), hc.from_topography(topography)
    np.testing.assert_array_equal(object_scan.heights, file_scan.heights)
    assert object_scan.pixel_size == file_scan.pixel_size
    metres = Topography(1e-9 * topography.heights(), (1.28e-6, 1.28e-6), unit="m")
    np.testing.assert_allclose(hc.from_topography(metres).heights, file_scan.heights, atol=1e-4)
    for faulty_topography, message_parts in {
        Topography(topography.heights(), (1.0, 1.0)): ["a map of SurfaceTopography with a unit"],
        UniformLineScan(np.arange(64.0), 1.0, unit="nm"): ["found UniformLineScan"],
        Topography(np.zeros((4, 4)), (1.0, 1.0), unit="V"): ["a unit of length, found 'V'"],
    }.items():
        assert_says(
            refusal(hc.from_topography, faulty_topography), "topography: expected", *message_parts
        )


def test_a_scan_and_its_spectrum_are_predicted_like_the_file(files):
    """Measured and extrapolated spectra give the numbers, intervals and statuses of the command."""
    contact = {"radius": 250e3, "rho": 5.6, "work": 0.0463} | LOAD
    wide = random_map(
        generator(3), 256, 40.0, partial(smooth_rolloff, plateau=3e5, rolloff=1000.0, hurst=0.8)
    )
    path = scan_files.write_scan(files / "wide.nc", wide.heights.T, (10240.0, 10240.0))
    command_numbers = predict_json(str(path))
    numbers_of_scan = hc.predict(hc.read_scan(path), **contact)
    measured_numbers = hc.predict(hc.read_spectrum(path), **contact)
    extrapolated_numbers = hc.predict(hc.read_spectrum(path, extrapolated=True), **contact)
    for prefix, numbers in {"": measured_numbers, "extrapolated_": extrapolated_numbers}.items():
        for name in ("closed_form_force", "short_edge", "long_edge"):
            number = numbers[name]
            is_force = prefix and name == "closed_form_force"
            command_number = command_numbers["extrapolated_force" if is_force else prefix + name]
            assert number.value == pytest.approx(command_number["value"])
            assert number.status == command_number["status"]
            assert np.isfinite(number.low) == ("interval" in command_number)
    assert extrapolated_numbers["closed_form_force"].status == "inside"
    reliable_force = extrapolated_numbers["reliable_force"]
    assert reliable_force.value == measured_numbers["closed_form_force"].value
    assert reliable_force.status == "inside"
    for name in ("closed_form_force", "extrapolated_force", "short_edge"):
        assert numbers_of_scan[name].value == pytest.approx(
            command_numbers[name]["value"], rel=1e-4
        )


def test_an_extrapolated_force_without_a_known_error_has_a_reason(files):
    """Waves that a scan lacks matter; the extrapolated spectrum alone passes all checks."""
    density = partial(smooth_rolloff, plateau=3e5, rolloff=1000.0, hurst=0.8)
    scan = random_map(generator(3), 128, 20.0, density)
    path = scan_files.write_scan(files / "narrow.nc", scan.heights.T, (2560.0, 2560.0))
    contact = {"radius": 250e3, "rho": 5.6, "work": 0.0463} | LOAD
    numbers = hc.predict(hc.read_spectrum(path, extrapolated=True), **contact)
    assert numbers["closed_form_force"].status == numbers["reliable_force"].status == "outside"
    assert numbers["longest_octave_change"].status == "negligible"
    reliable_numbers = hc.predict(hc.read_spectrum(path), **contact)
    assert reliable_numbers["longest_octave_change"].status == "matters"


def test_unusual_quantities_are_questioned(files):
    """A hardness of 25 kPa was meant to be 25 GPa."""
    scan, contact = hc.read_scan("scan.nc"), SPHERE | {"preload": 1e-9, "hardness": 25e3}
    with pytest.warns(UserWarning, match="^hardness 25000 Pa: is the unit right?"):
        hc.predict(scan, rho=5.6, work=0.05, **contact)
    with pytest.warns(UserWarning, match="^hardness 25000 Pa: is the unit right?"):
        hc.pull_off_forces(scan, rho=5.6, work=0.05, **contact, **ARRAY)
    with pytest.warns(UserWarning, match="^rho 56 nm: is the unit right?"):
        hc.force_ratios(scan, {"short": [50, 100]}, rho=56.0, **SPHERE, **LOAD, **ARRAY)


def test_the_spectrum_warns_of_filled_pixels_and_of_cautions(files):
    heights = random_map(generator(3), 128, PIXEL_SIZE).heights / 4
    heights[60, 60] += 200.0  # a spike
    heights[3, 4:6] = np.nan
    np.savetxt("holed.txt", heights)
    with pytest.warns(UserWarning) as caught:
        hc.read_spectrum("holed.txt", unit="nm", map_size=1280.0)
    messages = [str(warning.message) for warning in caught]
    assert "holed.txt: 2 undefined pixels filled" in messages and len(messages) == 2
    assert_says(messages[0], "holed.txt: ", "of its pixels are spikes")
    assert {warning.filename for warning in caught} == {__file__}
    scan = hc.read_scan("holed.txt", unit="nm", map_size=1280.0, undefined_pixels="harmonic")
    with pytest.warns(UserWarning, match="^roughness: .* of its pixels are spikes") as caught:
        hc.predict(scan, rho=5.6, work=0.0463, **SPHERE, **LOAD)
    assert caught[0].filename == __file__


HOLED = np.ma.masked_greater(np.random.default_rng(1).normal(size=(32, 32)), 3)
MAP_WITH_HOLES = Topography(HOLED, (320, 320), unit="nm")
#: Function, faulty values among valid arguments, and parts of the refusal.
FAULTY = [
    (hc.pull_off_forces, {"radius": -1.0}, ["radius: expected a positive number, found -1.0"]),
    (hc.pull_off_forces, {"work": np.nan}, ["work: expected a positive number, found nan"]),
    (hc.pull_off_forces, {"rho": []}, ["rho: expected several numbers, found []"]),
    (hc.pull_off_forces, {"rho": ["5.6 nm"]}, ["rho: expected a positive", "'5.6 nm'"]),
    (hc.pull_off_forces, {"rho": [1e-4]}, ["rho: expected at least", "found 0.0001 nm"]),
    (hc.pull_off_forces, {"contacts_per_row": 3.5}, ["expected a whole number, found 3.5"]),
    (hc.pull_off_forces, {"contacts_per_row": 999}, ["at most the 256 pixels", "found 999"]),
    (hc.pull_off_forces, {"scan": np.zeros((64, 64))}, ["scan: expected a scan of hc.read_scan"]),
    (hc.pull_off_forces, {"scan": hc.HeightMap(np.zeros((64, 64)), 3e7)},
     ["a pixel_size of 0.05 to 10000 nm, found 3e+07 nm: is the unit right?"]),
    (hc.pull_off_forces, {"scan": hc.HeightMap(np.zeros((16, 32)), PIXEL_SIZE)},
     ["scan: expected a square map", "16 x 32 pixels"]),
    (hc.pull_off_forces, {"sphere": "sphere.nc"}, ["sphere: expected a scan of hc.read_scan"]),
    (hc.pull_off_forces, {"preload": 9e-4, "hardness": 5e8}, ["at most", "found 900 µN"]),
    (hc.pull_off_forces, {"hardness": 25}, ["1 kPa to 10000 GPa, found 25 Pa: is the unit right?"]),
    (hc.force_ratios, {"cutoffs": {"short": [20.0]}}, ["found [20.0]"]),
    (hc.force_ratios, {"cutoffs": {"small": [20.0]}}, ["short, long or both"]),
    (hc.force_ratios, {"cutoffs": {"short": 20.0}}, ["several numbers, found 20.0"]),
    (hc.predict, {"roughness": hc.Spectrum(np.array([1.0, 2.0]), np.array([1.0, np.nan]))},
     ["spectrum: expected growing wavevectors"]),
    (hc.force_ratios, {"cutoffs": {"short": [50.0]}, "tolerance": 5.0},
     ["tolerance: expected less than 1, found 5"]),
    (hc.predict, {"tolerance": 1}, ["tolerance: expected less than 1, found 1"]),
    (hc.predict, {"hardness": 1e6}, ["preload: expected less than"]),
    (hc.read_spectrum, {}, ["files: expected a table of a spectrum or scans"]),
    (hc.read_scan, {"path": "none.nc"}, ["none.nc: expected a scan, found no such file"]),
    (hc.read_scan, {"path": np.zeros((9, 9))}, ["files: expected a path", "array"]),
    (hc.read_scan, {"unit": None}, ["unit: expected a text, found None"]),
    (hc.read_scan, {"map_size": "5 um"}, ["map_size: expected a positive number"]),
    (hc.read_scan, {"undefined_pixels": "fill"}, ["refuse or harmonic, found 'fill'"]),
    (hc.read_scan, {"levelling": "sphere"}, ["expected plane, lines"]),
    (hc.read_scan, {"path": "bare.txt"}, ["for example map_size=5000 gives", 'unit="nm"']),
    (hc.read_scan, {"path": "line.txt"}, ['by unit="nm", or mm,nm for']),
    (hc.from_topography, {"topography": MAP_WITH_HOLES, "undefined_pixels": "fill"},
     ["undefined_pixels: expected refuse or harmonic, found 'fill'"]),
    (hc.from_topography, {"topography": MAP_WITH_HOLES},
     ['; undefined_pixels="harmonic" fills them']),
]  # fmt: skip


@pytest.mark.filterwarnings("ignore:.*is the unit right")
def test_faulty_arguments_are_refused_in_one_line_in_the_words_of_python(files):
    """The commands make the same checks, but their messages name options and keys."""
    np.savetxt("bare.txt", HOLED.data)
    np.savetxt("line.txt", np.column_stack([np.arange(32), HOLED.data[0]]))
    contact, scan = SPHERE | LOAD, hc.read_scan("scan.nc")
    valid = {
        hc.pull_off_forces: {"scan": scan, "rho": [5.6], "work": 0.05} | contact | ARRAY,
        hc.force_ratios: {"scan": scan, "rho": 5.6} | contact | ARRAY,
        hc.predict: {"roughness": hc.read_spectrum("my-psd.csv"), "rho": 5.6, "work": 0.05}
        | contact,
        hc.read_scan: {"path": "scan.nc"},
    }
    for function, faulty_values, message_parts in FAULTY:
        arguments = valid.get(function, {}) | faulty_values
        message = refusal(partial(function, **arguments))
        assert_says(message, *message_parts)
        assert len(message.splitlines()) == 1 and "--" not in message and " key " not in message


def test_the_example_scan_is_reproduced_by_its_code(tmp_path, monkeypatch):
    folder = ROOT / "resources/examples"
    code = re.search(
        r"^```python\n(.*?)^```", (folder / "README.md").read_text("utf-8"), re.M | re.S
    )
    monkeypatch.chdir(tmp_path)
    exec(code[1], {})
    written, shipped = (np.loadtxt(path / "demo.txt") for path in (tmp_path, folder))
    np.testing.assert_allclose(written, shipped, atol=0.011)
    scan = hc.read_scan(folder / "demo.txt")
    assert (scan.pixels, scan.size) == (256, pytest.approx(5000)) and 9 < scan.heights.std() < 11
