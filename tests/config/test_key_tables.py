"""The model, the configuration and their documentation say the same."""

import pytest
import yaml
from repository import PAPER, QUICK, ROOT, ROWS, leaves

from hardcontact.config.key_tables import documented
from hardcontact.config.model import Study, section
from hardcontact.config.selection import SurfaceRow

DOCUMENTATION = (ROOT / "config/README.md").read_text("utf-8")
ROWS_OF_KEYS = DOCUMENTATION.partition("<!-- keys: begin -->")[2].splitlines()
KEYS = list(leaves(PAPER))


def field(key):
    above, _, name = key.rpartition(".")
    return section(above).model_fields[name]


def test_the_configuration_of_the_paper_has_every_key_and_its_default():
    assert Study.model_validate(PAPER) == Study()
    assert sorted(KEYS) == sorted(leaves(Study().model_dump(warnings=False)))
    for key in KEYS:
        text = PAPER
        for part in key.split("."):
            text = text[part]
        assert field(key).default == text, key


def test_the_quick_study_changes_known_keys_only():
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    assert set(leaves(quick)) <= set(KEYS)


def test_the_tables_of_the_documentation_are_those_of_the_model():
    current = documented(DOCUMENTATION)
    assert current == DOCUMENTATION, "not current: run python -m hardcontact.config.key_tables"


def test_every_key_and_column_has_a_row_that_says_what_it_means():
    assert list(SurfaceRow.model_fields)[:6] == ROWS.splitlines()[0].split("\t")
    for name in [*KEYS, *SurfaceRow.model_fields]:
        (row,) = (line for line in ROWS_OF_KEYS if line.startswith(f"| `{name}` |"))
        _, meaning, values, *others = row.strip("| ").split(" | ")
        assert meaning.strip() and values.strip() and all(others[2:]), row


@pytest.mark.parametrize(
    ("key", "parts"),
    [
        ("contact.hardness", ["1000 to 1e+13 Pa", "`25 GPa`", "Intrinsic Work of Adhesion"]),
        ("scales.small.pixels", ["32 to 32768, a multiple of 2", "`8192`"]),
        ("scales.small.cutoffs", ["a list: 0.01 to 1e+09 nm", "14 values, `5 nm` to `2500 nm`"]),
        ("scales.sphere_roughness", ["`true` or `false`", "`false`"]),
        ("indent.preloads", ["a list: 1e-12 to 1 N", "`[10 uN, 20 uN]`"]),
        ("scans", ["`all` or a list: 1 to 9999", "`all`"]),
        ("topography.slope", ["`gradient` or `profile`"]),
    ],
)
def test_a_row_names_values_with_their_unit_and_the_default(key, parts):
    (row,) = (line for line in ROWS_OF_KEYS if line.startswith(f"| `{key}` |"))
    assert set(parts) <= set(row.strip("| ").split(" | ")), row
