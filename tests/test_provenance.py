"""What a file was made from: checked, described for archives; figures from datasets alone."""

import json
import re
import shutil
from pathlib import Path

import pandas as pd
import pytest
import xarray as xr
import yaml
from conftest import ROOT, copy_repository, cut, run_snakemake, snakemake
from rocrate.rocrate import ROCrate

from hardcontact import crate, dataset, folders, provenance

REDRAW = ("-s", "workflow/redraw.smk", "--forceall", "--config", "study=quick")
REPORT = ("--report", "results/quick/report.html", "--report-after-run")


def rewritten(path, **attributes):
    """Write a dataset again with other attributes; all values stay."""
    with xr.open_dataset(path) as data:
        data = data.load()
    data.assign_attrs(attributes).to_netcdf(path)


# The check


def test_a_finished_study_has_no_faults(finished):
    run = run_snakemake(finished, "verify")
    assert run.returncode == 0, run.stdout
    checked, faults, absent = map(
        int, re.search(r"(\d+) files checked, (\d+) faults, (\d+) inputs not", run.stdout).groups()
    )
    made = len(list((finished / "results/store-quick").rglob("*.nc")))
    assert faults == absent == 0 and checked > made  # all of the store, and the results


FINAL, STITCHED = "results/quick", "results/store-quick/stitched/ncd/scan-2-flat.nc"


@pytest.mark.parametrize(
    ("path", "named"),
    [
        (
            f"{FINAL}/adhesion.nc",
            [
                f"{FINAL}/adhesion.nc: is not the file that the study wrote",
                f"{FINAL}/inference.nc: does not match its input {FINAL}/adhesion.nc",
                f"{FINAL}/claims.csv: does not match",
                f"{FINAL}/figures/fig3.png: does not match",
            ],
        ),
        (f"{FINAL}/figures/fig6.csv", [f"{FINAL}/figures/fig6.csv: is not the file"]),
        (STITCHED, [f"{FINAL}/indent.nc: does not match its input {STITCHED}", "/ncd/scan-2/"]),
        ("resources/paper/table1.csv", ["figures/table1.pdf: does not match its input resources"]),
        ("workflow/hardcontact/patches.py", ["indent.nc: does not match its input workflow"]),
    ],
)
def test_a_changed_file_is_named_by_all_that_was_made_from_it(finished_copy, path, named):
    if path.endswith(".nc"):
        rewritten(finished_copy / path, comment="another")
    else:
        with open(finished_copy / path, "a") as file:
            file.write("\n")
    run = run_snakemake(finished_copy, "verify")
    assert run.returncode == 1 and "Traceback" not in run.stdout
    for part in named:
        assert part in run.stdout, run.stdout


def test_a_missing_output_is_a_fault_and_a_missing_input_is_counted(finished_copy):
    (finished_copy / "results/quick/figures/fig1.png").unlink()
    shutil.rmtree(finished_copy / "results/store-quick/masters")
    run = run_snakemake(finished_copy, "verify")
    assert run.returncode == 1
    assert "results/quick/figures/fig1.png: expected a file of the study, found none" in run.stdout
    assert "1 faults, 16 inputs not at hand" in run.stdout


def test_a_damaged_crate_is_named(finished_copy):
    cut(finished_copy / "results/quick" / crate.NAME, 0.5)
    run = run_snakemake(finished_copy, "verify")
    assert run.returncode == 1
    expected = f"error: results/quick/{crate.NAME}: expected a whole RO-Crate, found: "
    assert expected in run.stdout and "Traceback" not in run.stdout


def test_what_is_not_there_cannot_be_verified(tmp_path):
    with pytest.raises(ValueError, match=f"{tmp_path}: expected files of a study, found none"):
        provenance.check(tmp_path, crate.described(tmp_path))


def test_records_name_parameters_code_versions_and_inputs(finished, monkeypatch):
    monkeypatch.chdir(finished)
    found = provenance.traced("results/quick")
    described = crate.described("results/quick")
    assert {path for path in described if "/provenance/" not in path} == {
        path for path in found if path.startswith("results/quick/")
    }
    for path, record in found.items():
        inputs = json.loads(record["input_digests"])
        assert inputs and all(dataset.digest([name]) == value for name, value in inputs.items())
        assert json.loads(record["versions"])["numpy"]
        assert len(record["code_digest"]) == 64
        json.loads(record["parameters"])
        assert "environment.txt" in inputs, path


