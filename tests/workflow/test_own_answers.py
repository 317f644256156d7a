"""Studies of own surfaces by the two commands: files of all kinds become an honest answer."""

import json
import re

import numpy as np
import pytest
import xarray as xr
import yaml
from html_page import Page
from jsonschema import Draft202012Validator
from own_studies import LEFT_OUT, RANGE, SHARED, WORK, made, numbers, quantities, quick, rough, spm
from refusals import assert_says
from repository import ROOT
from scan_files import container, scan, write_coordinates
from scipy import stats
from SurfaceTopography import UniformLineScan

from hardcontact.insight.closed_form import gaussian_share
from hardcontact.numbers.random import generator

#: Studies beside the one that all tests share: before a release, and after what they hold changes.
long = pytest.mark.system

needs_scans = pytest.mark.skipif(not SHARED.is_dir(), reason=f"no real scans in {SHARED}")


def page_of(results):
    """Return the page of the answer without its scripts and their data."""
    html = (results / "answer.html").read_text("utf-8")
    return Page(re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL))


def cautions(surface):
    """Return the codes of what limits the answer of a surface."""
    return {row["status"] for name, row in surface.items() if name.startswith("caution")}


def assert_honest(results, fitted=False):
    """Expect what holds of the answer of every study of own surfaces."""
    answer, page = numbers(results), page_of(results)
    schema = ROOT / "workflow/schemas/answer.schema.json"
    Draft202012Validator(json.loads(schema.read_text("utf-8"))).validate(answer)
    figures = {figure["id"] for figure in page.attributes["figure"]}
    edges, force = (xr.load_dataset(results / f"{name}.nc") for name in ("edges", "force"))
    for name, surface in quantities(results).items():
        if name:
            assert {f"cutoffs-{name}", f"map-{name}", f"spectrum-{name}"} <= figures
            assert surface["force_mean"]["value"] > 0
            for side in ("small", "large"):
                assert_bounded(edges.sel(surface=name, side=side))
    assert quantities(results)[""]["range_of_adhesion"]["value"] in force["rho"]
    left_out = {part for part in LEFT_OUT | {"fit"} if part in page.texts["main"][0]}
    assert left_out >= LEFT_OUT | (set() if fitted else {"fit"})
    assert not re.search(r"\bnan\b|\binf\b|None|reproduced", page.texts["main"][0])
    made = {path.name for path in results.iterdir()}
    assert not made & {"claims.csv", "figures", "inference.nc", "band.nc", "report"}


def assert_bounded(of_side):
    """Expect of an edge that it lies between cutoffs and its interval around it, or is open."""
    known = of_side.dropna("cutoff_wavelength", subset=["scale_ratio"])["cutoff_wavelength"].values
    edge, bound = of_side["edge"].item(), of_side["edge_bound"].item()
    low, high = of_side["edge_interval"].values
    assert np.isnan(edge) == np.isfinite(bound)
    for end in (edge, low, high):
        assert np.isnan(end) or known.min() <= end <= known.max()
    assert not low >= high
    if np.isnan(edge):
        assert bound in (known.min(), known.max()) and of_side["edge_status"] != "found"
    else:
        assert not edge < low and not edge > high


# Real scans


@long
@needs_scans
@pytest.mark.parametrize(
    ("name", "files", "contacts"),
    [
        ("twin", ["uncd-demo-container.zip"], 100.0),
        ("ten", ["afm-10um-512.di"], 10_000.0),
        ("both", ["uncd-demo-container.zip", "afm-10um-512.di"], 10_000.0),
    ],
)
def test_real_scans(folder, name, files, contacts):
    results, said = made(folder, name, *(SHARED / file for file in files))
    assert_honest(results)
    surface = quantities(results)[name]
    assert surface["scan_size"]["value"] == contacts
    kinds = set(xr.load_dataset(results / "spectra.nc")["kind"].values.ravel())
    assert kinds == ({"map"} if name == "ten" else {"map", "profile"})
    mean = surface["force_mean"]
    if name == "twin":  # 100 nm are too small for a sphere of 250 µm: no interval, and a warning.
        assert (mean["low"], mean["high"]) == (None, None)
        assert_says(said, "the window holds 36% of the force")
        assert {"window", "blind_measurements"} <= cautions(surface)
    else:
        assert 14.2 < surface["scan_1_rms_height"]["value"] < 14.4
        assert mean["low"] < mean["value"] < mean["high"]
        assert 20 < surface["short_edge"]["value"] < 100
        assert "conditional" in cautions(surface)
        assert surface["force_continued_small"]["value"] < 0.7 * mean["value"]


