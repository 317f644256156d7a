"""The tables of the paper's numbers, as the study reads them."""

from pathlib import Path

import pandas as pd
import pytest

from hardcontact.base import published

PAPER = Path(__file__).parents[2] / "resources" / "paper"


def test_pairs_include_the_published_pair_and_their_shares_add_up_to_one():
    pairs = pd.read_csv(PAPER.parent / "adhesion/pairs.csv", index_col="pair")
    constants = published.read_constants(PAPER / "constants.csv").value
    assert pairs.range_of_adhesion_nm["published"] == constants["range_of_adhesion"]
    assert pairs.work_of_adhesion_J_m2["published"] == constants["work_of_adhesion"]
    assert pairs.share_of_sets.sum() == pytest.approx(1)
