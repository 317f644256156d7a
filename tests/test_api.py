"""What programs use: oracles, the same numbers as scripts and commands, and the examples of it."""

import doctest
import inspect
import json
import re
import runpy
import subprocess
import sys
from contextlib import nullcontext
from types import SimpleNamespace

import matplotlib
import numpy as np
import pytest
import scan_files
from direct_sum import direct_total
from known_spectra import rough
from measurements import map_of
from periodic_maps import height_map
from refusals import assert_says, refusal
from repository import ROOT

import hardcontact as hc
from hardcontact import api
from hardcontact.commands.predict import predict, predict_arguments
from hardcontact.contact.contact import Contact
from hardcontact.numbers.number import plain
from hardcontact.numbers.random import generator
from hardcontact.records import dataset
from hardcontact.records.origin import canonical
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum

DOCS = ROOT / "resources/docs"
FUNCTIONS = [name for name in hc.API if inspect.isfunction(getattr(hc, name))]
PIXEL = 10.0
LOAD = {"preload": 10e-6, "hardness": 25e9}
ARRAY = {"window": 1600.0, "count": 3}
SPHERE = {"radius": 50e3}


class Named(list):
    """Files or lists of them by name, and all by place, as Snakemake gives them."""

    def __init__(self, **files):
        super().__init__(np.hstack(list(files.values())).tolist())
        vars(self).update(files)

    def __getitem__(self, key):
        return vars(self)[key] if isinstance(key, str) else super().__getitem__(key)


@pytest.fixture
def files(tmp_path, monkeypatch):
    """Work in a folder with a scan and a table of a spectrum."""
    monkeypatch.chdir(tmp_path)
    heights = map_of(generator(3), 128, PIXEL).heights / 4
    scan_files.scan(tmp_path / "scan.nc", heights.T, (1280.0, 1280.0))
    spectrum = rough(17, 1000, 0.8, 20)
    rows = ["wavevector,wavevector_unit,c_iso,c_iso_unit"]
    rows += [
        f"{q!r},rad/nm,{c!r},nm4"
        for q, c in zip(spectrum.wavevector.tolist(), spectrum.density.tolist(), strict=True)
    ]
    (tmp_path / "my-psd.csv").write_text("\n".join(rows))
    return tmp_path


@pytest.fixture
def script(files, monkeypatch):
    """Run a script on files of the folder."""
    # A job that fails ends its process, which here is that of all tests.
    monkeypatch.setattr("hardcontact.records.job.job_log", lambda path: nullcontext())

    def run(name, parameters, inputs, **outputs):
        snakemake = SimpleNamespace(
            input=Named(**inputs),
            output=Named(**outputs),
            params=SimpleNamespace(canonical=canonical(parameters)),
            threads=1,
            log=["script.log"],
        )
        runpy.run_path(str(ROOT / f"workflow/scripts/{name}.py"), {"snakemake": snakemake})

    return run