# Files of all kinds, surfaces with scans of different sizes


@pytest.fixture(scope="module")
def several(folder):
    """Two surfaces: a rectangle beside a line scan, and a container of a map with gaps."""
    scans = folder / "scans"
    spm(scans / "rectangle.001", rough(generator(1), 128)[:96], 2000.0)
    profile = np.concatenate(rough(generator(2), 64, 20_000.0)[:8])
    write_coordinates(UniformLineScan(profile, 160_000.0, unit="nm"), scans / "line.txt")
    gaps = np.ma.masked_array(rough(generator(3), 128).T, False)
    gaps[5:9, 40] = np.ma.masked
    entry = {"name": "map", "datafile": {"original": "map.nc"}}
    scan(scans / "map.nc", gaps, (2500.0, 2500.0))
    container(scans / "twin.zip", [entry], {"map.nc": scans / "map.nc"})
    return made(
        folder, "several",
        "--surface", "My film", scans / "rectangle.001", scans / "line.txt",
        "--surface", "twin", scans / "twin.zip", "--tip", "5 nm",
    )  # fmt: skip


@long
def test_files_of_all_kinds_are_told_and_used(folder, several):
    results, said = several
    assert_says(said, "cropped", "96 x 96", "line scan", "undefined pixels", "5 nm")
    overlay = yaml.safe_load((folder / "config/several.yaml").read_text())
    assert overlay["scan"]["undefined_pixels"] == "harmonic"
    spectra = xr.load_dataset(results / "spectra.nc")
    assert spectra["kind"].values.tolist() == [["map", "profile"], ["map", ""]]
    assert "4 undefined pixels" in spectra["notes"].values[1, 0]
    assert spectra["label"].values[0] == "My film"


@long
def test_surfaces_on_different_grids_have_each_their_answer(several):
    results, _ = several
    assert_honest(results)
    _, film, twin = quantities(results).values()
    assert (film["scan_size"]["value"], twin["scan_size"]["value"]) == (1500.0, 2500.0)
    assert film["pixel_size"]["value"] == pytest.approx(15.625)
    assert twin["pixel_size"]["value"] == pytest.approx(19.53, abs=0.01)


# Own forces


@long
def test_the_region_of_own_forces_holds_the_truth(measured):
    assert_honest(measured, fitted=True)
    fit = xr.load_dataset(measured / "fit.nc").sel(contact_model="plastic")
    low, high = fit.region.sel(rho=RANGE, method="nearest").values
    assert low < WORK < high
    assert fit.tests.values.tolist() == [40, 40] and fit.attrs["basis"] == "measured"
    # The region is worth having: it leaves out most of what was computed.
    assert np.isfinite(fit.region).all("bound").mean() < 0.7


@long
def test_own_forces_stand_on_the_page_as_measured(measured):
    assert "forces" in [one["id"] for one in page_of(measured).attributes["section"]]
    for name, surface in quantities(measured).items():
        if name:
            assert surface["measured_force"]["source"] == "measured"
            assert surface["measured_force_tests"]["value"] == 40
    edges = xr.load_dataset(measured / "edges.nc")
    assert not edges["conditional"].any() and set(edges["interval_source"].values) == {"scans"}


# A colloidal probe


@pytest.mark.study
def test_a_colloidal_probe_has_its_own_force(probe):
    assert_honest(probe)
    answer = numbers(probe)
    assert answer["contact"] == {
        "hardness": "5 GPa", "preload": "100 nN", "radius of the sphere": "5 µm",
        "range of adhesion": "2 nm", "sphere": "smooth", "work of adhesion": "30 mJ/m²",
    }  # fmt: skip
    of_study, surface = quantities(probe).values()
    assert of_study["range_of_adhesion"]["value"] == 2.0
    assert of_study["work_of_adhesion"]["value"] == pytest.approx(0.03)
    # Less than the smooth limit 2 pi R W, by the roughness.
    assert surface["force_mean"]["value"] < 0.5 * 2 * np.pi * 5e-6 * 0.03


