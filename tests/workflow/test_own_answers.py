"""Studies of your surfaces turn files of all kinds into an answer."""

import json
import re

import numpy as np
import pytest
import xarray as xr
import yaml
from comparison import undescribed_variables
from html_page import Page, dead_links
from jsonschema import Draft202012Validator
from own_studies import RANGE, WORK, read_answer, read_quantities, run_quick
from repository import ROOT, copy_repository, run_snakemake_with_forks

from hardcontact.report.figures.listing import FIGURE_SUFFIXES, OWN_FIGURES

pytestmark = pytest.mark.study


@pytest.fixture
def several(own_study):
    """Return the results of the study that files of all kinds make."""
    return own_study / "results/several-quick"


def test_every_variable_of_own_surfaces_has_a_unit_and_a_meaning(several):
    assert undescribed_variables(several) == []
    text = (several / "datasets.md").read_text("utf-8")
    assert {f"## {name}.nc" for name in ("edges", "fit", "force", "spectra")} <= {*text.split("\n")}


def page_of(results):
    """Return the page of the answer without its scripts and their data."""
    html = (results / "answer.html").read_text("utf-8")
    return Page(re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL))


def check_answer(results, missing_figures=()):
    """Check what the answer of every study of your surfaces has."""
    answer, page = read_answer(results), page_of(results)
    schema = ROOT / "workflow/schemas/answer.schema.json"
    Draft202012Validator(json.loads(schema.read_text("utf-8"))).validate(answer)
    figures = {figure["id"].removesuffix("-figure") for figure in page.attributes["figure"]}
    assert figures == set(OWN_FIGURES) - set(missing_figures)
    figure_files = {path.name for path in (results / "figures").glob("*.*")}
    assert figure_files >= {f"{name}.{suffix}" for name in figures for suffix in FIGURE_SUFFIXES}
    edges, force = (xr.load_dataset(results / f"{name}.nc") for name in ("edges", "force"))
    for name, surface in read_quantities(results).items():
        if name:
            assert surface["mean_force"]["value"] > 0
            for side in ("short", "long"):
                assert_bounded(edges.sel(surface=name, side=side))
    assert read_quantities(results)[""]["range_of_adhesion"]["value"] in force["rho"]
    assert not re.search(r"\bnan\b|\binf\b|None|reproduced", page.texts["main"][0])
    made_paths = {path.relative_to(results).as_posix() for path in results.rglob("*.*")}
    html = (results / "answer.html").read_text("utf-8")
    assert dead_links({"answer.html": html}, made_paths - {"answer.html"}) == []
    files = {path.name for path in results.iterdir()}
    assert not files & {"claims.csv", "sets.nc", "report"}


def assert_bounded(edge_data):
    """Expect an edge between cutoffs and inside its interval, or an open edge."""
    ratios = edge_data["filtered_force_ratio"].dropna("cutoff_wavelength")
    cutoffs = ratios["cutoff_wavelength"].values
    edge, bound = edge_data["edge"].item(), edge_data["edge_bound"].item()
    low, high = edge_data["edge_interval"].values
    assert np.isnan(edge) == np.isfinite(bound)
    for end in (edge, low, high):
        assert np.isnan(end) or cutoffs.min() <= end <= cutoffs.max()
    assert not low >= high
    if np.isnan(edge):
        assert bound in (cutoffs.min(), cutoffs.max()) and edge_data["edge_status"] != "found"
    else:
        assert not edge < low and not edge > high


# Files of all kinds, surfaces on different grids


def test_surfaces_on_different_grids_have_their_own_answers(several):
    check_answer(several)
    surfaces = read_quantities(several)
    film, twin = surfaces["my_film"], surfaces["twin"]
    # 96 of 128 rows of 2000 nm, and 128 of 2500 nm.
    assert (film["scan_size"]["value"], twin["scan_size"]["value"]) == (1500.0, 2500.0)
    assert film["pixel_size"]["value"] == pytest.approx(15.625)
    assert twin["pixel_size"]["value"] == pytest.approx(19.53, abs=0.01)


# Your forces


def test_the_interval_from_own_forces_contains_the_true_work(several):
    fit = xr.load_dataset(several / "fit.nc").sel(contact_model="plastic")
    assert fit.force_count.values.tolist() == [40, 40]
    works = fit.work_by_range_interval
    low, high = works.sel(surface="twin").sel(rho_fine=RANGE, method="nearest").values
    force = xr.load_dataset(several / "force.nc").sel(surface="twin", contact_model="plastic")
    weak, strong = force.force_interval.sel(rho=RANGE, method="nearest").values
    # The mean of the tests adds little to what scans and positions on the sphere leave open.
    assert low < WORK < high < 1.3 * low * strong / weak
    # The scan of the film is too small for an interval, so that no pair is known.
    assert works.sel(surface="my_film").isnull().all() and fit.region.isnull().all()


# A rough sphere


def test_the_answer_has_the_contacts_and_the_roughness_of_a_rough_sphere(several):
    assert read_answer(several)["contact"]["sphere"] == "sphere"
    page = (several / "answer.html").read_text("utf-8")
    assert page.count("The wavelengths that matter most") == 2
    positions_on_scans = 2 * 3**2
    assert xr.load_dataset(several / "adhesion.nc").sizes["sphere_scan"] == positions_on_scans
    # The sphere's shape is subtracted before its roughness is measured.
    ball = xr.load_dataset(several / "topography.nc").rms_height.sel(surface="sphere")
    assert ball.values == pytest.approx(2.0, rel=0.1)


# A colloidal probe


def test_a_colloidal_probe_has_a_force_below_the_smooth_limit(probe):
    check_answer(probe, missing_figures={"works"})
    assert read_answer(probe)["contact"]["radius of the sphere"] == "5 µm"
    study, surface = read_quantities(probe).values()
    assert study["range_of_adhesion"]["value"] == 2.0
    assert study["work_of_adhesion"]["value"] == pytest.approx(0.03)
    # Less than the smooth limit 2 pi R W, by the roughness.
    assert surface["mean_force"]["value"] < 0.5 * 2 * np.pi * 5e-6 * 0.03


# A spectrum from a publication

#: The study of `config/crn.yaml` on one of its surfaces and small grids.
DESCRIBED = {
    "study": "described",
    "surfaces": "described.tsv",
    "quick": {
        "substitutes": {"pixels": 128},
        "contact": {"contacts_per_row": 4},
        "band": {
            "short": {"pixels": 256, "transition": "160 nm", "cutoffs": ["100 nm", "200 nm"]},
            "long": {"pixels": 512, "cutoffs": ["1000 nm", "8000 nm"]},
        },
    },
}


def test_a_described_spectrum_has_an_answer(tmp_path):
    study = copy_repository(tmp_path / "study")
    header, row = (study / "config/crn.tsv").read_text().splitlines(keepends=True)[:2]
    (study / "described.tsv").write_text(header + row)
    (study / "described.yaml").write_text(yaml.safe_dump(DESCRIBED))
    run = run_quick(study, "crn", overlays=["described.yaml"], run=run_snakemake_with_forks)
    assert run.returncode == 0, run.stdout[-3000:]
    check_answer(study / "results/described-quick", missing_figures={"works"})
