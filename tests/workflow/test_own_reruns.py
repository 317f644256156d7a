"""In a study of your surfaces, a change repeats exactly what depends on it."""

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


def test_a_key_repeats_its_dependents_a_row_those_of_its_surface_and_no_change_nothing(own_study):
    """The digest of the rows of a surface is part of the paths of all its files."""
    table = pd.read_csv(
        own_study / "config/several.tsv", sep="\t", dtype=str, keep_default_na=False
    )
    table.loc[table.surface == "twin", "tip_radius"] = "20 nm"
    table.to_csv(own_study / "changed.tsv", sep="\t", index=False)
    overlays = {
        "work.yaml": {"adhesion": {"work": "60 mJ/m2"}},
        "row.yaml": {"surfaces": "changed.tsv"},
    }
    for name, overlay in overlays.items():
        (own_study / name).write_text(yaml.safe_dump(overlay))
    runs = [words_of_dry_run(), *(words_of_dry_run(name) for name in overlays)]
    outputs = snakemake_outputs(own_study, runs)
    unchanged, other_work, _ = (
        set(re.findall(r"^(?:local)?rule (\w+):\n", output, re.M)) - {"all"} for output in outputs
    )
    assert unchanged == set()
    pages = {"answer_surfaces", "describe_study"}
    assert other_work == {"compute_force_dataset", "fit_measured"} | pages
    assert "/twin/" in outputs[-1]
    assert not re.search(r"^    output: .*/my_film/", outputs[-1], re.M)
