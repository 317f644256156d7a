"""A changed key or column repeats exactly its dependents in a study of the user's surfaces."""

import re

import pandas as pd
import pytest
import yaml
from repository import snakemake_outputs

pytestmark = pytest.mark.study


def words_of_dry_run(*overlays):
    """Return the words of a dry run of the study that all tests share."""
    files = ["config/several.yaml", "few.yaml", *overlays]
    return ["-n", "--configfile", *files, "--config", "effort=quick"]


def rules_of(output):
    """Return the rules in the output of a dry run."""
    return set(re.findall(r"^(?:local)?rule (\w+):\n", output, re.M)) - {"all"}


# Rules that a change repeats

PAGE = {"answer_surfaces", "describe_study"}
EDGES = {"find_edges_of_scans", "compute_force_dataset"}
FORCES = {"compute_pull_off", "aggregate_adhesion", "fit_measured"} | EDGES
OCTAVES = {"compute_octave_forces", "aggregate_sensitivity"}
HINDCAST = {"compute_hindcast_forces", "aggregate_hindcast"} | EDGES
FILTERED = {"compute_filtered_forces", "aggregate_filtered_forces"}
MASTERS = {"synthesize_masters"} | FILTERED | EDGES
SPECTRA = {
    "measure_spectrum", "sample_spectra", "aggregate_spectra",
    "combine_spectra", "combine_sampled_spectra",
}  # fmt: skip
#: The table of roughness of all surfaces, and its readers.
TOPOGRAPHY = {"aggregate_topography", "compute_force_dataset", "fit_measured"}
SCANS = {"prepare_scan", "combine_scans"} | TOPOGRAPHY


COLUMN = {"read_scan"} | SCANS | SPECTRA | FORCES | OCTAVES | HINDCAST | MASTERS
#: An overlay, and the rules that depend on what it changes besides PAGE.
CHANGES = [
    ({"adhesion": {"work": "60 mJ/m2"}}, {"compute_force_dataset", "fit_measured"}),
    ({"scan": {"levelling": "lines"}}, SCANS | SPECTRA | FORCES | OCTAVES | HINDCAST | MASTERS),
    ({"contact": {"preload": "20 uN"}}, FORCES | OCTAVES | HINDCAST | FILTERED),
    ({"surfaces": "changed.tsv"}, COLUMN),
]


def test_a_change_repeats_exactly_its_dependents_and_no_change_nothing(own_study):
    """The digest of the rows of a surface is part of the paths of all its files."""
    table = pd.read_csv(
        own_study / "config/several.tsv", sep="\t", dtype=str, keep_default_na=False
    )
    table.loc[table.surface == "twin", "tip_radius"] = "20 nm"
    table.to_csv(own_study / "changed.tsv", sep="\t", index=False)
    runs = [words_of_dry_run()]
    for number, (overlay, _) in enumerate(CHANGES):
        (own_study / f"{number}.yaml").write_text(yaml.safe_dump(overlay))
        runs.append(words_of_dry_run(f"{number}.yaml"))
    unchanged, *planned = snakemake_outputs(own_study, runs)
    assert rules_of(unchanged) == set()
    assert [rules_of(output) for output in planned] == [rules | PAGE for _, rules in CHANGES]
    changed_row = planned[-1]
    assert "/twin/" in changed_row
    assert not re.search(r"^    output: .*/my_film/", changed_row, re.M)