@pytest.mark.study
def test_the_report_shows_the_answer_and_nothing_of_the_paper(folder, probe):
    report = probe / "report.html"
    run = quick(folder, "probe", "--report", str(report.relative_to(folder)))
    assert run.returncode == 0, run.stdout[-3000:]
    text = report.read_text("utf-8")
    (categories,) = re.findall(r"var categories = (\{.*\});", text)
    assert categories.startswith('{"0. Answer"') and "Verdicts" not in categories
    assert "Nothing of the paper" in text and "Fig. 3" not in text


# Scans of the sphere


#: What forces are not averaged over.
AXES = ("contact_model", "rho")


def mean_force(adhesion):
    """Mean force over contacts (model, range) in N, at 1 J/m²."""
    force = adhesion.pull_off_force
    return force.mean([name for name in force.dims if name not in AXES])


def gaussian_relative(adhesion, rms_height):
    """Mean over contacts of F/(2 pi R W) in closed form, at their approaches (model, range)."""
    approach = -adhesion.closest_approach
    summits = xr.apply_ufunc(stats.norm.sf, approach / rms_height)
    relative = xr.apply_ufunc(gaussian_share, rms_height, approach, adhesion.rho) + summits
    return relative.mean([name for name in relative.dims if name not in AXES])


@long
def test_a_rough_sphere_sticks_less(folder):
    x = (np.arange(128) - 63.5) * 2500 / 128
    shape = -(x[:, None] ** 2 + x**2) / (2 * 250e3)
    spm(folder / "scans/flat.001", rough(generator(5), rms=3.0), 2500.0)
    for number in range(2):
        ball = shape + rough(generator(6, number), rms=2.0)
        spm(folder / f"scans/ball-{number}.001", ball, 2500.0)
    balls = [f"scans/ball-{number}.001" for number in range(2)]
    results, _ = made(folder, "ball", "scans/flat.001", "--sphere", *balls)
    assert_honest(results)
    assert numbers(results)["contact"]["sphere"] == "sphere"
    adhesion = xr.load_dataset(results / "adhesion.nc")
    assert adhesion.sizes["sphere_scan"] == 2 and list(adhesion.surface.values) == ["ball"]
    # The sphere's shape is subtracted before its roughness is measured.
    rms_height = xr.load_dataset(results / "topography.nc").rms_height
    flat, ball = (rms_height.sel(surface=name, drop=True) for name in ("ball", "sphere"))
    assert ball.values == pytest.approx(2.0, rel=0.1)
    smooth = folder / "smooth.yaml"
    smooth.write_text(yaml.safe_dump(
        {"sphere": {"surface": "smooth"}, "surfaces": "smooth.tsv", "quick": {"study": "smooth"}}
    ))  # fmt: skip
    table = (folder / "config/ball.tsv").read_text().splitlines(keepends=True)
    (folder / "smooth.tsv").write_text("".join(row for row in table if row[:6] != "sphere"))
    assert quick(folder, "ball", "adhesion", overlays=[smooth]).returncode == 0
    without = xr.load_dataset(folder / "results/smooth/adhesion.nc")
    ratio = mean_force(adhesion) / mean_force(without)
    # Of independent bodies the squares of the rms heights add up.
    flat = flat.sel(scan=1, drop=True)
    both = np.hypot(flat, ball.rename(scan="sphere_scan"))
    expected = gaussian_relative(adhesion, both) / gaussian_relative(without, flat)
    # The closed form is that of many points: single peaks decide at the shortest range alone.
    many = adhesion.rho > (both**2 / -adhesion.closest_approach).max()
    assert (~many).sum() <= 1
    lost, lost_in_theory = (1 - of.where(many, drop=True) for of in (ratio, expected))
    np.testing.assert_allclose(lost, lost_in_theory, rtol=0.1)
    assert (0.01 < ratio).all() and (ratio.where(ratio.rho <= RANGE, drop=True) < 0.8).all()
