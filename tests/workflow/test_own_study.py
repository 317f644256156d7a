"""Studies of own surfaces by the two commands: files of all kinds become an honest answer."""

import re
from contextlib import contextmanager

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from changes import KEYS_OF_OWN_SURFACES
from faults import errors
from html_page import Page
from own_studies import SHARED, made, new, numbers, quick, rough, spm
from refusals import assert_says
from scan_files import container, cut, scan, write_coordinates
from SurfaceTopography import UniformLineScan

from hardcontact.random import generator

pytestmark = pytest.mark.study

needs_scans = pytest.mark.skipif(not SHARED.is_dir(), reason=f"no real scans in {SHARED}")

#: Targets of the paper's study that own surfaces leave out.
LEFT_OUT = {
    "elastic", "plasticity", "asperities", "classical", "sets", "robustness", "claims", "figures",
    "pages", "insight", "atomic",
}  # fmt: skip


@pytest.fixture(scope="module")
def folder(repository):
    """A copy of the repository with a folder of scans."""
    (repository / "scans").mkdir()
    return repository


def page_of(results):
    """Return the text of the answer's page, with plain spaces."""
    body = Page((results / "answer.html").read_text("utf-8")).texts["body"]
    return body[0].replace("\u00a0", " ")


def assert_honest(results, fitted=False):
    """Expect what holds of the answer of every study of own surfaces."""
    answer, text = numbers(results), page_of(results)
    for surface in answer["surfaces"].values():
        assert surface["answer"] in text and all(limit in text for limit in surface["limits"])
        for side in ("small", "large"):
            assert_bounded(surface["band"][side])
        rho = surface["force"]["rho"]["values"]
        assert answer["range_of_adhesion"]["value"] in rho
        assert surface["force"]["value"] > 0
    assert {one["part"] for one in answer["left_out"]} == LEFT_OUT | (set() if fitted else {"fit"})
    assert not re.search(r"\bnan\b|\binf\b|None|published|reproduced", text)
    made = {path.name for path in results.iterdir()}
    assert not made & {"claims.csv", "figures", "inference.nc", "band.nc", "report"}


def assert_bounded(band):
    """Expect of an edge that it lies between cutoffs and its interval around it, or is open."""
    cutoffs, edge = band["cutoff_wavelength"]["values"], band["edge"]
    low, high = edge["interval"]
    assert (edge["value"] is None) == (band["bound"]["value"] is not None)
    for end in (edge["value"], low, high):
        assert end is None or min(cutoffs) <= end <= max(cutoffs)
    assert low is None or high is None or low < high
    if edge["value"] is None:
        assert band["bound"]["value"] in (min(cutoffs), max(cutoffs))
        assert re.match("at (least|most) ", band["text"])
    elif low is not None and high is not None:
        assert low <= edge["value"] <= high


# Real scans


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
    (answer,) = numbers(results)["surfaces"].values()
    assert answer["basis"] == "measured" and answer["scan_size"]["value"] == contacts
    kinds = {one["kind"] for one in answer["spectrum"]["measurements"]}
    assert kinds == ({"map"} if name == "ten" else {"map", "profile"})
    if name == "twin":  # 100 nm are too small for a sphere of 250 µm: no interval, and a warning.
        assert answer["force"]["interval"] == [None, None]
        assert_says(said, "the window holds 36% of the force")
        assert_says(" ".join(answer["limits"]), "too low", "Reliable at no wavelength")
    else:
        assert 14.2 < answer["scans"][0]["rms_height"]["value"] < 14.4
        low, high = answer["force"]["interval"]
        assert low < answer["force"]["value"] < high
        assert 20 < answer["band"]["small"]["edge"]["value"] < 100
        assert "conditional on this scan" in answer["band"]["small"]["interval_note"]
        assert_says(answer["answer"], "that its scans show, but", "if it goes on below 200 nm")
        continued = answer["force"]["with_continued_roughness"]["small"]
        assert continued["differs"] and continued["value"] < 0.7 * answer["force"]["value"]


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


def test_files_of_all_kinds_are_told_and_used(folder, several):
    results, said = several
    assert_says(said, "cropped", "96 x 96", "line scan", "undefined pixels", "5 nm")
    overlay = yaml.safe_load((folder / "config/several.yaml").read_text())
    assert overlay["scan"]["undefined_pixels"] == "harmonic"
    film, twin = numbers(results)["surfaces"].values()
    kinds = [[one["kind"] for one in of["spectrum"]["measurements"]] for of in (film, twin)]
    assert kinds == [["map", "profile"], ["map"]]
    notes = twin["spectrum"]["measurements"][0]["notes"]
    assert "4 undefined pixels" in notes
    assert film["label"] == "My film"


