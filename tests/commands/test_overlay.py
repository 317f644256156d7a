"""The overlay and the table of surfaces: text that the study reads as it was meant."""

import pytest
import yaml
from own_entries import entry
from scan_files import scan

from hardcontact.commands.inventory import table_rows
from hardcontact.commands.new import nested, overlay_text, table_text, write_files
from hardcontact.commands.proposal import Choice
from hardcontact.config.selection import surface_table

CHOICES = [
    Choice("study", "1e3", "a name that YAML takes for a number"),
    Choice("forces", "my forces: #1.csv", ""),
    Choice("contact.count", 20, "in each direction, " * 20),
    Choice("scales.small.cutoffs", [f"{length} nm" for length in range(5, 60)], "many"),
    Choice("scales.small.pixels", 4096, ""),
    Choice("scales.range", "5.6 nm", "the paper's"),
]


def test_an_overlay_is_read_as_it_was_meant():
    text = overlay_text(["by hand", "", "# twice"], CHOICES, [Choice("study", "no", "")])
    assert yaml.safe_load(text) == nested(CHOICES, {"quick": {"study": "no"}})
    assert max(map(len, text.splitlines())) <= 100
    assert "the paper's" in text and "# many" in text


def test_later_values_replace_earlier_ones_and_nothing_else():
    base = {"scales": {"range": "1 nm", "large": {"tiles": 4}}, "seed": 1}
    changed = nested(CHOICES, base)
    assert changed["scales"]["large"] == {"tiles": 4} and changed["seed"] == 1
    assert changed["scales"]["range"] == "5.6 nm"
    assert base["scales"]["range"] == "1 nm"


def test_the_table_is_read_as_it_was_meant(tmp_path):
    paths = [str(scan(tmp_path / f"{name}.nc")) for name in "uvw"]
    spectrum, *contact = (
        entry(path=path, dataset="d", tip_given=path != paths[2]) for path in paths
    )
    text = table_text(table_rows([spectrum, *contact], contact, "10 nm"))
    (tmp_path / "own.tsv").write_text(text)
    table = surface_table(tmp_path / "own.tsv")
    assert table.path.tolist() == [paths[1], paths[2], paths[0]]
    assert table.use.tolist() == ["contact", "contact", "spectrum"]
    assert table.scan.tolist() == [1, 2, 3]
    assert table.tip_radius.tolist() == ["10 nm", "", "10 nm"]
    assert set(table.source) == {"measured"}


def test_all_files_are_written_or_none(tmp_path):
    first, second = tmp_path / "first", tmp_path / "folder"
    second.mkdir()
    (second / "kept").write_text("")
    with pytest.raises(ValueError, match="folder: expected a file to be written"):
        write_files({second: "b", first: "a"})
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]
    with pytest.raises(ValueError, match="folder: expected a file to be written"):
        write_files({first: "a", second: "b"})
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]
    write_files({first: "ä", tmp_path / "third": "b"})
    assert first.read_text("utf-8") == "ä"
