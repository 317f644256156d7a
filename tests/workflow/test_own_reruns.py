"""A changed key or column repeats exactly its dependents in a study of the user's surfaces."""

import re

import pandas as pd
import pytest
import yaml
from own_studies import change_file
from repository import snakemake_output, snakemake_outputs

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
EDGES = {"find_edges_of_scans", "compute_force_at_pair"}
FORCES = {"compute_pull_off", "aggregate_adhesion", "fit_measured"} | EDGES
OCTAVES = {"compute_octave_forces", "aggregate_sensitivity"}
HINDCAST = {"compute_hindcast_forces", "aggregate_hindcast"} | EDGES
FILTERED = {"compute_filtered_forces", "aggregate_scales"}
MASTERS = {"synthesize_masters"} | FILTERED | EDGES
SPECTRA = {
    "measure_spectrum", "sample_spectra", "aggregate_spectra",
    "combine_spectra", "combine_sampled_spectra",
}  # fmt: skip
#: The table of roughness of all surfaces, and its readers.
TOPOGRAPHY = {"aggregate_topography", "compute_force_at_pair", "fit_measured"}
SCANS = {"prepare_scan", "combine_scans"} | TOPOGRAPHY


#: A key, another value, and the rules that depend on it besides PAGE.
CHANGES = [
    ("adhesion.work", "60 mJ/m2", {"compute_force_at_pair", "fit_measured"}),
    ("scan.levelling", "lines", SCANS | SPECTRA | FORCES | OCTAVES | HINDCAST | MASTERS),
    ("contact.preload", "20 uN", FORCES | OCTAVES | HINDCAST | FILTERED),
]


def test_a_changed_key_repeats_exactly_its_dependents_and_no_change_nothing(own_study):
    """One process plans all runs, because each process takes seconds to load the library."""
    runs = [words_of_dry_run()]
    for key, value, _ in CHANGES:
        section, name = key.split(".")
        (own_study / f"{name}.yaml").write_text(yaml.safe_dump({section: {name: value}}))
        runs.append(words_of_dry_run(f"{name}.yaml"))
    unchanged, *planned = map(rules_of, snakemake_outputs(own_study, runs))
    assert unchanged == set()
    assert planned == [rules | PAGE for _, _, rules in CHANGES]


def test_a_changed_column_repeats_its_surface_alone(own_study):
    """The digest of the rows of a surface is part of the paths of all its files."""
    path = own_study / "config/several.tsv"
    table = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    table.loc[table.surface == "twin", "tip_radius"] = "20 nm"
    with change_file(path, table.to_csv(sep="\t", index=False)):
        output = snakemake_output(own_study, *words_of_dry_run())
        assert rules_of(output) == (
            {"read_scan"} | SCANS | SPECTRA | FORCES | OCTAVES | HINDCAST | MASTERS | PAGE
        )
    assert "/twin/" in output and not re.search(r"^    output: .*/my_film/", output, re.M)
