"""Faults in the table of statements are refused before a run."""

import pandas as pd
import pytest
from refusals import refusal
from repository import ROOT

from hardcontact.base.published import CLAIMS
from hardcontact.contact.contact import CONTACT_MODELS
from hardcontact.inference.band_forces import BAND_PARTS
from hardcontact.inference.published_fit import PAIRS
from hardcontact.paper.claims.selection import LABELS, SURFACES
from hardcontact.paper.claims.statements import check_claims
from hardcontact.paper.classical_comparison import METRIC_PREFIXES
from hardcontact.paper.classical_models import CLASSICAL_MODELS, Roughness
from hardcontact.paper.contact_dependence import SCALED_QUANTITIES
from hardcontact.paper.posterior import NONE_LEFT_OUT
from hardcontact.surfaces.synthesis import SIDES

TABLE = pd.read_csv(ROOT / CLAIMS, dtype=str, keep_default_na=False)


def test_the_statements_of_the_paper_are_accepted():
    check_claims(ROOT / CLAIMS)


#: Columns that accept a stray character.
TEXTS = ["section", "statement", "number", "unit", "note"]


@pytest.mark.parametrize("column", TABLE.columns.drop(TEXTS))
def test_a_stray_character_is_refused_with_its_line_and_column(tmp_path, column):
    path = tmp_path / "claims.csv"
    table = TABLE.copy()
    table.loc[3, column] += "§;"
    table.to_csv(path, index=False)
    assert f"claims.csv: line 5: {column}: expected" in refusal(check_claims, path)


@pytest.mark.parametrize(
    ("column", "cell", "end"),
    [
        ("quantity", "best_eror", "found best_eror (did you mean best_error?)"),
        ("quantity", "depth", "found depth"),  # of the indents, not of the topography in this line
        ("id", TABLE.id[1], f"each once, found {TABLE.id[1]} again"),
        ("number", " ", "found ''"),
        ("dataset", "topografy", "found topografy (did you mean topography?)"),
        ("select", "surface=ncdd", "ncd, mcd, ruby, found ncdd (did you mean ncd?)"),
        ("select", "surface=mcd>unc,ncd", "found unc (did you mean uncd?)"),
        ("select", "surfaces=mcd", "found surfaces (did you mean surface?)"),
        ("select", "rho=far", "expected rho as a number, found far"),
        ("rule", "close", "expected interval, factor 2, below, above or order, found 'close'"),
        ("samples_from", "posterior", "sets for the dataset topography, found posterior"),
    ],
)
def test_a_faulty_cell_is_refused_with_its_line_and_column(tmp_path, column, cell, end):
    path = tmp_path / "claims.csv"
    table = TABLE.copy()
    table.loc[3, column] = cell
    table.to_csv(path, index=False)
    message = refusal(check_claims, path)
    assert f"claims.csv: line 5: {column}: expected" in message and message.endswith(end)


def test_an_open_quote_is_refused_in_one_line(tmp_path):
    path = tmp_path / "claims.csv"
    lines = (ROOT / CLAIMS).read_text("utf-8").splitlines()
    path.write_text("\n".join([*lines[:4], f'"{lines[4]}', *lines[5:]]), "utf-8")
    assert "claims.csv: expected" in refusal(check_claims, path)


def test_labels_of_claims_are_those_of_the_library():
    library = {
        "contact_model": CONTACT_MODELS, "side": SIDES, "pair": PAIRS, "metrics": METRIC_PREFIXES,
        "model": CLASSICAL_MODELS, "rms_parameter": Roughness._fields,
        "exponent_of": SCALED_QUANTITIES, "band_part": BAND_PARTS,
        "left_out": [NONE_LEFT_OUT, *SURFACES],
    }  # fmt: skip
    assert {name: [*labels] for name, labels in library.items()} == {
        name: [*LABELS[name]] for name in library
    }
