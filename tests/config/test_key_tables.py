"""The model, the configuration and their documentation say the same."""

import pytest
import yaml
from repository import PAPER, QUICK, ROOT, leaves

from hardcontact.config import key_tables
from hardcontact.config.model import Study

DOCUMENTATION = (ROOT / "config/README.md").read_text("utf-8")
ROWS_OF_KEYS = DOCUMENTATION.partition("<!-- keys: begin -->")[2].splitlines()


def test_the_configuration_and_its_documentation_are_made_from_the_model():
    instead = "not current: run python -m hardcontact.config.key_tables"
    assert key_tables.configuration() == (ROOT / "config/config.yaml").read_text("utf-8"), instead
    assert key_tables.documented(DOCUMENTATION) == DOCUMENTATION, instead


def test_the_configuration_of_the_paper_has_every_key_and_its_default():
    assert Study.model_validate(PAPER) == Study()
    assert sorted(leaves(PAPER)) == sorted(leaves(Study().model_dump(warnings=False)))


def test_the_quick_study_changes_known_keys_only():
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    assert set(leaves(quick)) <= set(leaves(PAPER))


@pytest.mark.parametrize(
    ("key", "parts"),
    [
        ("contact.hardness", ["1000 to 1e+13 Pa", "`25 GPa`", "Intrinsic Work of Adhesion"]),
        ("scales.small.pixels", ["32 to 32768, a multiple of 2", "`8192`"]),
        ("scales.small.cutoffs", ["a list: 0.01 to 1e+09 nm", "14 values, `5 nm` to `2500 nm`"]),
        ("scales.sphere_roughness", ["`true` or `false`", "`false`"]),
        ("scans", ["`all` or a list: 1 to 9999", "`all`"]),
        ("topography.slope", ["`gradient` or `profile`"]),
    ],
)
def test_a_row_names_values_with_their_unit_and_the_default(key, parts):
    (row,) = (line for line in ROWS_OF_KEYS if line.startswith(f"| `{key}` |"))
    assert set(parts) <= set(row.strip("| ").split(" | ")), row