def test_surfaces_on_different_grids_have_each_their_answer(several):
    results, _ = several
    assert_honest(results)
    film, twin = numbers(results)["surfaces"].values()
    assert (film["scan_size"]["value"], twin["scan_size"]["value"]) == (1500.0, 2500.0)
    assert film["pixel_size"]["value"] == pytest.approx(15.625)
    assert twin["pixel_size"]["value"] == pytest.approx(19.53, abs=0.01)
    text = page_of(results)
    assert text.count("predicted pull-off force") == 2


# Own forces


RANGE, WORK = 5.6, 0.05  # nm, one of those computed; J/m²


def forces_on(adhesion, surface, rng):
    """Forty forces in µN, log-normal about the mean force of a surface at RANGE and WORK."""
    of_surface = adhesion.pull_off_force.sel(surface=surface, contact_model="plastic")
    mean = WORK * float(of_surface.sel(rho=RANGE, method="nearest").mean()) * 1e6
    return mean * np.exp(rng.normal(-(0.5**2) / 2, 0.5, size=40))


@pytest.fixture(scope="module")
def measured(folder):
    """Five scans each of two surfaces, on which forces were measured that follow RANGE and WORK."""
    surfaces = []
    for label, rms in (("bare", 4.0), ("coated", 15.0)):
        files = [folder / f"scans/{label}-{number}.001" for number in range(5)]
        for number, file in enumerate(files):
            spm(file, rough(generator(8, label, number), rms=rms), 2500.0)
        surfaces += ["--surface", label, *files]
    # Forces are known once the contacts are computed.
    assert new(folder, "pair", *surfaces).returncode == 0
    run = quick(folder, "pair", "adhesion")
    assert run.returncode == 0, run.stdout[-3000:]
    adhesion = xr.load_dataset(folder / "results/pair-quick/adhesion.nc")
    rng = generator(8, "tests")
    rows = [
        {"surface": surface, "value": f"{force:.4f}", "unit": "uN"}
        for surface in ("bare", "coated")
        for force in forces_on(adhesion, surface, rng)
    ]
    pd.DataFrame(rows).to_csv(folder / "my.csv", index=False)
    return made(folder, "pair", "--overwrite", *surfaces, "--forces", "my.csv")[0]


def test_the_region_of_own_forces_holds_the_truth(measured):
    assert_honest(measured, fitted=True)
    fit = xr.load_dataset(measured / "fit.nc").sel(contact_model="plastic")
    low, high = fit.region.sel(rho=RANGE, method="nearest").values
    assert low < WORK < high
    assert fit.tests.values.tolist() == [40, 40] and fit.attrs["basis"] == "measured"
    # The region is worth having: it leaves out most of what was computed.
    assert np.isfinite(fit.region).all("bound").mean() < 0.7


def test_own_forces_stand_on_the_page_as_measured(measured):
    text, fit = page_of(measured), numbers(measured)["fit"]
    assert fit is not None
    assert_says(text, "Fit to your own forces (measured)", "Measured:", "40 tests", "5 scans")
    for surface in numbers(measured)["surfaces"].values():
        assert not surface["band"]["small"]["conditional"]


# A colloidal probe


@pytest.fixture(scope="module")
def probe(folder):
    """A small probe on one scan."""
    spm(folder / "scans/probe.001", rough(generator(4), 128, 1000.0, 3.0), 1000.0)
    options = ["--radius", "5um", "--hardness", "5GPa", "--preload", "100nN", "--range", "2nm"]
    return made(folder, "probe", "scans/probe.001", *options, "--work", "30 mJ/m2")[0]


def test_a_colloidal_probe_has_its_own_force(probe):
    assert_honest(probe)
    answer = numbers(probe)
    assert answer["contact"] == {
        "hardness": "5 GPa", "preload": "100 nN", "radius of the sphere": "5 µm",
        "sphere": "smooth",
    }  # fmt: skip
    assert answer["range_of_adhesion"]["value"] == 2.0
    assert answer["work_of_adhesion"]["value"] == pytest.approx(0.03)
    # Less than the smooth limit 2 pi R W, by the roughness.
    (surface,) = answer["surfaces"].values()
    assert surface["force"]["value"] < 0.5 * 2 * np.pi * 5e-6 * 0.03


