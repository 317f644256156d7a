"""Statements of the paper are checked before a job removes verdicts that were good."""

import pandas as pd
import pytest
from refusals import refusal
from repository import ROOT

from hardcontact.config.claim_table import refuse_claims
from hardcontact.run.checks import CLAIMS

TABLE = pd.read_csv(ROOT / CLAIMS, dtype=str, keep_default_na=False)


def test_the_statements_of_the_paper_are_accepted():
    refuse_claims(ROOT / CLAIMS)


TEXTS = ["section", "statement", "number", "unit", "note"]


@pytest.mark.parametrize("column", TABLE.columns.drop(TEXTS))
def test_a_stray_character_is_refused_with_its_line_and_column(tmp_path, column):
    path = tmp_path / "claims.csv"
    table = TABLE.copy()
    table.loc[3, column] += "§;"
    table.to_csv(path, index=False)
    assert f"claims.csv: line 5: {column}: expected" in refusal(refuse_claims, path)


@pytest.mark.parametrize(
    ("column", "cell"), [("quantity", "best_eror"), ("quantity", "depth"), ("number", " ")]
)
def test_an_unknown_quantity_and_a_number_without_a_name_are_refused(tmp_path, column, cell):
    """The depth is a variable of the indents, not of the topography in this line."""
    path = tmp_path / "claims.csv"
    table = TABLE.copy()
    table.loc[3, column] = cell
    table.to_csv(path, index=False)
    assert f"claims.csv: line 5: {column}: expected" in refusal(refuse_claims, path)


def test_an_open_quote_is_refused_in_one_line(tmp_path):
    path = tmp_path / "claims.csv"
    lines = (ROOT / CLAIMS).read_text("utf-8").splitlines()
    path.write_text("\n".join([*lines[:4], f'"{lines[4]}', *lines[5:]]), "utf-8")
    assert "claims.csv: expected" in refusal(refuse_claims, path)
