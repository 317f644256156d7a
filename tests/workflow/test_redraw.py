"""Figures and pages are drawn again from the datasets of a finished study alone."""

import re
import shutil

import pytest
from repository import copy_repository, run_snakemake_with_forks

REDRAW = ("-s", "workflow/redraw.smk", "--config", "study=tiny")
#: Figures that are drawn again: maps, curves against the cutoff, and single symbols.
DRAWN_AGAIN = ("fig1", "fig6", "fig_features")


@pytest.mark.study
def test_figures_and_pages_are_redrawn_from_the_datasets_alone(finished, tmp_path):
    study = copy_repository(tmp_path / "downloaded")
    results = study / "results/tiny"
    (results / "figures/.origin").mkdir(parents=True)
    finished_results = finished / "results/tiny"
    package_lists = ("environment.txt", "lock.txt")
    copied_paths = [
        *(finished / "results" / name for name in package_lists),
        *(path for path in finished_results.glob("*.*") if path.suffix in (".nc", ".csv", ".yaml")),
        *(path for path in finished_results.glob("figures/[!.]*") if path.stem not in DRAWN_AGAIN),
        *finished_results.glob("figures/.origin/*"),
    ]
    for path in copied_paths:
        shutil.copyfile(path, study / path.relative_to(finished))
    run = run_snakemake_with_forks(study, *REDRAW, "--verbose")
    assert run.returncode == 0, run.stdout[-3000:]
    jobs = set(re.findall(r"^(?:local)?rule (\w+):", run.stdout, re.M)) - {"redraw"}
    assert jobs == {f"draw_{name}" for name in DRAWN_AGAIN} | {"answer_paper"}
    # Nothing is computed: no store, only the lists of packages.
    result_folders = {path.name for path in (study / "results").iterdir()}
    assert result_folders == {"tiny", *package_lists}
    finished_paths = [*(finished_results / "figures").glob("[!.]*")]
    finished_paths += (finished_results / "report").glob("*.html")
    finished_paths += (finished_results / name for name in ("answer.html", "answer.json"))
    for path in finished_paths:
        redrawn_path = results / path.relative_to(finished_results)
        assert redrawn_path.read_bytes() == path.read_bytes(), path