def test_the_same_study_made_again_is_the_same(folder, probe, tmp_path):
    first = {name: (probe / name).read_bytes() for name in ("answer.json", "answer.html")}
    for made_of_it in (probe, folder / "results/store-probe"):
        made_of_it.rename(tmp_path / made_of_it.name)
    run = quick(folder, "probe")
    assert run.returncode == 0, run.stdout[-3000:]
    assert {name: (probe / name).read_bytes() for name in first} == first


def test_a_second_run_has_nothing_to_do(folder, probe):
    assert_says(quick(folder, "probe", "-n").stdout, "Nothing to be done")


def test_the_report_shows_the_answer_and_nothing_of_the_paper(folder, probe):
    report = probe / "report.html"
    run = quick(folder, "probe", "--report", str(report.relative_to(folder)))
    assert run.returncode == 0, run.stdout[-3000:]
    text = report.read_text("utf-8")
    (categories,) = re.findall(r"var categories = (\{.*\});", text)
    assert categories.startswith('{"0. Answer"') and "Verdicts" not in categories
    assert "Nothing of the paper" in text and "Fig. 3" not in text


def test_a_study_is_not_overwritten(folder, probe):
    before = (folder / "config/probe.yaml").read_bytes()
    done = new(folder, "probe", "scans/probe.001")
    assert done.returncode == 1 and "--overwrite" in done.stderr
    assert (folder / "config/probe.yaml").read_bytes() == before


@pytest.mark.parametrize("target", sorted(LEFT_OUT | {"fit"}))
def test_a_target_left_out_says_why(folder, probe, target):
    run = quick(folder, "probe", target, "-n")
    assert run.returncode == 0
    (reason,) = {one["reason"] for one in numbers(probe)["left_out"] if one["part"] == target}
    assert f"{target} is left out: {reason}" in run.stdout


# Scans of the sphere


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
    topography = xr.load_dataset(results / "topography.nc").sel(surface="sphere")
    assert topography.rms_height.values == pytest.approx(2.0, rel=0.1)
    smooth = folder / "smooth.yaml"
    smooth.write_text(yaml.safe_dump(
        {"sphere": {"surface": "smooth"}, "surfaces": "smooth.tsv", "quick": {"study": "smooth"}}
    ))  # fmt: skip
    table = (folder / "config/ball.tsv").read_text().splitlines(keepends=True)
    (folder / "smooth.tsv").write_text("".join(row for row in table if row[:6] != "sphere"))
    assert quick(folder, "ball", "adhesion", overlays=[smooth]).returncode == 0
    without = xr.load_dataset(folder / "results/smooth/adhesion.nc")
    ratio = adhesion.pull_off_force.mean() / without.pull_off_force.mean()
    assert 0.01 < ratio < 0.95


# Bad input


@contextmanager
def changed(path, text):
    """Change a file for a while."""
    before = path.read_text()
    path.write_text(text)
    try:
        yield
    finally:
        path.write_text(before)


def files_of(folder):
    """Return the files of a study, without what Snakemake keeps for itself."""
    return {path for path in folder.rglob("*") if ".snakemake" not in path.parts}


def test_several_faults_are_told_at_once_and_nothing_is_written(folder, probe):
    (folder / "scans/broken.001").write_text("no scan")
    cut(spm(folder / "scans/short.001", rough(generator(7)), 2500.0), 0.6)
    (folder / "unitless.csv").write_text("surface,value,unit\nmine,1,\n")
    before = files_of(folder)
    done = new(
        folder, "mine", "scans/broken.001", "scans/short.001", "none.001", "scans/probe.001",
        "--preload", "10", "--radius", "3 N", "--forces", "unitless.csv",
    )  # fmt: skip
    assert done.returncode == 1 and not done.stdout
    lines = done.stderr.splitlines()
    expected = ["--preload", "--radius", "broken.001", "short.001", "none.001", "unitless.csv"]
    assert all(line.startswith("error: ") and ": expected " in line for line in lines)
    assert all(any(part in line for line in lines) for part in expected)
    assert files_of(folder) == before


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        ({"contact": {"preload": 10}}, ["config key contact.preload", "unit of N", "found 10"]),
        ({"contact": {"preload": "10 kg"}}, ["config key contact.preload", "10 kg"]),
        ({"contact": {"preload": "1 N"}}, ["contact.preload", "at most 1.37 mN", "found 1 N"]),
        ({"forces": "none.csv"}, ["config key forces", "no file none.csv"]),
        ({"forces": "unitless.csv"}, ["unitless.csv: line 2: unit", "expected"]),
        ({"quick": {"scales": {"rang": "1 nm"}}}, ["rang"]),
        ({"published": "paper"}, ["expected"]),
    ],
)
def test_a_bad_overlay_is_refused_in_the_users_units(folder, probe, change, parts):
    (folder / "unitless.csv").write_text("surface,value,unit\nprobe,1,\n")
    (folder / "bad.yaml").write_text(yaml.safe_dump(change))
    before = files_of(folder)
    run = quick(folder, "probe", overlays=["bad.yaml"])
    assert run.returncode != 0
    assert_says(" ".join(errors(run.stdout)), *parts)
    assert files_of(folder) == before


