"""Studies of own surfaces made again: the same, or what a change of a key or a column concerns."""

import re

import pandas as pd
import pytest
import yaml
from own_studies import changed, quick
from refusals import assert_says


@pytest.mark.study
def test_the_same_study_made_again_is_the_same(folder, probe, tmp_path):
    first = {name: (probe / name).read_bytes() for name in ("answer.json", "answer.html")}
    for made_of_it in (probe, folder / "results/store-probe-quick"):
        made_of_it.rename(tmp_path / made_of_it.name)
    run = quick(folder, "probe")
    assert run.returncode == 0, run.stdout[-3000:]
    assert {name: (probe / name).read_bytes() for name in first} == first


@pytest.mark.study
def test_a_second_run_has_nothing_to_do(folder, probe):
    assert_says(quick(folder, "probe", "-n").stdout, "Nothing to be done")


# What a change makes again


PAGE = {"answer_surfaces", "keep_configuration", "describe_crate"}
FORCES = {
    "compute_pull_off", "measure_window_change", "aggregate_adhesion", "predict_force",
    "fit_forces",
}  # fmt: skip
MASTERS = {
    "synthesize_masters", "filter_masters", "aggregate_scales", "find_band_edges",
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
    "scan.undefined_pixels": ("harmonic", {"read_scan"} | SCANS | SPECTRA | FORCES | MASTERS),
    "contact.preload": ("20 uN", FORCES | {"filter_masters", "aggregate_scales",
                                           "find_band_edges"}),
}  # fmt: skip


def planned(run):
    """Return the rules of a dry run."""
    assert run.returncode == 0, run.stdout
    return set(re.findall(r"^(?:local)?rule (\w+):\n", run.stdout, re.M)) - {"all"}


@pytest.mark.system
@pytest.mark.parametrize("key", KEYS)
def test_a_key_makes_again_what_depends_on_it(folder, measured, key):
    value, rules = KEYS[key]
    for part in reversed(key.split(".")):
        value = {part: value}
    (folder / "other.yaml").write_text(yaml.safe_dump(value))
    assert planned(quick(folder, "pair", "-n", overlays=["other.yaml"])) == rules | PAGE


@pytest.mark.system
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


@pytest.mark.system
@pytest.mark.parametrize("column", COLUMNS)
def test_a_column_makes_again_what_depends_on_it(folder, measured, column):
    text, rules = COLUMNS[column]
    path = folder / "config/pair.tsv"
    table = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    table.loc[len(table) - 1, column] = text
    with changed(path, table.to_csv(sep="\t", index=False)):
        assert planned(quick(folder, "pair", "-n")) == rules | PAGE
