"""The table of experiments: read with its priors, all that is wrong with it told at once."""

import csv

import pytest
from refusals import assert_says
from repository import ROOT

from hardcontact.config.configuration import read_yaml
from hardcontact.config.experiments import EXPERIMENTS, EXPERIMENTS_SCHEMA, PRIORS, experiments
from hardcontact.insight.experiments import Cell

SCHEMA = read_yaml(str(ROOT / EXPERIMENTS_SCHEMA))


def read(path):
    return experiments(str(path), str(ROOT / PRIORS), SCHEMA)


@pytest.fixture
def changed(tmp_path):
    """Writes the table with cells of its first rows changed."""

    def written(*changes):
        with open(ROOT / EXPERIMENTS, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        for row, change in zip(rows, changes, strict=False):
            row.update(change)
        path = tmp_path / "experiments.csv"
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
        return path

    return written


def test_cells_are_read_and_unknown_ones_have_their_prior():
    found = {one.id: one for one in read(ROOT / EXPERIMENTS)}
    laitinen = found["laitinen"]
    assert laitinen.cells["rms_height_nm"] == Cell("stated", 1.5, 1.5)
    assert laitinen.cells["radius_nm"] == Cell("assumed", 1000, 20000)
    assert laitinen.cells["hurst"] == Cell("unknown", 0.4, 0.95)
    assert laitinen.missing == [] and found["chai"].missing == ["measured", "radius_nm"]
    assert {"hard", "soft", "wet"} == {one.contact for one in found.values()}


def test_every_fault_is_told_in_one_line(changed):
    path = changed(
        {"radius_nm": "250000", "contact": "dry"},
        {"id": "thimons_uncd", "rms_height_nm": "stated 20..10"},
        {"rule": "interval", "high": ""},
        {"measured": ""},
        {"measured": "3"},
    )
    with pytest.raises(ValueError) as caught:
        read(path)
    said = sorted(str(caught.value).splitlines())
    assert len(said) == 7
    assert_says(said[0], "line 2", "contact", "hard or soft or wet", "dry")
    assert_says(said[1], "line 2", "radius_nm", "stated", "unknown", "250000")
    assert_says(said[2], "line 3", "id", "thimons_uncd")
    assert_says(said[3], "line 3", "rms_height_nm", "ascend", "stated 20..10")
    assert_says(said[4], "line 4", "rule", "limit")
    assert_says(said[5], "line 5", "measured", "nothing", "above")
    assert_says(said[6], "line 6", "measured", "3", "interval")


def test_units_and_heights_that_cannot_be_are_refused(changed):
    swapped = {"rms_height_nm": "stated 17", "rougher_rms_height_nm": "stated 4"}
    with pytest.raises(ValueError) as caught:
        read(changed(swapped, {"radius_nm": "stated 0.25", "hardness_GPa": "stated 25e9"}))
    said = sorted(str(caught.value).splitlines())
    assert_says(said[0], "line 2", "rougher_rms_height_nm", "stated 17", "stated 4")
    assert_says(said[1], "line 3", "hardness_GPa", "200", "25e9")
    assert_says(said[2], "line 3", "radius_nm", "between 1", "0.25")


def test_other_columns_are_refused(tmp_path):
    path = tmp_path / "experiments.csv"
    path.write_text("id,force\none,1\n")
    with pytest.raises(ValueError, match="expected the columns id, label.* found id, force"):
        read(path)
