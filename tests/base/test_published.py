"""The tables of the paper's numbers, as the study reads them."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from hardcontact.base import published

PAPER = Path(__file__).parents[2] / "resources" / "paper"


def test_constants_have_the_published_values():
    constants = published.read_constants(PAPER / "parameters.csv")
    assert constants.loc["range_of_adhesion", ["value", "uncertainty"]].tolist() == [5.6, 0.5]
    assert constants.value["short_edge"] == 43
    assert np.isnan(constants.uncertainty["short_edge"])
    assert constants.index.is_unique


def test_pairs_include_the_published_pair_and_their_shares_add_up_to_one():
    pairs = pd.read_csv(PAPER.parent / "adhesion/pairs.csv", index_col="pair")
    constants = published.read_constants(PAPER / "parameters.csv").value
    assert pairs.range_of_adhesion_nm["published"] == constants["range_of_adhesion"]
    assert pairs.work_of_adhesion_J_m2["published"] == constants["work_of_adhesion"]
    assert pairs.share_of_sets.sum() == pytest.approx(1)


def test_printed_statistics_keep_their_digits():
    text = published.read_printed_statistics(PAPER / "pull_off.csv")
    assert text.mean_force["uncd"] == "0.4e-6"
    numbers = published.read_measured_statistics(PAPER / "pull_off.csv")
    assert text.astype(float).equals(numbers)


def test_importing_does_not_load_xarray():
    code = "import sys, hardcontact.base.published; sys.exit('xarray' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