# The crate


def test_the_crate_says_what_an_archive_asks(finished, monkeypatch):
    monkeypatch.chdir(finished)
    folder = Path("results/quick")
    read = ROCrate(str(folder))
    root = read.root_dataset
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert root["name"].startswith(citation["title"]) and root["license"]["name"] == "MIT"
    assert root["author"][0]["name"] == citation["authors"][0]["name"]
    assert root["citation"].id == "https://doi.org/10.1007/s11340-021-00733-6"
    action = read.get("#study")
    results = {folder / entity.id: entity["sha256"] for entity in action["result"]}
    assert {path.suffix for path in results} >= {".nc", ".csv", ".pdf", ".png", ".html", ".yaml"}
    assert all(dataset.digest([path]) == value for path, value in results.items())
    inputs = {entity["name"]: entity["sha256"] for entity in action["object"]}
    assert "resources/spectra/uncd.csv" in inputs and "config/surfaces.tsv" in inputs
    assert all(dataset.digest([path]) == value for path, value in inputs.items())
    required = action["instrument"]["softwareRequirements"]
    pinned = (ROOT / "environment.txt").read_text().splitlines()
    assert {f"{package['name']}=={package['version']}" for package in required} <= set(pinned)
    assert len(required) == sum("==" in line for line in pinned)


def test_describing_twice_gives_the_same(finished, monkeypatch):
    monkeypatch.chdir(finished)
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    first, second = (crate.describe("results/quick", "quick", citation, {}) for _ in range(2))
    assert first == second


def test_the_kept_configuration_is_the_study(finished):
    kept = yaml.safe_load((finished / "results/quick/configuration.yaml").read_text())
    assert kept["study"] == "quick" and kept["contact"]["hardness"] == "25 GPa"
    tables = [pd.read_csv(finished / path, sep="\t") for path in
              ("results/quick/surfaces.tsv", "config/surfaces.tsv")]  # fmt: skip
    pd.testing.assert_frame_equal(*tables)


# Figures without the data


def test_figures_and_report_are_redrawn_from_the_datasets_alone(finished, tmp_path):
    study = copy_repository(tmp_path / "downloaded")
    results = study / "results/quick"
    results.mkdir(parents=True)
    for path in (finished / "results/quick").iterdir():
        if path.is_file() and path.suffix in (".nc", ".csv", ".yaml"):
            shutil.copyfile(path, results / path.name)
    run = snakemake(study, *REDRAW, *REPORT)
    assert run.returncode == 0, run.stdout[-3000:]
    jobs = set(re.findall(r"^(?:local)?rule (\w+):", run.stdout, re.M)) - {"redraw"}
    assert len(jobs) == 11
    assert jobs == {name for name in jobs if name.startswith("draw_")} | {"describe_study"}
    assert {path.name for path in (study / "results").iterdir()} == {"quick"}
    for path in [*(finished / "results/quick/figures").iterdir(),
                 *(finished / "results/quick/report").iterdir()]:  # fmt: skip
        redrawn = results / path.relative_to(finished / "results/quick")
        assert redrawn.read_bytes() == path.read_bytes(), path
    assert "fig6" in (results / "report.html").read_text()


def test_redrawing_without_results_says_so(finished, tmp_path):
    study = copy_repository(tmp_path / "empty")
    run = snakemake(study, *REDRAW)
    assert run.returncode == 1 and "Traceback" not in run.stdout
    assert "results/quick/configuration.yaml: expected the configuration of a finished study" in (
        run.stdout
    )


# Folders


def test_a_folder_is_held_once_and_freed_of_half_files(tmp_path):
    folder = tmp_path / "results"
    (folder / "store").mkdir(parents=True)
    half = folder / "store" / f"{dataset.PART}x.nc"
    half.write_text("half")
    held = folders.hold(folder)
    assert not half.exists()
    with pytest.raises(ValueError, match="expected no other run in this folder, found one"):
        folders.hold(folder)
    held.close()
    folders.hold(folder).close()