@pytest.mark.parametrize("text", ["study: x\n  a: [b\n", "- a\n", None])
def test_a_broken_or_missing_overlay_makes_nothing(folder, probe, text):
    """Snakemake reads it before the study can, and says so in its own words."""
    path = folder / "broken.yaml"
    path.unlink(missing_ok=True)
    if text is not None:
        path.write_text(text)
    before = files_of(folder)
    assert quick(folder, "probe", overlays=[path]).returncode != 0
    assert files_of(folder) == before


def test_a_scan_that_is_gone_is_named(folder, probe):
    table = folder / "config/probe.tsv"
    with changed(table, table.read_text().replace("probe.001", "gone.001")):
        run = quick(folder, "probe")
    assert run.returncode != 0
    (line,) = errors(run.stdout)
    assert_says(line, "config/probe.tsv: line 2", "scans/gone.001", "no such file")


# What a change makes again


PAGE = {"answer_surfaces", "keep_configuration", "describe_crate"}
FORCES = {
    "compute_pull_off", "measure_window_change", "aggregate_adhesion", "predict_force",
    "fit_forces",
}  # fmt: skip
MASTERS = {
    "synthesize_small_scale_master", "synthesize_large_scale_master", "compute_filtered_pull_off",
    "aggregate_scales", "find_band_edges",
}  # fmt: skip
SPECTRA = {"measure_spectrum", "aggregate_spectra"}
#: What says of every surface how rough it is, and what reads that.
TOPOGRAPHY = {"aggregate_topography", "predict_force", "fit_forces"}
SCANS = {"prepare_scan", "measure_topography"} | TOPOGRAPHY

#: Another value of a key, and what is made again.
KEYS = {
    "adhesion.work": ("60 mJ/m2", {"predict_force", "fit_forces"}),
    "forces": ("none", set()),
    "scan.levelling": ("lines", SCANS | SPECTRA | FORCES | MASTERS),
    "scan.undefined_pixels": ("harmonic", SCANS | SPECTRA | FORCES | MASTERS),
    "contact.preload": ("20 uN", FORCES | {"compute_filtered_pull_off", "aggregate_scales",
                                           "find_band_edges"}),
}  # fmt: skip


def planned(run):
    """Return the rules of a dry run."""
    assert run.returncode == 0, run.stdout
    return set(re.findall(r"^(?:local)?rule (\w+):\n", run.stdout, re.M)) - {"all"}


@pytest.mark.parametrize("key", KEYS)
def test_a_key_makes_again_what_depends_on_it(folder, measured, key):
    value, rules = KEYS[key]
    for part in reversed(key.split(".")):
        value = {part: value}
    (folder / "other.yaml").write_text(yaml.safe_dump(value))
    assert planned(quick(folder, "pair", "-n", overlays=["other.yaml"])) == rules | PAGE


def test_keys_of_own_surfaces_are_changed_here():
    assert KEYS_OF_OWN_SURFACES <= {*KEYS, "published"}


def test_more_forces_make_the_fit_again(folder, measured):
    path = folder / "my.csv"
    with changed(path, path.read_text() + "bare,1.0,uN\n"):
        assert planned(quick(folder, "pair", "-n")) == {
            "fit_forces", "answer_surfaces", "describe_crate",
        }  # fmt: skip


#: Another text of a column in the last row of a surface, and what is made again.
COLUMNS = {
    "tip_radius": ("20 nm", SPECTRA | MASTERS | TOPOGRAPHY),
    # Masters are made of the first scans, and spectra of all, whatever they are used for.
    "use": ("spectrum", {"aggregate_adhesion", "find_band_edges"} | TOPOGRAPHY),
}


@pytest.mark.parametrize("column", COLUMNS)
def test_a_column_makes_again_what_depends_on_it(folder, measured, column):
    text, rules = COLUMNS[column]
    path = folder / "config/pair.tsv"
    table = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    table.loc[len(table) - 1, column] = text
    with changed(path, table.to_csv(sep="\t", index=False)):
        assert planned(quick(folder, "pair", "-n")) == rules | PAGE
