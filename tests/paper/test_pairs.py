"""The pairs at which users get forces: the published pair, and pairs inferred from sets."""

import re

import pandas as pd
import pytest
from full_study import read_full_study
from paper_numbers import PARAMETERS
from repository import ROOT

PAIRS = pd.read_csv(ROOT / "resources/adhesion/pairs.csv", index_col="pair")


def test_pairs_include_the_published_pair_and_their_shares_add_up_to_one():
    assert PAIRS.range_of_adhesion_nm["published"] == PARAMETERS["range_of_adhesion"]
    assert PAIRS.work_of_adhesion_J_m2["published"] == PARAMETERS["work_of_adhesion"]
    assert PAIRS.share_of_sets.sum() == pytest.approx(1)


def test_inferred_pairs_are_rounded_results_of_the_full_study():
    inferred_pairs = PAIRS.drop("published")
    full_study = read_full_study()["value"]
    for column in ["range_of_adhesion_nm", "work_of_adhesion_J_m2", "share_of_sets"]:
        quantity = re.sub("_nm$|_J_m2$", "", column)
        for pair, value in inferred_pairs[column].items():
            assert float(f"{full_study[f'{pair}.{quantity}']:.2g}") == value