def test_names_are_there_and_nothing_is_loaded_before_one_is_used():
    assert set(hc.API) <= set(dir(hc)) & set(dir(api)) and len(FUNCTIONS) <= 10
    assert "api" not in hc.API and not hasattr(hc, "read")
    program = (
        "import sys, hardcontact; print(*sys.modules); hardcontact.metrics; print(*sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    before, after = (set(line.split()) for line in run.stdout.splitlines())
    assert {name for name in before if name.startswith(("hardcontact", "numpy"))} == {"hardcontact"}
    assert "hardcontact.api" in after


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_example_of_every_function_runs(name, files):
    names = {"hc": hc, "np": np}
    text = inspect.getdoc(getattr(hc, name))
    examples = doctest.DocTestParser().get_examples(text)
    assert examples, name
    for example in examples:
        exec(example.source, names)


def test_the_page_of_examples_runs_in_order(files):
    page = (DOCS / "api.md").read_text("utf-8")
    assert len(page.splitlines()) <= 120
    assert sorted(re.findall(r"^\| `(\w+)` \|", page, re.M)) == FUNCTIONS
    names = {}
    for block in re.findall(r"^```python\n(.*?)^```", page, re.M | re.S):
        exec(block, names)
    assert names["force"].value > 0 and names["table"].density.max() > 0


def test_the_notebook_runs_and_holds_no_outputs(files):
    matplotlib.use("agg")
    cells = json.loads((DOCS / "example.ipynb").read_text("utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert 5 <= len(cells) <= 8 and not any(cell["outputs"] for cell in code)
    names = {}
    for cell in code:
        exec("".join(cell["source"]), names)
    assert names["numbers"]["pull_off_force"].value > 0
    names["plt"].close("all")


def test_metrics_of_a_wave_are_those_of_its_closed_form(tmp_path):
    amplitude, waves, pixels = 5.0, 8, 128
    wave = amplitude * np.cos(2 * np.pi * waves * (np.arange(pixels) + 0.5) / pixels)
    path = scan_files.scan(tmp_path / "wave.nc", np.tile(wave[:, None], pixels), (1280.0, 1280.0))
    scan = hc.read_scan(path)
    found, half = hc.metrics(scan), np.pi * waves / pixels
    assert found["rms_height"] == pytest.approx(amplitude / np.sqrt(2))
    assert found["peak_to_valley"] == pytest.approx(2 * wave.max())
    # Differences between neighbours are a wave of 2 sin(half) times the amplitude.
    gradient = amplitude * 2 * np.sin(half) / PIXEL / np.sqrt(2)
    assert found["rms_gradient"] == pytest.approx(gradient, rel=0.01)
    laplacian = amplitude * (2 * np.sin(half) / PIXEL) ** 2 / np.sqrt(2)
    assert found["rms_laplacian"] == pytest.approx(laplacian, rel=0.01)
    wavevector, _, isotropic = hc.measured_psds(scan)
    highest = wavevector[np.nanargmax(isotropic)]
    assert highest == pytest.approx(2 * np.pi * waves / 1280, rel=0.15)


def test_forces_are_the_direct_sum_over_every_pixel(files):
    scan, work, rho = hc.read_scan("scan.nc"), 0.05, 5.6
    forces = hc.pull_off_forces(scan, ranges=[2.0, rho], work=work, **SPHERE, **LOAD, **ARRAY)
    pixels, window = 256, 160
    mirrored = np.pad(scan.heights.astype(float), [(0, 128)] * 2, mode="symmetric")
    offset = np.arange(window) - window // 2
    sphere = (offset * PIXEL) ** 2 / (2 * SPHERE["radius"])
    places = np.floor((np.arange(3) + 0.25) * pixels / 3).astype(int)
    for i, j in np.ndindex(3, 3):
        y, x = places[i], places[j]
        seen = mirrored[np.ix_((y + offset) % pixels, (x + offset) % pixels)]
        gap = sphere[:, None] + sphere - seen
        for model, count in (("rigid", 1), ("plastic", Contact(radius=1.0, **LOAD).pixels(PIXEL))):
            expected = work / (rho * 1e-9) * (PIXEL * 1e-9) ** 2 * direct_total(gap, count, rho)
            found = forces.pull_off_force.sel(contact_model=model, rho=rho)[i, j].item()
            assert found == pytest.approx(expected, rel=1e-6)
    assert forces.pull_off_force.units == "N" and forces.work_of_adhesion == work


def test_the_force_on_a_plane_is_that_of_derjaguin():
    plane = height_map(np.zeros((128, 128)), PIXEL)
    forces = hc.pull_off_forces(
        plane, ranges=[5.6], work=0.05, **SPHERE, **LOAD, window=8000, count=1
    )
    expected = 2 * np.pi * SPHERE["radius"] * 1e-9 * 0.05
    assert forces.pull_off_force.sel(contact_model="rigid").item() == pytest.approx(expected)
    assert forces.window_change.item() < 1e-9


def test_scripts_give_the_same_numbers(script):
    reading = {"dataset": "", "undefined_pixels": "refuse", "unit": "none"}
    script("read_scan", reading, {"scan": "scan.nc"}, made="measurement.nc")
    levelling = {"levelling": "plane", "sphere_radius": None}
    outputs = {"scan": "levelled.nc", "stitched": "stitched.nc"}
    script("prepare_scan", levelling, {"measurement": "measurement.nc"}, **outputs)
    scan, levelled = hc.read_scan("scan.nc"), read_height_map("levelled.nc")
    np.testing.assert_array_equal(scan.heights, levelled.heights)
    assert scan.pixel_size == levelled.pixel_size

    given = {"sphere_scans": [1], "contact": LOAD | ARRAY, "ranges": [2.0, 5.6]}
    given |= SPHERE | {"reference_range": 5.6}
    inputs = {"substrate": "stitched.nc", "spheres": []}
    script("compute_pull_off", given, inputs, made="forces.nc")
    expected = dataset.read("forces.nc").isel(sphere_scan=0)
    found = hc.pull_off_forces(scan, ranges=[2.0, 5.6], work=0.05, **SPHERE, **LOAD, **ARRAY)
    of_script = expected.pull_off_force.transpose(*found.pull_off_force.dims)
    np.testing.assert_allclose(found.pull_off_force, 0.05 * of_script, rtol=1e-12)
    assert found.window_change.item() == pytest.approx(expected.window_change.item(), rel=1e-9)

    given = levelling | {"tip_radii": [None]}
    script("measure_spectrum", given, {"measurements": ["measurement.nc"]}, made="spectrum.nc")
    whole = hc.read_spectrum("scan.nc", continued=True)
    np.testing.assert_array_equal(whole.density, read_spectrum("spectrum.nc").density)

    scales = {"pixels": 256, "cutoffs": [40.0, 80.0, 160.0]}
    given = {
        "surface": "own", "realizations": [1], "masters": True, "sides": {"small": scales},
        "radii": [SPHERE["radius"]], "loads": [LOAD], "ranges": [5.6], **ARRAY,
    }  # fmt: skip
    inputs = {"small_masters": ["stitched.nc"], "sphere": []}
    script("filter_masters", given, inputs, made="filtered.nc")
    forces = dataset.read("filtered.nc").mean(["contact_y", "contact_x"])
    forces = forces.squeeze(["realization", "side", "radius", "load", "rho"])
    ratios = hc.force_ratios(scan, {"small": scales["cutoffs"]}, rho=5.6, **SPHERE, **LOAD, **ARRAY)
    np.testing.assert_allclose(
        ratios.ratio.sel(side="small"), forces.pull_off_force / forces.unfiltered_pull_off_force
    )


def test_ratios_are_those_of_the_waves_that_are_left():
    """Of two waves a cutoff between them leaves either one."""
    place = 2 * np.pi * np.arange(128) / 128
    long, short = np.tile(4 * np.cos(2 * place), (128, 1)), np.tile(np.cos(16 * place), (128, 1))
    sphere = SPHERE | LOAD | ARRAY

    def force(heights):
        forces = hc.pull_off_forces(height_map(heights, PIXEL), ranges=[5.6], work=1.0, **sphere)
        return forces.pull_off_force.sel(contact_model="plastic").mean().item()

    both = height_map(long + short, PIXEL)
    found = hc.force_ratios(both, {"small": [30, 200], "large": [1000, 200]}, rho=5.6, **sphere)
    ratio = found.ratio.sel(cutoff_wavelength=200)
    whole = force(long + short)
    assert ratio.sel(side="small").item() == pytest.approx(force(long) / whole, rel=1e-5)
    assert ratio.sel(side="large").item() == pytest.approx(force(short) / whole, rel=1e-5)
    assert np.isnan(found.ratio.sel(side="small", cutoff_wavelength=1000))
    edge = found.sel(side="small")
    assert 30 < edge.edge < 200 and edge.edge_status == "found"
    # At least as much of the force as the tolerance asks for: the edge is open.
    open_edge = hc.force_ratios(both, {"small": [30, 60]}, rho=5.6, **sphere).sel(side="small")
    assert np.isnan(open_edge.edge) and open_edge.edge_bound == 60 and open_edge.edge_at_least


def test_the_prediction_is_that_of_the_command(files):
    numbers = hc.predict(hc.read_spectrum("my-psd.csv"), radius=250e3, rho=5.6, work=0.0463, **LOAD)
    told = json.loads(predict(predict_arguments(["my-psd.csv", "--json", "-"])))
    assert numbers["pull_off_force"].status == "inside"
    for name, one in numbers.items():
        assert told[name]["value"] == plain(one.value)
        assert told[name]["unit"] == one.unit and told[name].get("status", "") == one.status


@pytest.mark.parametrize(
    ("wrong", "parts"),
    [
        ({"radius": -1.0}, ["radius: expected a positive number, found -1.0"]),
        ({"ranges": []}, ["ranges: expected a positive number"]),
        ({"ranges": [1e-4]}, ["ranges: expected at least", "found 0.0001 nm"]),
        ({"preload": 1.0}, ["preload: expected at most", "found 1 N"]),
        ({"count": 999}, ["count: expected at most the 256 pixels", "found 999"]),
        ({"radius": "50 um"}, ["radius: expected a positive number, found '50 um'"]),
        ({"work": np.nan}, ["work: expected a positive number, found nan"]),
    ],
)
def test_what_cannot_be_computed_is_refused_in_a_line(wrong, parts, files):
    scan = hc.read_scan("scan.nc")
    given = {"ranges": [5.6], "work": 0.05} | SPHERE | LOAD | ARRAY | wrong
    message = refusal(lambda: hc.pull_off_forces(scan, **given))
    assert_says(message, *parts)
    assert len(message.splitlines()) == 1


def test_maps_spectra_and_cutoffs_are_refused(files):
    scan, sphere = hc.read_scan("scan.nc"), SPHERE | LOAD | ARRAY
    wide = hc.HeightMap(np.zeros((16, 32)), PIXEL, False, "measured")
    forces = lambda one: hc.pull_off_forces(one, ranges=[5.6], work=1.0, **sphere)  # noqa: E731
    assert_says(refusal(forces, wide), "scan: expected a square map", "16 x 32 pixels")
    ratios = lambda cutoffs: hc.force_ratios(scan, cutoffs, rho=5.6, **sphere)  # noqa: E731
    assert_says(refusal(ratios, {"small": [20.0]}), "cutoffs: expected", "found [20.0]")
    assert_says(refusal(ratios, {"short": [20.0]}), "small, large or both", "['short']")
    wavevector, _, density = hc.measured_psds(scan)
    of = SPHERE | LOAD | {"rho": 5.6, "work": 0.05}
    gaps = hc.Spectrum(wavevector, density)
    assert_says(refusal(lambda: hc.predict(gaps, **of)), "spectrum: expected growing wavevectors")
    soft = of | {"hardness": 1e6}
    known = hc.read_spectrum("my-psd.csv")
    assert_says(refusal(lambda: hc.predict(known, **soft)), "preload: expected less than")
    assert_says(refusal(hc.read_spectrum), "files: expected a table of a spectrum or scans")
    levelled = lambda: hc.read_scan("scan.nc", levelling="sphere")  # noqa: E731
    assert_says(refusal(levelled), "levelling: expected plane or lines, found sphere")
    assert_says(refusal(hc.read_scan, "none.nc"), "none.nc: expected a scan, found no such file")
