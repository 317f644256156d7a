"""The crate describes a study for archives, which can redraw its figures."""

import re
import shutil
from pathlib import Path

import pytest
import yaml
from refusals import assert_says, refusal
from repository import ROOT, copy_repository, snakemake
from rocrate.rocrate import ROCrate

from hardcontact.base import crate
from hardcontact.base.origin import digest, pinned_versions

REDRAW = ("-s", "workflow/redraw.smk", "--config", "study=quick")
#: Figures that are drawn again: maps, curves against the cutoff, and sets.
DRAWN_AGAIN = ("fig1", "fig6", "fig_sets")
REPORT = ("--report", "results/quick/report.html", "--report-after-run")


@pytest.fixture
def folder(tmp_path):
    """Make a folder of results with a table, a log and a hidden file, and its crate."""
    folder = tmp_path / "results" / "small"
    for name in ("claims.csv", "figures/fig1.csv", "logs/a.log", ".lock"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(name)
    text = crate.crate_text(folder, "small", ROOT / "CITATION.cff", {"numpy": "2.0"})
    (folder / crate.CRATE_FILE).write_text(text)
    return folder


def test_outputs_are_described_and_logs_are_not(folder):
    files = [folder / "claims.csv", folder / "figures/fig1.csv"]
    assert crate.described_files(folder) == {path.as_posix(): digest(path) for path in files}


@pytest.mark.parametrize("content", ["", "[]", '{"@graph": [{"@type": "File"}]}'])
def test_a_damaged_crate_is_refused(folder, content):
    (folder / crate.CRATE_FILE).write_text(content)
    assert_says(
        refusal(crate.described_files, folder),
        crate.CRATE_FILE,
        "expected a whole RO-Crate, found: ",
    )


# The quick study


@pytest.mark.study
def test_the_crate_describes_results_inputs_and_packages(finished, monkeypatch):
    monkeypatch.chdir(finished)
    folder = Path("results/quick")
    described_study = ROCrate(str(folder))
    root = described_study.root_dataset
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert root["name"].startswith(citation["title"]) and root["license"]["name"] == "MIT"
    assert root["author"][0]["name"] == citation["authors"][0]["name"]
    assert root["citation"].id == "https://doi.org/10.1007/s11340-021-00733-6"
    action = described_study.get("#study")
    results = {folder / entity.id: entity["sha256"] for entity in action["result"]}
    assert {path.suffix for path in results} >= {".nc", ".csv", ".pdf", ".png", ".html", ".yaml"}
    assert {folder / "answer.html", folder / "answer.json"} <= results.keys()
    assert all(digest(path) == value for path, value in results.items())
    inputs = {entity["name"]: entity["sha256"] for entity in action["object"]}
    assert "resources/spectra/uncd.csv" in inputs and "config/surfaces.tsv" in inputs
    assert all(digest(path) == value for path, value in inputs.items())
    required = action["instrument"]["softwareRequirements"]
    versions = {package["name"]: package["version"] for package in required}
    assert versions == pinned_versions(ROOT / "environment.txt")


# Figures without the data


@pytest.mark.study
def test_figures_and_report_are_redrawn_from_the_datasets_alone(finished, tmp_path):
    study = copy_repository(tmp_path / "downloaded")
    results = study / "results/quick"
    (results / "figures").mkdir(parents=True)
    finished_results = finished / "results/quick"
    packages = ("environment.txt", "constraints.txt")
    copied = [
        *(finished / "results" / name for name in packages),
        *(path for path in finished_results.glob("*.*") if path.suffix in (".nc", ".csv", ".yaml")),
        *(path for path in finished_results.glob("figures/[!.]*") if path.stem not in DRAWN_AGAIN),
    ]
    for path in copied:
        shutil.copyfile(path, study / path.relative_to(finished))
    run = snakemake(study, *REDRAW, *REPORT, "--verbose")
    assert run.returncode == 0, run.stdout[-3000:]
    jobs = set(re.findall(r"^(?:local)?rule (\w+):", run.stdout, re.M)) - {"redraw"}
    assert jobs == {f"draw_{name}" for name in DRAWN_AGAIN} | {"write_pages", "answer_paper"}
    # Nothing is computed: no store, only the lists of packages.
    result_folders = {path.name for path in (study / "results").iterdir()}
    assert result_folders == {"quick", *packages}
    redrawn_paths = [*(finished_results / "figures").glob("[!.]*")]
    redrawn_paths += (finished_results / "report").glob("*.html")
    redrawn_paths += (finished_results / name for name in ("answer.html", "answer.json"))
    for path in redrawn_paths:
        redrawn_path = results / path.relative_to(finished_results)
        assert redrawn_path.read_bytes() == path.read_bytes(), path
    assert "fig6" in (results / "report.html").read_text()
