"""The tables of the paper's numbers, as the study reads them."""

import re
from pathlib import Path

import pandas as pd
import pytest
from full_study import read_full_study

from hardcontact.base import published

PAPER = Path(__file__).parents[2] / "resources" / "paper"


def test_pairs_include_the_published_pair_and_their_shares_add_up_to_one():
    pairs = pd.read_csv(PAPER.parent / "adhesion/pairs.csv", index_col="pair")
    constants = published.read_constants(PAPER / "constants.csv").value
    assert pairs.range_of_adhesion_nm["published"] == constants["range_of_adhesion"]
    assert pairs.work_of_adhesion_J_m2["published"] == constants["work_of_adhesion"]
    assert pairs.share_of_sets.sum() == pytest.approx(1)


def test_inferred_pairs_are_those_of_the_sets_of_the_full_study():
    pairs = pd.read_csv(PAPER.parent / "adhesion/pairs.csv", index_col="pair").drop("published")
    full_study = read_full_study()["value"]
    for column in pairs.columns[:3]:
        quantity = re.sub("_nm$|_J_m2$", "", column)
        for pair, value in pairs[column].items():
            assert float(f"{full_study[f'{pair}.{quantity}']:.2g}") == value
